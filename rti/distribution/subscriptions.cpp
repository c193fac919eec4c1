// Each region that a federate subscribes with is one subscriber of the filter, for all classes.
#include "rti/distribution/subscriptions.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::rti {
namespace {

void set_tier(DeclaredInterest::Regional& regional, im::Entity entity, std::uint32_t tier) {
  tier = std::min(tier, Turns::tier_max);
  if (tier > regional.tiers.size()) regional.tiers.resize(tier);
  for (std::uint32_t k = 1; k <= regional.tiers.size(); ++k) {
    if (k == tier) regional.tiers[k - 1].insert(entity);
    else regional.tiers[k - 1].erase(entity);
  }
}

double area_of(const im::Region& region) {
  return (region.high_x - region.low_x) * (region.high_y - region.low_y);
}

}  // namespace

Subscriptions::Subscriptions(const Fom& fom, RegionTable& regions, im::Filter& filter,
                             const FilterFacts& facts, std::size_t newcomer_pairs_max)
    : fom_(fom),
      regions_(regions),
      filter_(filter),
      facts_(facts),
      newcomers_(newcomer_pairs_max) {}

void Subscriptions::add_federate(std::uint32_t federate) {
  if (federate >= federates_.size()) federates_.resize(federate + std::size_t{1});
  assert(!federates_[federate]);
  federates_[federate] = std::make_unique<DeclaredInterest>();
  DeclaredInterest& interest = *federates_[federate];
  interest.federate = federate;
  interest.everywhere.declared.resize(fom_.object_classes().size());
  interest.everywhere.expanded = interest.everywhere.declared;
}

void Subscriptions::remove_federate(std::uint32_t federate) {
  assert(federates_[federate]->regionals.empty());
  if (federates_[federate]->is_waiting) newcomers_.forget(federate);
  federates_[federate].reset();
}

bool Subscriptions::is_a(std::uint16_t interaction_class, std::uint16_t superclass) const {
  return fom_.is_a(InteractionClassHandle{interaction_class}, InteractionClassHandle{superclass});
}

void Subscriptions::expand(ClassInterest& interest) const {
  for (std::size_t i = 0; i < interest.declared.size(); ++i)
    interest.expanded[i] = inherited(interest, static_cast<std::uint16_t>(i));
}

AttributeSet Subscriptions::inherited(const ClassInterest& interest,
                                      std::uint16_t object_class) const {
  AttributeSet set;
  for (ObjectClassHandle each{object_class}; each; each = fom_.at(each).parent)
    set = set | interest.declared[each.value];
  return set;
}

AttributeSet Subscriptions::active(const ClassInterest& interest,
                                   std::uint16_t object_class) const {
  if (interest.passive.empty()) return inherited(interest, object_class);
  AttributeSet set;
  for (ObjectClassHandle each{object_class}; each; each = fom_.at(each).parent)
    set = set | interest.declared[each.value].without(interest.passive[each.value]);
  return set;
}

void Subscriptions::subscribe(std::uint32_t federate, std::uint16_t object_class,
                              const Subscription& attributes, RegionSlot region) {
  assert(object_class < fom_.object_classes().size());
  assert(attributes.subscribed.includes(attributes.active));
  DeclaredInterest& interest = *federates_[federate];
  const bool is_regional = region != no_region;
  Regional* const with = is_regional ? &regional(interest, region) : nullptr;
  ClassInterest& classes = with != nullptr ? with->classes : interest.everywhere;
  const AttributeSet before = std::exchange(classes.declared[object_class], attributes.subscribed);
  const AttributeSet passive = attributes.subscribed.without(attributes.active);
  if (classes.passive.empty() && !passive.is_empty())
    classes.passive.resize(classes.declared.size());
  if (!classes.passive.empty()) classes.passive[object_class] = passive;
  const auto is_empty = [](AttributeSet set) { return set.is_empty(); };
  if (is_regional && std::ranges::all_of(classes.declared, is_empty))
    return drop_regional(interest, region);
  if (!attributes.subscribed.includes(before)) {
    if (interest.is_waiting) return take_in(interest);  // nobody waits to be sent less
  } else if (interest.is_waiting ||
             !newcomers_.admit(pairs_looked_at(interest) +
                               (with != nullptr ? pairs_of(*with) : object_count(object_class)))) {
    return wait(interest);
  }
  expand(classes);
  if (with != nullptr) pass(interest, *with);
  interest.is_changed = true;
}

/// Those that a match looks at since the subscriptions of one federate are new, beside their own:
/// most objects are looked at 64 at once.
std::size_t Subscriptions::pairs_looked_at(const DeclaredInterest& interest) const {
  return interest.is_changed ? 0 : 1 + regions_.object_count() / 64;
}

/// Of the class and its subclasses.
std::size_t Subscriptions::object_count(std::uint16_t object_class) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < fom_.object_classes().size(); ++i)
    if (const auto each = static_cast<std::uint16_t>(i);
        fom_.is_a(ObjectClassHandle{each}, ObjectClassHandle{object_class}))
      count += regions_.objects().count_of_class(each);
  return count;
}

