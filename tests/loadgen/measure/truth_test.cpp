// Tiny worlds in which every figure of truth is known by arithmetic.
#include "loadgen/measure/truth/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "game/model/random_stream.h"
#include "game/net/peer/peer_trace.h"
#include "game/net/server_trace.h"
#include "game/net/trace_lines.h"
#include "loadgen/measure/truth/classification.h"
#include "loadgen/measure/truth/relevance_intervals.h"
#include "loadgen/measure/truth/replay.h"
#include "loadgen/measure/truth/scope_history.h"
#include "tests/loadgen/measure/areas.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Relevance, ABoxThatTouchesTheSquareIsRelevantAndOneAHairBeyondIsNot) {
  const Vector2 bat(2.0, 3.0), half_extent(0.25, 0.5);
  EXPECT_EQ(depth(square, bat, {3.25, 3.0}, half_extent), 0.0);
  EXPECT_LT(depth(square, bat, {3.25 + 1e-9, 3.0}, half_extent), 0.0);
  EXPECT_EQ(depth(square, bat, {2.0, 4.25}, half_extent), 0.25);
  EXPECT_EQ(depth(disc, bat, {2.0, 4.25}, half_extent), -0.25) << "a disc asks for the centre";
  EXPECT_EQ(text_of({RelevanceArea::Shape::square, 1.58}),
            "square of 3.16 m around the bat, touched by the entity's box");
}

TEST(Relevance, MayTakeInTheOwnSideAndWhatIsAlwaysRelevant) {
  using enum physics::BodyKind;
  using game::Team;
  RelevanceArea area = square;
  EXPECT_FALSE(is_relevant_anywhere(area, Team::left, bat, Team::left));
  area.has_team = true;
  EXPECT_TRUE(is_relevant_anywhere(area, Team::left, bat, Team::left));
  EXPECT_FALSE(is_relevant_anywhere(area, Team::left, bat, Team::right));
  EXPECT_FALSE(is_relevant_anywhere(area, Team::none, bat, Team::none))
      << "of no team, not of one that is called none";
  EXPECT_FALSE(is_relevant_anywhere(area, Team::left, puck, Team::none));
  area.always.emplace().add(puck);
  area.always->add(post);
  EXPECT_TRUE(is_relevant_anywhere(area, Team::left, puck, Team::none));
  EXPECT_FALSE(is_relevant_anywhere(area, Team::left, bat, Team::right));
  EXPECT_EQ(text_of(area),
            "square of 2 m around the bat, touched by the entity's box, or a bat of the player's "
            "team, or any puck or post");
}

TEST(Surroundings, FindWhatLookingAtEachEntityFinds) {
  game::RandomStream random(7);
  std::vector<Placed> placed;
  for (std::uint32_t i = 0; i < 500; ++i)
    placed.push_back({i,
                      {random.uniform(-1.0, 11.0), random.uniform(-1.0, 6.0)},
                      {random.uniform(0.0, 0.6), random.uniform(0.0, 0.2)}});
  for (const RelevanceArea& area : {square, disc}) {
    Surroundings surroundings(area, 10.0, 5.0);
    surroundings.build(placed);
    surroundings.check();
    std::vector<Relevant> found;
    for (std::uint32_t own = 0; own < 500; own += 7) {
      std::vector<Relevant> expected;
      for (const Placed& each : placed)
        if (const double within = depth(area, placed[own].centre, each.centre, each.half_extent);
            each.entity != own && within >= 0.0)
          expected.push_back({each.entity, within});
      surroundings.find(placed[own].centre, own, found);
      ASSERT_EQ(found, expected) << "around " << own << ", seed 7";
    }
  }
}

