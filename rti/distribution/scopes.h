// Each federate's scope as the last match decided it, and the objects for which it changed.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "im/change.h"
#include "rti/distribution/turns.h"
#include "rti/objects/bitmap.h"
#include "rti/objects/object_table.h"
#include "rti/types.h"

namespace rink::rti {

/// A change of scope that a federate has not been sent yet.
struct ScopeEvent {
  ObjectSlot slot;
  im::Transition transition;
};

/// One federate's scope, as the last match decided it.
struct FederateInterest {
  std::uint32_t federate = 0;
  Bitmap known;             ///< discovered and not removed
  Bitmap in_scope;          ///< of the last match
  Bitmap needs_full_state;  ///< came into scope since the last flush: the full state is due
  bool needs_any_full_state = false;
  Bitmap holds_static;  ///< objects whose static values it was sent since it discovered them
  Bitmap holds_former;  ///< objects whose newest values it was sent by the stream: residuals may
                        ///< refer to them, and back in scope they need not be sent again
  std::vector<ScopeEvent> events;  ///< since the last flush
  Bitmap unannounced;  ///< in scope, to be announced by a later flush; they keep `needs_full_state`
                       ///< until then
  bool has_unannounced = false;
  Bitmap unannounced_exits;  ///< went out of scope between two turns of a federate that is not
                             ///< updated at every match (rti/update_rate.h)
  bool has_unannounced_exits = false;
  std::uint32_t announced_to = 0, sent_to = 0;  ///< where the last flush without room for all of
                                                ///< `unannounced` and `needs_full_state` stopped
  std::vector<ObjectSlot> sent_now;  ///< announced and sent in full before all else in this flush,
                                     ///< since a message in time-stamp order names them
  bool is_uniform = true;  ///< all of a class's objects in scope have the same attributes:
                           ///< `by_class`; else `by_object`
  static constexpr std::uint16_t no_class = 0xffff;
  std::uint16_t host_served = no_class;  ///< the class of whose objects the host itself tells this
                                         ///< federate: the RTI keeps the scope and is silent
  std::vector<AttributeSet> by_class, by_object;
  std::unique_ptr<Turns> turns;  ///< null unless the filter makes some objects in scope wait

  /// The objects that this flush updates.
  const Bitmap& reflected() const { return turns ? turns->reflected : in_scope; }

  /// The attributes of an object that are in the federate's scope.
  AttributeSet attributes_in_scope(ObjectSlot slot, std::uint16_t object_class) const {
    if (!in_scope.contains(slot)) return {};
    return is_uniform ? by_class[object_class] : by_object[slot];
  }
};

/// Federates are dense slots, as in the federation execution.
class Scopes {
 public:
  /// Adds a federate with an empty scope. Its slot must be free (asserted).
  FederateInterest& add(std::uint32_t federate) {
    if (federate >= interests_.size()) interests_.resize(federate + std::size_t{1});
    assert(!interests_[federate]);
    interests_[federate] = std::make_unique<FederateInterest>();
    interests_[federate]->federate = federate;
    return *interests_[federate];
  }
  /// Removes a federate; all objects in its scope are touched.
  void remove(std::uint32_t federate) {
    if (is_watched_) of(federate).in_scope.for_each([this](ObjectSlot slot) { touch(slot); });
    interests_[federate].reset();
  }
  /// Valid until it is removed.
  FederateInterest& of(std::uint32_t federate) { return *interests_[federate]; }
  const FederateInterest& of(std::uint32_t federate) const { return *interests_[federate]; }
  /// Removes the object from all scopes without notifying any federate.
  void forget(ObjectSlot slot) {
    for (const std::unique_ptr<FederateInterest>& each : interests_)
      if (each) each->in_scope.erase(slot);
  }

  /// While watched, `touched` collects the objects that entered or left any federate's scope, in
  /// whole or in part, that were registered or that changed owners, until it is cleared. It may
  /// name one more than once.
  void watch(bool is_watched) { is_watched_ = is_watched; }
  void touch(ObjectSlot slot) {
    if (is_watched_) touched_.push_back(slot);
  }
  std::vector<ObjectSlot>& touched() { return touched_; }

 private:
  std::vector<std::unique_ptr<FederateInterest>> interests_;  ///< by federate; null in free slots
  bool is_watched_ = false;
  std::vector<ObjectSlot> touched_;
};

}  // namespace rink::rti
