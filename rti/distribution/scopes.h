// What is in each federate's scope, as the last match decided it, and for which objects that
// changed.
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

/// A change that a federate has not been told yet.
struct ScopeEvent {
  ObjectSlot slot;
  im::Transition transition;
};

/// What is in one federate's scope, as the last match decided it.
struct FederateInterest {
  std::uint32_t federate = 0;
  Bitmap known;             ///< discovered and not removed
  Bitmap in_scope;          ///< of the last match
  Bitmap needs_full_state;  ///< came into scope since the last flush: the whole state is due
  bool needs_any_full_state = false;
  std::vector<ScopeEvent> events;  ///< since the last flush
  Bitmap unannounced;  ///< in scope, and it will be told so by a later flush; their states stay
                       ///< fresh until then
  bool has_unannounced = false;
  std::uint32_t announced_to = 0, sent_to = 0;  ///< where the last flush without room for all of
                                                ///< `unannounced` and `needs_full_state` stopped
  std::vector<ObjectSlot> sent_now;  ///< announced, and their state told, before all else in this
                                     ///< flush, since something in time-stamp order speaks of them
  bool is_uniform = true;  ///< all of a class's objects in scope have the same attributes:
                           ///< `by_class`; else `by_object`
  std::vector<AttributeSet> by_class, by_object;
  std::unique_ptr<Turns> turns;  ///< null unless the filter says that some of those in scope wait

  /// The objects that the flush at hand updates.
  const Bitmap& reflected() const { return turns ? turns->reflected : in_scope; }

  /// The attributes of an object that are in its scope.
  AttributeSet attributes_in_scope(ObjectSlot slot, std::uint16_t object_class) const {
    if (!in_scope.contains(slot)) return {};
    return is_uniform ? by_class[object_class] : by_object[slot];
  }
};

/// Federates are dense slots, as in the federation execution.
class Scopes {
 public:
  /// Nothing is in its scope. The slot must be free (asserted).
  FederateInterest& add(std::uint32_t federate) {
    if (federate >= interests_.size()) interests_.resize(federate + std::size_t{1});
    assert(!interests_[federate]);
    interests_[federate] = std::make_unique<FederateInterest>();
    interests_[federate]->federate = federate;
    return *interests_[federate];
  }
  /// All that was in its scope is touched.
  void remove(std::uint32_t federate) {
    if (is_watched_) of(federate).in_scope.for_each([this](ObjectSlot slot) { touch(slot); });
    interests_[federate].reset();
  }
  /// Valid until it is removed.
  FederateInterest& of(std::uint32_t federate) { return *interests_[federate]; }
  const FederateInterest& of(std::uint32_t federate) const { return *interests_[federate]; }
  /// Nobody has the object in scope any more, and no federate is notified.
  void forget(ObjectSlot slot) {
    for (const std::unique_ptr<FederateInterest>& each : interests_)
      if (each) each->in_scope.erase(slot);
  }

  /// While it is watched, `touched` lists the objects that came into or went out of anybody's
  /// scope, in whole or in part, or were registered or changed hands, until it is cleared; it may
  /// name one more than once.
  void watch(bool is_watched) { is_watched_ = is_watched; }
  void touch(ObjectSlot slot) {
    if (is_watched_) touched_.push_back(slot);
  }
  std::vector<ObjectSlot>& touched() { return touched_; }

 private:
  std::vector<std::unique_ptr<FederateInterest>> interests_;  ///< by federate; null where nobody is
  bool is_watched_ = false;
  std::vector<ObjectSlot> touched_;
};

}  // namespace rink::rti
