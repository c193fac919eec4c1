// Bodies of very different sizes: the grid shows everybody who may touch, against all pairs, and a
// world of them goes as one in which everybody looks at everybody.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "game/physics/grid/cell_grid.h"
#include "game/physics/grid/size_classes.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// Log-uniform.
double size_between(std::mt19937_64& random, double low, double high) {
  return low * std::pow(high / low, uniform(random, 0.0, 1.0));
}

/// Boxes on a field of 4 x 2 m, those above `small` m in more cells than one.
class Crowd {
 public:
  static constexpr double length = 4.0, width = 2.0;

  Crowd(std::mt19937_64& random, std::uint32_t count, double small, double ratio)
      : random_(random), small_(small) {
    grid_.rebuild(length, width, 2.0 * small, count, 0.0);
    grid_.resize(count);
    for (std::uint32_t body = 0; body < count; ++body) {
      // One in four is wide; of these some are long, some thin.
      const bool is_wide = body % 4 == 0;
      const auto extent = [&] {
        return is_wide ? size_between(random, 0.5 * small, ratio * small)
                       : size_between(random, 0.1 * small, small);
      };
      extents_.push_back({extent(), extent()});
      places_.push_back(anywhere());
      list(body);
    }
  }

  std::uint32_t count() const { return static_cast<std::uint32_t>(places_.size()); }
  std::uint32_t wide_count() const { return grid_.wide().count(); }
  std::uint64_t crossings() const { return crossings_; }

  std::vector<std::uint32_t> seen_by(std::uint32_t body) const {
    std::vector<std::uint32_t> list(grid_.collected_max());
    list.resize(grid_.collect(body, list.data()));
    std::sort(list.begin(), list.end());
    return list;
  }
  bool may_touch(std::uint32_t one, std::uint32_t other) const {
    return ((places_[one] - places_[other]).cwiseAbs() - extents_[one] - extents_[other])
               .maxCoeff() <= 0.0;
  }

  /// Goes straight, from cell to cell as in a world; what comes into sight is what the grid says.
  void go(std::uint32_t body, const Vector2& way) {
    Vector2& at = places_[body];
    const Vector2 to = (at + way).cwiseMax(Vector2(0.0, 0.0)).cwiseMin(Vector2(length, width));
    const Vector2 from = at;
    for (;;) {
      double share = 1.0;
      int direction = -1;
      for (const int axis : {0, 1}) {
        const double edge = edge_of(body, axis, to[axis] > at[axis]), step = to[axis] - from[axis];
        if (step == 0.0 || (edge - from[axis]) / step >= share) continue;
        share = (edge - from[axis]) / step;
        direction = 2 * axis + (step > 0.0);
      }
      at = direction < 0 ? to : Vector2(from + share * (to - from));
      if (direction < 0) return;
      cross(body, static_cast<CellGrid::Direction>(direction));
    }
  }
  /// To the very edge at which it leaves its cells, where there is one.
  void go_to_edge(std::uint32_t body) {
    const int axis = static_cast<int>(random_() % 2);
    const double edge = edge_of(body, axis, random_() % 2 == 0);
    if (!std::isinf(edge)) places_[body][axis] = edge;
  }
  void leave_and_come_back_elsewhere(std::uint32_t body) {
    grid_.remove(body);
    EXPECT_FALSE(grid_.is_listed(body));
    places_[body] = anywhere();
    list(body);
  }

 private:
  Vector2 anywhere() {
    Vector2 place(uniform(random_, 0.0, length), uniform(random_, 0.0, width));
    // Some on the lines between cells, some in the corners.
    for (const int axis : {0, 1})
      if (random_() % 4 == 0)
        place[axis] = std::min(std::round(place[axis] / grid_.side()) * grid_.side(),
                               axis == 0 ? length : width);
    return place;
  }
  void list(std::uint32_t body) {
    const Vector2 &at = places_[body], &extent = extents_[body];
    if (extent.maxCoeff() <= small_) grid_.insert(body, at.x(), at.y());
    else grid_.insert_wide(body, {at.x(), at.y(), extent.x(), extent.y()});
  }
  double edge_of(std::uint32_t body, int axis, bool is_high) const {
    const CellGrid::Place place = grid_.place(body);
    return axis == 0 ? grid_.column_edge(place.column, is_high)
                     : grid_.row_edge(place.row, is_high);
  }
  void cross(std::uint32_t body, CellGrid::Direction direction) {
    ++crossings_;
    const std::vector<std::uint32_t> before = seen_by(body);
    grid_.move(body, direction);
    std::vector<std::uint32_t> ahead(grid_.collected_max()), came;
    ahead.resize(grid_.collect_ahead(body, direction, ahead.data()));
    std::sort(ahead.begin(), ahead.end());
    const std::vector<std::uint32_t> after = seen_by(body);
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                        std::back_inserter(came));
    EXPECT_EQ(ahead, came);
  }

  std::mt19937_64& random_;
  double small_;
  CellGrid grid_;
  std::vector<Vector2> places_, extents_;
  std::uint64_t crossings_ = 0;
};

