// Headings and flights that the game's server hands to the RTI's filter, and rates by tier, against
// the game itself.
#include "game/net/server/push_filter_hints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "game/replication/region_sweep.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

const Entity& bat_of(LockstepRink& rink, std::uint32_t player) {
  return rink.server().game().entity(*rink.server().game().bat(player));
}

im::Region view_of(LockstepRink& rink, std::uint32_t player) {
  std::vector<rti::SubscribedRegion> views;
  rink.execution().list_subscribed_regions(views);
  return std::ranges::find(views, *rink.server().seats().federate_of(player),
                           &rti::SubscribedRegion::federate)
      ->bounds;
}

TEST(Headings, AreWhereKeysPushAPlayerAndNotWhereHisBatStillGoes) {
  LockstepRink rink(small_crowd(),
                    {.scheme = "cone(half_angle=90)", .clients = 1, .view_fraction = 0.5});
  rink.start();
  rink.client(0).press(Key::right);
  rink.run(0.6);
  rink.client(0).release(Key::right);
  rink.client(0).press(Key::left);
  rink.tick();
  const im::Region view = view_of(rink, 0);
  rink.tick();
  const Game& game = rink.server().game();
  ASSERT_GT(game.velocity(bat_of(rink, 0).id).x(), 0.0) << "it goes right, and is pushed left";
  const double x = (view.low_x + view.high_x) / 2.0, y = (view.low_y + view.high_y) / 2.0,
               radius = (view.high_x - view.low_x) / 2.0;
  std::size_t seen = 0, hidden = 0;
  for (const Entity& each : game.entities()) {
    const Vector2 offset = game.position(each.id) - Vector2(x, y);
    if (each.player == 0u || offset.norm() > radius - 0.2 ||
        std::abs(offset.x()) < each.half_extent.x() + 1e-3)
      continue;
    EXPECT_EQ(rink.execution().is_in_scope(*rink.server().seats().federate_of(0),
                                           rink.server().publisher().object(each.id)),
              offset.x() < 0.0);
    ++(offset.x() < 0.0 ? seen : hidden);
  }
  EXPECT_GT(seen, 5u);
  EXPECT_GT(hidden, 5u);
}

struct Missed {
  std::size_t pairs = 0, missed = 0,
              missed_unhit = 0;  ///< the last: of pucks that no bat pushed and nothing hit
  std::uint64_t regions_changed = 0;
};

/// Pairs of a player's declared region and a puck whose box was in it at some of five instants of a
/// tick, and those of them that the decision at its beginning did not hold.
Missed missed_within_ticks(const std::string& scheme, std::uint32_t sweep_ticks) {
  const Scene scene = small_crowd();
  const double rate_hz = 20.0;
  LockstepRink rink(scene, {.scheme = scheme,
                            .clients = 4,
                            .rate_hz = rate_hz,
                            .server = {.sweep_ticks = sweep_ticks,
                                       .tick_s = 1.0 / rate_hz,
                                       .replay = keys_for(scene, 5, 4.0)}});
  rink.start();
  Missed result;
  for (int tick = 0; tick < 40; ++tick) {
    std::vector<im::Region> views;
    for (std::uint32_t player = 0; player < 4; ++player) views.push_back(view_of(rink, player));
    rink.tick();
    Game ahead = rink.server().game().copy();
    std::vector<std::pair<std::uint32_t, EntityId>> within;
    for (int part = 0; part < 5; ++part) {
      ahead.advance(rink.now + part / rate_hz / 5.0);
      for (std::uint32_t player = 0; player < 4; ++player) {
        const im::Region& view = views[player];
        for (const Entity& each : ahead.entities()) {
          if (each.kind != physics::BodyKind::puck) continue;
          const im::Region box = bounding_box(ahead.position(each.id), each.half_extent);
          if (box.high_x > view.low_x + 1e-5 && box.low_x < view.high_x - 1e-5 &&
              box.high_y > view.low_y + 1e-5 && box.low_y < view.high_y - 1e-5)
            within.emplace_back(player, each.id);
        }
      }
    }
    std::ranges::sort(within, [](const auto& a, const auto& b) {
      return std::pair(a.first, a.second.index) < std::pair(b.first, b.second.index);
    });
    within.erase(std::unique(within.begin(), within.end()), within.end());
    for (const auto& [player, puck] : within) {
      ++result.pairs;
      if (rink.execution().is_in_scope(*rink.server().seats().federate_of(player),
                                       rink.server().publisher().object(puck)))
        continue;
      ++result.missed;
      const physics::World& world = rink.server().game().world();
      const bool is_free = world.motion(puck).acceleration.isZero(0.0) &&
                           world.motion(puck).drag.isConstant(world.spec().puck_drag, 0.0);
      if (is_free && ahead.world().motion_version(puck) == world.motion_version(puck))
        ++result.missed_unhit;
    }
  }
  result.regions_changed = rink.execution().distribution().counters().regions_changed;
  return result;
}

