// Interest by brute force: every pair looked at anew, written apart from the filters that it
// judges.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "im/filter.h"
#include "tests/im/view_truth.h"

namespace rink::im {

using Pairs = std::set<std::pair<Subscriber, Entity>>;
using Relevant = std::function<bool(
    const Observer& subscription, const Body& update)>;  // rules that know no headings fit as well

/// The nearest point of `update` is in the closed disc that `subscription` holds. Wide enough that
/// only rounding of a 64th bit could matter.
inline bool disc_touches(const Region& subscription, const Region& update) {
  const auto offset = [](long double low, long double high, long double update_low,
                         long double update_high) {
    const long double middle = (low + high) / 2.0L;
    return std::clamp(middle, update_low, update_high) - middle;
  };
  const long double radius = std::min((subscription.high_x - 0.0L - subscription.low_x) / 2.0L,
                                      (subscription.high_y - 0.0L - subscription.low_y) / 2.0L);
  const long double x =
      offset(subscription.low_x, subscription.high_x, update.low_x, update.high_x);
  const long double y =
      offset(subscription.low_y, subscription.high_y, update.low_y, update.high_y);
  return radius * radius >= x * x + y * y;
}

inline bool overlap_closed(const Region& s, const Region& u) {
  return !(u.high_x < s.low_x || s.high_x < u.low_x || u.high_y < s.low_y || s.high_y < u.low_y);
}

inline double middle(double low, double high) { return low / 2.0 + high / 2.0; }

/// The cell of the middle of `update` is one that `subscription` touches.
inline bool grid_touches(const FilterSettings& settings, const Region& s, const Region& u) {
  const auto cell = [&](double coordinate, double origin) {
    return std::floor((coordinate - origin) / settings.cell_size);
  };
  const double column = cell(middle(u.low_x, u.high_x), settings.world.low_x),
               row = cell(middle(u.low_y, u.high_y), settings.world.low_y);
  return cell(s.low_x, settings.world.low_x) <= column &&
         column <= cell(s.high_x, settings.world.low_x) &&
         cell(s.low_y, settings.world.low_y) <= row && row <= cell(s.high_y, settings.world.low_y);
}

/// The same, half-open to the last bit, at a side that is the settings' doubled until `update` does
/// not exceed it.
inline bool level_touches(const FilterSettings& settings, const Region& s, const Region& u) {
  const double longer = std::min(std::max(u.high_x - u.low_x, u.high_y - u.low_y),
                                 std::numeric_limits<double>::max() / 4.0);
  const double size =
      settings.cell_size * static_cast<double>(std::exp2(std::max(
                               0.0L, std::ceil(std::log2(longer / (settings.cell_size + 0.0L))))));
  const auto touches = [size](double origin, double centre, double low, double high) {
    const double number = std::floor((centre - origin) / size), first = origin + number * size,
                 end = origin + (number + 1.0) * size;
    return first <= high && (low < end || (first == end && low == end));
  };
  return touches(settings.world.low_x, middle(u.low_x, u.high_x), s.low_x, s.high_x) &&
         touches(settings.world.low_y, middle(u.low_y, u.high_y), s.low_y, s.high_y);
}

/// The hexagon whose middle is nearest to that of `update`, looked for among all around it (of
/// equals the right one), cut with `subscription` along the normals of all sides.
inline bool hexagon_touches(const FilterSettings& settings, const Region& s, const Region& u) {
  const double width = settings.cell_size, row_height = width * std::sqrt(3.0) / 2.0,
               x = middle(u.low_x, u.high_x), y = middle(u.low_y, u.high_y);
  const double near_row = std::floor((y - settings.world.low_y) / row_height),
               near_column = std::floor((x - settings.world.low_x) / width);
  double best = std::numeric_limits<double>::infinity(), best_x = 0.0, best_y = 0.0;
  for (int around = 0; around < 9; ++around) {
    const double row = near_row + around / 3 - 1, column = near_column + around % 3 - 1;
    const double middle_x = settings.world.low_x +
                            (column + (std::fmod(row, 2.0) == 0.0 ? 0.0 : 0.5)) * width,
                 middle_y = settings.world.low_y + row * row_height;
    const double distance = std::hypot(x - middle_x, y - middle_y);
    if (distance <= best) best = distance, best_x = middle_x, best_y = middle_y;
  }
  const double half_width = width / 2.0, half_height = width / std::sqrt(3.0);
  if (!overlap_closed(s, {best_x - half_width, best_y - half_height, best_x + half_width,
                          best_y + half_height}))
    return false;
  for (const double slope : {-std::sqrt(3.0), std::sqrt(3.0)}) {
    const double corners[] = {s.low_x + slope * s.low_y, s.low_x + slope * s.high_y,
                              s.high_x + slope * s.low_y, s.high_x + slope * s.high_y};
    const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
    if (*high < best_x + slope * best_y - width || *low > best_x + slope * best_y + width)
      return false;
  }
  return true;
}

/// Steps along the axes from the subscription's middle to the nearest point of `update`, against
/// half its shorter side.
inline bool diamond_touches(const Region& s, const Region& u) {
  if (!overlap_closed(s, u)) return false;
  const auto away = [](double at, double low, double high) {
    return at < low ? low - at : at > high ? at - high : 0.0;
  };
  return away(middle(s.low_x, s.high_x), u.low_x, u.high_x) +
             away(middle(s.low_y, s.high_y), u.low_y, u.high_y) <=
         std::min(s.high_x - s.low_x, s.high_y - s.low_y) / 2.0;
}

/// The product of two functions that fall evenly from 1 in the middle of a disc to 0 at its rim is
/// at least as much as asked, inside of both discs.
inline bool nimbus_touches(const FilterSettings& settings, const Region& s, const Region& u) {
  if (!overlap_closed(s, u)) return false;
  const long double x = middle(u.low_x, u.high_x) - 0.0L - middle(s.low_x, s.high_x),
                    y = middle(u.low_y, u.high_y) - 0.0L - middle(s.low_y, s.high_y),
                    squared = x * x + y * y;
  const long double focus = std::min(s.high_x - 0.0L - s.low_x, s.high_y - 0.0L - s.low_y) / 2.0L,
                    nimbus = settings.nimbus_radius > 0.0 ? settings.nimbus_radius : focus;
  if (squared > focus * focus || squared > nimbus * nimbus) return false;
  const auto share = [&](long double radius) {
    return squared > 0.0L ? 1.0L - std::sqrt(squared) / radius : 1.0L;
  };
  return settings.awareness == 0.0 || share(focus) * share(nimbus) >= settings.awareness;
}

inline bool strip_touches(const FilterSettings& settings, const Region& s, const Region& u) {
  const auto strip = [&](double coordinate) {
    return std::floor((coordinate - settings.world.low_x) / settings.cell_size);
  };
  const double own = strip(middle(u.low_x, u.high_x));
  return strip(s.low_x) <= own && own <= strip(s.high_x);
}

/// Rectangles overlap, and of no post all ways between the corners of both middles' cells pass
/// through the inside, unless a corner of the subscriber's is there.
inline bool cells_see(const FilterSettings& settings, const Region& s, const Region& u) {
  if (!overlap_closed(s, u)) return false;
  const auto cell = [&](const Region& region) -> Region {
    const auto edge = [&](double coordinate, double origin, double next) {
      return origin +
             (std::floor((coordinate - origin) / settings.cell_size) + next) * settings.cell_size;
    };
    const double x = middle(region.low_x, region.high_x), y = middle(region.low_y, region.high_y);
    return {edge(x, settings.world.low_x, 0.0), edge(y, settings.world.low_y, 0.0),
            edge(x, settings.world.low_x, 1.0), edge(y, settings.world.low_y, 1.0)};
  };
  const Region from = cell(s), to = cell(u);
  return std::none_of(settings.posts.begin(), settings.posts.end(), [&](const Disc& post) {
    for (const double x : {from.low_x, from.high_x})
      for (const double y : {from.low_y, from.high_y}) {
        const Region eye{x, y, x, y};
        if (is_in_shadow(post, eye, x, y)) return false;
        for (const double to_x : {to.low_x, to.high_x})
          for (const double to_y : {to.low_y, to.high_y})
            if (!is_in_shadow(post, eye, to_x, to_y)) return false;
      }
    return true;
  });
}

/// Rectangles overlap, and whoever goes so many steps from the subscription's tile, each over a
/// side of which no post holds both ends, can come to that of `update`.
inline bool tiles_reach(const FilterSettings& settings, const Region& s, const Region& u) {
  if (!overlap_closed(s, u)) return false;
  const double size = settings.cell_size, low_x = settings.world.low_x,
               low_y = settings.world.low_y;
  const auto tile = [&](const Region& region) {
    return std::pair(std::floor((middle(region.low_x, region.high_x) - low_x) / size),
                     std::floor((middle(region.low_y, region.high_y) - low_y) / size));
  };
  const auto is_in = [](const Disc& post, long double x, long double y) {
    x -= post.x, y -= post.y;
    return x * x + y * y < static_cast<long double>(post.radius) * post.radius;
  };
  const auto is_open = [&](double x, double y, double end_x, double end_y) {
    return std::none_of(settings.posts.begin(), settings.posts.end(), [&](const Disc& post) {
      return is_in(post, low_x + x * size, low_y + y * size) &&
             is_in(post, low_x + end_x * size, low_y + end_y * size);
    });
  };
  const std::pair end = tile(u);
  std::set<std::pair<double, double>> reached{tile(s)};
  for (double left = settings.tile_steps; left >= 0.0; --left) {
    for (auto it = reached.begin(); it != reached.end();)  // who is too far to come there in time
      if (std::abs(it->first - end.first) + std::abs(it->second - end.second) > left)
        it = reached.erase(it);
      else ++it;
    if (reached.count(end) != 0) return true;
    for (const auto& [x, y] : std::set(reached)) {
      if (is_open(x, y, x, y + 1.0)) reached.emplace(x - 1.0, y);
      if (is_open(x + 1.0, y, x + 1.0, y + 1.0)) reached.emplace(x + 1.0, y);
      if (is_open(x, y, x + 1.0, y)) reached.emplace(x, y - 1.0);
      if (is_open(x, y + 1.0, x + 1.0, y + 1.0)) reached.emplace(x, y + 1.0);
    }
  }
  return false;
}

/// What each scheme promises, one pair at a time.
inline Relevant rule_of(const std::string& scheme, const FilterSettings& settings) {
  const auto with_settings =
      [settings](bool (*rule)(const FilterSettings&, const Region&, const Region&)) {
        return [=](const Region& s, const Region& u) { return rule(settings, s, u); };
      };
  if (scheme == "none") return [](const Region&, const Region&) { return true; };
  if (scheme == "region") return overlap_closed;
  if (scheme == "aura") return disc_touches;
  if (scheme == "hybrid")
    return [settings](const Region& s, const Region& u) {
      return grid_touches(settings, s, u) && overlap_closed(s, u);
    };
  if (scheme == "hierarchical") return with_settings(level_touches);
  if (scheme == "always")
    return [](const Observer&, const Body& u) { return u.role.is_always_relevant; };
  if (scheme == "owner")
    return [](const Observer& s, const Body& u) {
      return u.role.owner != Role::none && u.role.owner == s.role.owner;
    };
  if (scheme == "team")
    return [](const Observer& s, const Body& u) {
      return u.role.team != Role::none && u.role.team == s.role.team;
    };
  if (scheme == "cone")
    return
        [settings](const Observer& s, const Region& u) { return sector_touches(settings, s, u); };
  if (scheme == "sight") return with_settings(is_in_sight);
  if (scheme == "pvs") return with_settings(cells_see);
  if (scheme == "tiles") return with_settings(tiles_reach);
  if (scheme == "diamond") return diamond_touches;
  if (scheme == "nimbus") return with_settings(nimbus_touches);
  if (scheme == "strips") return with_settings(strip_touches);
  if (scheme == "hex") return with_settings(hexagon_touches);
  return with_settings(grid_touches);
}

/// Those that decide about a pair by the pair alone; zones follow from all entities.
inline std::vector<std::string> schemes_of_pairs() {
  std::vector<std::string> names = filter_names();
  std::erase(names, "zones");
  return names;
}

/// A filter together with all it was told, its reported changes replayed, and the rule it must
/// agree with.
class Judged {
 public:
  Judged(const std::string& scheme, const FilterSettings& settings)
      : Judged(make_filter(scheme, settings), rule_of(scheme, settings)) {}
  /// Who is in goes on being so while `stays` says so.
  Judged(std::unique_ptr<Filter> filter, Relevant relevant, Relevant stays = nullptr)
      : filter_(std::move(filter)), relevant_(std::move(relevant)), stays_(std::move(stays)) {}

