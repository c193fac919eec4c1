// Claims, their check, verdicts, handovers and live players, each without the protocol around it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <string>

#include "game/peer/window/handovers.h"
#include "game/peer/window/live_players.h"
#include "game/peer/window/window_verdicts.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

/// Two pucks that meet at x = 1.95 m, left of the border at 2 m, within 0.05 s; a third far left;
/// and a bat at the border's left. An `offset` [m] lets them meet
/// askew, which is a free impact.
physics::World meeting(double offset = 0.0) {
  physics::World world(physics::test::rink_of(4.0, 2.0));
  world.add(physics::PuckSpec{.position = {1.85, 1.0}, .velocity = {1.0, 0.0}, .radius = 0.05});
  world.add(
      physics::PuckSpec{.position = {2.05, 1.0 + offset}, .velocity = {-3.0, 0.0}, .radius = 0.05});
  world.add(physics::PuckSpec{.position = {0.5, 0.5}, .radius = 0.05});
  world.add(physics::BatSpec{.position = {1.8, 1.7}, .half_extent = {0.05, 0.05}});
  return world;
}

/// What one of two peers keeps of that scene, after a window of 0.05 s.
struct Side {
  Side(const physics::World& world, PeerNumber number, double halo = 0.25)
      : halos(Division::into_strips(field, 2), number, halo),
        share(world.spec(), world.body_count(), 2) {
    std::vector<std::uint32_t> all(world.body_count());
    std::iota(all.begin(), all.end(), 0u);
    for (const std::uint32_t body : all) share.put(body, physics::Subdomain::state_in(world, body));
    share.begin_window();
    homes.settle(share.settle(all, halos), window);
    homes.choose_watched(window);
    share.play({}, window.end);
    homes.find_edge();
    trace.follow(window);
  }
  Window window{.number = 4, .start = 0.0, .end = 0.05};
  Halos halos;
  Share share;
  Homes homes{share, halos};
  ClaimTrace trace{share, homes};
  Accusation accusation;
  ClaimCheck check{share, halos, homes, trace, accusation};
  TimedKeys keys;
  LivePlayers players{share, halos, accusation};
  Handovers handovers{share, halos, keys, accusation};
};

TEST(ClaimTrace, ClaimsTheEventsOfGhostsAndNothingOfWhatIsFarAway) {
  const Side left(meeting(), 0);
  const Claims claims = left.trace.claims_for(1, left.window, left.halos);
  EXPECT_EQ(claims.window, 4u);
  EXPECT_EQ(claims.known_count, 2u) << "a puck and the bat";
  ASSERT_EQ(claims.bodies.size(), 1u) << "nothing happened to the bat";
  EXPECT_EQ(claims.bodies.front().number, 0u);
  EXPECT_TRUE(claims.bodies.front().is_known);
  ASSERT_EQ(claims.flights.size(), 1u);
  EXPECT_NEAR(claims.flights.front().begin, 0.025, 1e-12);
  EXPECT_EQ(left.trace.own_events(), 1u);
  ASSERT_EQ(left.trace.mixed().size(), 1u) << "an own body and a ghost";
  EXPECT_EQ(left.trace.needed_halo(left.halos.own_zones()), 0.0);
}

TEST(ClaimCheck, AgreesWithAnHonestOwnerAndDoubtsAFalseDigest) {
  const physics::World world = meeting();
  Side left(world, 0);
  const Side right(world, 1);
  Claims claims = right.trace.claims_for(0, right.window, right.halos);
  left.check.receive(1, claims);
  ASSERT_TRUE(left.check.are_possible(left.window)) << left.accusation.text();
  EXPECT_TRUE(left.check.agree(left.window));
  EXPECT_FALSE(left.check.is_doubtful(1));
  claims.flights.front().state ^= 1;
  left.check.receive(1, claims);
  EXPECT_FALSE(left.check.agree(left.window)) << "it met an own body";
  EXPECT_TRUE(left.check.is_doubtful(1));
  left.check.blame_doubted();
  EXPECT_THAT(left.accusation.text(), StartsWith("peer 1 claims what cannot be agreed with of"));
}

