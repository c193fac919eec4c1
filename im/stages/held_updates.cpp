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
  if (subscriber >= subscriptions_.size()) subscriptions_.resize(subscriber + std::size_t{1});
  subscriptions_[subscriber] = region;
  Parts::set_subscription_region(subscriber, region);
}

void HeldUpdates::remove_entity(Entity entity) {
  Parts::remove_entity(entity);
  if (entity >= places_.size()) return;
  places_[entity].is_new = true;
  if (entity >= near_.size()) return;
  for (const Subscriber subscriber : near_[entity].span()) {
    known_.erase(subscriber, entity);
    held_.erase(subscriber, entity);
  }
  near_[entity].clear();
}

void HeldUpdates::remove_subscriber(Subscriber subscriber) {
  Parts::remove_subscriber(subscriber);
  if (subscriber < known_.size())
    for (const Known& known : known_[subscriber].span()) forget(subscriber, known.entity);
  known_.remove_subscriber(subscriber);
  held_.remove_subscriber(subscriber);
}

/// Takes the subscriber out of the list of those for whom `entity` is relevant.
void HeldUpdates::forget(Subscriber subscriber, Entity entity) {
  assert(entity < near_.size());
  Buffer<Subscriber>& near = near_[entity];
  Subscriber* const place = std::find(near.data(), near.data() + near.size(), subscriber);
  assert(place != near.data() + near.size());
  *place = near[near.size() - 1];
  near.resize(near.size() - 1);
}

std::span<const Change> HeldUpdates::match() {
  ++now_;
  const std::span<const Change> changes = parts_.front()->match();
  move_places();
  take(changes);
  due_.clear();
  for (Subscriber subscriber = 0; subscriber < held_.size(); ++subscriber) {
    Buffer<Held>& pairs = held_[subscriber];
    if (pairs.empty()) continue;
    pairs_tested_ += pairs.size();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Place& place = places_[pairs[i].entity];
      if (place.matched_at == now_) pairs[i].way += distance(place.before, place.middle);
    }
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
  for (const Entity entity : touched_.span()) {
    Place& place = places_[entity];
    const Half middle = middle_of(place.region);
    place.before = std::exchange(place.is_new, false) ? middle : place.middle;
    place.middle = middle;
    place.matched_at = now_;
    if (std::exchange(place.is_updated, false)) hold(entity);
    place.is_listed = false;
  }
  touched_.clear();
}

/// Adds an update of `entity` to what each of its subscribers was not told yet. A subscriber for
/// whom the entity becomes relevant at this match is not among them, since it is sent the whole
/// state.
void HeldUpdates::hold(Entity entity) {
  if (entity >= near_.size()) return;
  for (const Subscriber subscriber : near_[entity].span()) {
    Buffer<Held>& pairs = held_.list_of(subscriber);
    ++pairs_tested_;
    if (Held* const held = PairLists<Held>::find(pairs, entity)) ++held->updates;
    else PairLists<Held>::insert(pairs, {entity, 1, now_ - 1, places_[entity].before, 0.0, false});
  }
}

void HeldUpdates::take(std::span<const Change> changes) {
  for (const auto& [subscriber, entity, transition, tier] : changes) {
    assert(transition == Transition::entered || transition == Transition::left);
    if (entity >= near_.size()) near_.resize(entity + std::size_t{1});
    if (transition == Transition::entered) {
      PairLists<Known>::insert(known_.list_of(subscriber), {entity});
      near_[entity].push_back(subscriber);
    } else {
      known_.erase(subscriber, entity);
      held_.erase(subscriber, entity);
      forget(subscriber, entity);
    }
  }
}

void HeldUpdates::tell(Subscriber subscriber, Buffer<Held>& pairs) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!pairs[i].is_due) {
      pairs[kept++] = pairs[i];
      continue;
    }
    updates_ += pairs[i].updates;
    ++told_;
    due_.push_back({subscriber, pairs[i].entity, Transition::due});
  }
  pairs.resize(kept);
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

/// Asserts that lists are in order, that both directions of pairs agree, and that of no pair that
/// is not relevant anything is held back.
void HeldUpdates::check() const {
  [[maybe_unused]] std::size_t near_count = 0, known_count = 0;
  for (const Buffer<Subscriber>& near : near_) near_count += near.size();
  known_.check([&](const Known& known) {
    ++known_count;
    return known.entity < places_.size() && !places_[known.entity].is_new;
  });
  assert(near_count == known_count);
  held_.check([this](const Held& held) {
    return held.entity < near_.size() && !near_[held.entity].empty() && held.updates > 0 &&
           held.since < now_ && !held.is_due && held.way >= 0.0;
  });
}

}  // namespace rink::im