TEST(Flights, LetADecisionHoldUntilTheNextAndSpareRegions) {
  const Missed plain = missed_within_ticks("region", 0),
               flown = missed_within_ticks("region with swept(horizon=0.1)", 0),
               swept = missed_within_ticks("region", 2);
  ASSERT_GT(plain.missed, 20u) << "of " << plain.pairs;
  EXPECT_LT(4 * flown.missed, plain.missed) << flown.missed << " of " << flown.pairs << ", against "
                                            << plain.missed << " of " << plain.pairs;
  EXPECT_EQ(flown.missed_unhit, 0u) << "a flight is exact until something hits the puck";
  EXPECT_EQ(swept.missed, 0u)
      << "which the sweep of the server reckons with, at the price of larger regions";
  EXPECT_LT(2 * flown.regions_changed, plain.regions_changed)
      << "a puck's region is handed in when it takes another flight";
}

TEST(Flights, OfWhatFrictionStopsAreNotHandedIn) {
  Scene scene = small_crowd();
  scene.world.puck_friction = 0.5;
  LockstepRink rink(scene, {.scheme = "region with swept(horizon=0.1)", .clients = 2});
  rink.start();
  rink.run(1.0);
  const im::Region view = view_of(rink, 0);
  rink.tick();
  std::vector<im::StageCount> counts;
  rink.execution().filter().list_counts(counts);
  for (const im::StageCount& each : counts)
    if (std::string(each.what) == "flights told") {
      EXPECT_LE(each.count, rink.server().game().entities().size())
          << "at rest they have one, of no velocity";
    }
  for (const Entity& each : rink.server().game().entities()) {
    const im::Region box = bounding_box(rink.server().game().position(each.id), each.half_extent);
    const double gap = std::max({view.low_x - box.high_x, box.low_x - view.high_x,
                                 view.low_y - box.high_y, box.low_y - view.high_y});
    if (std::abs(gap) > 1e-5) {
      EXPECT_EQ(rink.execution().is_in_scope(*rink.server().seats().federate_of(0),
                                             rink.server().publisher().object(each.id)),
                gap < 0.0);
    }
  }
}

/// In a far tier a body was, at one of the last eight ticks, where a player believes it to be; and
/// one whose motion has not changed for so long is where he works it out to be.
TEST(Tiers, NeverLeaveAMirrorMoreThanItsPeriodBehind) {
  for (const std::string policy : {"periodic", "on-event", "snapshot"}) {
    const Scene scene = small_crowd();
    LockstepRink rink(scene, {.scheme = "none with tiers(at=0.05 at=0.1 at=0.2)",
                              .clients = 2,
                              .view_fraction = 1.0,
                              .extrapolates = false,
                              .server = {.policy = policy, .replay = keys_for(scene, 5, 4.0)}});
    rink.start();
    const physics::World& world = rink.server().game().world();
    std::vector<std::vector<Vector2>> paths(world.body_count());
    std::vector<std::vector<std::uint32_t>> versions(world.body_count());
    std::size_t compared = 0;
    for (std::size_t tick = 0; tick < 60; ++tick) {
      rink.tick();
      for (const Entity& each : rink.server().game().entities()) {
        std::vector<Vector2>& path = paths[each.id.index];
        path.push_back(rink.server().game().position(each.id));
        versions[each.id.index].push_back(world.motion_version(each.id));
        if (tick < 8 || (policy == "snapshot" && each.kind == physics::BodyKind::bat))
          continue;  // snapshots know nothing of thrust
        const EntityReplica* const seen =
            rink.client(0).replicas().find(rink.server().publisher().object(each.id));
        ASSERT_NE(seen, nullptr);
        const Vector2 believed = seen->position_at(rink.now);
        double off = (believed - path[tick]).norm();
        if (policy != "periodic" &&
            versions[each.id.index][tick] != versions[each.id.index][tick - 8])
          continue;
        for (std::size_t back = 1; policy == "periodic" && back < 8; ++back)
          off = std::min(off, (believed - path[tick - back]).norm());
        EXPECT_LT(off, 3e-3) << policy << ", entity " << each.id.index << " at tick " << tick;
        ++compared;
      }
    }
    EXPECT_GT(compared, 1000u) << policy;
    EXPECT_GT(rink.execution().counters().updates_put_off, 100u) << policy;
  }
}

}  // namespace
}  // namespace rink::game
