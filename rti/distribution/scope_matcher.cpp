// Computes the scope of each pair of a federate and an object again when something of the pair has
// changed.
#include "rti/distribution/scope_matcher.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::rti {

void ScopeMatcher::match(std::span<const im::Change> changes, std::vector<ObjectSlot>& changed) {
  apply_filter_changes(changes);
  parts_.subscriptions.for_each([this](const DeclaredInterest& declared) {
    if (declared.is_changed) reconsider_all(declared);
  });
  apply_changed_regions(changed);
  for (const ObjectSlot slot : changed)
    parts_.subscriptions.for_each(
        [&](const DeclaredInterest& declared) { reconsider(declared, slot); });
  changed.clear();
}

void ScopeMatcher::apply_filter_changes(std::span<const im::Change> changes) {
  // All memberships come first: the attributes in scope may depend on several regions.
  Subscriptions& subscriptions = parts_.subscriptions;
  const bool decides_tiers = parts_.turns.decides_tiers();
  const bool holds_updates = parts_.turns.holds_updates();
  const auto is_due = [](const im::Change& each) { return each.transition == im::Transition::due; };
  for (const im::Change& each : changes)
    if (!is_due(each)) subscriptions.take(each, decides_tiers);
  for (const im::Change& each : changes) {
    // A filter takes what enters one subscription for told, though it was in another's scope.
    if (holds_updates && each.transition != im::Transition::left) prompt(each);
    if (is_due(each)) continue;
    const DeclaredInterest& declared = subscriptions.of(subscriptions.federate_of(each.subscriber));
    if (declared.is_changed) continue;
    for (const ObjectSlot slot : parts_.regions.of_entity(each.entity).objects)
      reconsider(declared, slot);
  }
}

/// What was held back of the entity waits no longer.
void ScopeMatcher::prompt(const im::Change& change) {
  FederateInterest& interest =
      parts_.scopes.of(parts_.subscriptions.federate_of(change.subscriber));
  for (const ObjectSlot slot : parts_.regions.of_entity(change.entity).objects)
    if (interest.in_scope.contains(slot)) interest.turns->prompt.insert(slot);
}

void ScopeMatcher::apply_changed_regions(std::vector<ObjectSlot>& changed) {
  for (const RegionSlot slot : parts_.regions.changed()) {
    const DistributedRegion& region = parts_.regions[slot];
    changed.insert(changed.end(), region.objects.begin(), region.objects.end());
    if (region.subscription_count == 0) continue;
    const DeclaredInterest& declared = parts_.subscriptions.of(region.federate);
    for (const Regional& each : declared.regionals)
      if (each.region == slot) reconsider_around(declared, each);
  }
  parts_.regions.forget_changed();
}

/// Considers all objects that a change of the subscription's region in other dimensions may
/// concern: those that the filter lets through and those that it does not know.
void ScopeMatcher::reconsider_around(const DeclaredInterest& declared, const Regional& regional) {
  const RegionTable& regions = parts_.regions;
  if (!regional.is_placed) {
    for (ObjectSlot slot = 0; slot < regions.object_count(); ++slot)
      if (regions.use_of(slot).region != no_region) reconsider(declared, slot);
    return;
  }
  if (!regional.is_planar)
    regional.inside.for_each([&](im::Entity entity) {
      for (const ObjectSlot slot : regions.of_entity(entity).objects) reconsider(declared, slot);
    });
  for (const RegionSlot region : regions.unplaced())
    for (const ObjectSlot slot : regions[region].objects) reconsider(declared, slot);
}

/// The part of `attributes` that the regional subscription covers of an object that uses several
/// regions.
AttributeSet ScopeMatcher::covered(const Regional& regional, ObjectSlot object,
                                   AttributeSet attributes) const {
  AttributeSet placed, inside;
  for (const Association& each : parts_.regions.several_of(object)) {
    placed = placed | each.attributes;
    if (!(each.attributes & attributes).is_empty() &&
        parts_.subscriptions.is_within(regional, each.region))
      inside = inside | each.attributes;
  }
  return AttributeSet(attributes.bits & (inside.bits | ~placed.bits));
}

template <bool is_active_only>
AttributeSet ScopeMatcher::wanted(const DeclaredInterest& declared, ObjectSlot slot) const {
  const Object& object = parts_.objects[slot];
  if (!object.is_alive || object.is_leaving || object.owner == declared.federate) return {};
  const std::uint16_t object_class = object.object_class;
  const auto named_by = [&](const ClassInterest& classes) {
    return is_active_only ? parts_.subscriptions.active(classes, object_class)
                          : classes.expanded[object_class];
  };
  const auto is_own = [&] { return parts_.facts.is_own(declared.federate, slot); };
  AttributeSet set = named_by(declared.everywhere);
  const RegionTable::Use& used = parts_.regions.use_of(slot);
  for (const Regional& each : declared.regionals) {
    const AttributeSet named = named_by(each.classes);
    if (used.region == RegionTable::several) {
      set = set | (is_own() ? named : covered(each, slot, named));
      continue;
    }
    const bool is_heard =
        used.region == no_region || (used.entity != RegionTable::no_entity && each.is_placed
                                         ? each.inside.contains(used.entity)
                                         : parts_.subscriptions.is_within(each, used.region));
    if (is_heard || is_own()) set = set | named;
  }
  return object.owner == no_federate
             ? set & parts_.ownership.owned_by_others(declared.federate, slot)
             : set;
}

