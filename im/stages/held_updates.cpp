// Keeps what was held back for each pair, and reports the pairs that are due.
#include "im/stages/held_updates.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "im/basics/checked.h"

namespace rink::im {

HeldUpdates::HeldUpdates(std::unique_ptr<Filter> inner, const char* name)
    : Parts(std::move(inner)), name_(name) {}

double HeldUpdates::distance(const Half& from, const Half& to) {
  const double x = to.x - from.x, y = to.y - from.y;
  return 2.0 * std::sqrt(x * x + y * y);
}

void HeldUpdates::set_update_region(Entity entity, const Region& region) {
  if (entity >= places_.size()) places_.resize(entity + std::size_t{1});
  places_[entity].region = region;
  list(entity);
  Parts::set_update_region(entity, region);
}

void HeldUpdates::note_update(Entity entity) {
  Parts::note_update(entity);
  if (entity >= places_.size()) return;
  places_[entity].is_updated = true;
  list(entity);
}

void HeldUpdates::list(Entity entity) {
  if (!std::exchange(places_[entity].is_listed, true)) touched_.push_back(entity);
}

void HeldUpdates::set_subscription_region(Subscriber subscriber, const Region& region) {
  if (subscriber >= subscriptions_.size()) {
    const std::size_t count = subscriber + std::size_t{1};
    subscriptions_.resize(count), has_untold_.resize(count);
    held_.list_of(subscriber);
  }
  subscriptions_[subscriber] = region;
  Parts::set_subscription_region(subscriber, region);
}

void HeldUpdates::remove_entity(Entity entity) {
  Parts::remove_entity(entity);
  if (entity >= places_.size()) return;
  places_[entity].is_new = true;
  held_.remove_entity(entity);
}

void HeldUpdates::remove_subscriber(Subscriber subscriber) {
  Parts::remove_subscriber(subscriber);
  held_.remove_subscriber(subscriber);
}

std::span<const Change> HeldUpdates::match() {
  ++now_;
  const std::span<const Change> changes = parts_.front()->match();
  move_places();
  take(changes);
  due_.clear();
  for (Subscriber subscriber = 0; subscriber < held_.size(); ++subscriber) {
    if (!is_any_updated_ && !has_untold_[subscriber]) continue;
    Buffer<Held>& pairs = held_[subscriber];
    pairs_tested_ += pairs.size();
    has_untold_[subscriber] = count_updates(pairs);
    if (!has_untold_[subscriber]) continue;
    judge(subscriber, {pairs.data(), pairs.size()});
    tell(subscriber, pairs);
  }
  if constexpr (checks_whole_structures) check();
  if (due_.empty()) return reported(changes);
  changes_.resize(changes.size() + due_.size());
  std::merge(changes.begin(), changes.end(), due_.data(), due_.data() + due_.size(),
             changes_.data(), [](const Change& a, const Change& b) {
               return std::pair(a.subscriber, a.entity) < std::pair(b.subscriber, b.entity);
             });
  return reported(changes_.span());
}

void HeldUpdates::move_places() {
  is_any_updated_ = false;
  for (const Entity entity : touched_.span()) {
    Place& place = places_[entity];
    const Half middle = middle_of(place.region);
    place.before = std::exchange(place.is_new, false) ? middle : place.middle;
    place.middle = middle;
    place.matched_at = now_;
    if (std::exchange(place.is_updated, false)) place.updated_at = now_, is_any_updated_ = true;
    place.is_listed = false;
  }
  touched_.clear();
}

/// An entity that enters is told in full.
void HeldUpdates::take(std::span<const Change> changes) {
  for (const Change& change : changes) {
    assert(change.transition == Transition::entered || change.transition == Transition::left);
    Buffer<Held>& pairs = held_[change.subscriber];
    Held* const held = PairLists<Held>::find(pairs, change.entity);
    assert((held == nullptr) == (change.transition == Transition::entered));
    if (held) PairLists<Held>::erase(pairs, held);
    else PairLists<Held>::insert(pairs, {change.entity, 0, now_, {}, 0.0, false});
  }
}

bool HeldUpdates::count_updates(Buffer<Held>& pairs) const {
  bool has_untold = false;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Held& held = pairs[i];
    const Place& place = places_[held.entity];
    const Half& before = place.matched_at == now_ ? place.before : place.middle;
    if (place.updated_at == now_ && held.since != now_ && held.updates++ == 0)
      held = {held.entity, 1, now_ - 1, before, 0.0, false};
    if (held.updates == 0) continue;
    has_untold = true;
    held.way += distance(before, place.middle);
  }
  return has_untold;
}

void HeldUpdates::tell(Subscriber subscriber, Buffer<Held>& pairs) {
  bool has_untold = false;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Held& held = pairs[i];
    if (!std::exchange(held.is_due, false) || held.updates == 0) {
      has_untold |= held.updates > 0;
      continue;
    }
    updates_ += held.updates;
    ++told_;
    held = {held.entity, 0, now_, {}, 0.0, false};
    due_.push_back({subscriber, held.entity, Transition::due});
  }
  has_untold_[subscriber] = has_untold;
}

Traits HeldUpdates::traits() const {
  Traits own = Parts::traits();
  own.holds_updates = true;
  return own;
}

void HeldUpdates::list_counts(std::vector<StageCount>& counts) const {
  Parts::list_counts(counts);
  counts.push_back({name_, "updates in what was told", updates_});
  counts.push_back({name_, "told", told_});
}

/// Asserts that lists are in order, and that no pair lacks a place or was told in the future.
void HeldUpdates::check() const {
  held_.check([this](const Held& held) {
    return held.entity < places_.size() && !places_[held.entity].is_new && held.since <= now_ &&
           !held.is_due && held.way >= 0.0;
  });
}

}  // namespace rink::im