void expect_everybody_seen(const Crowd& crowd) {
  std::vector<std::vector<std::uint32_t>> seen;
  for (std::uint32_t body = 0; body < crowd.count(); ++body) seen.push_back(crowd.seen_by(body));
  const auto sees = [&](std::uint32_t one, std::uint32_t other) {
    return std::binary_search(seen[one].begin(), seen[one].end(), other);
  };
  for (std::uint32_t body = 0; body < crowd.count(); ++body) {
    EXPECT_EQ(std::adjacent_find(seen[body].begin(), seen[body].end()), seen[body].end());
    EXPECT_TRUE(sees(body, body));
    for (std::uint32_t other = 0; other < crowd.count(); ++other) {
      EXPECT_TRUE(sees(body, other) || !crowd.may_touch(body, other))
          << body << " misses " << other;
      EXPECT_EQ(sees(body, other), sees(other, body)) << body << " and " << other;
    }
  }
}

TEST(Sizes, WhoeverMayTouchIsSeenWhateverTheSizesAndHoweverTheyMove) {
  constexpr std::uint64_t seed = 11;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  for (const double ratio : {1.0, 1.5, 3.0, 10.0, 30.0, 100.0}) {
    SCOPED_TRACE(testing::Message() << "sizes 1 to " << ratio);
    Crowd crowd(random, 120, 0.02, ratio);
    EXPECT_EQ(crowd.wide_count() > 0, ratio > 1.0);
    expect_everybody_seen(crowd);
    for (int round = 0; round < 12; ++round) {
      for (int step = 0; step < 120; ++step) {
        const auto body = static_cast<std::uint32_t>(random() % crowd.count());
        const auto kind = random() % 8;
        if (kind == 0) crowd.leave_and_come_back_elsewhere(body);
        else if (kind == 1) crowd.go_to_edge(body);
        else crowd.go(body, {uniform(random, -0.4, 0.4), uniform(random, -0.4, 0.4)});
      }
      expect_everybody_seen(crowd);
    }
    EXPECT_GT(crowd.crossings(), 1000u);
  }
}

/// A body that goes back where it came from does not cross at once again.
TEST(Sizes, NobodyFlickersAtAnEdge) {
  CellGrid grid;
  grid.rebuild(4.0, 2.0, 0.04, 1000, 0.0);
  grid.resize(1);
  for (const double half : {0.05, 0.1, 0.33, 0.7}) {
    grid.insert_wide(0, {1.7, 1.0, half, 0.3});
    for (const CellGrid::Direction direction : {CellGrid::right, CellGrid::left}) {
      const double edge = grid.column_edge(grid.place(0).column, direction == CellGrid::right);
      grid.move(0, direction);
      const double back = grid.column_edge(grid.place(0).column, direction != CellGrid::right);
      EXPECT_GT(std::abs(edge - back), grid.side() / 100.0) << half;
      EXPECT_EQ(back < edge, direction == CellGrid::right);
    }
    grid.remove(0);
  }
}

double side_of(double reach) { return std::max(0.1, 2.1 * reach); }

TEST(Sizes, AFewLongOnesAreWideAndBodiesOfAboutOneSizeAreNot) {
  SizeClasses sizes;
  for (int k = 0; k < 1000; ++k) sizes.add(0.03 + 0.00001 * k);
  EXPECT_EQ(sizes.choose(20.0, side_of).wide_count, 0u);
  sizes.add(0.5);
  const SizeClasses::Choice choice = sizes.choose(20.0, side_of);
  EXPECT_EQ(choice.wide_count, 1u);
  EXPECT_DOUBLE_EQ(choice.reach, 0.03999);
}

