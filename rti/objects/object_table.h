// Every registered object with its latest values, in dense slots.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rti/federate_ambassador.h"
#include "rti/fom/fom.h"
#include "rti/objects/bitmap.h"
#include "rti/wire/bytes.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Index into the table; used again some time after the object is gone.
using ObjectSlot = std::uint32_t;
inline constexpr ObjectSlot no_object = 0xffffffffu;
inline constexpr std::uint32_t no_federate = 0xffffffffu;  ///< in place of a federate's slot: none

struct Object {
  ObjectHandle handle;
  static constexpr std::uint32_t no_negotiation = 0xffffffffu;
  std::uint32_t owner = 0;  ///< slot of the federate that owns every attribute; no_federate if
                            ///< several do or some are unowned (rti/ownership)
  std::uint32_t negotiation = no_negotiation;  ///< the ownership's record, if it has one
  std::uint16_t object_class = 0;
  bool is_alive = false;
  bool is_leaving = false;      ///< deleted at a logical time that some have not reached: not
                                ///< discovered any more
  AttributeSet valued;          ///< attributes that have a value
  AttributeSet changed_static;  ///< static ones that were given a second value all the same
  std::string name;
  std::vector<std::byte> fixed;  ///< coded values of fixed size, at the class's offsets
  std::vector<std::vector<std::byte>> varying;  ///< coded values of varying size, by attribute

  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, handle, owner, negotiation, object_class, is_alive, is_leaving, valued,
                    changed_static, name, fixed, varying);
  }
};

/// Latest values serve federates that join late or get an object into scope; storing one touches
/// one object only.
class ObjectTable {
 public:
  explicit ObjectTable(const Fom& fom);

  ObjectSlot insert(ObjectHandle handle, std::uint32_t owner, std::uint16_t object_class,
                    std::string_view name);
  /// Keeps the slot until `recycle`, so that this tick's messages about the object cannot be taken
  /// for those about a new one.
  void erase(ObjectSlot slot);
  void recycle();

  ObjectSlot find(ObjectHandle handle) const;
  Object& operator[](ObjectSlot slot) { return objects_[slot]; }
  const Object& operator[](ObjectSlot slot) const { return objects_[slot]; }
  ObjectSlot slot_count() const { return static_cast<ObjectSlot>(objects_.size()); }
  std::size_t size() const { return size_; }
  /// The living objects of a class, without those of its subclasses.
  const Bitmap& of_class(std::uint16_t object_class) const { return classes_[object_class].slots; }
  std::size_t count_of_class(std::uint16_t object_class) const {
    return classes_[object_class].count;
  }
  /// True if an object of this handle exists or existed; handles are not used twice.
  bool was_registered(ObjectHandle handle) const;
  /// Uses the handle up without an object.
  void pass_over(ObjectHandle handle);
  /// Living objects whose handles are in `block`.
  std::uint32_t alive_in(std::uint32_t block) const {
    return block < blocks_.size() ? blocks_[block].alive : 0;
  }
  /// No more objects will be registered in `block`: its memory is freed with the last of them.
  void close_block(std::uint32_t block);
  /// Calls `visit(slot)` for each living object whose handle is in `block`.
  template <class Visit>
  void for_each_in_block(std::uint32_t block, Visit visit) const {
    if (block >= blocks_.size()) return;
    const std::vector<ObjectSlot>& slots = blocks_[block].slots;
    for (std::size_t i = 0; i < slots.size(); ++i)
      if (slots[i] != no_object) visit(slots[i]);
  }

  /// `coded` must be the values of `set` as they travel.
  void store(ObjectSlot slot, AttributeSet set, Bytes coded);
  /// The coded value of an attribute, which must have one; valid until the next is stored.
  Bytes value(ObjectSlot slot, AttributeHandle attribute) const;
  /// Appends the coded values of `set`, all of which must be valued.
  void append(ObjectSlot slot, AttributeSet set, std::vector<std::byte>& bytes) const;
  /// The static attributes of the object if each has the only value that it ever had: who was sent
  /// them needs them no more.
  AttributeSet settled_static(ObjectSlot slot) const {
    const Object& object = objects_[slot];
    const AttributeSet statics = layouts_[object.object_class].statics;
    const bool is_settled =
        object.valued.includes(statics) && (object.changed_static & statics).is_empty();
    return is_settled ? statics : AttributeSet();
  }
  /// The bytes that `append` would append.
  std::size_t size_of(ObjectSlot slot, AttributeSet set) const;
  /// Asserts that handles and slots lead to each other, that each slot is alive, leaving or free,
  /// and that counts are right.
  void check() const;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, classes_, objects_, free_, leaving_, blocks_, size_);
  }

 private:
  struct Block {
    std::vector<ObjectSlot> slots;  ///< by number; no_object where none exists now
    std::uint32_t registered = 0;   ///< numbers below were used; they come in order
    std::uint32_t alive = 0;
    bool is_closed = false;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, slots, registered, alive, is_closed);
    }
  };
  Block& block_of(ObjectHandle handle);
  struct Layout {
    std::vector<std::uint32_t> offsets;  ///< of fixed attributes
    std::uint32_t fixed_size = 0;
    bool has_varying = false;
    AttributeSet statics;
  };
  std::vector<Layout> layouts_;  ///< by class
  struct Members {
    Bitmap slots;
    std::size_t count = 0;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, slots, count);
    }
  };
  std::vector<Members> classes_;  ///< by class
  const Fom& fom_;
  std::vector<Object> objects_;
  std::vector<ObjectSlot> free_, leaving_;
  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

}  // namespace rink::rti
