// What peers of a session agree on, and what they know of lost ones: without windows or messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "game/peer/session/agreement.h"
#include "game/peer/session/marks.h"
#include "game/peer/session/part_change.h"
#include "game/peer/session/replicas.h"
#include "game/physics/bodies/body_records.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Three peers at the start of a session of 30 windows of 0.1 s, with two spare bats.
struct Three {
  SessionSettings settings{.number = 0, .peer_count = 3, .window_count = 30, .end_of = [](auto k) {
                             return 0.1 * static_cast<double>(k);
                           }};
  Whole whole{.spec = physics::test::rink_of(4.0, 2.0), .body_count = 3, .puck_radii = {0.1, 0.1}};
  State now{
      .members = {0, 1, 2}, .cuts = Cuts::by_count(field, {}, 3), .slots = 3, .next_number = 3};
  Halos halos{now.division(), 0, 0.25};
  WindowVerdicts verdicts{halos, 6.0};
  Roles roles{3};
  Accusation accusation;
  Three() { settings.bat_count = 2; }
  State next() {
    const Agreement agreement(settings, whole);
    const State state = agreement.next(now, verdicts, roles, 0.1, accusation);
    state.check();
    return state;
  }
};

TEST(Agreement, GivesTheZonesOfWhoLeavesToOthers) {
  Three three;
  three.verdicts.receive(1, {.accepts = true, .leaves = true});
  const State next = three.next();
  EXPECT_EQ(next.step, 1u);
  EXPECT_EQ(next.window, 1u);
  EXPECT_THAT(next.cuts.peers(), ElementsAre(0u, 2u));
  EXPECT_THAT(next.members, ElementsAre(0u, 1u, 2u)) << "until the step after";
  EXPECT_THAT(next.next_voters(), ElementsAre(0u, 2u));
}

TEST(Agreement, MakesACandidateThatAllReachAMember) {
  Three three;
  Verdict asked{.accepts = true};
  asked.admission.asking = {{.token = 7, .bat_count = 2}, {.token = 8, .bat_count = 1}};
  three.verdicts.receive(2, asked);
  three.now = three.next();
  ASSERT_EQ(three.now.candidates.size(), 1u) << "there are two bats, not three";
  EXPECT_EQ(three.now.candidates.front().number, 3u);
  EXPECT_EQ(three.now.candidates.front().sponsor, 2u);
  three.now.step = three.now.window = 0, three.now.time = 0.0;
  Verdict reached{.accepts = true};
  reached.admission.reached = {3};
  three.verdicts.receive(1, reached), three.verdicts.receive(2, reached);
  EXPECT_THAT(three.next().members, ElementsAre(0u, 1u, 2u)) << "peer 0 does not reach it";
  three.verdicts.decide(reached, true, 0.0);
  const State next = three.next();
  EXPECT_THAT(next.members, ElementsAre(0u, 1u, 2u, 3u));
  EXPECT_THAT(next.fresh, ElementsAre(3u));
  EXPECT_EQ(next.slots, 4u);
}

TEST(Agreement, MakesOneCandidateOfAToken) {
  Three three;
  Verdict asked{.accepts = true};
  asked.admission.asking = {{.token = 7}, {.token = 7}, {.token = 8}};
  three.verdicts.receive(1, asked), three.verdicts.receive(2, asked);
  three.now = three.next();
  ASSERT_EQ(three.now.candidates.size(), 2u);
  EXPECT_EQ(three.now.candidates.front().newcomer.token, 7u);
  EXPECT_EQ(three.now.candidates.back().newcomer.token, 8u);
}

/// Else a peer could score with the pucks of others.
TEST(Agreement, NamesWhoCountsAGoalOfAnothersPuck) {
  Three three;
  three.settings.goals = GoalRules{.goals_to_win = std::nullopt, .places = {}};
  three.roles.own(0), three.roles.add_ghost(1, 2);
  Verdict scored{.accepts = true};
  scored.goals = {{0.05, 0, true}};
  three.verdicts.decide(scored, true, 0.0);
  scored.goals = {{0.06, 1, false}};
  three.verdicts.receive(2, scored);
  const State next = three.next();
  EXPECT_FALSE(three.accusation.is_made()) << three.accusation.text();
  EXPECT_EQ(next.scoring.left, 1u);
  EXPECT_EQ(next.scoring.right, 1u);
  for (const std::uint32_t puck : {0u, 1u}) {
    Three other;
    other.settings.goals = GoalRules{.goals_to_win = std::nullopt, .places = {}};
    other.roles.own(0), other.roles.add_ghost(1, 2);
    scored.goals = {{0.05, puck, true}};
    other.verdicts.receive(1, scored);
    other.next();
    EXPECT_EQ(other.accusation.text(), "peer 1 sent a goal that cannot be") << puck;
  }
}

