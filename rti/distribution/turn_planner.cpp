// Plans turns and shares out budgets. An object that waits is updated later by its newest state
// alone, so a missed turn costs nothing.
#include "rti/distribution/turn_planner.h"

#include <algorithm>
#include <cassert>

#include "im/stages/priority_order.h"

namespace rink::rti {

TurnPlanner::TurnPlanner(im::Filter& filter, const ObjectTable& objects, const RegionTable& regions,
                         const Subscriptions& subscriptions, const FilterFacts& facts)
    : filter_(filter),
      objects_(objects),
      regions_(regions),
      subscriptions_(subscriptions),
      facts_(facts),
      decides_tiers_(filter.traits().decides_tiers),
      holds_updates_(filter.traits().holds_updates),
      budget_(filter.priority() ? filter.priority()->budget() : 0) {}

/// True if the object is in scope by a subscription on which the filter does not decide.
bool TurnPlanner::never_waits(const DeclaredInterest& declared, ObjectSlot slot) const {
  const RegionTable::Use& used = regions_.use_of(slot);
  const std::uint16_t object_class = objects_[slot].object_class;
  if (used.region == no_region || facts_.is_own(declared.federate, slot) ||
      !declared.everywhere.expanded[object_class].is_empty())
    return true;
  return used.region != RegionTable::several &&
         std::ranges::any_of(declared.regionals, [&](const Subscriptions::Regional& each) {
           return !each.is_placed && !each.classes.expanded[object_class].is_empty() &&
                  subscriptions_.is_within(each, used.region);
         });
}

/// Held while no subscription without bounds has it in scope.
bool TurnPlanner::is_held(const DeclaredInterest& declared, ObjectSlot slot) const {
  return holds_updates_ && regions_.use_of(slot).entity != RegionTable::no_entity &&
         !never_waits(declared, slot);
}

std::uint32_t TurnPlanner::tier_of(const DeclaredInterest& declared, ObjectSlot slot) const {
  const RegionTable::Use& used = regions_.use_of(slot);
  std::uint32_t tier =
      used.entity == RegionTable::no_entity || never_waits(declared, slot) ? 0 : Turns::tier_max;
  for (const Subscriptions::Regional& each : declared.regionals) {
    if (tier == 0 || !(each.is_placed && each.inside.contains(used.entity))) continue;
    std::uint32_t own = 0;
    for (std::uint32_t k = 1; k <= each.tiers.size(); ++k)
      if (each.tiers[k - 1].contains(used.entity)) own = k;
    tier = std::min(tier, own);
  }
  return tier;
}

void TurnPlanner::place(Turns& turns, const DeclaredInterest& declared, ObjectSlot slot,
                        bool is_new) const {
  assert(places_objects());
  const std::uint32_t tier = tier_of(declared, slot);
  bool is_changed = false;
  if (const bool is_held_now = is_held(declared, slot); is_held_now != turns.held.contains(slot)) {
    is_changed = true;
    if (is_held_now) turns.held.insert(slot);
    else turns.held.erase(slot);
  }
  for (std::uint32_t k = 1; k <= Turns::tier_max; ++k) {
    Bitmap& tiers = turns.tiers[k - 1];
    if (tiers.contains(slot) == (k == tier)) continue;
    is_changed = true;
    if (k == tier) tiers.insert(slot);
    else tiers.erase(slot);
  }
  if (is_changed && !is_new) turns.prompt.insert(slot);
}

void TurnPlanner::plan_turns(FederateInterest& interest) const {
  assert(is_needed() && interest.turns);
  Turns& turns = *interest.turns;
  turns.waiting.clear();
  for (std::size_t i = 0; i < turns.held.word_count(); ++i)
    turns.waiting.insert_word(i, turns.held.word(i) & interest.in_scope.word(i) &
                                     ~interest.needs_full_state.word(i) & ~turns.prompt.word(i));
  const std::uint64_t number = turns.number > 0 ? turns.number : match_;
  for (std::uint32_t k = 1; k <= Turns::tier_max; ++k) {
    const Bitmap& tier = turns.tiers[k - 1];
    const std::uint64_t turn = turn_of(number, k);
    for (std::size_t i = 0; i < tier.word_count(); ++i)
      turns.waiting.insert_word(i, tier.word(i) & ~turn & interest.in_scope.word(i) &
                                       ~interest.needs_full_state.word(i) & ~turns.prompt.word(i));
  }
  turns.prompt.clear();
}

/// The budget is shared out once for each match; changes between two matches wait for the next.
void TurnPlanner::share_out(FederateInterest& interest,
                            const DataDistribution::BytesDue& bytes_due) {
  assert(has_budget() && interest.turns);
  Turns& turns = *interest.turns;
  assert(turns.shared_out <= match_);
  const std::size_t budget = turns.shared_out == match_ ? 0 : budget_;
  turns.shared_out = match_;
  fill(interest, bytes_due, budget);
  for (std::size_t i = 0; i < put_off_.word_count(); ++i) {
    const std::uint64_t left_out = put_off_.word(i) & ~sent_.word(i) & interest.in_scope.word(i);
    // The filter takes what it called due for told, and will not say so again.
    turns.prompt.insert_word(i, left_out & turns.held.word(i) & ~turns.waiting.word(i));
    turns.waiting.insert_word(i, left_out);
  }
}

/// Lists what fits into the budget, and what does not.
void TurnPlanner::fill(const FederateInterest& interest,
                       const DataDistribution::BytesDue& bytes_due, std::size_t budget) {
  const DeclaredInterest& declared = subscriptions_.of(interest.federate);
  const Bitmap& waiting = interest.turns->waiting;
  im::PriorityOrder& order = *filter_.priority();
  put_off_.clear();
  sent_.clear();
  const auto due = [&](im::Entity entity) {
    std::size_t bytes = 0;
    bool is_waiting = false;
    for (const ObjectSlot slot : regions_.of_entity(entity).objects) {
      if (!interest.in_scope.contains(slot) || never_waits(declared, slot)) continue;
      is_waiting |= waiting.contains(slot);
      if (!waiting.contains(slot)) bytes += bytes_due(slot);
    }
    return bytes == 0 && is_waiting ? im::PriorityOrder::not_now : bytes;
  };
  for (const Subscriptions::Regional& each : declared.regionals) {
    if (!each.is_placed) continue;
    if (budget == 0) {
      each.inside.for_each([&](im::Entity entity) { list(declared, entity, put_off_); });
      continue;
    }
    for (const im::PriorityOrder::Item& item :
         order.fill(each.subscriber, budget,
                    [&](const im::PriorityOrder::Item& asked) { return due(asked.entity); }))
      list(declared, item.entity, sent_);
    for (const im::PriorityOrder::Item& item : order.put_off())
      list(declared, item.entity, put_off_);
  }
}

void TurnPlanner::list(const DeclaredInterest& declared, im::Entity entity, Bitmap& objects) const {
  for (const ObjectSlot slot : regions_.of_entity(entity).objects)
    if (!never_waits(declared, slot)) objects.insert(slot);
}

}  // namespace rink::rti
