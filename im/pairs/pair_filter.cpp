// Gathers the pairs to ask about into arrays, so that a function is called once for many.
#include "im/pairs/pair_filter.h"

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "im/marks.h"
#include "im/pairs/parties.h"
#include "im/schemes/candidate_pairs.h"
#include "im/schemes/odometer.h"
#include "im/schemes/overlap_filter.h"

namespace rink::im {
namespace {

constexpr float never_rests = -std::numeric_limits<float>::infinity();

/// More than the rounding errors of a few sums and products of the coordinates of a region.
double rounding(const rink_party& party) {
  return 1e-12 * std::max(std::max(std::abs(party.low_x), std::abs(party.high_x)),
                          std::max(std::abs(party.low_y), std::abs(party.high_y))) +
         1e-300;
}

class PairFilter final : public OverlapFilter {
 public:
  PairFilter(const Region& world, std::unique_ptr<PairFunction> predicate, PairScope scope)
      : OverlapFilter(scope == PairScope::all ? Region{} : world),
        predicate_(std::move(predicate)),
        uses_(predicate_->uses()),
        is_everywhere_(scope == PairScope::all),
        may_rest_(uses_ == PairUses{} && !is_everywhere_),
        entity_parties_(uses_),
        subscriber_parties_(uses_) {}

  void set_update_region(Entity entity, const Region& region) override {
    const bool was_swept = swept_entities_.unset(entity);
    place_entity(entity, region, was_swept);
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    const bool was_swept = swept_subscribers_.unset(subscriber);
    place_subscriber(subscriber, region, was_swept);
  }
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override {
    if (from == to) return set_update_region(entity, from);
    place_entity(entity, hull_of(from, to), swept_entities_.set(entity));
  }
  void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                     const Region& to) override {
    if (from == to) return set_subscription_region(subscriber, from);
    place_subscriber(subscriber, hull_of(from, to), swept_subscribers_.set(subscriber));
  }
  void remove_entity(Entity entity) override {
    OverlapFilter::remove_entity(entity);
    swept_entities_.unset(entity);
    entity_parties_.remove(entity);
    pairs_.remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    OverlapFilter::remove_subscriber(subscriber);
    swept_subscribers_.unset(subscriber);
    subscriber_parties_.remove(subscriber);
    pairs_.remove_subscriber(subscriber);
  }
  void set_entity_role(Entity entity, const Role& role) override {
    note(entities_, entity, entity_parties_.set_role(entity, role));
  }
  void set_subscriber_role(Subscriber subscriber, const Role& role) override {
    note(subscribers_, subscriber, subscriber_parties_.set_role(subscriber, role));
  }
  void set_entity_facts(Entity entity, const Facts& facts) override {
    note(entities_, entity, entity_parties_.set_facts(entity, facts));
  }
  void set_subscriber_facts(Subscriber subscriber, const Facts& facts) override {
    note(subscribers_, subscriber, subscriber_parties_.set_facts(subscriber, facts));
  }
  void set_heading(Subscriber subscriber, const Heading& heading) override {
    note(subscribers_, subscriber, subscriber_parties_.set_heading(subscriber, heading));
  }
  void set_time(double now) override {
    assert(std::isfinite(now));
    if (uses_.age && std::exchange(now_, now) != now) is_older_ = true;
  }
  Traits traits() const override {
    return {.uses_roles = uses_.roles,
            .uses_headings = uses_.motion,
            .uses_facts = uses_.motion || uses_.age,
            .uses_time = uses_.age};
  }
  std::span<const Change> match() override {
    const std::span<const Change> box_changes = find();
    const bool is_stale = entity_parties_.take_stale() | subscriber_parties_.take_stale();
    if (std::exchange(is_older_, false) || is_stale) {
      entity_parties_.age(now_), subscriber_parties_.age(now_);
      asks_all_ = true;
      for (Subscriber subscriber = 0; subscriber < subscribers_.size(); ++subscriber)
        pairs_.touch(subscriber);
    }
    for (const Subscriber subscriber : subscribers_.moved()) pairs_.touch(subscriber);
    for (const Entity entity : entities_.moved()) pairs_.touch_near(entity);
    if (may_rest_) entity_ways_.follow(entities_), subscriber_ways_.follow(subscribers_);
    pairs_.visit_touched(box_changes,
                         [this](Subscriber subscriber, const CandidatePairs::List& list) {
                           gather(subscriber, list);
                         });
    ask();
    asks_all_ = false;
    changes_.clear();
    pairs_.report(changes_);
    settle(changes_.span());
    return changes_.span();
  }