TEST(Classification, PoolsPairsOverSamples) {
  Classification counts;
  EXPECT_FALSE(counts.precision());
  counts.add(std::vector<std::uint32_t>{1, 3, 5, 9},
             std::vector<Relevant>{{3, 0.1}, {4, 0.1}, {5, 0.1}});
  counts.add({}, std::vector<Relevant>{{2, 0.1}});
  counts.add(std::vector<std::uint32_t>{2}, {});
  EXPECT_DOUBLE_EQ(*counts.precision(), 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(*counts.recall(), 2.0 / 4.0);
}

TEST(Jain, IsOneForEqualSharesAndAnNthForOneThatHasAll) {
  EXPECT_DOUBLE_EQ(*jain_index(std::vector<double>{3, 3, 3, 3}), 1.0);
  EXPECT_DOUBLE_EQ(*jain_index(std::vector<double>{0, 5, 0, 0}), 0.25);
  EXPECT_DOUBLE_EQ(*jain_index(std::vector<double>{1, 3}), 16.0 / 20.0);
  EXPECT_FALSE(jain_index({}));
}

TEST(PositionErrors, RootMeanSquarePercentileAndMaximumAreThoseOfTheSample) {
  PositionErrors errors;
  for (int mm = 1; mm <= 1000; ++mm) errors.add(1e-3 * mm);
  const ErrorFigures figures = errors.figures();
  EXPECT_NEAR(*figures.rms, std::sqrt(1001.0 * 2001.0 / 6.0),
              1e-9);  // sum of squares n (n + 1)(2n + 1)/6
  EXPECT_NEAR(*figures.p50, 500.0, 1e-9);
  EXPECT_NEAR(*figures.p90, 900.0, 1e-9);
  EXPECT_NEAR(*figures.p99, 990.0, 1e-9);
  EXPECT_NEAR(*figures.max, 1000.0, 1e-9);
  PositionErrors few;
  few.add(0.002);
  EXPECT_FALSE(few.figures().p50 || few.figures().p99);
  few.add_replaced(3.0), few.add_replaced(4.0);
  EXPECT_NEAR(*few.figures().max, 2.0, 1e-9);
  EXPECT_EQ(few.figures().replaced_samples, 2u);
  EXPECT_NEAR(*few.figures().replaced_rms, 1e3 * std::sqrt(12.5), 1e-9);
}

TEST(Percentiles, OfDurationsAreThoseWhoseRankTheyAre) {
  std::vector<double> durations_s;
  for (int i = 10'000; i >= 1; --i) durations_s.push_back(1e-3 * i);
  const Percentiles ms = percentiles_ms(durations_s), us = percentiles_us(durations_s);
  EXPECT_DOUBLE_EQ(*ms.p50, 5'000.0);
  EXPECT_DOUBLE_EQ(*ms.p90, 9'000.0);
  EXPECT_DOUBLE_EQ(*ms.p95, 9'500.0);
  EXPECT_DOUBLE_EQ(*ms.p99, 9'900.0);
  EXPECT_DOUBLE_EQ(*ms.p999, 9'990.0);
  EXPECT_DOUBLE_EQ(*ms.max, 10'000.0);
  EXPECT_DOUBLE_EQ(*us.p50, 5e6);
  durations_s.resize(19);
  EXPECT_FALSE(percentiles_ms(durations_s).p50) << "nine lie beyond it";
}

TEST(ScopeHistory, KnowsWhatWasInScopeAtAnInstant) {
  ScopeHistory history({{0.1, 4, true}, {0.2, 7, true}, {0.2, 4, true}, {0.3, 4, false}});
  std::vector<std::uint32_t> entities;
  history.advance(0.25);
  history.list(nobody, entities);
  EXPECT_THAT(entities, ElementsAre(4, 7));
  EXPECT_EQ(history.entered_s(4), 0.1) << "told again, it stays since when it was";
  history.advance(0.3);
  history.list(nobody, entities);
  EXPECT_THAT(entities, ElementsAre(7));
  history.list(7, entities);
  EXPECT_TRUE(entities.empty());
}

TEST(ScopeChanges, CountEntriesExitsAndFlapsWithinTheSpan) {
  const std::vector<ScopeStep> steps{
      {-1.0, 1, true}, {-1.0, 9, true}, {0.5, 1, false}, {1.2, 1, true}, {1.3, 1, true},
      {1.5, 2, true},  {1.6, 9, false}, {2.5, 1, false}, {4.0, 1, true}, {5.0, 2, false}};
  const ScopeChanges changes = count_changes(steps, 9, 1.0, 5.0);
  EXPECT_EQ(changes.entries, 3u);
  EXPECT_EQ(changes.exits, 1u);
  EXPECT_EQ(changes.flaps, 1u) << "back after 0.7 s, and after 1.5 s";
}

TEST(ScopeChanges, AnEntryIsAFlapIfTheEntityHadLeftLessThanASecondBefore) {
  const auto flaps = [](double away_s) {
    return count_changes(
               std::vector<ScopeStep>{{-1.0, 1, true}, {1.0, 1, false}, {1.0 + away_s, 1, true}}, 9,
               0.0, 5.0)
        .flaps;
  };
  EXPECT_EQ(flaps(1.0 - 1e-6), 1u);
  EXPECT_EQ(flaps(1.0), 0u);
}

/// An entity on a line at 1 m/s towards an observer at rest: its depth grows by the second, from -1
/// at 0 s.
struct Approach {
  static constexpr double look_s = 0.3;
  RelevanceIntervals intervals;
  void watch(ScopeHistory delivered, double until_s) {
    for (int i = 0; i * look_s <= until_s; ++i) {
      const double now = i * look_s, depth = std::min(now - 1.0, 3.0 - now);  // and leaves at 3 s
      delivered.advance(now);
      std::vector<Relevant> relevant;
      if (depth >= 0.0) relevant.push_back({5, depth});
      intervals.look(now, relevant, delivered, [&](const Relevant& each) {
        const double before = now - look_s - 1.0;
        return before / (before - each.depth);
      });
    }
    intervals.end();
  }
};

TEST(RelevanceIntervals, AnEntryIsLateFromWhenItCrossedTheBorderToWhenItsStateCame) {
  Approach approach;
  approach.watch(ScopeHistory({{1.75, 5, true}}), 6.0);
  ASSERT_EQ(approach.intervals.lateness_s().size(), 1u);
  EXPECT_NEAR(approach.intervals.lateness_s()[0], 0.75, 1e-12)
      << "looks are 0.3 s apart, the crossing at 1 s is found between them";
  EXPECT_EQ(approach.intervals.never_delivered(), 0u);
}

TEST(RelevanceIntervals, WhatIsThereAlreadyIsNotLate) {
  Approach approach;
  approach.watch(ScopeHistory({{0.4, 5, true}}), 6.0);
  EXPECT_THAT(approach.intervals.lateness_s(), ElementsAre(0.0));
}

TEST(RelevanceIntervals, AnEntityThatNeverCameIsLateForItsWholeStay) {
  Approach gone, seen_to_the_last;
  gone.watch(ScopeHistory({}), 6.0);
  ASSERT_EQ(gone.intervals.never_delivered(), 1u);
  EXPECT_NEAR(gone.intervals.lateness_s()[0], 2.3, 1e-12) << "seen at 3.0 s, gone at 3.3 s";
  seen_to_the_last.watch(ScopeHistory({}), 2.1);
  EXPECT_NEAR(seen_to_the_last.intervals.lateness_s()[0], 1.1, 1e-12);
}

TEST(RelevanceIntervals, WhatWasThereAtTheFirstLookHasNoKnownBeginning) {
  RelevanceIntervals intervals;
  intervals.look(0.0, std::vector<Relevant>{{1, 0.5}}, ScopeHistory({}),
                 [](const Relevant&) { return 1.0; });
  intervals.end();
  EXPECT_TRUE(intervals.lateness_s().empty());
}

TEST(Sampling, TheSameSeedLooksAtTheSamePlayersAndInstants) {
  const game::SamplingSettings settings{.seed = 3, .clients = 100, .from_s = 0.5, .until_s = 3.5};
  EXPECT_EQ(game::sampled_players(settings), game::sampled_players(settings));
  EXPECT_EQ(game::sampled_players(settings).size(), 32u);
  const std::vector<double> instants = game::sampled_instants(settings, 1);
  ASSERT_EQ(instants.size(), 30u);
  for (std::size_t i = 0; i < instants.size(); ++i)
    EXPECT_EQ(std::floor((instants[i] - 0.5) / 0.1), static_cast<double>(i))
        << "one from each tenth of a second";
  EXPECT_NE(instants, game::sampled_instants(settings, 2));
}

TEST(Sampling, LooksTenTimesASecondButAtLeastTwentyAndAtMostAHundredTimesOnceInEachEqualPart) {
  for (const auto& [span_s, count] :
       {std::pair{0.5, 20u}, {2.0, 20u}, {2.5, 25u}, {7.0, 70u}, {10.0, 100u}, {60.0, 100u}}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const std::vector<double> instants = game::sampled_instants(
          {.seed = seed, .clients = 5, .from_s = 1.0, .until_s = 1.0 + span_s}, 1);
      ASSERT_EQ(instants.size(), count) << span_s << " s, seed " << seed;
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_EQ(std::floor((instants[i] - 1.0) * count / span_s), static_cast<double>(i))
            << span_s << " s, seed " << seed;
    }
  }
}

TEST(Sampling, LooksAtAllPlayersUpToThirtyTwoAndAtDifferentOnesOfMore) {
  const auto players = [](std::uint64_t seed, std::uint32_t clients) {
    std::vector<std::uint32_t> sampled = game::sampled_players({.seed = seed, .clients = clients});
    std::ranges::sort(sampled);
    EXPECT_EQ(std::ranges::adjacent_find(sampled), sampled.end()) << "nobody twice";
    EXPECT_LT(sampled.back(), clients);
    return sampled;
  };
  for (const std::uint32_t clients : {1u, 31u, 32u}) EXPECT_EQ(players(1, clients).size(), clients);
  EXPECT_EQ(players(1, 33).size(), 32u);
  EXPECT_EQ(players(1, 1000).size(), 32u);
  EXPECT_NE(players(1, 1000), players(2, 1000));
}

}  // namespace
}  // namespace rink::loadgen