TEST(ClaimCheck, WantsTheStatesOfMovedGhostsOnWhichItDoesNotAgree) {
  const physics::World world = meeting();
  Side left(world, 0);
  const Side right(world, 1);
  Claims claims = right.trace.claims_for(0, right.window, right.halos);
  const auto wanted = [&] {
    left.check.receive(1, claims);
    EXPECT_TRUE(left.check.are_possible(left.window)) << left.accusation.text();
    left.check.agree(left.window);
    return left.check.wanted();
  };
  EXPECT_THAT(wanted(), IsEmpty());
  claims.flights.front().state ^= 1;
  EXPECT_THAT(wanted(), ElementsAre(1u));
  claims.bodies.clear(), claims.flights.clear();
  EXPECT_THAT(wanted(), IsEmpty()) << "its owner says that it is as it was";
}

TEST(ClaimCheck, RefusesAnotherWindow) {
  Side left(meeting(), 0);
  left.check.receive(1, Claims{.window = 5, .bodies = {}, .flights = {}, .presses = {}});
  EXPECT_FALSE(left.check.are_possible(left.window));
  EXPECT_EQ(left.accusation.text(), "peer 1 claims window 5 instead of 4");
}

TEST(ClaimCheck, PutsDoubtfulGhostsBackOrTakesThemAway) {
  Side left(meeting(), 0);
  left.check.receive(1, Claims{.window = 4, .bodies = {}, .flights = {}, .presses = {}});
  EXPECT_FALSE(left.check.agree(left.window)) << "its owner says that it met nobody";
  left.check.correct(left.share);
  EXPECT_EQ(bytes_of(left.share.state(1)), bytes_of(left.share.subdomain().state_before(1)));
  EXPECT_FALSE(left.check.is_doubtful(1)) << "no longer";
}

TEST(WindowVerdicts, WidenTheHaloOfWhoRepeatsAlone) {
  Halos halos(Division::into_strips(field, 2), 0, 0.25);
  WindowVerdicts verdicts(halos, 6.0);
  EXPECT_FALSE(verdicts.decide({}, true, 0.5).accepts) << "its paths need a wider halo";
  verdicts.receive(1, {.accepts = true, .halo = 0.125f});
  EXPECT_EQ(verdicts.conclude(), Outcome::repeat);
  EXPECT_TRUE(verdicts.repeats(0) && !verdicts.repeats(1));
  EXPECT_NEAR(halos.own(), 0.525, 1e-6);
  EXPECT_EQ(halos.of(1), 0.25) << "it does not repeat";
  EXPECT_TRUE(verdicts.decide({}, true, 0.5).accepts);
  EXPECT_EQ(verdicts.conclude(), Outcome::final);
  EXPECT_EQ(halos.of(1), 0.125);
}

TEST(WindowVerdicts, GiveAllTheWholeFieldWhereTheEngineCountsEvents) {
  Halos halos(Division::into_strips(field, 2), 0, 0.25);
  WindowVerdicts verdicts(halos, 6.0);
  verdicts.decide({.at_once_max = physics::events_at_once_local / 2}, true, 0.0);
  verdicts.receive(1, {.accepts = true, .at_once_max = physics::events_at_once_local / 2});
  EXPECT_EQ(verdicts.conclude(), Outcome::repeat);
  EXPECT_TRUE(halos.are_whole());
}

TEST(WindowVerdicts, BlameWhoeverNeverAccepts) {
  Halos halos(Division::into_strips(field, 2), 0, 0.25);
  WindowVerdicts verdicts(halos, 6.0);
  Accusation accusation;
  int repeats = 0;
  for (; repeats < 1000 && !accusation.is_made(); ++repeats) {
    verdicts.decide({}, true, 0.0);
    verdicts.receive(1, {.accepts = false, .halo = 9.0f});
    EXPECT_EQ(verdicts.conclude(), Outcome::repeat);
    verdicts.blame_refusing({.number = 7}, accusation);
  }
  EXPECT_EQ(accusation.text(), "peer 1 accepts no run of window 7");
  EXPECT_EQ(repeats, 112);
  EXPECT_TRUE(verdicts.is_stuck());
  verdicts.begin_window();
  EXPECT_FALSE(verdicts.is_stuck());
}

