// Swept update regions against the paths that the bodies really took.
#include <gtest/gtest.h>

#include "game/control/game.h"
#include "game/players/random_plan.h"
#include "game/replication/region_sweep.h"
#include "tests/net/scenes.h"
#include "tests/physics/scenes.h"

namespace rink::game {
namespace {

bool contains(const im::Region& outer, const im::Region& inner) {
  return outer.low_x <= inner.low_x && outer.low_y <= inner.low_y && outer.high_x >= inner.high_x &&
         outer.high_y >= inner.high_y;
}

TEST(RegionSweep, ThePathBoxHoldsEveryPointOfThePathAndTouchesIt) {
  const physics::Motion thrown_against_thrust{.time = 1.0,
                                              .position = {2.0, 3.0},
                                              .velocity = {1.5, -0.4},
                                              .acceleration = {-4.0, 0.0},
                                              .drag = {3.0, 0.0}};
  const im::Region box = path_box(thrown_against_thrust, 1.1, 2.0);
  double highest = -1.0;
  for (int i = 0; i <= 100'000; ++i) {
    const physics::Vector2 at = thrown_against_thrust.at(1.1 + 0.9 * i / 100'000).position;
    ASSERT_TRUE(
        contains({box.low_x - 1e-12, box.low_y - 1e-12, box.high_x + 1e-12, box.high_y + 1e-12},
                 {at.x(), at.y(), at.x(), at.y()}));
    highest = std::max(highest, at.x());
  }
  EXPECT_NEAR(box.high_x, highest, 1e-9) << "it turns on the way, and the box ends where it does";
}

/// Of all that an impact can do, what it does most: a light one that rests is thrown at twice the
/// speed of the heavy one that hits it just after a tick. If it comes to meet it, its own speed is
/// added.
TEST(RegionSweep, HoldsWhoIsThrownByAnImpactRightAfterTheTick) {
  constexpr double tick_s = 0.05, radius = 0.1, speed = 10.0;
  for (const double own : {0.0, 3.0, 10.0}) {
    physics::World world(physics::test::rink_of(10.0, 2.0));
    const physics::BodyId light = world.add(physics::PuckSpec{
        .position = {5.0, 1.0}, .velocity = {-own, 0.0}, .radius = radius, .mass = 1e-3});
    world.add(physics::PuckSpec{.position = {5.0 - 2.0 * radius - 1e-6, 1.0},
                                .velocity = {speed, 0.0},
                                .radius = radius,
                                .mass = 1e3});
    RegionSweep sweep(1, tick_s);
    physics::Movers movers;
    movers.look(world);
    sweep.look_at(world, movers);
    RegionSweep::Swept swept;
    const im::Region region = sweep.region(world, light, swept);
    world.advance(tick_s);
    EXPECT_NEAR(world.velocity(light).x(), 2.0 * speed + own, 1e-3);
    EXPECT_TRUE(contains(region, bounding_box(world.position(light), world.half_extent(light))))
        << world.position(light).x() << " beyond " << region.high_x;
  }
}

TEST(RegionSweep, HoldsForAsManyTicksAsItWasSweptAndForNoneAfterAnImpact) {
  constexpr double tick_s = 1.0 / 32.0;
  for (const std::uint32_t ticks : {1u, 2u, 5u}) {
    physics::World world(physics::test::rink_of(10.0, 2.0));
    const physics::BodyId puck =
        world.add(physics::PuckSpec{.position = {1.0, 1.0}, .velocity = {1.0, 0.0}, .radius = 0.1});
    RegionSweep sweep(ticks, tick_s);
    physics::Movers movers;
    movers.look(world);
    sweep.look_at(world, movers);
    RegionSweep::Swept swept;
    sweep.region(world, puck, swept);
    for (std::uint32_t tick = 0; tick <= ticks; ++tick) {
      world.advance(tick_s * tick);
      EXPECT_EQ(sweep.still_holds(world, puck, swept), tick < ticks) << tick << " of " << ticks;
    }
  }
}

TEST(RegionSweep, WhatIsDecidedAtATickHoldsUntilTheNextWhateverIsHit) {
  const Scene scene = small_crowd();
  Game game(scene);
  for (const InputEvent& event : game::random_plan(3, game.player_count(), 4.0)) game.submit(event);
  constexpr double tick_s = 1.0 / 30.0;
  for (const std::uint32_t ticks : {1u, 4u}) {
    RegionSweep sweep(ticks, tick_s);
    physics::Movers movers;
    std::vector<RegionSweep::Swept> swept(game.world().body_count());
    std::vector<im::Region> regions(game.world().body_count());
    std::uint64_t kept = 0, remade = 0;
    const double start = game.now();
    for (int tick = 0; tick < 60; ++tick) {
      movers.look(game.world());
      sweep.look_at(game.world(), movers);
      std::vector<bool> was_in_play(
          game.world().body_count());  // a puck that is put back at a face-off appears, it does not
                                       // come by a path
      for (const Entity& entity : game.entities()) {
        const bool holds =
            tick > 0 && sweep.still_holds(game.world(), entity.id, swept[entity.id.index]);
        if (!holds)
          regions[entity.id.index] = sweep.region(game.world(), entity.id, swept[entity.id.index]);
        ++(holds ? kept : remade);
        was_in_play[entity.id.index] = game.world().is_in_play(entity.id);
      }
      for (int part = 0; part < 8; ++part) {
        game.advance(start + (tick + part / 8.0) * tick_s);
        for (const Entity& entity : game.entities())
          if (was_in_play[entity.id.index] && game.world().is_in_play(entity.id)) {
            ASSERT_TRUE(contains(regions[entity.id.index],
                                 bounding_box(game.position(entity.id), entity.half_extent)))
                << "entity " << entity.id.index << " tick " << tick << " part " << part << " at "
                << game.position(entity.id).transpose() << " region "
                << regions[entity.id.index].low_x << " " << regions[entity.id.index].high_x << " "
                << regions[entity.id.index].low_y << " " << regions[entity.id.index].high_y << " v "
                << game.velocity(entity.id).transpose() << " ticks " << ticks;
          }
      }
      game.advance(start + (tick + 1) * tick_s);
    }
    if (ticks == 4) {
      EXPECT_GT(kept, remade) << "most regions outlive their tick";
    }
  }
}

}  // namespace
}  // namespace rink::game