  void move_entity(Entity entity, const Region& region) {
    filter_->set_update_region(entity, region);
    static_cast<Region&>(entities_[entity]) = region;
  }
  void take_role(Entity entity, const Role& role) {
    filter_->set_entity_role(entity, role);
    if (entities_.contains(entity)) entities_[entity].role = role;
  }
  void join(Subscriber subscriber, const Role& role) {
    filter_->set_subscriber_role(subscriber, role);
    if (subscribers_.contains(subscriber)) subscribers_[subscriber].role = role;
  }
  void move_subscriber(Subscriber subscriber, const Region& region) {
    filter_->set_subscription_region(subscriber, region);
    static_cast<Region&>(subscribers_[subscriber]) = region;
  }
  void turn(Subscriber subscriber, const Heading& heading) {
    filter_->set_heading(subscriber, heading);
    if (!subscribers_.contains(subscriber)) return;
    if (heading == Heading{}) turned_.erase(subscriber);
    else subscribers_[subscriber].heading = heading, turned_.insert(subscriber);
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
    turned_.erase(subscriber);
    middles_.erase(subscriber);
    std::erase_if(known_, [subscriber](const auto& pair) { return pair.first == subscriber; });
  }

  /// Replays one match: ordered, each change news, and the sum of all of them equal to the recount.
  void check_match() {
    for (auto& [subscriber, observer] : subscribers_) follow(subscriber, observer);
    const Pairs expected = recount(known_);
    const auto changes = filter_->match();
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const Change& change = changes[i];
      const std::pair pair{change.subscriber, change.entity};
      if (i > 0) {
        ASSERT_LT(std::pair(changes[i - 1].subscriber, changes[i - 1].entity), pair)
            << "out of order or doubled";
      }
      if (change.transition == Transition::tier_changed || change.transition == Transition::due) {
        ASSERT_TRUE(known_.contains(pair)) << "news of who is not there";
        continue;
      }
      const bool is_news = change.transition == Transition::entered ? known_.insert(pair).second
                                                                    : known_.erase(pair) == 1;
      ASSERT_TRUE(is_news) << "subscriber " << pair.first << " entity " << pair.second;
    }
    ASSERT_EQ(known_, expected);
  }

