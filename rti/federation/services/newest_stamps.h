// Until when what is known of an object holds: the newest stamp of whom it belongs to.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/objects/object_table.h"
#include "rti/ownership/ownership.h"
#include "rti/types.h"

namespace rink::rti {

/// All that a federate says of its objects holds at least until its latest update.
class NewestStamps {
 public:
  NewestStamps(const ObjectTable& objects, const Ownership& ownership)
      : objects_(objects), ownership_(ownership) {}

  void joined(std::uint32_t slot) {
    if (slot >= said_.size()) said_.resize(slot + 1);
    said_[slot] = {};
  }
  void left(std::uint32_t slot) { said_[slot] = {}; }
  /// By its latest update.
  void say(std::uint32_t slot, const Stamp& stamp) { said_[slot] = stamp; }
  /// By one that may have been overtaken on its way.
  void say_unless_older(std::uint32_t slot, const Stamp& stamp) {
    if (stamp.time >= said_[slot].time) said_[slot] = stamp;
  }
  void say_if_newer(std::uint32_t slot, const Stamp& stamp) {
    if (said_[slot].time < stamp.time) said_[slot] = stamp;
  }

  /// The newest stamp of its owners, but not older than what a former owner said.
  Stamp of(ObjectSlot object) const {
    const std::uint32_t owner = objects_[object].owner;
    return inherited_.empty() && owner < said_.size() ? said_[owner] : among_owners(object);
  }
  /// It changes hands, and holds until `newest` at least.
  void inherit(ObjectSlot object, const Stamp& newest) {
    if (object >= inherited_.size()) inherited_.resize(objects_.slot_count());
    inherited_[object] = newest;
  }
  void forget(ObjectSlot object) {
    if (object < inherited_.size()) inherited_[object] = {};
  }

 private:
  Stamp among_owners(ObjectSlot object) const;

  const ObjectTable& objects_;
  const Ownership& ownership_;
  std::vector<Stamp> said_;       ///< by federate slot
  std::vector<Stamp> inherited_;  ///< by object slot: of former owners; as long as the last object
                                  ///< that changed hands
};

}  // namespace rink::rti