TEST(Losses, LetAMajorityGoOnAndHalfOfItWithTheFirst) {
  Three three;
  Losses losses;
  EXPECT_EQ(losses.majority(three.now), Losses::Majority::sure);
  EXPECT_TRUE(losses.note(2, "peer 2 is gone", false));
  EXPECT_FALSE(losses.note(2, "again", false));
  EXPECT_EQ(losses.last(), "peer 2 is gone");
  EXPECT_EQ(losses.majority(three.now), Losses::Majority::sure);
  losses.note(0, "peer 0 is gone", false);
  EXPECT_EQ(losses.majority(three.now), Losses::Majority::none);
  EXPECT_THAT(losses.gone(), ElementsAre(0u, 2u));
  losses.note(0, {}, true);
  EXPECT_EQ(losses.majority(three.now), Losses::Majority::sure) << "of the two who did not finish";
  losses.check();
}

std::vector<PeerNumber> sentenced(Losses& losses, const State& now) {
  std::vector<PeerNumber> peers;
  for (const Losses::Sentence& sentence : losses.settle(now)) peers.push_back(sentence.peer);
  return peers;
}

/// Peer 1 misses peer 2; peer 0 goes with it once it misses peer 2 as well, and else against it.
TEST(Losses, AskWhoIsMissedAndGiveItUpOrItsAccusers) {
  const Three three;
  const Loss accusation{.questions = {{2, Answer::missed}}},
      answer{.questions = {{2, Answer::heard}}};
  Losses hearing(0), missing(0);
  hearing.make_room(3), missing.make_room(3);
  EXPECT_TRUE(hearing.is_news(1, accusation));
  hearing.hear(1, accusation), missing.hear(1, accusation);
  EXPECT_FALSE(hearing.is_news(1, accusation));
  EXPECT_EQ(hearing.told(three.now).questions, (std::vector<Question>{{2, Answer::open}}));
  EXPECT_FALSE(hearing.agrees(2)) << "it has not answered";
  hearing.hear(2, answer);
  EXPECT_TRUE(hearing.agrees(1) && hearing.agrees(2));
  EXPECT_EQ(hearing.told(three.now).questions, answer.questions);
  EXPECT_THAT(sentenced(hearing, three.now), ElementsAre(1u));
  EXPECT_TRUE(missing.miss(2, "peer 2 has said nothing"));
  EXPECT_EQ(missing.told(three.now).questions, accusation.questions);
  EXPECT_THAT(sentenced(missing, three.now), ElementsAre(2u));
  EXPECT_THAT(missing.told(three.now).questions, ElementsAre(Question{2, Answer::missed}))
      << "until it is lost";
  missing.note(2, "peer 2 is gone", false);
  EXPECT_THAT(missing.told(three.now).questions, IsEmpty());
  missing.check();
}

/// A line that breaks between peers 0 and 1 costs peer 1 alone, as peers 0, 1 and 2 see it.
TEST(Losses, OfALineBetweenTwoAreTheHigherNumbers) {
  const Three three;
  Losses first(0), second(1), third(2);
  for (Losses* one : {&first, &second, &third}) one->make_room(3);
  first.miss(1, "peer 1 is gone"), second.miss(0, "peer 0 is gone");
  first.hear(2, {.questions = {{0, Answer::heard}, {1, Answer::heard}}});
  second.hear(2, {.questions = {{0, Answer::heard}, {1, Answer::heard}}});
  third.hear(0, {.questions = {{0, Answer::heard}, {1, Answer::missed}}});
  third.hear(1, {.questions = {{0, Answer::missed}, {1, Answer::heard}}});
  EXPECT_THAT(sentenced(first, three.now), ElementsAre(1u));
  EXPECT_THAT(sentenced(second, three.now), ElementsAre(1u));
  EXPECT_THAT(sentenced(third, three.now), ElementsAre(1u));
}

