// Where the engine counts events in the whole field: who must look at all of it, and who need not.
#include <gtest/gtest.h>

#include <vector>

#include "game/peer/assembly.h"
#include "game/peer/window/window_verdicts.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

constexpr float halo = 0.25f;

/// The verdicts of three peers as the first of them has them.
struct ThreeVerdicts {
  Halos halos{Division::into_strips(field, 3), 0, halo};
  WindowVerdicts verdicts{halos, 6.0};

  /// By peer. All accept.
  Outcome conclude(std::vector<Verdict> all) {
    for (PeerNumber peer = 0; peer < 3; ++peer) {
      all[peer].accepts = true, all[peer].halo = halo;
      if (peer == 0) verdicts.decide(all[peer], true, 0.0);
      else verdicts.receive(peer, all[peer]);
    }
    return verdicts.conclude();
  }
  bool repeats(bool first, bool second, bool third) const {
    return verdicts.repeats(0) == first && verdicts.repeats(1) == second &&
           verdicts.repeats(2) == third;
  }
};

Verdict with_crowd(std::uint64_t events) {
  return {.at_once_max = events, .critical = {{0.5, events, false}}};
}
Verdict with_report(Verdict verdict, const InstantReport& report) {
  verdict.reports = {report};
  return verdict;
}

TEST(WindowVerdicts, AskAboutCrowdedInstantsBeforeAnybodyPlaysAgain) {
  ThreeVerdicts three;
  EXPECT_EQ(three.conclude({with_crowd(50), {.at_once_max = 20}, {}}), Outcome::repeat);
  EXPECT_TRUE(three.repeats(false, false, false));
  ASSERT_EQ(three.verdicts.asked().size(), 1u);
  EXPECT_LT(three.verdicts.asked().front().low, 0.5);
  EXPECT_GT(three.verdicts.asked().front().high, 0.5);
  const Outcome outcome =
      three.conclude({with_report(with_crowd(50), {60, 50, 50, 7}),
                      with_report({.at_once_max = 20}, {5, 4, 4, 8}), with_report({}, {})});
  EXPECT_EQ(outcome, Outcome::final) << "the twenty came at another time";
}

TEST(WindowVerdicts, DoNotSettleAnInstantOfWhichOneSaysNothing) {
  ThreeVerdicts three;
  const Verdict first = with_crowd(50), second{.at_once_max = 20};
  for (const bool says_nothing : {true, false}) {
    EXPECT_EQ(three.conclude({first, second, {}}), Outcome::repeat);
    const Outcome outcome = three.conclude(
        {with_report(first, {60, 50, 50, 7}),
         says_nothing ? second : with_report(second, {5, 4, 4, 8}), with_report({}, {})});
    EXPECT_EQ(outcome, says_nothing ? Outcome::repeat : Outcome::final);
  }
}

TEST(WindowVerdicts, AskAboutEachUnsolvedInstantOnce) {
  ThreeVerdicts three;
  Verdict first{.at_once_max = 1, .critical = {{0.25, 1, true}, {0.5, 1, true}}}, second = first;
  second.critical.front().time += 1e-12;
  EXPECT_EQ(three.conclude({first, second, {}}), Outcome::repeat);
  EXPECT_EQ(three.verdicts.asked().size(), 2u);
  const std::vector<InstantReport> reports{{2, 2, 1, 7}, {3, 1, 1, 8}};
  first.reports = second.reports = reports;
  second.reports.back() = {3, 2, 2, 8};
  EXPECT_EQ(three.conclude({first, second, {.reports = {{}, {}}}}), Outcome::final)
      << "both have had the same events, which are theirs";
}

TEST(WindowVerdicts, LetThoseAloneSeeTheWholeFieldWhoHaveEventsThen) {
  ThreeVerdicts three;
  const Verdict crowded = with_crowd(40);
  three.conclude({crowded, crowded, {}});
  const std::vector<Verdict> reported{with_report(crowded, {40, 40, 40, 7}),
                                      with_report(crowded, {40, 40, 40, 8}), with_report({}, {})};
  EXPECT_EQ(three.conclude(reported), Outcome::repeat);
  EXPECT_TRUE(three.repeats(true, true, false));
  EXPECT_EQ(three.halos.of(1), infinity);
  EXPECT_EQ(three.halos.of(2), halo);
  EXPECT_TRUE(three.verdicts.asked().empty());
  three.conclude({crowded, crowded, {}});
  EXPECT_EQ(three.conclude(reported), Outcome::repeat);
  EXPECT_TRUE(three.repeats(true, true, true)) << "that did not help";
  EXPECT_TRUE(three.halos.are_whole());
  EXPECT_EQ(three.conclude({crowded, crowded, {}}), Outcome::final) << "all have seen all";
}