TEST(LivePlayers, PressKeysOfTheirOwnBatsAlone) {
  Side left(meeting(), 0);
  left.players.seat({.bat = 3, .peer = 1, .period = 0.0, .puck_count = 1});
  const std::vector<Press> presses{{3, {1.0, 0.0}, 2, 0.0}, {3, {0.0, 0.0}, 1, 99.0}};
  left.players.stamp(1, presses, 0.05, left.keys);
  EXPECT_FALSE(left.accusation.is_made()) << left.accusation.text();
  ASSERT_EQ(left.keys.later().size(), 2u);
  EXPECT_EQ(left.keys.later().front().time, 0.05) << "not before the window's end";
  EXPECT_EQ(left.keys.later().back().time, 0.05 + LivePlayers::ahead_max);
  const std::vector<Observation> seen = left.players.due_for(1, left.window);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_THAT(seen.front().pucks, testing::SizeIs(1));
  EXPECT_THAT(left.players.due_for(0, left.window), IsEmpty());
  left.players.stamp(0, presses, 0.05, left.keys);
  EXPECT_EQ(left.accusation.text(), "peer 0 presses a key of bat 3, which it does not play");
}

TEST(LivePlayers, FeelKeysThatCameEarlyAtOnceIfNobodyElseHasTheBat) {
  constexpr std::uint32_t bat = 3;
  const Press press{bat, {1.0, 0.0}, 2, 0.0};
  Side left(meeting(), 0);
  left.players.seat({.bat = bat, .peer = 1, .period = 0.0, .puck_count = 0});
  left.players.receive_early(1, press), left.players.receive_early(0, press);
  left.players.stamp_unseen(0.0, left.keys);
  EXPECT_THAT(left.keys.due(), IsEmpty()) << "peer 1 has the bat as a ghost";
  left.players.stamp_early(0.05, left.keys);
  ASSERT_EQ(left.keys.later().size(), 1u) << "peer 0 does not play it";
  EXPECT_EQ(left.keys.later().front().time, 0.05);

  Side far(meeting(), 0, 0.01);
  far.players.seat({.bat = bat, .peer = 1, .period = 0.0, .puck_count = 0});
  far.players.receive_early(1, press);
  far.players.stamp_unseen(0.0, far.keys);
  ASSERT_EQ(far.keys.due().size(), 1u);
  EXPECT_EQ(far.keys.due().front().time, 0.0);
  far.players.stamp_early(0.05, far.keys);
  EXPECT_THAT(far.keys.later(), IsEmpty()) << "each is stamped once";
}

/// A message may hold as many as its sender likes: time that grows with their square would stop the
/// session.
TEST(LivePlayers, StampAHundredThousandEarlyKeysInOrder) {
  constexpr std::uint32_t bat = 3, count = 100'000;
  Side far(meeting(), 0, 0.01);
  far.players.seat({.bat = bat, .peer = 1, .period = 0.0, .puck_count = 0});
  for (std::uint32_t k = 0; k < count; ++k)
    far.players.receive_early(1, {bat, {1e-5 * k, 0.0}, 2, 0.0});
  far.players.stamp_unseen(0.0, far.keys);
  ASSERT_EQ(far.keys.due().size(), count);
  EXPECT_TRUE(
      std::ranges::is_sorted(far.keys.due(), {}, [](const Key& key) { return key.thrust.x(); }));
}

TEST(LivePlayers, KeepEarlyKeysOfABatOnItsWayForOneWindow) {
  constexpr std::uint32_t bat = 3;
  for (const int waits : {1, 2}) {
    Side right(meeting(), 1);
    right.players.seat({.bat = bat, .peer = 0, .period = 0.0, .puck_count = 0});
    right.players.receive_early(0, {bat, {1.0, 0.0}, 2, 0.0});
    for (int k = 1; k <= waits; ++k) right.players.stamp_early(0.05 * k, right.keys);
    EXPECT_THAT(right.keys.later(), IsEmpty()) << "it is the other's";
    right.halos.divide(Division(field, {{{0.0, 0.0, 1.25, 2.0}, 0}, {{1.25, 0.0, 4.0, 2.0}, 1}}, 2),
                       0.25);
    std::vector<std::uint32_t> there;
    for (std::uint32_t body = 0; body < right.share.roles().body_count(); ++body)
      if (right.share.subdomain().is_there(body)) there.push_back(body);
    right.share.settle(there, right.halos);
    ASSERT_TRUE(right.share.owns(bat));
    right.players.stamp_early(0.15, right.keys);
    EXPECT_THAT(right.keys.later(), testing::SizeIs(waits == 1 ? 1 : 0));
  }
}

