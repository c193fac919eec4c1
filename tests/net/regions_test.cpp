// Regions of a game over the network: that of a player stays around the bat, and that of what is
// gone goes with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rti/management/federation_report.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

std::uint32_t regions_of(LockstepRink& rink, const std::string& name) {
  const rti::FederationReport report = rink.execution().report();
  const auto found = std::ranges::find(report.federates, name, &rti::FederateReport::name);
  return found != report.federates.end() ? found->counts.regions : 0u;
}

TEST(RegionsOfTheServer, AreOneForEachEntityHoweverManyCameAndWent) {
  LockstepRink rink(small_crowd(), {.clients = 3});
  rink.start();
  rink.run(0.2);
  ASSERT_EQ(regions_of(rink, "server"), rink.server().game().entities().size());
  for (int round = 0; round < 4; ++round) {
    const std::size_t player = rink.client_count() - 1;
    rink.leave(player);
    rink.run(0.1);
    EXPECT_EQ(regions_of(rink, "server"), rink.server().game().entities().size())
        << "after one has left";
    rink.add_client("bat-2");
    rink.run(0.2);
    EXPECT_EQ(regions_of(rink, "server"), rink.server().game().entities().size())
        << "after one has come";
  }
}

/// Declared anew when the bat is half of the margin from its middle, so that the view is always
/// within it: not later, and not at every step either.
TEST(TheRegionOfAPlayer, FollowsTheBatByHalvesOfItsMargin) {
  constexpr double margin = 0.3;
  const Scene scene = match();
  LockstepRink rink(scene,
                    {.clients = 2, .rate_hz = 60.0, .view_fraction = 0.05, .view_margin = margin});
  rink.start();
  Client& player = rink.client(0);
  const physics::Field& field = scene.world.field;
  const double view_half = 0.5 * std::sqrt(0.05 * field.length * field.width);
  std::uint32_t declared = 0;
  double furthest = 0.0, path = 0.0;
  Vector2 before = rink.server().game().position(*rink.server().game().bat(0));
  im::Region last = player.view();
  for (int tick = 0; tick < 240; ++tick) {
    if (tick % 60 == 0) player.press(tick % 120 == 0 ? Key::up : Key::down);
    if (tick % 60 == 30) player.release(tick % 120 == 30 ? Key::up : Key::down);
    rink.tick();
    const Vector2 bat = rink.server().game().position(*rink.server().game().bat(0));
    path += (bat - before).norm(), before = bat;
    const im::Region& view = player.view();
    const Vector2 middle(0.5 * (view.low_x + view.high_x), 0.5 * (view.low_y + view.high_y));
    furthest = std::max(furthest, (bat - middle).cwiseAbs().maxCoeff());
    EXPECT_NEAR(view.high_x - view.low_x, 2.0 * (view_half + margin), 1e-6);
    declared += view == last ? 0u : 1u;
    last = view;
  }
  EXPECT_LE(furthest, 0.5 * margin + 1e-6);
  EXPECT_GT(furthest, 0.4 * margin) << "or the test shows nothing";
  EXPECT_GE(declared, 2u);
  EXPECT_LE(declared, path / (0.5 * margin) + 1.0);
}

/// The bats move by the server's replay. Under `none` players who declare no regions mirror what
/// those mirror who do, and are silent but for keys and heartbeats.
TEST(PlayersWithoutRegions, MirrorTheSameUnderNoneAndSendKeysAndHeartbeatsAlone) {
  const Scene scene = small_crowd();
  const LockstepSettings declaring{
      .scheme = "none", .clients = 4, .server = {.replay = keys_for(scene, 5, 4.0)}};
  LockstepSettings silent = declaring;
  silent.declares_regions = false;
  LockstepRink with(scene, declaring), without(scene, silent);
  for (LockstepRink* rink : {&with, &without}) {
    rink->start();
    rink->settle();
  }
  const auto sent_by = [](LockstepRink& rink, std::size_t k) {
    return rink.client(k).ambassador().counters();
  };
  std::vector<rti::AmbassadorCounters> with_before, without_before;
  for (std::size_t k = 0; k < with.client_count(); ++k)
    with_before.push_back(sent_by(with, k)), without_before.push_back(sent_by(without, k));
  std::uint64_t keys = 0;
  for (int tick = 0; tick < 90; ++tick) {
    if (tick % 30 == 0) {
      for (LockstepRink* rink : {&with, &without}) rink->client(0).press(Key::up);
      ++keys;
    }
    with.tick(), without.tick();
    for (std::size_t k = 0; k < with.client_count(); ++k) {
      const ReplicaSet &mine = without.client(k).replicas(), &other = with.client(k).replicas();
      ASSERT_EQ(mine.entities().size(), other.entities().size());
      ASSERT_EQ(mine.counters().updates, other.counters().updates);
      for (const Entity& entity : with.server().game().entities()) {
        const EntityReplica *one = mine.find(without.server().publisher().object(entity.id)),
                            *two = other.find(with.server().publisher().object(entity.id));
        ASSERT_TRUE(one != nullptr && two != nullptr && one->in_scope && two->in_scope)
            << "client " << k << ", entity " << entity.id.index;
        ASSERT_EQ(one->position, two->position)
            << "client " << k << ", entity " << entity.id.index << ", tick " << tick;
      }
    }
  }
  constexpr std::uint64_t heartbeats_max = 3;  // one for each second of silence
  for (std::size_t k = 0; k < with.client_count(); ++k) {
    const rti::AmbassadorCounters declared = sent_by(with, k), kept_silent = sent_by(without, k);
    EXPECT_LE(kept_silent.frames_sent - without_before[k].frames_sent,
              heartbeats_max + (k == 0 ? keys : 0u))
        << "client " << k;
    EXPECT_GT(declared.bytes_sent - with_before[k].bytes_sent,
              10 * (kept_silent.bytes_sent - without_before[k].bytes_sent))
        << "or the test shows nothing";
  }
  EXPECT_EQ(regions_of(without, "bat-0"), 0u);
  EXPECT_EQ(regions_of(with, "bat-0"), 1u);
}

}  // namespace
}  // namespace rink::game