TEST(WindowVerdicts, DoNotTrustACountOfEventsThatNobodyOwns) {
  ThreeVerdicts three;
  Verdict unsolved{.at_once_max = 1, .critical = {{0.5, 1, true}}};
  three.conclude({{}, unsolved, {}});
  EXPECT_EQ(three.conclude(
                {with_report({}, {}), with_report(unsolved, {5, 3, 3, 7}), with_report({}, {})}),
            Outcome::repeat)
      << "two events of ghosts that their owners do not have";
  EXPECT_TRUE(three.repeats(false, true, false));
}

TEST(WindowVerdicts, AskNothingWhileSomebodyDoesNotAccept) {
  ThreeVerdicts three;
  three.verdicts.decide(with_crowd(100), true, 0.0);
  three.verdicts.receive(1, {.accepts = false, .halo = 1.0f});
  three.verdicts.receive(2, {.accepts = true, .halo = halo});
  EXPECT_EQ(three.verdicts.conclude(), Outcome::repeat);
  EXPECT_TRUE(three.verdicts.asked().empty());
  EXPECT_TRUE(three.repeats(false, true, false));
}

/// A hall of four zones, each 2 m long, in which a puck moves slowly along.
physics::WorldSpec hall() { return physics::test::rink_of(8.0, 1.0); }

/// Two rows from `first` to `last` [m] that hit both walls at one instant.
void add_rows(physics::World& world, double first, double last) {
  for (double x = first; x < last; x += 0.025)
    for (const double way : {-1.0, 1.0})
      world.add(physics::PuckSpec{
          .position = {x, 0.5 + 0.02 * way}, .velocity = {0.0, way}, .radius = 0.01});
}

/// The repetitions of each peer, over 30 windows of 0.05 s.
std::vector<std::uint64_t> repeats_of(physics::World& world) {
  for (PeerNumber zone = 0; zone < 4; ++zone)
    world.add(physics::PuckSpec{
        .position = {2.0 * zone + 1.8, 0.2}, .velocity = {0.1, 0.0}, .radius = 0.03});
  Assembly assembly(world, Division::into_strips(world.spec().field, 4), 0.15, 0.05);
  for (int window = 1; window <= 30 && !testing::Test::HasFailure(); ++window) {
    physics::test::RandomKeys::advance(world, 0.05 * window);
    assembly.advance();
    for (std::uint32_t body = 0; body < world.body_count(); ++body)
      EXPECT_EQ(bytes_of(assembly.state(body)), bytes_of(physics::Subdomain::state_in(world, body)))
          << "window " << window << ", body " << body;
  }
  EXPECT_GE(world.counters().events_at_once_max, 64u);
  std::vector<std::uint64_t> repeats;
  for (const Peer& peer : assembly.peers()) repeats.push_back(peer.counters().repeats);
  return repeats;
}

TEST(Instants, OfACrowdThatOnePeerOwnsMakeNobodyPlayAgain) {
  physics::World world(hall());
  add_rows(world, 2.3, 3.7);
  EXPECT_EQ(repeats_of(world), (std::vector<std::uint64_t>{0, 0, 0, 0}));
}

TEST(Instants, OfACrowdAcrossABorderConcernItsOwnersAlone) {
  physics::World world(hall());
  add_rows(world, 1.1, 2.9);
  const std::vector<std::uint64_t> repeats = repeats_of(world);
  EXPECT_GT(repeats[0], 0u);
  EXPECT_GT(repeats[1], 0u);
  EXPECT_EQ(repeats[2] + repeats[3], 0u);
}

TEST(Instants, OfCrowdsThatAreFarApartConcernBoth) {
  physics::World world(hall());
  add_rows(world, 0.3, 1.4), add_rows(world, 6.3, 7.4);
  const std::vector<std::uint64_t> repeats = repeats_of(world);
  EXPECT_GT(repeats[0], 0u);
  EXPECT_GT(repeats[3], 0u);
  EXPECT_EQ(repeats[1] + repeats[2], 0u);
}

}  // namespace
}  // namespace rink::peer::test