TEST(Sizes, MostBodiesStandInOneCell) {
  SizeClasses sizes;
  for (int k = 0; k < 1000; ++k) sizes.add(k < 10 ? 0.001 : 0.1);
  EXPECT_EQ(sizes.choose(100.0, side_of).wide_count, 0u);
  EXPECT_EQ(SizeClasses().choose(1.0, side_of).wide_count, 0u);
}

/// Pucks of sizes 1 to 30, long bats under keys, posts.
std::uint64_t played_hash(std::uint64_t seed, double cell_size, std::vector<Event>* events) {
  std::mt19937_64 random(seed);
  WorldSpec spec = rink_of(4.0, 2.0, 0.9, seed % 2 == 0 ? 0.0 : 0.2, 1.0);
  if (seed % 3 == 0) spec.restitution = RestitutionTable(1, 1.0);
  spec.cell_size = cell_size;
  World world(spec);
  world.record_events(true);
  std::vector<BodyId> bats;
  for (int k = 0; k < 4; ++k) {
    const BatSpec bat{.position = {0.3 + k, uniform(random, 0.75, 1.25)},
                      .half_extent = {0.02, uniform(random, 0.2, 0.7)},
                      .mass = 3.0};
    if (world.is_free(bat.position, bat.half_extent)) bats.push_back(world.add(bat));
  }
  for (int k = 0; k < 250; ++k) {
    const bool is_wide = k % 10 == 0;
    const double size = is_wide ? size_between(random, 0.03, 0.3) : 0.01;
    const Vector2 place(uniform(random, size, 4.0 - size), uniform(random, size, 2.0 - size)),
        velocity(uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0));
    if (!world.is_free(place, size)) continue;
    if (k % 30 == 0) world.add(PostSpec{.position = place, .radius = size});
    else world.add(PuckSpec{.position = place, .velocity = velocity, .radius = size, .mass = size});
  }
  for (int key = 0; key < 20; ++key) {
    world.set_thrust(bats[random() % bats.size()],
                     {uniform(random, -5.0, 5.0), uniform(random, -5.0, 5.0)});
    world.advance(0.05 * (key + 1));
  }
  EXPECT_LT(world.max_overlap(), 1e-9);
  events->assign(world.events().begin(), world.events().end());
  return world.hash();
}

TEST(Sizes, AWorldOfManySizesGoesAsOneInWhichEverybodyLooksAtEverybody) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::vector<Event> events, events_of_all_pairs;
    const std::uint64_t hash = played_hash(seed, 0.0, &events),
                        hash_of_all_pairs = played_hash(seed, 10.0, &events_of_all_pairs);
    EXPECT_EQ(hash, hash_of_all_pairs);
    ASSERT_EQ(events.size(), events_of_all_pairs.size());
    EXPECT_GT(events.size(), 500u);
    for (std::size_t k = 0; k < events.size(); ++k) {
      EXPECT_EQ(events[k].time, events_of_all_pairs[k].time);
      EXPECT_EQ(events[k].body, events_of_all_pairs[k].body);
      EXPECT_EQ(events[k].other, events_of_all_pairs[k].other);
    }
  }
}

/// One full-width bat among 1,000 pucks: 1,036 pairs per event where it makes all cells large.
TEST(Sizes, ALongBatLeavesThePucksToThemselves) {
  World world(rink_of(5.0, 2.0, 1.0, 0.0, 0.0));
  const BodyId bat =
      world.add(BatSpec{.position = {0.2, 1.0}, .half_extent = {0.05, 0.999}, .mass = 50.0});
  std::mt19937_64 random(3);
  for (int k = 0; k < 1000; ++k)
    world.add(PuckSpec{.position = {0.4 + 0.09 * (k % 50), 0.05 + 0.1 * (k / 50)},
                       .velocity = {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)},
                       .radius = 0.02});
  world.set_thrust(bat, {1.0, 0.0});
  world.advance(1.0);
  const Counters& counters = world.counters();
  EXPECT_GT(counters.bat_impacts, 30u);
  EXPECT_LT(counters.predictions, 60 * counters.events());
}

}  // namespace
}  // namespace rink::physics::test