std::size_t Subscriptions::pairs_of(const Regional& regional) const {
  const DistributedRegion& region = regions_[regional.region];
  if (!region.is_placed) return regions_.object_count();
  if (!region.is_committed) return 0;
  return newcomers_.expected(area_of(region.plane), regions_.object_count());
}

std::size_t Subscriptions::pairs_of(const DeclaredInterest& interest) const {
  std::size_t pairs = pairs_looked_at(interest);
  for (std::size_t each = 0; each < interest.everywhere.declared.size(); ++each)
    if (!interest.everywhere.expanded[each].includes(interest.everywhere.declared[each]))
      pairs += object_count(static_cast<std::uint16_t>(each));
  for (const Regional& each : interest.regionals)
    if (!each.is_passed || !is_expanded(each.classes)) pairs += pairs_of(each);
  return pairs;
}

bool Subscriptions::is_expanded(const ClassInterest& interest) const {
  for (std::size_t each = 0; each < interest.declared.size(); ++each)
    if (!interest.expanded[each].includes(interest.declared[each])) return false;
  return true;
}

/// Passes the region to the filter for the first time, if there is one to pass.
void Subscriptions::pass(const DeclaredInterest& interest, Regional& regional) {
  const DistributedRegion& region = regions_[regional.region];
  if (!regional.is_placed || regional.is_passed || !region.is_committed) return;
  filter_.set_subscription_region(regional.subscriber, region.plane);
  facts_.inform_subscriber(interest.federate, regional.subscriber);
  regional.is_passed = regional.is_new = true;
  passed_.push_back({interest.federate, regional.region});
  passed_area_ += area_of(region.plane);
}

void Subscriptions::wait(DeclaredInterest& interest) {
  if (!std::exchange(interest.is_waiting, true)) newcomers_.wait(interest.federate);
}

void Subscriptions::take_in(DeclaredInterest& interest) {
  if (std::exchange(interest.is_waiting, false)) newcomers_.forget(interest.federate);
  expand(interest.everywhere);
  for (Regional& each : interest.regionals) {
    expand(each.classes);
    pass(interest, each);
  }
  interest.is_changed = true;
}

void Subscriptions::admit_waiting() {
  newcomers_.admit_waiting([this](std::uint32_t federate) { return pairs_of(of(federate)); },
                           [this](std::uint32_t federate) { take_in(*federates_[federate]); });
}

void Subscriptions::end_match() {
  newcomers_.end_match(passed_area_, found_);
  for (const Passed& each : passed_) {
    if (!federates_[each.federate]) continue;
    for (Regional& regional : federates_[each.federate]->regionals)
      if (regional.region == each.region) regional.is_new = false;
  }
  passed_.clear();
  passed_area_ = 0.0;
  found_ = 0;
}

Subscription Subscriptions::subscribed(std::uint32_t federate, std::uint16_t object_class,
                                       RegionSlot region) const {
  const DeclaredInterest& interest = *federates_[federate];
  const auto of = [object_class](const ClassInterest& classes) {
    const AttributeSet subscribed = classes.declared[object_class];
    return Subscription{subscribed, classes.passive.empty()
                                        ? subscribed
                                        : subscribed.without(classes.passive[object_class])};
  };
  if (region == no_region) return of(interest.everywhere);
  for (const Regional& each : interest.regionals)
    if (each.region == region) return of(each.classes);
  return {};
}

Subscription Subscriptions::subscribed_anywhere(std::uint32_t federate,
                                                std::uint16_t object_class) const {
  const DeclaredInterest& interest = *federates_[federate];
  Subscription all{inherited(interest.everywhere, object_class),
                   active(interest.everywhere, object_class)};
  for (const Regional& each : interest.regionals) {
    all.subscribed = all.subscribed | inherited(each.classes, object_class);
    all.active = all.active | active(each.classes, object_class);
  }
  return all;
}

void Subscriptions::subscribe_interaction(std::uint32_t federate, std::uint16_t interaction_class,
                                          RegionSlot region, Listening listening) {
  assert(region != no_region && interaction_class < fom_.interaction_classes().size());
  auto& interactions = federates_[federate]->interactions;
  std::erase_if(interactions, [&](const auto& each) {
    return each.interaction_class == interaction_class && each.region == region;
  });
  if (listening != Listening::none)
    interactions.push_back({interaction_class, region, listening == Listening::passive});
}

Listening Subscriptions::subscribes_interaction(std::uint32_t federate,
                                                std::uint16_t interaction_class) const {
  Listening found = Listening::none;
  for (const auto& each : federates_[federate]->interactions) {
    if (!is_a(interaction_class, each.interaction_class)) continue;
    if (!each.is_passive) return Listening::active;
    found = Listening::passive;
  }
  return found;
}

