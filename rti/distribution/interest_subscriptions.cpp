// What each federate subscribes to, everywhere or within a region.
#include <algorithm>

#include "rti/distribution/interest.h"

namespace rink::rti {

void Interest::expand(ClassInterest& interest) const {
  for (std::uint32_t i = 0; i < interest.declared.size(); ++i) {
    interest.expanded[i] = interest.declared[i];
    for (ObjectClassHandle parent = fom_.at(ObjectClassHandle{i}).parent; parent;
         parent = fom_.at(parent).parent)
      interest.expanded[i] = interest.expanded[i] | interest.declared[parent.value];
  }
}

bool Interest::subscribe(std::uint32_t federate, std::uint16_t object_class,
                         const Subscription& attributes, RegionHandle region) {
  DeclaredInterest& interest = *federates_[federate];
  if (region && !has_region(federate, region)) return false;
  const RegionSlot slot = region ? slot_of(federate, region) : no_region;
  ClassInterest& classes = region ? regional(interest, slot).classes : interest.everywhere;
  classes.declared[object_class] = attributes.heard;
  const AttributeSet passive = attributes.heard.without(attributes.active);
  if (classes.passive.empty() && !passive.is_empty())
    classes.passive.resize(classes.declared.size());
  if (!classes.passive.empty()) classes.passive[object_class] = passive;
  expand(classes);
  interest.is_changed = true;
  const auto& declared = classes.declared;
  if (region && std::all_of(declared.begin(), declared.end(),
                            [](AttributeSet set) { return set.is_empty(); }))
    drop_regional(interest, slot);
  return true;
}

Subscription Interest::subscribed(std::uint32_t federate, std::uint16_t object_class,
                                  RegionHandle region) const {
  const DeclaredInterest& interest = *federates_[federate];
  const auto of = [object_class](const ClassInterest& classes) {
    const AttributeSet heard = classes.declared[object_class];
    return Subscription{
        heard, classes.passive.empty() ? heard : heard.without(classes.passive[object_class])};
  };
  if (!region) return of(interest.everywhere);
  for (const Regional& each : interest.regionals)
    if (each.region == slot_of(federate, region)) return of(each.classes);
  return {};
}

Subscription Interest::subscribed_anywhere(std::uint32_t federate,
                                           std::uint16_t object_class) const {
  const DeclaredInterest& interest = *federates_[federate];
  Subscription all{interest.everywhere.expanded[object_class],
                   active(interest.everywhere, object_class)};
  for (const Regional& each : interest.regionals) {
    all.heard = all.heard | each.classes.expanded[object_class];
    all.active = all.active | active(each.classes, object_class);
  }
  return all;
}

bool Interest::subscribe_interaction(std::uint32_t federate, std::uint16_t interaction_class,
                                     RegionHandle region, Listening listening) {
  if (!has_region(federate, region)) return false;
  auto& interactions = federates_[federate]->interactions;
  const RegionSlot slot = slot_of(federate, region);
  std::erase_if(interactions, [&](const auto& each) {
    return each.interaction_class == interaction_class && each.region == slot;
  });
  if (listening != Listening::none)
    interactions.push_back({interaction_class, slot, listening == Listening::passive});
  return true;
}

Listening Interest::subscribes_interaction(std::uint32_t federate,
                                           std::uint16_t interaction_class) const {
  Listening found = Listening::none;
  for (const auto& each : federates_[federate]->interactions) {
    if (!fom_.is_a(InteractionClassHandle{interaction_class},
                   InteractionClassHandle{each.interaction_class}))
      continue;
    if (!each.is_passive) return Listening::active;
    found = Listening::passive;
  }
  return found;
}

bool Interest::hears(std::uint32_t federate, std::uint16_t interaction_class, std::uint32_t sender,
                     std::span<const RegionHandle> sent) {
  for (const auto& each : federates_[federate]->interactions) {
    if (!fom_.is_a(InteractionClassHandle{interaction_class},
                   InteractionClassHandle{each.interaction_class}))
      continue;
    for (const RegionHandle region : sent)
      if (regions_overlap(regions_[slot_of(sender, region)], regions_[each.region])) return true;
  }
  return false;
}

Interest::Regional& Interest::regional(DeclaredInterest& interest, RegionSlot slot) {
  for (Regional& each : interest.regionals)
    if (each.region == slot) return each;
  DistributedRegion& region = regions_[slot];
  ++region.subscription_count;
  Regional& added = interest.regionals.emplace_back();
  added.region = slot;
  added.is_placed = region.is_placed;
  added.is_planar = region.is_planar;
  added.classes.declared.resize(fom_.object_classes().size());
  added.classes.expanded = added.classes.declared;
  if (!region.is_placed) {
    ++unplaced_subscription_count_;
    return added;
  }
  if (free_subscribers_.empty()) {
    free_subscribers_.push_back(static_cast<im::Subscriber>(subscribers_.size()));
    subscribers_.emplace_back();
  }
  added.subscriber = free_subscribers_.back();
  free_subscribers_.pop_back();
  subscribers_[added.subscriber] = interest.federate;
  if (!region.is_committed) return added;
  filter_->set_subscription_region(added.subscriber, region.plane);
  tell_subscriber(interest, added.subscriber);
  return added;
}

void Interest::drop_regional(DeclaredInterest& interest, RegionSlot slot) {
  const auto found = std::ranges::find(interest.regionals, slot, &Regional::region);
  if (found == interest.regionals.end()) return;
  --regions_[slot].subscription_count;
  if (found->is_placed) {
    filter_->remove_subscriber(found->subscriber);
    free_subscribers_.push_back(found->subscriber);
  } else {
    --unplaced_subscription_count_;
  }
  interest.regionals.erase(found);
  interest.is_changed = true;
}

void Interest::list_regions_of_interest(std::vector<RegionOfInterest>& regions) const {
  for (const auto& interest : federates_) {
    if (!interest) continue;
    for (const Regional& each : interest->regionals) {
      const DistributedRegion& region = regions_[each.region];
      if (region.is_placed && region.is_committed)
        regions.push_back({interest->federate, region.plane});
    }
  }
}

}  // namespace rink::rti
