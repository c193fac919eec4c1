// Tiers and budgets: who of those in scope is not told of yet.
#include <algorithm>

#include "im/stages/priority_order.h"
#include "rti/distribution/interest.h"

namespace rink::rti {

/// Of an entity that a subscription lets through.
void Interest::set_tier(Regional& regional, im::Entity entity, std::uint32_t tier) {
  tier = std::min(tier, Turns::tier_max);
  if (tier > regional.tiers.size()) regional.tiers.resize(tier);
  for (std::uint32_t k = 1; k <= regional.tiers.size(); ++k) {
    if (k == tier) regional.tiers[k - 1].insert(entity);
    else regional.tiers[k - 1].erase(entity);
  }
}

/// In scope without the filter's saying so.
bool Interest::never_waits(const DeclaredInterest& interest, ObjectSlot slot) {
  const Use& used = uses_[slot];
  const std::uint16_t object_class = objects_[slot].object_class;
  if (used.region == no_region || is_own(interest, slot) ||
      !interest.everywhere.expanded[object_class].is_empty())
    return true;
  return used.region != several && std::ranges::any_of(interest.regionals, [&](const auto& each) {
           return !each.is_placed && !each.classes.expanded[object_class].is_empty() &&
                  overlaps(each, used.region);
         });
}

/// The nearest in which some subscription has it; 0 if one hears of it without the filter's saying
/// so.
void Interest::place_in_tier(DeclaredInterest& interest, ObjectSlot slot, bool is_new) {
  const Use& used = uses_[slot];
  std::uint32_t tier =
      used.entity == no_entity || never_waits(interest, slot) ? 0 : Turns::tier_max;
  for (const Regional& each : interest.regionals) {
    if (tier == 0 || !(each.is_placed && each.inside.contains(used.entity))) continue;
    std::uint32_t own = 0;
    for (std::uint32_t k = 1; k <= each.tiers.size(); ++k)
      if (each.tiers[k - 1].contains(used.entity)) own = k;
    tier = std::min(tier, own);
  }
  Turns& turns = *interest.turns;
  bool is_changed = false;
  for (std::uint32_t k = 1; k <= Turns::tier_max; ++k) {
    Bitmap& tiers = turns.tiers[k - 1];
    if (tiers.contains(slot) == (k == tier)) continue;
    is_changed = true;
    if (k == tier) tiers.insert(slot);
    else tiers.erase(slot);
  }
  if (is_changed && !is_new) turns.prompt.insert(slot);
}

void Interest::take_turns(std::uint32_t federate) {
  DeclaredInterest& interest = *federates_[federate];
  Turns& turns = *interest.turns;
  turns.waiting.clear();
  for (std::uint32_t k = 1; k <= Turns::tier_max; ++k) {
    const Bitmap& tier = turns.tiers[k - 1];
    const std::uint64_t turn = turn_of(match_, k);
    for (std::size_t i = 0; i < tier.word_count(); ++i)
      turns.waiting.insert_word(i, tier.word(i) & ~turn & interest.in_scope.word(i) &
                                       ~interest.fresh.word(i) & ~turns.prompt.word(i));
  }
  turns.prompt.clear();
}

/// Once for each match: what comes between two of them waits for the next.
void Interest::share_out(std::uint32_t federate, const BytesDue& bytes_due) {
  DeclaredInterest& interest = *federates_[federate];
  Turns& turns = *interest.turns;
  im::PriorityOrder& order = *filter_->priority();
  const std::size_t budget = turns.shared_out == match_ ? 0 : budget_;
  turns.shared_out = match_;
  put_off_.clear();
  sent_.clear();
  const auto due = [&](im::Entity entity) {
    std::size_t bytes = 0;
    bool is_waiting = false;
    for (const ObjectSlot slot : regions_[region_of_entity_[entity]].objects) {
      if (!interest.in_scope.contains(slot) || never_waits(interest, slot)) continue;
      is_waiting |= turns.waiting.contains(slot);
      if (!turns.waiting.contains(slot)) bytes += bytes_due(slot);
    }
    return bytes == 0 && is_waiting ? im::PriorityOrder::not_now : bytes;
  };
  const auto list = [this, &interest](im::Entity entity, Bitmap& objects) {
    for (const ObjectSlot slot : regions_[region_of_entity_[entity]].objects)
      if (!never_waits(interest, slot)) objects.insert(slot);
  };
  for (const Regional& each : interest.regionals) {
    if (!each.is_placed) continue;
    if (budget == 0) {
      each.inside.for_each([&](im::Entity entity) { list(entity, put_off_); });
      continue;
    }
    for (const im::PriorityOrder::Item& item :
         order.fill(each.subscriber, budget,
                    [&](const im::PriorityOrder::Item& asked) { return due(asked.entity); }))
      list(item.entity, sent_);
    for (const im::PriorityOrder::Item& item : order.put_off()) list(item.entity, put_off_);
  }
  for (std::size_t i = 0; i < put_off_.word_count(); ++i)
    turns.waiting.insert_word(i, put_off_.word(i) & ~sent_.word(i) & interest.in_scope.word(i));
}

}  // namespace rink::rti
