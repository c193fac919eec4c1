// The matching engine behind the schemes: both its ways and both its paths give the same changes, and those that brute force gives.
#include <gtest/gtest.h>

#include "im/overlap_filter.h"
#include "tests/im/layouts.h"

namespace rink::im {
namespace {

/// Regions on the move, handed to any number of filters alike.
class Scene {
 public:
  Scene(const Layout& layout, std::uint64_t seed, std::uint32_t entity_count, std::uint32_t subscriber_count) : layout_(layout), random_(seed) {
    for (std::uint32_t i = 0; i < entity_count; ++i) entities_.push_back(layout.draw(random_, 0.2));
    for (std::uint32_t i = 0; i < subscriber_count; ++i) subscribers_.push_back(layout.draw(random_, 1.0));
  }
  /// Each moves with this probability, one in five of them anywhere.
  void step(double share) {
    for (Region& region : entities_)
      if (between(random_, 0.0, 1.0) < share) region = moved(random_, region, layout_, 0.2);
    for (Region& region : subscribers_)
      if (between(random_, 0.0, 1.0) < share) region = moved(random_, region, layout_, 1.0);
  }
  /// Nearly all move on by up to so many 64ths of a metre, so that ties stay ties; true if entity 3 and subscriber 5 are to be forgotten first.
  bool drift(int reach) {
    const auto shift = [&] { return std::round(between(random_, -reach, reach)) / 64.0; };
    for (std::vector<Region>* regions : {&entities_, &subscribers_})
      for (Region& region : *regions) {
        const double dx = shift(), dy = shift();
        if (between(random_, 0.0, 1.0) < 0.9) region = {region.low_x + dx, region.low_y + dy, region.high_x + dx, region.high_y + dy};
      }
    return between(random_, 0.0, 1.0) < 0.1;
  }
  void tell(Filter& filter) const {
    for (std::uint32_t i = 0; i < entities_.size(); ++i) filter.set_update_region(i, entities_[i]);
    for (std::uint32_t i = 0; i < subscribers_.size(); ++i) filter.set_subscription_region(i, subscribers_[i]);
  }
  /// All overlaps, subscriber by subscriber.
  std::vector<bool> recount() const {
    std::vector<bool> table;
    for (const Region& s : subscribers_)
      for (const Region& u : entities_) table.push_back(!(u.high_x < s.low_x || s.high_x < u.low_x || u.high_y < s.low_y || s.high_y < u.low_y));
    return table;
  }
  std::size_t entity_count() const { return entities_.size(); }