AttributeSet ScopeMatcher::actively_in_scope(std::uint32_t federate, ObjectSlot slot) const {
  const DeclaredInterest& declared = parts_.subscriptions.of(federate);
  const AttributeSet in_scope_now =
      parts_.scopes.of(federate).attributes_in_scope(slot, parts_.objects[slot].object_class);
  const auto is_passive = [](const Regional& each) { return !each.classes.passive.empty(); };
  const bool has_passive =
      !declared.everywhere.passive.empty() || std::ranges::any_of(declared.regionals, is_passive);
  return in_scope_now.is_empty() || !has_passive ? in_scope_now
                                                 : in_scope_now & wanted<true>(declared, slot);
}

bool ScopeMatcher::uniform_classes(const DeclaredInterest& declared,
                                   std::vector<AttributeSet>& by_class) const {
  if (parts_.regions.has_several() && !declared.regionals.empty()) return false;
  by_class = declared.everywhere.expanded;
  for (const Regional& each : declared.regionals)
    for (std::size_t i = 0; i < by_class.size(); ++i) {
      const AttributeSet set = each.classes.expanded[i];
      if (by_class[i].is_empty()) by_class[i] = set;
      else if (!set.is_empty() && set != by_class[i]) return false;
    }
  return true;
}

/// Lists all objects that are in the federate's scope or may come into it. Who joins a large world
/// and sees a small part of it is looked at in words of 64 objects for most of it: with 2,500
/// newcomers among 27,500 objects the first match took seconds when each pair was looked at.
void ScopeMatcher::list_candidates(const DeclaredInterest& declared) {
  const ObjectSlot count = parts_.objects.slot_count();
  const RegionTable& regions = parts_.regions;
  candidates_.clear();
  candidates_.insert_all(parts_.scopes.of(declared.federate).in_scope);
  const auto class_count = static_cast<std::uint16_t>(declared.everywhere.expanded.size());
  for (std::uint16_t each = 0; each < class_count; ++each)
    if (!declared.everywhere.expanded[each].is_empty())
      candidates_.insert_all(parts_.objects.of_class(each));
  if (declared.regionals.empty()) return;
  const auto is_unplaced = [](const Regional& each) { return !each.is_placed; };
  if (parts_.facts.role_of(declared.federate).owner != im::Role::none)
    for (ObjectSlot slot = 0; slot < count; ++slot)
      if (parts_.facts.is_own(declared.federate, slot)) candidates_.insert(slot);
  if (regions.has_several() || std::ranges::any_of(declared.regionals, is_unplaced)) {
    for (ObjectSlot slot = 0; slot < count; ++slot) candidates_.insert(slot);
    return;
  }
  candidates_.insert_all(regions.without_region());
  for (const RegionSlot region : regions.unplaced())
    for (const ObjectSlot slot : regions[region].objects) candidates_.insert(slot);
  for (const Regional& each : declared.regionals)
    each.inside.for_each([&](im::Entity entity) {
      for (const ObjectSlot slot : regions.of_entity(entity).objects) candidates_.insert(slot);
    });
}

void ScopeMatcher::reconsider_all(const DeclaredInterest& declared) {
  parts_.subscriptions.clear_changed(declared.federate);
  FederateInterest& interest = parts_.scopes.of(declared.federate);
  std::vector<AttributeSet> by_class, by_object;
  const bool is_uniform = uniform_classes(declared, by_class);
  // Else four bytes per object of the world would come and go with every client, and leave holes
  // in the heap.
  if (!is_uniform) by_object.resize(parts_.objects.slot_count());
  list_candidates(declared);
  candidates_.for_each([&](ObjectSlot slot) {
    const AttributeSet is = wanted(declared, slot);
    settle(declared, interest, slot, is);
    if (!is_uniform) by_object[slot] = is;
  });
  interest.is_uniform = is_uniform;
  interest.by_class = std::move(by_class);
  interest.by_object = std::move(by_object);
}

void ScopeMatcher::reconsider(const DeclaredInterest& declared, ObjectSlot slot) {
  assert(slot < parts_.objects.slot_count());
  ++parts_.counters.pairs_reconsidered;
  FederateInterest& interest = parts_.scopes.of(declared.federate);
  const AttributeSet is = wanted(declared, slot);
  settle(declared, interest, slot, is);
  if (interest.is_uniform) return;
  if (slot >= interest.by_object.size()) interest.by_object.resize(parts_.objects.slot_count());
  interest.by_object[slot] = is;
}

/// Notes that the attributes `is` of an object are in a federate's scope from now on.
void ScopeMatcher::settle(const DeclaredInterest& declared, FederateInterest& interest,
                          ObjectSlot slot, AttributeSet is) {
  const AttributeSet was = interest.attributes_in_scope(slot, parts_.objects[slot].object_class);
  if (parts_.turns.places_objects() && !is.is_empty())
    parts_.turns.place(*interest.turns, declared, slot, was.is_empty());
  // An object whose scope is as before is touched, too: its subscription may be passive now.
  if (was != is || !is.is_empty()) parts_.scopes.touch(slot);
  if (was == is) return;
  if (was.is_empty()) {
    interest.in_scope.insert(slot);
    interest.events.push_back({slot, im::Transition::entered});
    ++parts_.counters.entries;
  } else if (is.is_empty()) {
    interest.in_scope.erase(slot);
    interest.events.push_back({slot, im::Transition::left});
    ++parts_.counters.exits;
  }
  if (!was.includes(is)) {
    interest.needs_full_state.insert(slot);
    interest.needs_any_full_state = true;
  }
}

}  // namespace rink::rti
