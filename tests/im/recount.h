// Interest by brute force: every pair looked at anew, written apart from the filters that it judges.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "im/filter.h"

namespace rink::im {

using Pairs = std::set<std::pair<Subscriber, Entity>>;
using Relevant = std::function<bool(const Region& subscription, const Region& update)>;

/// The nearest point of `update` is in the closed disc that `subscription` holds. Wide enough that only rounding of a 64th bit could matter.
inline bool disc_touches(const Region& subscription, const Region& update) {
  const auto offset = [](long double low, long double high, long double update_low, long double update_high) {
    const long double middle = (low + high) / 2.0L;
    return std::clamp(middle, update_low, update_high) - middle;
  };
  const long double radius = std::min((subscription.high_x - 0.0L - subscription.low_x) / 2.0L, (subscription.high_y - 0.0L - subscription.low_y) / 2.0L);
  const long double x = offset(subscription.low_x, subscription.high_x, update.low_x, update.high_x);
  const long double y = offset(subscription.low_y, subscription.high_y, update.low_y, update.high_y);
  return radius * radius >= x * x + y * y;
}

/// What each scheme promises, one pair at a time.
inline Relevant rule_of(const std::string& scheme, const FilterSettings& settings) {
  if (scheme == "none") return [](const Region&, const Region&) { return true; };
  if (scheme == "region")
    return [](const Region& s, const Region& u) {
      return !(u.high_x < s.low_x || s.high_x < u.low_x || u.high_y < s.low_y || s.high_y < u.low_y);
    };
  if (scheme == "aura") return disc_touches;
  return [settings](const Region& s, const Region& u) {
    const auto cell = [&](double coordinate, double origin) { return std::floor((coordinate - origin) / settings.cell_size); };
    const double column = cell((u.low_x + u.high_x) / 2.0, settings.world.low_x), row = cell((u.low_y + u.high_y) / 2.0, settings.world.low_y);
    return cell(s.low_x, settings.world.low_x) <= column && column <= cell(s.high_x, settings.world.low_x) &&
           cell(s.low_y, settings.world.low_y) <= row && row <= cell(s.high_y, settings.world.low_y);
  };
}

/// A filter together with all it was told, its reported changes replayed, and the rule it must agree with.
class Judged {
 public:
  Judged(const std::string& scheme, const FilterSettings& settings) : Judged(make_filter(scheme, settings), rule_of(scheme, settings)) {}
  Judged(std::unique_ptr<Filter> filter, Relevant relevant) : filter_(std::move(filter)), relevant_(std::move(relevant)) {}

  void move_entity(Entity entity, const Region& region) {
    filter_->set_update_region(entity, region);
    entities_[entity] = region;
  }
  void move_subscriber(Subscriber subscriber, const Region& region) {
    filter_->set_subscription_region(subscriber, region);
    subscribers_[subscriber] = region;
  }
  /// Its caller knows: pairs with the removed one are dropped without a word from the filter.
  void remove_entity(Entity entity) {
    filter_->remove_entity(entity);
    entities_.erase(entity);
    std::erase_if(known_, [entity](const auto& pair) { return pair.second == entity; });
  }
  void remove_subscriber(Subscriber subscriber) {
    filter_->remove_subscriber(subscriber);
    subscribers_.erase(subscriber);
    std::erase_if(known_, [subscriber](const auto& pair) { return pair.first == subscriber; });
  }

  /// Replays one match: ordered, each change news, and the sum of all of them equal to the recount.
  void check_match() {
    const auto changes = filter_->match();
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const Change& change = changes[i];
      const std::pair pair{change.subscriber, change.entity};
      if (i > 0) {
        ASSERT_LT(std::pair(changes[i - 1].subscriber, changes[i - 1].entity), pair) << "out of order or doubled";
      }
      const bool is_news = change.transition == Transition::entered ? known_.insert(pair).second : known_.erase(pair) == 1;
      ASSERT_TRUE(is_news) << "subscriber " << pair.first << " entity " << pair.second;
    }
    ASSERT_EQ(known_, recount());
  }

  Pairs recount() const {
    Pairs pairs;
    for (const auto& [subscriber, subscription] : subscribers_)
      for (const auto& [entity, update] : entities_)
        if (relevant_(subscription, update)) pairs.insert({subscriber, entity});
    return pairs;
  }

  const std::map<Entity, Region>& entities() const { return entities_; }
  const std::map<Subscriber, Region>& subscribers() const { return subscribers_; }
  Filter& filter() { return *filter_; }

 private:
  std::unique_ptr<Filter> filter_;
  Relevant relevant_;
  std::map<Entity, Region> entities_;
  std::map<Subscriber, Region> subscribers_;
  Pairs known_;
};

}  // namespace rink::im