 private:
  /// So many pairs are asked about at once that the call counts for little.
  static constexpr std::size_t enough = 512;

  void place_entity(Entity entity, const Region& region, bool is_news) {
    is_news |= entity_parties_.place(entity, region);
    OverlapFilter::set_update_region(entity, is_everywhere_ ? Region{} : region);
    note(entities_, entity, is_news && (is_everywhere_ || !entities_.has_moved(entity)));
  }
  void place_subscriber(Subscriber subscriber, const Region& region, bool is_news) {
    is_news |= subscriber_parties_.place(subscriber, region);
    OverlapFilter::set_subscription_region(subscriber, is_everywhere_ ? Region{} : region);
    note(subscribers_, subscriber,
         is_news && (is_everywhere_ || !subscribers_.has_moved(subscriber)));
  }
  /// Something changed beside the region that the engine knows.
  void note(RegionHistory& regions, std::uint32_t id, bool is_news) {
    if (!is_news) return;
    regions.touch(id);
    ++counters_.regions_moved;
  }
  bool is_swept(Subscriber subscriber, Entity entity) const {
    return swept_entities_.has(entity) || swept_subscribers_.has(subscriber);
  }

  void gather(Subscriber subscriber, const CandidatePairs::List& list) {
    const bool asks = asks_all_ || subscribers_.has_moved(subscriber);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Entity entity = list.entity(i);
      if (!asks && !entities_.has_moved(entity)) continue;
      if (may_rest_ && way(subscriber, entity) < static_cast<double>(list.rests_until(i))) continue;
      pairs_asked_.push_back({subscriber, entity});
      places_.push_back(static_cast<std::uint32_t>(i));
    }
    if (pairs_asked_.size() >= enough) ask();
  }
  double way(Subscriber subscriber, Entity entity) const {
    return entity_ways_[entity] + subscriber_ways_[subscriber];
  }
  void ask() {
    const std::size_t count = pairs_asked_.size();
    if (count == 0) return;
    counters_.pairs_tested += count;
    results_.resize(count);
    slacks_.assign(count, 0.0);
    predicate_->evaluate(
        {subscriber_parties_.data(), entity_parties_.data(), pairs_asked_.data(), count},
        results_.data(), slacks_.data());
    for (std::size_t i = 0; i < count; ++i) {
      const auto [subscriber, entity] = pairs_asked_[i];
      if (is_swept(subscriber, entity)) pairs_.decide(subscriber, places_[i], true, never_rests);
      else pairs_.decide(subscriber, places_[i], results_[i] != 0.0, rests_until(i));
    }
    pairs_asked_.clear(), places_.clear();
  }
  /// Rounded down; where nothing is known it is always over.
  float rests_until(std::size_t i) const {
    const auto [subscriber, entity] = pairs_asked_[i];
    if (!may_rest_ || !(slacks_[i] > 0.0)) return never_rests;
    const double slack = slacks_[i] - rounding(subscriber_parties_.data()[subscriber]) -
                         rounding(entity_parties_.data()[entity]);
    const auto until = static_cast<float>(std::min(way(subscriber, entity) + slack, 1e30));
    return slack > 0.0 ? until - until * 0x1p-20f : never_rests;
  }

  std::unique_ptr<PairFunction> predicate_;
  PairUses uses_;
  bool is_everywhere_, may_rest_;
  bool is_older_ = false, asks_all_ = false;
  double now_ = 0.0;
  Parties entity_parties_, subscriber_parties_;
  CandidatePairs pairs_;
  Marks swept_entities_, swept_subscribers_;
  Odometer entity_ways_, subscriber_ways_;
  std::vector<rink_pair> pairs_asked_;
  std::vector<std::uint32_t> places_;  // of each in its subscriber's list
  std::vector<double> results_, slacks_;
  Buffer<Change> changes_;
};

}  // namespace

std::unique_ptr<Filter> make_pair_filter(const FilterSettings& settings,
                                         std::unique_ptr<PairFunction> predicate, PairScope scope) {
  assert(predicate != nullptr);
  return std::make_unique<PairFilter>(settings.world, std::move(predicate), scope);
}

}  // namespace rink::im
