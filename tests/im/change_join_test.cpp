// The matching engine behind the schemes: both its ways and both its paths give the same changes,
// and those that brute force gives.
#include <gtest/gtest.h>

#include "im/matching/advance.h"
#include "im/schemes/overlap_filter.h"
#include "tests/im/layouts.h"
#include "tests/im/recount.h"

namespace rink::im {
namespace {

/// Regions on the move, handed to any number of filters alike.
class Scene {
 public:
  Scene(const Layout& layout, std::uint64_t seed, std::uint32_t entity_count,
        std::uint32_t subscriber_count)
      : layout_(layout), random_(seed) {
    for (std::uint32_t i = 0; i < entity_count; ++i) entities_.push_back(layout.draw(random_, 0.2));
    for (std::uint32_t i = 0; i < subscriber_count; ++i)
      subscribers_.push_back(layout.draw(random_, 1.0));
  }
  /// Each moves with this probability, one in five of them anywhere.
  void step(double share) {
    for (Region& region : entities_)
      if (between(random_, 0.0, 1.0) < share) region = moved(random_, region, layout_, 0.2);
    for (Region& region : subscribers_)
      if (between(random_, 0.0, 1.0) < share) region = moved(random_, region, layout_, 1.0);
  }
  /// Nearly all move on by up to so many 64ths of a metre, so that ties stay ties; true if entity 3
  /// and subscriber 5 are to be forgotten first.
  bool drift(int reach) {
    const auto shift = [&] { return std::round(between(random_, -reach, reach)) / 64.0; };
    for (std::vector<Region>* regions : {&entities_, &subscribers_})
      for (Region& region : *regions) {
        const double dx = shift(), dy = shift();
        if (between(random_, 0.0, 1.0) < 0.9)
          region = {region.low_x + dx, region.low_y + dy, region.high_x + dx, region.high_y + dy};
      }
    return between(random_, 0.0, 1.0) < 0.1;
  }
  void tell(Filter& filter) const {
    for (std::uint32_t i = 0; i < entities_.size(); ++i) filter.set_update_region(i, entities_[i]);
    for (std::uint32_t i = 0; i < subscribers_.size(); ++i)
      filter.set_subscription_region(i, subscribers_[i]);
  }
  /// Who meets whom, subscriber by subscriber.
  std::vector<bool> recount(Shape shape) const {
    std::vector<bool> table;
    for (const Region& s : subscribers_)
      for (const Region& u : entities_)
        table.push_back(shape == Shape::disc ? disc_touches(s, u) : overlap_closed(s, u));
    return table;
  }
  std::size_t entity_count() const { return entities_.size(); }