 private:
  const Layout& layout_;
  Random random_;
  std::vector<Region> entities_, subscribers_;
};

/// A hundred, a tenth and a thousandth of all, in a sequence that goes from each to each: rebuilding, updating in place, and taking up again what was left.
constexpr std::array shares{1.0, 0.02, 0.05, 0.3, 0.001, 0.1, 1.0, 1.0, 0.01, 0.0, 0.2};

void follow(const Layout& layout, std::uint64_t seed, std::uint32_t entity_count, std::uint32_t subscriber_count, int rounds) {
  SCOPED_TRACE(std::string(layout.name) + " with seed " + std::to_string(seed));
  Scene scene(layout, seed, entity_count, subscriber_count);
  const Region world{0.0, 0.0, side, side};
  OverlapFilter best(world), scalar(world, Instructions::scalar), lost({1e6, 1e6, 1e6 + 1.0, 1e6 + 1.0});
  std::vector<bool> known(std::size_t{entity_count} * subscriber_count);
  for (int round = 0; round < rounds; ++round)
    for (const double share : shares) {
      scene.step(share);
      for (Filter* filter : {static_cast<Filter*>(&best), static_cast<Filter*>(&scalar), static_cast<Filter*>(&lost)}) scene.tell(*filter);
      const auto changes = best.match(), plain = scalar.match(), far = lost.match();
      ASSERT_TRUE(std::equal(changes.begin(), changes.end(), plain.begin(), plain.end())) << "the scalar path differs";
      ASSERT_TRUE(std::equal(changes.begin(), changes.end(), far.begin(), far.end())) << "the expected world changes the result";
      for (const Change& change : changes) {
        const std::size_t place = change.subscriber * scene.entity_count() + change.entity;
        ASSERT_NE(known[place], change.transition == Transition::entered) << "subscriber " << change.subscriber << " entity " << change.entity;
        known[place] = !known[place];
      }
      ASSERT_EQ(known, scene.recount()) << "after a share of " << share;
    }
}

TEST(ChangeJoin, FollowsManyThroughEveryShareOfMovers) {
  for (const Layout& layout : layouts) follow(layout, 1, 700, 300, 2);
}
/// More than the engine takes in the order of their ids.
TEST(ChangeJoin, FollowsSubscribersInTheOrderOfTheirPlaces) { follow(layouts[0], 2, 200, 5'000, 1); }

/// For as long as nobody goes far, nobody is binned anew. Who was forgotten is someone new.
void drift(const Layout& layout, std::uint64_t seed, std::uint32_t entity_count, std::uint32_t subscriber_count, int ticks) {
  SCOPED_TRACE(std::string(layout.name) + " with seed " + std::to_string(seed));
  Scene scene(layout, seed, entity_count, subscriber_count);
  const Region world{0.0, 0.0, side, side};
  OverlapFilter best(world), scalar(world, Instructions::scalar);
  std::vector<bool> known(std::size_t{entity_count} * subscriber_count);
  for (int tick = 0; tick < ticks; ++tick) {
    if (scene.drift(tick % 3)) {
      for (Filter* filter : {&best, &scalar}) filter->remove_entity(3), filter->remove_subscriber(5);
      for (std::size_t place = 0; place < known.size(); ++place)
        if (place % entity_count == 3 || place / entity_count == 5) known[place] = false;
    }
    scene.tell(best), scene.tell(scalar);
    const auto changes = best.match(), plain = scalar.match();
    ASSERT_TRUE(std::equal(changes.begin(), changes.end(), plain.begin(), plain.end())) << "the scalar path differs";
    for (const Change& change : changes) known[change.subscriber * scene.entity_count() + change.entity] = change.transition == Transition::entered;
    ASSERT_EQ(known, scene.recount()) << "at tick " << tick;
  }
}

TEST(ChangeJoin, FollowsManyWhoDriftSlowly) {
  for (const Layout& layout : layouts) drift(layout, 3, 700, 300, 60);
}
TEST(ChangeJoin, FollowsManySubscribersWhoDriftSlowly) { drift(layouts[1], 4, 100, 5'000, 20); }

/// What moves is known where it was binned until it is a quarter of a column away.
TEST(BoxIndex, KeepsBoxesInTheirCellsWhileTheyAreNear) {
  Random random(7);
  RegionHistory regions;
  BoxIndex index;
  const auto tell = [&](double shift) {
    for (std::uint32_t id = 0; id < 1'000; ++id) {
      const Region from = shift == 0.0 ? around(between(random, 0.0, side), between(random, 0.0, side), 0.1) : regions[id].now;
      regions.set(id, {from.low_x + shift, from.low_y - shift, from.high_x + shift, from.high_y - shift});
    }
    regions.take_moved();
  };
  tell(0.0);
  index.begin({0.0, 0.0, side, side}, regions.size(), true);
  for (std::uint32_t id = 0; id < regions.size(); ++id) index.stage(id, regions[id]);
  index.build();
  // 1,000 boxes in 256 square metres, 32 to a square, of which a row has six to the square: columns of half a metre.
  for (int tick = 0; tick < 10; ++tick) {
    regions.settle();
    tell(0.01);
    ASSERT_TRUE(index.follow(regions)) << "after " << tick;
    Buffer<Stretch> stretches;
    const FloatBox asked{3.0f, 4.0f, 9.0f, 8.0f};
    index.find_changes({asked, asked, 0, 0}, stretches);
    std::vector<bool> is_candidate(regions.size());
    for (const Stretch& stretch : stretches.span())
      for (std::uint32_t place = stretch.first; place < stretch.end; ++place) is_candidate[index.ids()[place]] = true;
    for (std::uint32_t id = 0; id < regions.size(); ++id) {
      const bool was_in = overlap(regions[id].before, {3.0, 4.0, 9.0, 8.0}), is_in = overlap(regions[id].now, {3.0, 4.0, 9.0, 8.0});
      ASSERT_TRUE(was_in == is_in || is_candidate[id]) << id;
    }
  }
  regions.settle();
  tell(0.2);
  EXPECT_FALSE(index.follow(regions));
}

TEST(ChangeJoinLong, DriftsThroughEveryLayout) {
  for (std::uint64_t seed = 10; seed < 40; ++seed)
    for (const Layout& layout : layouts) {
      drift(layout, seed, 700, 300, 200);
      if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(ChangeJoinLong, FollowsManyThroughEveryShareOfMovers) {
  for (std::uint64_t seed = 10; seed < 60; ++seed)
    for (const Layout& layout : layouts) {
      follow(layout, seed, static_cast<std::uint32_t>(10 * seed), static_cast<std::uint32_t>(700 - 10 * seed), 8);
      if (testing::Test::HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace rink::im
