// Lists of changes against the versions of all motions, however often and by whom they are read.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "game/physics/movers.h"
#include "game/physics/world.h"
#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

/// What a reader that looks at everything at each reading would know.
struct Seen {
  std::vector<std::uint32_t> versions;
  std::vector<bool> is_in_play, is_removed;
};

Seen look_at_all(const World& world) {
  Seen seen;
  for (std::uint32_t k = 0; k < world.body_count(); ++k) {
    seen.versions.push_back(world.motion_version({k}));
    seen.is_in_play.push_back(world.is_in_play({k}));
    seen.is_removed.push_back(world.is_removed({k}));
  }
  return seen;
}

std::set<std::uint32_t> changed_between(const Seen& before, const Seen& after) {
  std::set<std::uint32_t> bodies;
  for (std::uint32_t k = 0; k < after.versions.size(); ++k)
    if (k >= before.versions.size() || before.versions[k] != after.versions[k] ||
        before.is_in_play[k] != after.is_in_play[k] || before.is_removed[k] != after.is_removed[k])
      bodies.insert(k);
  return bodies;
}

std::set<std::uint32_t> in(std::span<const BodyId> bodies) {
  std::set<std::uint32_t> numbers;
  for (const BodyId body : bodies) numbers.insert(body.index);
  return numbers;
}

/// Pucks, a post and bats between walls, of which some rest at first.
World a_world_with_all_kinds() {
  WorldSpec spec = test::rink_of(6.0, 3.0);
  spec.puck_drag = 0.5;
  World world(spec);
  world.add(PostSpec{.position = {3.0, 1.5}, .radius = 0.2});
  world.add(BatSpec{.position = {1.0, 1.5}, .half_extent = {0.05, 0.2}});
  world.add(BatSpec{.position = {5.0, 1.5}, .half_extent = {0.05, 0.2}});
  for (int k = 0; k < 40; ++k)
    world.add(PuckSpec{.position = {0.3 + 0.55 * (k % 10), 0.3 + 0.3 * (k / 10) + (k / 20) * 1.2},
                       .velocity = {k % 7 == 0 ? 1.0 + 0.1 * k : 0.0, k % 7 == 0 ? 0.7 : 0.0},
                       .radius = 0.04});
  return world;
}

TEST(Changes, AreThoseOfAllMotionsWhoeverReadsThemAndHoweverOften) {
  World world = a_world_with_all_kinds();
  std::mt19937_64 random(3);
  constexpr std::array<int, 3> strides{1, 3, 17};
  std::array<ChangeCursor, 3> cursors;
  std::array<Seen, 3> seen;
  for (int step = 0; step < 400; ++step) {
    if (step % 5 == 0)
      world.set_thrust({1 + static_cast<std::uint32_t>(random() % 2)},
                       {static_cast<double>(random() % 5) - 2.0, 0.5});
    if (step % 90 == 89) world.remove({3 + static_cast<std::uint32_t>(step / 10)});
    if (step == 200 && world.is_free({0.1, 0.1}, 0.03))
      world.add(PuckSpec{.position = {0.1, 0.1}, .velocity = {0.0, 0.0}, .radius = 0.03});
    world.advance(0.01 * (step + 1));
    for (std::size_t reader = 0; reader < strides.size(); ++reader) {
      if (step % strides[reader] != 0) continue;
      Seen now = look_at_all(world);
      ASSERT_EQ(in(world.changed(cursors[reader])), changed_between(seen[reader], now))
          << "reader " << reader << " at step " << step;
      seen[reader] = std::move(now);
    }
  }
}

TEST(Changes, AreAllBodiesForWhoReadsForTheFirstTimeOrComesFromAnotherWorld) {
  World first = a_world_with_all_kinds(), second = a_world_with_all_kinds();
  ChangeCursor cursor;
  EXPECT_EQ(first.changed(cursor).size(), first.body_count());
  EXPECT_TRUE(first.changed(cursor).empty());
  EXPECT_EQ(second.changed(cursor).size(), second.body_count());
  const auto restored = World::restore(second.save());
  ASSERT_TRUE(restored);
  EXPECT_EQ(restored->changed(cursor).size(), restored->body_count());
}

/// Two bodies that hit each other again and again, and a reader that looks once in thousands.
TEST(Changes, AreHandedOutToASlowReaderWithoutKeepingMoreThanItNeeds) {
  World world(test::rink_of(1.0, 0.2));
  for (const double x : {0.2, 0.8})
    world.add(PuckSpec{.position = {x, 0.1}, .velocity = {0.5 - x, 0.0}, .radius = 0.05});
  world.add(PuckSpec{.position = {0.5, 0.05}, .velocity = {0.0, 0.0}, .radius = 0.01});
  ChangeCursor slow, quick;
  world.changed(slow);
  for (int step = 0; step < 10'000; ++step) {
    world.advance(0.5 * (step + 1));
    world.changed(quick);
  }
  const auto changed = world.changed(slow);
  EXPECT_LE(changed.size(), 2u * world.body_count() + 1024u + world.body_count());
  const std::set<std::uint32_t> bodies = in(changed);
  EXPECT_TRUE(bodies.contains(0) && bodies.contains(1));
}

TEST(Movers, AreThoseInPlayWhoDoNotRest) {
  World world = a_world_with_all_kinds();
  Movers movers;
  for (int step = 0; step < 300; ++step) {
    if (step % 20 == 0) world.set_thrust({1}, {step % 40 == 0 ? 2.0 : -2.0, 0.0});
    if (step == 150) world.remove({1});
    world.advance(0.02 * (step + 1));
    movers.look(world);
    std::set<std::uint32_t> moving;
    for (std::uint32_t k = 0; k < world.body_count(); ++k)
      if (world.is_in_play({k}) && !world.is_resting({k})) moving.insert(k);
    ASSERT_EQ(in(movers.moving()), moving) << "at step " << step;
    EXPECT_TRUE(std::ranges::is_sorted(movers.moving()));
    EXPECT_TRUE(std::ranges::is_sorted(movers.changed()));
  }
}

}  // namespace
}  // namespace rink::physics