TEST(Marks, ShowWhoWasToldSomethingElse) {
  const Three three;
  const std::vector<std::vector<std::uint8_t>> words{{1, 2}, {3}}, others{{1, 2}, {4}};
  State next = three.now;
  ++next.step;
  Marks here, there, other;
  for (Marks* marks : {&here, &there, &other}) marks->note_round(0, words);
  there.note_round(0, words), other.note_round(0, others);
  const auto told = [&](const Marks& marks) { return marks.told(next, three.now); };
  EXPECT_FALSE(Marks::differ(told(here), told(there))) << "one round apart";
  EXPECT_FALSE(Marks::differ(told(here), told(other)));
  here.note_round(0, words);
  EXPECT_FALSE(Marks::differ(told(here), told(there)));
  EXPECT_TRUE(Marks::differ(told(here), told(other)));
  State elsewhere = three.now;
  elsewhere.zones = 1;
  EXPECT_TRUE(Marks::differ(told(here), here.told(elsewhere, elsewhere)));
}

TEST(Losses, RefuseStepsAndNumbersThatNobodyHas) {
  const Three three;
  EXPECT_THAT(Losses::fault_of({.step = 1, .gone = {2}}, three.now), IsEmpty());
  EXPECT_THAT(Losses::fault_of({.step = 2, .gone = {2}}, three.now), HasSubstr("is at step 2"));
  EXPECT_THAT(Losses::fault_of({.step = 0, .gone = {3}}, three.now), HasSubstr("never was"));
  EXPECT_THAT(Losses::fault_of({.step = 0, .questions = {{3, Answer::open}}}, three.now),
              HasSubstr("never was"));
}

TEST(Replicas, AreKeptByTheNextInTheRing) {
  Three three;
  EXPECT_EQ(Replicas::keeper_of(1, three.now), 2u);
  EXPECT_EQ(Replicas::keeper_of(2, three.now), 0u);
  Losses losses;
  losses.note(2, "it is gone", false);
  EXPECT_EQ(Replicas::first_unkept(three.now, losses), std::nullopt);
  EXPECT_THAT(Replicas::parts_of(0, three.now, losses), ElementsAre(0u, 2u));
  EXPECT_THAT(Replicas::parts_of(1, three.now, losses), ElementsAre(1u));
  losses.note(0, "and its keeper", false);
  EXPECT_EQ(Replicas::first_unkept(three.now, losses), 2u);
}

TEST(Replicas, HandOutWhatIsNear) {
  Three three;
  physics::World world(three.whole.spec);
  for (const double x : {0.5, 1.2, 3.5})
    world.add(physics::PuckSpec{.position = {x, 1.0}, .radius = 0.05});
  three.now.cuts =
      Cuts::by_count(field, std::vector<Vector2>{{0.5, 1.0}, {1.2, 1.0}, {3.5, 1.0}}, 3);
  const Division division = three.now.division();
  const PeerNumber first = division.owner_of({0.5, 1.0}), keeper = (first + 1) % 3;
  const Validator scene(world);
  Replicas replicas(keeper);
  replicas.make_room(3);
  replicas.begin(world, three.now, 0.0, scene);
  const std::vector<PeerNumber> own{first};
  const Part part = replicas.of(first).part(three.whole.spec, scene, division, first);
  const Handover wide = Replicas::share(std::vector{part}, division, first, infinity);
  EXPECT_EQ(wide.bodies.size(), 1u);
  std::vector<PeerNumber> zones{(first + 1) % 3, (first + 2) % 3};
  EXPECT_EQ(first_elsewhere(wide.bodies, 0.0, division, own), std::nullopt);
  EXPECT_EQ(first_elsewhere(wide.bodies, 0.0, division, zones), wide.bodies.front().number);
  std::vector<Handover::Body> scored = wide.bodies;
  scored.front().state.flight.vx = 100.0;
  EXPECT_NE(first_elsewhere(scored, 1.0, division, own), std::nullopt);
  scored.front().state.flags |= physics::Body::gone;
  EXPECT_EQ(first_elsewhere(scored, 1.0, division, own), std::nullopt)
      << "a puck in a goal keeps its velocity, but stays";
  EXPECT_FALSE(replicas.of(first).add(PartRecord{.step = 3})) << "not the next step";
}

}  // namespace
}  // namespace rink::peer::test