TEST(Handovers, BringWhatComesIntoAnotherHalo) {
  const physics::World world = meeting();
  Side left(world, 0), right(world, 1);
  const auto send = [&] {
    return left.handovers.for_next(1, left.window, 0.1, left.homes, left.trace);
  };
  const Handover usual = send();
  EXPECT_EQ(usual.bodies.size() + usual.free_flights.size(), 0u) << "it has them, and can tell";
  left.handovers.note_wanted(1, {3, 0});
  const Handover sent = send();
  EXPECT_THAT(left.share.coming(1), ElementsAre(0u, 3u));
  ASSERT_EQ(sent.bodies.size() + sent.free_flights.size(), 1u) << "the bat is as it was";
  right.check.receive(0, left.trace.claims_for(1, left.window, left.halos));
  ASSERT_TRUE(right.check.are_possible(right.window) && right.check.agree(right.window));
  Handover lie = sent;
  lie.bodies.push_back({1, left.share.state(0)});
  right.handovers.receive(0, lie);
  right.handovers.complete(right.check);
  for (const auto& [body, state] : right.handovers.enter(0).bodies) EXPECT_EQ(body, 0u);
  EXPECT_EQ(right.accusation.text(), "peer 0 hands over body 1, which it does not own");
}

/// What peer 0 hands over to peer 1, which has a ghost of puck 0, after a window of `world`: with
/// the claims as `alter` leaves them, and the states as `lie` does. Answers the accusation.
std::string accused(
    const physics::World& world, const std::function<void(Handover&)>& lie,
    const std::function<void(Claims&)>& alter = [](Claims&) {}) {
  Side left(world, 0), right(world, 1);
  left.handovers.note_wanted(1, {0});
  Handover sent = left.handovers.for_next(1, left.window, 0.1, left.homes, left.trace);
  Claims claims = left.trace.claims_for(1, left.window, left.halos);
  alter(claims);
  lie(sent);
  right.check.receive(0, claims);
  EXPECT_TRUE(right.check.are_possible(right.window)) << right.accusation.text();
  right.check.agree(right.window);
  right.handovers.receive(0, sent);
  right.handovers.complete(right.check);
  return right.accusation.text();
}

constexpr const char* another_state =
    "peer 0 hands over body 0 in another state than it has claimed";

void nudge(Handover& sent) { sent.free_flights.at(0).velocity.x() *= 1.0 + 1e-9; }

/// Else an owner could hand over another body than the one that all saw fly.
TEST(Handovers, BringGhostsAsBothHaveThem) {
  const auto honest = [](Handover& sent) { EXPECT_EQ(sent.free_flights.size(), 1u); };
  EXPECT_EQ(accused(meeting(0.01), honest), "");
  EXPECT_EQ(accused(meeting(0.01), nudge), another_state);
  const auto whole = [](const physics::World& world, std::uint32_t repeats) {
    return [&world, repeats](Handover& sent) {
      BodyState state = physics::Subdomain::state_in(world, 0);
      sent.free_flights.at(0).write_to(state.flight);
      state.repeats = repeats;
      sent.free_flights.clear();
      sent.bodies = {{0, state}};
    };
  };
  const physics::World world = meeting(0.01);
  EXPECT_EQ(accused(world, whole(world, 0)), "");
  EXPECT_EQ(accused(world, whole(world, 3)), another_state) << "no claim shows that";
}

