// The objects that a federate registered or discovered, and those that it forgot while messages
// about them may still arrive.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/objects/known_object.h"
#include "rti/objects/object_map.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Own objects are in an array by their number within the block of handles that the RTI gave; those
/// of others, few of many, in a map, so memory follows what is in scope.
class ObjectBook {
 public:
  /// The federate has joined and received this block of handles.
  void begin(std::uint32_t block) { block_ = block; }
  /// Adds a block for when the first is used up. False if one waits already, or it is the same
  /// block.
  bool add_block(std::uint32_t block);

  /// True if the handle is in the present block.
  bool is_ours(ObjectHandle object) const { return object.value / object_block == block_; }
  /// True if this federate registered the object, also in a block that is used up: objects left of
  /// such a block are kept like those of others.
  bool was_registered_here(ObjectHandle object) const {
    return is_ours(object) || is_in_former_block(object);
  }
  /// Null if the object is not known, or its deletion is under way. Valid until an object is added
  /// or forgotten.
  const KnownObject* find(ObjectHandle object) const {
    if (!is_ours(object)) {
      const KnownObject* known = others_.find(object);
      return known != nullptr && known->object_class != KnownObject::unknown ? known : nullptr;
    }
    const std::uint32_t number = object.value % object_block;
    const bool is_known = number < own_.size() && own_[number].object_class != KnownObject::unknown;
    return is_known ? &own_[number] : nullptr;
  }
  /// True of an object that was deleted or forgotten here: messages about it were sent before the
  /// RTI knew.
  bool is_gone(ObjectHandle object) const;
  /// Calls `visit(ObjectHandle, const KnownObject&)` for each.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::uint32_t i = 0; i < own_.size(); ++i)
      if (own_[i].object_class != KnownObject::unknown) visit(handle(i), own_[i]);
    others_.for_each(visit);
  }

  /// False if every handle that the RTI gave is in use.
  bool has_handle() const { return registered_count_ < object_block || further_block_; }
  /// Registers an object, owned whole. There must be a free handle.
  ObjectHandle add(ObjectClassHandle object_class);
  /// Adds an object of another federate; false if its handle is in the present block or known
  /// already.
  bool discover(ObjectHandle object, ObjectClassHandle object_class);
  /// Notes whether all of a known object is owned here.
  void set_own(ObjectHandle object, bool is_own) { place_of(object).is_own = is_own; }

  /// The RTI has removed the object.
  void remove(ObjectHandle object);
  /// The federate deleted or forgot the object, and the RTI may not know it yet.
  void leave(ObjectHandle object);
  /// The RTI knows that the object was deleted or forgotten: no messages about it follow unless it
  /// is discovered anew.
  void settle_gone(ObjectHandle object);
  /// Forgets what was settled; called at the end of its frame.
  void sweep();
  /// The object is deleted at a later logical time; until then `restore` gives it back as it was.
  KnownObject hide(ObjectHandle object);
  void restore(ObjectHandle object, const KnownObject& known);

  std::size_t memory_bytes() const;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, block_, registered_count_, further_block_, former_blocks_, own_,
                    others_, gone_) &&
           (!Stream::is_reading || is_sound());
  }
  std::uint32_t block() const { return block_; }

 private:
  /// True if handles are within their blocks, and those of the present one apart from others.
  bool is_sound() const;
  ObjectHandle handle(std::uint32_t number) const { return {block_ * object_block + number}; }
  bool is_in_former_block(ObjectHandle object) const;
  KnownObject& place_of(ObjectHandle object);
  void begin_further_block();

  std::uint32_t block_ = 0, registered_count_ = 0;  ///< in that block
  std::optional<std::uint32_t> further_block_;
  std::vector<std::uint32_t> former_blocks_;
  std::vector<KnownObject> own_;  ///< by number within the block
  ObjectMap<KnownObject> others_;
  std::vector<GoneObject> gone_;  ///< of others
};

}  // namespace rink::rti
