// More peers than events may come at one instant: they are not taken for simultaneous unless they
// are.
#include <gtest/gtest.h>

#include "game/peer/assembly.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

constexpr PeerNumber peer_count = 80;

physics::WorldSpec long_hall() {
  physics::WorldSpec spec;
  spec.field = {
      .length = 80.0, .width = 1.0, .goal_width = 0.0, .wall = 0, .bats_keep_to_half = false};
  spec.restitution = physics::RestitutionTable(1, 1.0);
  return spec;
}

struct Compared {
  std::uint64_t different = 0, repeats = 0;
  std::uint64_t at_once = 0;
};

Compared played_alone_and_shared(physics::World& whole, int windows, double window) {
  Assembly assembly(whole, Division::into_strips(whole.spec().field, peer_count), 0.3, window);
  Compared compared;
  for (int k = 1; k <= windows; ++k) {
    physics::test::RandomKeys::advance(whole, window * k);
    assembly.advance();
    for (std::uint32_t body = 0; body < whole.body_count(); ++body)
      compared.different +=
          bytes_of(assembly.state(body)) != bytes_of(physics::Subdomain::state_in(whole, body));
  }
  for (const Peer& peer : assembly.peers()) compared.repeats += peer.counters().repeats;
  compared.at_once = whole.counters().events_at_once_max;
  return compared;
}

TEST(ManyPeers, PlayAGasWithoutTakingItsEventsForSimultaneous) {
  physics::World whole(long_hall());
  Random random(5);
  while (whole.body_count() < 400) {
    physics::PuckSpec puck;
    puck.position = {uniform(random, 0.1, 79.9), uniform(random, 0.1, 0.9)};
    puck.velocity = {uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0)};
    if (whole.is_free(puck.position, puck.radius)) whole.add(puck);
  }
  const Compared compared = played_alone_and_shared(whole, 60, 0.05);
  EXPECT_EQ(compared.different, 0u);
  // Were sums over peers all that is known, each of the 80 would repeat each of the 60 windows.
  EXPECT_LT(compared.repeats, 100u);
}

/// One in each zone, all of which hit a wall at the same instant, again and again.
TEST(ManyPeers, NoticeWhatIsSimultaneousAmongAll) {
  physics::World whole(long_hall());
  for (PeerNumber zone = 0; zone < peer_count; ++zone) {
    physics::PuckSpec puck;
    puck.position = {zone + 0.5, 0.5};
    puck.velocity = {0.0, 1.0};
    whole.add(puck);
  }
  const Compared compared = played_alone_and_shared(whole, 20, 0.1);
  EXPECT_EQ(compared.at_once, 80u);
  EXPECT_EQ(compared.different, 0u);
  EXPECT_GE(compared.repeats, peer_count);
}

}  // namespace
}  // namespace rink::peer::test