  Pairs recount(const Pairs& before) const {
    Pairs pairs;
    for (const auto& [subscriber, subscription] : subscribers_)
      for (const auto& [entity, update] : entities_)
        if (relevant_(subscription, update) ||
            (stays_ && before.contains({subscriber, entity}) && stays_(subscription, update)))
          pairs.insert({subscriber, entity});
    return pairs;
  }

  const std::map<Entity, Body>& entities() const { return entities_; }
  const std::map<Subscriber, Observer>& subscribers() const { return subscribers_; }
  Filter& filter() { return *filter_; }
  const Pairs& known() const { return known_; }

 private:
  /// Who was not told where to look looks where his middle went since the last match.
  void follow(Subscriber subscriber, Observer& observer) {
    const std::pair now = eye_of(observer);
    const auto [last, is_new] = middles_.insert({subscriber, now});
    const Heading way{now.first - last->second.first, now.second - last->second.second};
    if (!is_new && way != Heading{} && !turned_.contains(subscriber)) observer.heading = way;
    last->second = now;
  }

  std::unique_ptr<Filter> filter_;
  Relevant relevant_, stays_;
  std::map<Entity, Body> entities_;
  std::map<Subscriber, Observer> subscribers_;
  std::set<Subscriber> turned_;                              // were told where to look
  std::map<Subscriber, std::pair<double, double>> middles_;  // at the last match
  Pairs known_;
};

}  // namespace rink::im
