// Who exchanges claims and handovers with whom: those whose bodies may meet, and nobody else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>

#include "game/peer/assembly.h"
#include "game/peer/cuts.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Four strips, each 1 m wide.
Halos second_of_four(double halo) {
  Halos halos(Division::into_strips(field, 4), 1, halo);
  halos.keep_to_neighbours(false);
  return halos;
}

TEST(Neighbours, AreAllOthersUntilVerdictsHaveSaidHowFarBodiesReach) {
  Halos halos = second_of_four(0.2);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u, 3u));
  halos.end_run(0.0);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u, 3u)) << "still of the first window";
  halos.begin_window();
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u));
}

TEST(Neighbours, AreThoseWhoseHalosMeetAndThoseThatGroupsReach) {
  Halos halos = second_of_four(0.2);
  halos.end_run(0.0), halos.begin_window();
  halos.set(3, 0.9), halos.end_run(0.0);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u, 3u)) << "they are 1 m apart";
  halos.set(3, 0.2), halos.end_run(0.0);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u, 3u)) << "until the window is over";
  halos.begin_window();
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u));
  halos.end_run(0.6), halos.begin_window();
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u, 3u)) << "a group is 0.6 m long";
}

TEST(Neighbours, AreThoseIntoWhoseZonesAnAnnexReaches) {
  Halos halos = second_of_four(0.2);
  halos.end_run(0.0), halos.begin_window();
  halos.set_annexes(3, {{1.7, 0.5, 2.5, 1.0}}), halos.end_run(0.0);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u, 3u));
  EXPECT_TRUE(halos.is_near(3, {1.8, 0.6, 1.9, 0.7}));
  EXPECT_FALSE(halos.is_near(3, {1.5, 0.6, 1.6, 0.7}));
  EXPECT_NEAR(halos.deepest_annex(), 0.3, 1e-12) << "from the zone's right side, at 2 m";
  halos.set_annexes(3, {}), halos.end_run(0.0);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u, 3u)) << "until the window is over";
  halos.begin_window();
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u));
  halos.set_annexes(1, {{2.5, 0.5, 3.1, 1.0}}), halos.end_run(0.0);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 2u, 3u)) << "an own annex as well";
  EXPECT_EQ(halos.deepest_annex(), 0.0);
}

TEST(Neighbours, HaveZonesAndPlayOn) {
  Halos halos = second_of_four(0.2);
  halos.end_run(0.0), halos.begin_window();
  halos.set_present(2, false);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u));
  halos.divide(Division(field, {{{0.0, 0.0, 4.0, 2.0}, 1}}, 5), 0.2);
  EXPECT_THAT(halos.neighbours(), ElementsAre(0u, 3u)) << "who leaves hands over what it has";
  halos.end_run(0.0), halos.begin_window();
  EXPECT_THAT(halos.neighbours(), IsEmpty());
  Halos late(Division(field, {{{0.0, 0.0, 4.0, 2.0}, 1}}, 2), 0, 0.2);
  late.keep_to_neighbours(true);
  EXPECT_THAT(late.neighbours(), IsEmpty()) << "it comes without a zone";
}

struct Traffic {
  std::uint64_t messages = 0, bytes = 0, different = 0;
};

/// Of each window and peer, verdicts left out. The field grows with the peers, who have 25 pucks
/// each.
Traffic traffic_of(PeerNumber peer_count, bool keeps_to_neighbours) {
  constexpr int windows = 40;
  constexpr double window = 0.02;
  physics::WorldSpec spec = physics::test::rink_of(16.0, 1.0 * peer_count / 8.0);
  physics::World whole(spec);
  Random random(5);
  std::vector<Vector2> places;
  while (whole.body_count() < 25 * peer_count) {
    physics::PuckSpec puck;
    puck.position = {uniform(random, 0.1, 15.9), uniform(random, 0.1, spec.field.width - 0.1)};
    puck.velocity = {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    if (!whole.is_free(puck.position, puck.radius)) continue;
    whole.add(puck), places.push_back(puck.position);
  }
  const Cuts cuts = Cuts::by_count(spec.field, places, peer_count);
  Assembly assembly(whole, cuts.division(peer_count), 0.2, window, keeps_to_neighbours);
  assembly.advance();
  const Assembly::Sent before = assembly.sent();
  for (int k = 1; k < windows; ++k) assembly.advance();
  physics::test::RandomKeys::advance(whole, window * windows);
  Traffic traffic;
  for (std::uint32_t body = 0; body < whole.body_count(); ++body)
    traffic.different +=
        bytes_of(assembly.state(body)) != bytes_of(physics::Subdomain::state_in(whole, body));
  traffic.messages = (assembly.sent().messages - before.messages) / (windows - 1);
  traffic.bytes = (assembly.sent().bytes - before.bytes) / (windows - 1);
  return traffic;
}

TEST(Neighbours, AloneSpeakToEachOtherInWindowsThatEqualOneEngine) {
  for (const PeerNumber peer_count : {8u, 32u}) {
    const Traffic all = traffic_of(peer_count, false), near = traffic_of(peer_count, true);
    std::cout << peer_count << " peers send in a window " << all.messages << " messages with "
              << all.bytes << " bytes to all, " << near.messages << " with " << near.bytes
              << " to neighbours\n";
    EXPECT_EQ(all.different + near.different, 0u);
    EXPECT_LT(near.messages, all.messages);
    EXPECT_LE(near.messages, 2u * 8u * peer_count) << "however many there are";
    EXPECT_LT(near.bytes, all.bytes);
  }
}

}  // namespace
}  // namespace rink::peer::test