 private:
  const Layout& layout_;
  Random random_;
  std::vector<Region> entities_, subscribers_;
};

/// A hundred, a tenth and a thousandth of all, in a sequence that goes from each to each:
/// rebuilding, updating in place, and taking up again what was left.
constexpr std::array shares{1.0, 0.02, 0.05, 0.3, 0.001, 0.1, 1.0, 1.0, 0.01, 0.0, 0.2};

void follow(const Layout& layout, std::uint64_t seed, std::uint32_t entity_count,
            std::uint32_t subscriber_count, int rounds, Shape shape) {
  SCOPED_TRACE(std::string(layout.name) + " with seed " + std::to_string(seed));
  Scene scene(layout, seed, entity_count, subscriber_count);
  const Region world{0.0, 0.0, side, side};
  OverlapFilter best(world, Instructions::best, shape), sse2(world, Instructions::sse2, shape),
      scalar(world, Instructions::scalar, shape);
  OverlapFilter lost({1e6, 1e6, 1e6 + 1.0, 1e6 + 1.0}, Instructions::best, shape);
  std::vector<bool> known(std::size_t{entity_count} * subscriber_count);
  for (int round = 0; round < rounds; ++round)
    for (const double share : shares) {
      scene.step(share);
      for (OverlapFilter* filter : {&best, &sse2, &scalar, &lost}) scene.tell(*filter);
      const auto changes = best.match(), four = sse2.match(), plain = scalar.match(),
                 far = lost.match();
      ASSERT_TRUE(std::equal(changes.begin(), changes.end(), plain.begin(), plain.end()))
          << "the scalar path differs";
      ASSERT_TRUE(std::equal(changes.begin(), changes.end(), four.begin(), four.end()))
          << "the path of SSE2 differs";
      ASSERT_TRUE(std::equal(changes.begin(), changes.end(), far.begin(), far.end()))
          << "the expected world changes the result";
      for (const Change& change : changes) {
        const std::size_t place = change.subscriber * scene.entity_count() + change.entity;
        ASSERT_NE(known[place], change.transition == Transition::entered)
            << "subscriber " << change.subscriber << " entity " << change.entity;
        known[place] = !known[place];
      }
      ASSERT_EQ(known, scene.recount(shape)) << "after a share of " << share;
    }
}

TEST(ChangeJoin, FollowsManyThroughEveryShareOfMovers) {
  for (const Layout& layout : layouts) follow(layout, 1, 700, 300, 2, Shape::rectangle);
}
TEST(ChangeJoin, FollowsManyThroughDiscs) {
  for (const Layout& layout : layouts) follow(layout, 5, 300, 200, 2, Shape::disc);
}
/// More than the engine takes in the order of their ids.
TEST(ChangeJoin, FollowsSubscribersInTheOrderOfTheirPlaces) {
  follow(layouts[0], 2, 200, 5'000, 1, Shape::rectangle);
}
TEST(ChangeJoin, FollowsDiscsInTheOrderOfTheirPlaces) {
  follow(layouts[1], 6, 50, 5'000, 1, Shape::disc);
}

/// For as long as nobody goes far, nobody is binned anew. Who was forgotten is someone new.
void drift(const Layout& layout, std::uint64_t seed, std::uint32_t entity_count,
           std::uint32_t subscriber_count, int ticks, Shape shape) {
  SCOPED_TRACE(std::string(layout.name) + " with seed " + std::to_string(seed));
  Scene scene(layout, seed, entity_count, subscriber_count);
  const Region world{0.0, 0.0, side, side};
  OverlapFilter best(world, Instructions::best, shape), sse2(world, Instructions::sse2, shape),
      scalar(world, Instructions::scalar, shape);
  std::vector<bool> known(std::size_t{entity_count} * subscriber_count);
  for (int tick = 0; tick < ticks; ++tick) {
    if (scene.drift(tick % 3)) {
      for (Filter* filter : {&best, &sse2, &scalar})
        filter->remove_entity(3), filter->remove_subscriber(5);
      for (std::size_t place = 0; place < known.size(); ++place)
        if (place % entity_count == 3 || place / entity_count == 5) known[place] = false;
    }
    scene.tell(best), scene.tell(sse2), scene.tell(scalar);
    const auto changes = best.match(), four = sse2.match(), plain = scalar.match();
    ASSERT_TRUE(std::equal(changes.begin(), changes.end(), plain.begin(), plain.end()))
        << "the scalar path differs";
    ASSERT_TRUE(std::equal(changes.begin(), changes.end(), four.begin(), four.end()))
        << "the path of SSE2 differs";
    for (const Change& change : changes)
      known[change.subscriber * scene.entity_count() + change.entity] =
          change.transition == Transition::entered;
    ASSERT_EQ(known, scene.recount(shape)) << "at tick " << tick;
  }
}

TEST(ChangeJoin, FollowsManyWhoDriftSlowly) {
  for (const Layout& layout : layouts)
    for (const Shape shape : {Shape::rectangle, Shape::disc}) drift(layout, 3, 200, 100, 40, shape);
}
TEST(ChangeJoin, FollowsManySubscribersWhoDriftSlowly) {
  drift(layouts[1], 4, 50, 5'000, 15, Shape::rectangle);
}

/// Who was binned while it took a large step is ahead of its cell by that step, however small the
/// later ones are.
TEST(ChangeJoin, FollowsManyWhoAreKickedNowAndThen) {
  constexpr std::size_t entities = 3'000, subscribers = 100;
  constexpr double world = 20.0;
  std::mt19937_64 random(9);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  struct Square {
    double x, y, half;
    Region region() const { return {x - half, y - half, x + half, y + half}; }
  };
  std::vector<Square> here(entities + subscribers);
  for (std::size_t k = 0; k < here.size(); ++k)
    here[k] = {between(0.0, world), between(0.0, world), k < entities ? 0.04 : 1.0};
  OverlapFilter filter({0.0, 0.0, world, world}, Instructions::best, Shape::rectangle);
  std::vector<bool> known(entities * subscribers);
  for (int tick = 0; tick < 40; ++tick) {
    const double step = tick % 12 == 0 ? 0.3 : 0.002;
    for (Square& one : here) one.x += between(-step, step), one.y += between(-step, step);
    for (std::size_t k = 0; k < entities; ++k)
      filter.set_update_region(static_cast<Entity>(k), here[k].region());
    for (std::size_t k = 0; k < subscribers; ++k)
      filter.set_subscription_region(static_cast<Subscriber>(k), here[entities + k].region());
    for (const Change& change : filter.match())
      known[change.subscriber * entities + change.entity] =
          change.transition == Transition::entered;
    std::size_t wrong = 0;
    for (std::size_t s = 0; s < subscribers; ++s) {
      const Region mine = here[entities + s].region();
      for (std::size_t e = 0; e < entities; ++e) {
        const Region its = here[e].region();
        wrong += known[s * entities + e] != (its.low_x <= mine.high_x && mine.low_x <= its.high_x &&
                                             its.low_y <= mine.high_y && mine.low_y <= its.high_y);
      }
    }
    ASSERT_EQ(wrong, 0u) << "at tick " << tick;
  }
}

/// A cell's line has room for eight, the rest of a crowd is in further ones: whoever comes, stays,
/// goes or is forgotten is found where he is. Where the floats end, too.
TEST(ChangeJoin, FollowsACrowdThatGathersInOneCellAndLeavesIt) {
  constexpr std::uint32_t entities = 400, subscribers = 40;
  for (const double scale : {1.0, 1e-30, 1e30}) {
    Random random(12);
    std::vector<Region> here(entities + subscribers);
    const auto draw = [&](double half) {
      const bool is_in_crowd = between(random, 0.0, 1.0) < 0.6;
      const Region r = is_in_crowd
                           ? around(5.0 + std::round(between(random, -2.0, 2.0)) / 8.0, 5.0, half)
                           : around(between(random, 0.0, side), between(random, 0.0, side), half);
      return Region{r.low_x * scale, r.low_y * scale, r.high_x * scale, r.high_y * scale};
    };
    OverlapFilter best({0.0, 0.0, side * scale, side * scale}),
        scalar({0.0, 0.0, side * scale, side * scale}, Instructions::scalar);
    std::vector<bool> known(std::size_t{entities} * subscribers);
    for (int tick = 0; tick < 120; ++tick) {
      for (std::uint32_t k = 0; k < here.size(); ++k)
        if (tick == 0 || between(random, 0.0, 1.0) < 0.08)
          here[k] = draw(k < entities ? 0.125 : 0.5);
      const auto gone = static_cast<std::uint32_t>(between(random, 0.0, subscribers));
      for (OverlapFilter* filter : {&best, &scalar}) {
        if (tick % 4 == 3) filter->remove_entity(gone), filter->remove_subscriber(gone);
        for (std::uint32_t k = 0; k < entities; ++k) filter->set_update_region(k, here[k]);
        for (std::uint32_t k = 0; k < subscribers; ++k)
          filter->set_subscription_region(k, here[entities + k]);
      }
      if (tick % 4 == 3)
        for (std::size_t pair = 0; pair < known.size(); ++pair)
          if (pair / entities == gone || pair % entities == gone) known[pair] = false;
      const auto changes = best.match(), plain = scalar.match();
      ASSERT_TRUE(std::equal(changes.begin(), changes.end(), plain.begin(), plain.end()))
          << "the scalar path differs";
      for (const Change& change : changes) {
        const std::size_t pair = change.subscriber * entities + change.entity;
        ASSERT_NE(known[pair], change.transition == Transition::entered)
            << "subscriber " << change.subscriber << " entity " << change.entity;
        known[pair] = !known[pair];
      }
      for (std::size_t pair = 0; pair < known.size(); ++pair)
        ASSERT_EQ(known[pair], overlap(here[entities + pair / entities], here[pair % entities]))
            << "at tick " << tick;
    }
  }
}

/// A point at (3, 4) is on the circle of radius 5, at any scale and wherever the middle is; the
/// least step that its coordinates know is off it.
TEST(ChangeJoin, SeesAPointOnACircleAsOneAtEveryScale) {
  for (const Instructions instructions : {Instructions::best, Instructions::scalar})
    for (int exponent = -80; exponent <= 80; exponent += 4)
      for (const double far : {0.0, 1'000.0, 0x1p20}) {
        const double unit = std::ldexp(1.0, exponent), x = far * unit, y = -2.0 * far * unit,
                     off = unit * 0x1p-20;
        OverlapFilter filter({-10.0, -10.0, 10.0, 10.0}, instructions, Shape::disc);
        const auto at = [&](double dx, double dy) {
          return Region{x + dx, y + dy, x + dx, y + dy};
        };
        const auto match = [&](double dx, double dy) {
          for (Entity entity = 0; entity < 20; ++entity)
            filter.set_update_region(entity, at(entity < 10 ? dx : -dx, entity < 10 ? dy : -dy));
          return filter.match().size();
        };
        filter.set_subscription_region(
            0, {x - 5.0 * unit, y - 5.0 * unit, x + 5.0 * unit, y + 5.0 * unit});
        ASSERT_EQ(match(3.0 * unit, 4.0 * unit), 20u) << exponent << " from " << far;
        ASSERT_EQ(match(3.0 * unit, 4.0 * unit + off), 20u) << exponent << " from " << far;
        ASSERT_EQ(match(4.0 * unit + off, 3.0 * unit), 0u) << exponent << " from " << far;
        ASSERT_EQ(match(4.0 * unit - off, 3.0 * unit), 20u) << exponent << " from " << far;
        ASSERT_EQ(match(3.0 * unit, 4.0 * unit), 0u) << exponent << " from " << far;
      }
}

/// What moves is known where it was binned until it is two thirds of a column away.
TEST(BoxIndex, KeepsBoxesInTheirCellsWhileTheyAreNear) {
  Random random(7);
  RegionHistory regions;
  BoxIndex index;
  const auto tell = [&](double shift) {
    for (std::uint32_t id = 0; id < 1'000; ++id) {
      const Region from = shift == 0.0
                              ? around(between(random, 0.0, side), between(random, 0.0, side), 0.1)
                              : regions[id].now;
      regions.set(
          id, {from.low_x + shift, from.low_y - shift, from.high_x + shift, from.high_y - shift});
    }
    regions.take_moved();
  };
  tell(0.0);
  index.begin({0.0, 0.0, side, side}, regions.size(), Boxes::moving);
  for (std::uint32_t id = 0; id < regions.size(); ++id) index.stage(id, regions[id]);
  index.build();
  // 1,000 boxes in 256 square metres, 32 to a square, of which a row has six to the square: columns
  // of half a metre.
  for (int tick = 0; tick < 10; ++tick) {
    regions.settle();
    tell(0.01);
    ASSERT_TRUE(index.follow(regions)) << "after " << tick;
    index.check();
    for (int question = 0; question < 100; ++question) {
      const float x = static_cast<float>(between(random, 0.0, side)),
                  y = static_cast<float>(between(random, 0.0, side));
      const FloatBox asked{x, y, x + 10.0f, y + 10.0f};
      const Region place_of_asker{asked.low_x, asked.low_y, asked.high_x, asked.high_y};
      Buffer<Stretch> stretches;
      index.find_changes({asked, asked, 0, 0}, stretches);
      std::vector<bool> is_candidate(regions.size());
      for (const Stretch& stretch : stretches.span())
        for (std::uint32_t place = stretch.first; place < stretch.end; ++place)
          is_candidate[index.ids()[place]] = true;
      for (std::uint32_t id = 0; id < regions.size(); ++id)
        ASSERT_TRUE(overlap(regions[id].before, place_of_asker) ==
                        overlap(regions[id].now, place_of_asker) ||
                    is_candidate[id])
            << "box " << id << " at tick " << tick;
    }
  }
  regions.settle();
  tell(0.2);
  EXPECT_FALSE(index.follow(regions));
}

/// Bit for bit, whatever is left over when they are taken several at a time; also of boxes that
/// were nowhere, or lie where floats end.
TEST(Advance, TakesBoxesToTheSamePlacesOneByOneAndSeveralAtATime) {
  Random random(11);
  for (const Layout& layout : layouts)
    for (std::uint32_t count = 0; count < 45; ++count) {
      RegionHistory regions;
      std::vector<std::uint32_t> ids;
      std::array<std::vector<float>, 4> before, binned;
      const Projection projection(0.25, -3.0);
      for (std::uint32_t id = 0; id < count; ++id) {
        regions.set(id, layout.draw(random, 1.0));
        ids.push_back(count - 1 - id);
        const FloatBox was = id % 11 == 10 ? float_nowhere : projection(layout.draw(random, 1.0)),
                       place = projection(layout.draw(random, 1.0));
        const float edges[2][4] = {{was.low_x, was.low_y, was.high_x, was.high_y},
                                   {place.low_x, place.low_y, place.high_x, place.high_y}};
        for (std::size_t i = 0; i < 4; ++i)
          before[i].push_back(edges[0][i]), binned[i].push_back(edges[1][i]);
      }
      for (const bool asks_exact : {true, false}) {
        const auto taken = [&](Instructions instructions) {
          auto now = binned;
          const BoxColumns from{before[0].data(), before[1].data(), before[2].data(),
                                before[3].data()};
          const Advancing boxes{ids.data(),
                                regions,
                                projection,
                                from,
                                {now[0].data(), now[1].data(), now[2].data(), now[3].data()}};
          const std::size_t first = std::min(count, 3u);
          const Advanced all = advance(instructions)(boxes, first, count, asks_exact);
          return std::pair(std::array{all.widest_x, all.widest_y, all.shift_x, all.shift_y,
                                      all.begun_x, all.begun_y, all.is_exact ? 1.0f : 0.0f},
                           now);
        };
        const auto plain = taken(Instructions::scalar);
        EXPECT_EQ(plain, taken(Instructions::sse2)) << layout.name << count;
        EXPECT_EQ(plain, taken(Instructions::best)) << layout.name << count;
        for (std::uint32_t i = 3; i < count; ++i)
          ASSERT_EQ(plain.second[2][i], projection(regions[ids[i]].now).high_x);
      }
    }
}

TEST(ChangeJoinLong, DriftsThroughEveryLayout) {
  for (std::uint64_t seed = 10; seed < 40; ++seed)
    for (const Layout& layout : layouts) {
      // Brute force is what takes the time: many are followed under every fifth seed alone.
      const std::uint32_t share = seed % 5 == 0 ? 1 : 3;
      for (const Shape shape : {Shape::rectangle, Shape::disc})
        drift(layout, seed, 700 / share, 300 / share, 100, shape);
      if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(ChangeJoinLong, FollowsFewThroughEveryShareOfMoversOverThousandsOfSeeds) {
  for (std::uint64_t seed = 1000; seed < 4000; ++seed)
    for (const Layout& layout : layouts) {
      follow(layout, seed, 40, 20, 1, seed % 2 == 0 ? Shape::rectangle : Shape::disc);
      if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(ChangeJoinLong, FollowsManyThroughEveryShareOfMovers) {
  for (std::uint64_t seed = 10; seed < 60; ++seed)
    for (const Layout& layout : layouts) {
      follow(layout, seed, static_cast<std::uint32_t>(10 * seed),
             static_cast<std::uint32_t>(700 - 10 * seed), 8,
             seed % 2 == 0 ? Shape::rectangle : Shape::disc);
      if (testing::Test::HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace rink::im