/// A puck that peer 1 does not have meets its ghost of puck 0.
physics::World meeting_beyond() {
  physics::World world(physics::test::rink_of(4.0, 2.0));
  world.add(physics::PuckSpec{.position = {1.8, 1.0}, .radius = 0.05});
  world.add(physics::PuckSpec{.position = {1.6, 1.01}, .velocity = {3.0, 0.0}, .radius = 0.05});
  world.add(physics::PuckSpec{.position = {3.0, 0.5}, .radius = 0.05});
  return world;
}

TEST(Handovers, BringDoubtfulGhostsAsTheirClaimsSay) {
  const auto honest = [](Handover& sent) { EXPECT_EQ(sent.free_flights.size(), 1u); };
  EXPECT_EQ(accused(meeting_beyond(), honest), "");
  EXPECT_EQ(accused(meeting_beyond(), nudge), another_state);
  const auto moved = [](double by) {
    return [by](Handover& sent) {
      BodyState state = physics::Subdomain::state_in(meeting_beyond(), 0);
      sent.free_flights.at(0).write_to(state.flight);
      state.flight.y += by;
      sent.free_flights.clear();
      sent.bodies = {{0, state}};
    };
  };
  EXPECT_EQ(accused(meeting_beyond(), moved(0.0)), "");
  EXPECT_EQ(accused(meeting_beyond(), moved(0.2)), another_state) << "not where it was claimed";
}

/// One that was only looked at after its impact has another last claim.
TEST(Handovers, BringGhostsThatWereLookedAtAfterTheirLastImpact) {
  const auto honest = [](Handover&) {};
  const auto look_at = [](Claims& claims) {
    Claims::Body& body = claims.bodies.at(0);
    ASSERT_EQ(body.number, 0u);
    ClaimedFlight looked_at = claims.flights.at(body.flight_count - 1);
    looked_at.state ^= 1;
    claims.flights.insert(claims.flights.begin() + body.flight_count++, looked_at);
  };
  EXPECT_EQ(accused(meeting(0.01), honest, look_at), "");
  EXPECT_EQ(accused(meeting_beyond(), honest, look_at), "");
  EXPECT_EQ(accused(meeting_beyond(), nudge, look_at), another_state);
}

TEST(Handovers, BringNothingOfGhostsOfWhichNothingIsClaimed) {
  const auto deny = [](Claims& claims) { claims.bodies.clear(), claims.flights.clear(); };
  EXPECT_EQ(accused(
                meeting_beyond(), [](Handover& sent) { sent.free_flights.clear(); }, deny),
            "");
  EXPECT_EQ(accused(
                meeting_beyond(), [](Handover&) {}, deny),
            another_state);
}

/// Else a peer could press the keys of others' bats, and hold what they own.
TEST(Handovers, BringNoKeysAndContactsOfOthers) {
  Side left(meeting(), 0);
  const Key key{0.1, 3, {1.0, 0.0}, 1};
  left.handovers.receive(1, {.bodies = {}, .rest_contacts = {}, .keys = {key}, .observations = {}});
  EXPECT_THAT(left.handovers.enter(1).keys, IsEmpty());
  EXPECT_EQ(left.accusation.text(), "peer 1 hands over a key of bat 3, which it does not own");

  Side other(meeting(), 0);
  const std::vector<RestContact> contacts{{.low = 0, .high = 1, .axis = 0, .age = {}},
                                          {.low = 0, .high = 2, .axis = 0, .age = {}}};
  other.handovers.receive(
      1, {.bodies = {}, .rest_contacts = contacts, .keys = {}, .observations = {}});
  EXPECT_EQ(other.handovers.enter(1).rest_contacts.size(), 1u) << "body 1 is peer 1's";
  EXPECT_EQ(other.accusation.text(),
            "peer 1 hands over a rest contact of bodies 0 and 2, neither of which it owns");
}

TEST(Handovers, BringWhatARepetitionNeeds) {
  Side left(meeting(), 0);
  left.halos.set(1, infinity);
  const Handover sent = left.handovers.for_repeat(1, left.window);
  ASSERT_EQ(sent.bodies.size(), 1u);
  EXPECT_EQ(sent.bodies.front().number, 2u) << "the others are there already";
  EXPECT_THAT(left.share.known(1), ElementsAre(0u, 2u, 3u));
}

}  // namespace
}  // namespace rink::peer::test