Subscriptions::Regional& Subscriptions::regional(DeclaredInterest& interest, RegionSlot slot) {
  for (Regional& each : interest.regionals)
    if (each.region == slot) return each;
  const DistributedRegion& region = regions_[slot];
  assert(region.exists && region.federate == interest.federate);  // a federate uses only its own
  regions_.count_subscription(slot, true);
  Regional& added = interest.regionals.emplace_back();
  added.region = slot;
  added.is_placed = region.is_placed;
  added.is_planar = region.is_planar;
  added.classes.declared.resize(fom_.object_classes().size());
  added.classes.expanded = added.classes.declared;
  if (region.is_placed) number(interest, added);
  return added;
}

void Subscriptions::number(DeclaredInterest& interest, Regional& added) {
  if (free_subscribers_.empty()) {
    free_subscribers_.push_back(static_cast<im::Subscriber>(subscribers_.size()));
    subscribers_.emplace_back();
  }
  added.subscriber = free_subscribers_.back();
  free_subscribers_.pop_back();
  subscribers_[added.subscriber] = interest.federate;
}

void Subscriptions::drop(std::uint32_t federate, RegionSlot region) {
  DeclaredInterest& interest = *federates_[federate];
  drop_regional(interest, region);
  std::erase_if(interest.interactions,
                [region](const auto& each) { return each.region == region; });
}

void Subscriptions::drop_regional(DeclaredInterest& interest, RegionSlot slot) {
  const auto found = std::ranges::find(interest.regionals, slot, &Regional::region);
  if (found == interest.regionals.end()) return;
  regions_.count_subscription(slot, false);
  if (found->is_placed) {
    filter_.remove_subscriber(found->subscriber);
    free_subscribers_.push_back(found->subscriber);
  }
  interest.regionals.erase(found);
  interest.is_changed = true;
}

void Subscriptions::follow(RegionSlot slot) {
  const DistributedRegion& region = regions_[slot];
  assert(region.is_committed);
  if (!region.is_placed || region.subscription_count == 0) return;
  DeclaredInterest& interest = *federates_[region.federate];
  for (Regional& each : interest.regionals) {
    if (each.region != slot) continue;
    if (each.is_passed) filter_.set_subscription_region(each.subscriber, region.plane);
    else if (interest.is_waiting || !newcomers_.admit(pairs_of(each))) wait(interest);
    else pass(interest, each);
  }
}

void Subscriptions::inform_filter(std::uint32_t federate) {
  for (const Regional& each : federates_[federate]->regionals)
    if (each.is_placed) facts_.inform_subscriber(federate, each.subscriber);
}

void Subscriptions::inform_headings(std::uint32_t federate) {
  for (const Regional& each : federates_[federate]->regionals)
    if (each.is_placed) facts_.inform_heading(federate, each.subscriber);
}

void Subscriptions::inform_facts(std::uint32_t federate) {
  for (const Regional& each : federates_[federate]->regionals)
    if (each.is_placed) facts_.inform_facts(federate, each.subscriber);
}

void Subscriptions::take(const im::Change& change, bool decides_tiers) {
  std::vector<Regional>& regionals = federates_[subscribers_[change.subscriber]]->regionals;
  const auto regional = std::ranges::find_if(regionals, [&](const Regional& each) {
    return each.is_placed && each.subscriber == change.subscriber;
  });
  assert(regional != regionals.end());
  const bool has_left = change.transition == im::Transition::left;
  if (regional->is_new && change.transition == im::Transition::entered) ++found_;
  if (has_left) regional->inside.erase(change.entity);
  else regional->inside.insert(change.entity);  // it may be inside already and only change its tier
  if (decides_tiers) set_tier(*regional, change.entity, has_left ? 0u : change.tier);
}

void Subscriptions::forget(im::Entity entity) {
  for (const std::unique_ptr<DeclaredInterest>& interest : federates_)
    if (interest)
      for (Regional& each : interest->regionals) each.inside.erase(entity);
}

bool Subscriptions::is_within(const Regional& regional, RegionSlot update) const {
  const DistributedRegion &region = regions_[update], &subscribed = regions_[regional.region];
  if (!regional.is_placed || !region.is_placed) return regions_.overlap(region, subscribed);
  if (!regional.inside.contains(region.entity)) return false;
  if (regional.is_planar || region.is_planar) return true;
  return regions_.overlap_beyond_plane(region, subscribed);
}

void Subscriptions::mark_regional_changed() {
  for (const std::unique_ptr<DeclaredInterest>& interest : federates_)
    if (interest && !interest->regionals.empty()) interest->is_changed = true;
}

void Subscriptions::list_regions(std::vector<RegionOfInterest>& regions) const {
  for_each([&](const DeclaredInterest& interest) {
    for (const Regional& each : interest.regionals) {
      const DistributedRegion& region = regions_[each.region];
      if (region.is_placed && region.is_committed)
        regions.push_back({interest.federate, region.plane});
    }
  });
}

}  // namespace rink::rti
