// The time until which the known state of an object holds: the newest stamp of its owner.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "rti/objects/object_table.h"
#include "rti/ownership/ownership.h"
#include "rti/types.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// The state of a federate's objects holds at least until its latest update of any of them.
class NewestStamps {
 public:
  NewestStamps(const ObjectTable& objects, const Ownership& ownership)
      : objects_(objects), ownership_(ownership) {}

  void joined(std::uint32_t slot) {
    if (slot >= newest_.size()) newest_.resize(slot + 1);
    newest_[slot] = {};
  }
  void left(std::uint32_t slot) { newest_[slot] = {}; }
  /// Notes the stamp of the federate's latest update.
  void note(std::uint32_t slot, const Stamp& stamp) {
    assert(slot < newest_.size());
    newest_[slot] = stamp;
  }
  /// Notes the stamp of an update that may have been overtaken on its way.
  void note_unless_older(std::uint32_t slot, const Stamp& stamp) {
    if (stamp.time >= newest_[slot].time) newest_[slot] = stamp;
  }
  void note_if_newer(std::uint32_t slot, const Stamp& stamp) {
    if (newest_[slot].time < stamp.time) newest_[slot] = stamp;
  }

  /// The newest stamp of the object's owners, but not older than a former owner's.
  Stamp of(ObjectSlot object) const {
    const std::uint32_t owner = objects_[object].owner;
    return inherited_.empty() && owner < newest_.size() ? newest_[owner] : among_owners(object);
  }
  /// The object changes owners, and its state holds until `newest` at least.
  void inherit(ObjectSlot object, const Stamp& newest) {
    assert(object < objects_.slot_count());
    if (object >= inherited_.size()) inherited_.resize(objects_.slot_count());
    inherited_[object] = newest;
  }
  void forget(ObjectSlot object) {
    if (object < inherited_.size()) inherited_[object] = {};
  }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, newest_, inherited_);
  }

 private:
  Stamp among_owners(ObjectSlot object) const;

  const ObjectTable& objects_;
  const Ownership& ownership_;
  std::vector<Stamp> newest_;     ///< by federate slot
  std::vector<Stamp> inherited_;  ///< by object slot: of former owners; as long as the last object
                                  ///< that changed hands
};

}  // namespace rink::rti
