// The search for saturation against services whose true limit is known: sharp, noisy at the edge,
// failing at one client, never failing, not measurable.
#include "loadgen/run/saturation/saturate_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>

#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

/// Holds up to and including `limit`.
Probing sharp(std::uint32_t limit) {
  return [limit](std::uint32_t clients, std::uint32_t) -> std::optional<Verdict> {
    return clients <= limit ? Verdict::holds : Verdict::fails;
  };
}

std::size_t probes_of(const Search& search, std::uint32_t clients) {
  return static_cast<std::size_t>(
      std::count_if(search.trials.begin(), search.trials.end(),
                    [clients](const Trial& trial) { return trial.clients == clients; }));
}

TEST(Saturation, ASharpLimitLiesBetweenWhatHeldAndWhatFailedWithinTheResolution) {
  for (const double resolution : {0.5, 0.1, 0.01, 1e-9}) {
    for (std::uint32_t limit = 1; limit < 5'000; limit += 1 + limit / 7) {
      const Search search =
          find_largest({.first = 100, .most = 20'000, .resolution = resolution}, sharp(limit));
      ASSERT_EQ(search.end, SearchEnd::bracketed) << limit;
      ASSERT_TRUE(search.held && search.failed);
      EXPECT_LE(*search.held, limit);
      EXPECT_GT(*search.failed, limit);
      EXPECT_TRUE(*search.failed == *search.held + 1 ||
                  *search.failed <= *search.held * (1.0 + resolution))
          << *search.held << " " << *search.failed;
      EXPECT_EQ(probes_of(search, *search.held), 2u) << "the edge is confirmed";
      EXPECT_EQ(probes_of(search, *search.failed), 2u) << "a failure is repeated";
    }
  }
}

TEST(Saturation, ProbesAreAsFewAsDoublingAndBisectionNeed) {
  const Search search =
      find_largest({.first = 100, .most = 100'000, .resolution = 0.1}, sharp(1'000));
  // 100, 200, 400, 800 hold and 1600 fails; log2(log 2 / log 1.1) = 2.9, so three bisections; each
  // failure and the edge take one more.
  EXPECT_LE(search.trials.size(), 4u + 2u + 3u * 2u + 1u);
}

TEST(Saturation, AServiceThatFailsWithOneClientSaysSo) {
  const Search search = find_largest({.first = 100}, sharp(0));
  EXPECT_EQ(search.end, SearchEnd::one_fails);
  EXPECT_FALSE(search.held);
  EXPECT_EQ(search.failed, 1u);
}

TEST(Saturation, AServiceThatNeverFailsHoldsAtLeastTheMostThatIsAllowed) {
  for (const std::uint32_t most : {1u, 100u, 12'345u}) {
    const Search search =
        find_largest({.first = std::min(100u, most), .most = most}, sharp(1'000'000));
    EXPECT_EQ(search.end, SearchEnd::most_holds);
    EXPECT_EQ(search.held, most);
    EXPECT_FALSE(search.failed);
    for (const Trial& trial : search.trials) EXPECT_LE(trial.clients, most);
  }
}

TEST(Saturation, RunsThatDoNotCountAreNoFailures) {
  const Search search = find_largest({.first = 100}, [](std::uint32_t clients, std::uint32_t) {
    return std::optional(clients <= 700 ? Verdict::holds : Verdict::invalid);
  });
  EXPECT_EQ(search.end, SearchEnd::not_valid);
  EXPECT_GE(*search.held, 700 / 1.1 - 1);
  EXPECT_LE(*search.held, 700u);
  // One that does not count does not vote; the next runs decide.
  const Search once =
      find_largest({.first = 100}, [](std::uint32_t clients, std::uint32_t attempt) {
        if (attempt == 0) return std::optional(Verdict::invalid);
        return std::optional(clients <= 700 ? Verdict::holds : Verdict::fails);
      });
  EXPECT_EQ(once.end, SearchEnd::bracketed);
  EXPECT_LE(*once.held, 700u);
}

TEST(Saturation, OneUnluckyProbeDoesNotDecideAndNeitherDoesOneLuckyOne) {
  const auto unlucky = [](std::uint32_t clients, std::uint32_t attempt) {
    return std::optional(clients == 200 && attempt == 0
                             ? Verdict::fails
                             : (clients <= 1'000 ? Verdict::holds : Verdict::fails));
  };
  EXPECT_GT(find_largest({.first = 100}, unlucky).held, 900u);
  const auto lucky = [](std::uint32_t clients, std::uint32_t attempt) {
    return std::optional(clients <= 1'000 || (clients == 1'600 && attempt == 0) ? Verdict::holds
                                                                                : Verdict::fails);
  };
  const Search search = find_largest({.first = 100, .most = 1'600}, lucky);
  EXPECT_EQ(search.end, SearchEnd::bracketed);
  EXPECT_LE(*search.held, 1'000u);
  EXPECT_GT(*search.held, 900u);
}

TEST(Saturation, AnEdgeThatDoesNotHoldTwiceLeavesWhatHeldBelowIt) {
  const auto lucky = [](std::uint32_t clients, std::uint32_t attempt) {
    return std::optional(clients <= 1'000 || (clients == 1'500 && attempt == 0) ? Verdict::holds
                                                                                : Verdict::fails);
  };
  const Search search = find_largest({.first = 100, .most = 1'500}, lucky);
  EXPECT_GT(*search.held, 900u);
  // 100, 200, 400 and 800 held once: nothing below 800 is asked again, nor anything between.
  const auto last_of_the_edge = std::ranges::find_if(search.trials, [](const Trial& trial) {
    return trial.clients == 1'500 && trial.attempt == 2;
  });
  ASSERT_NE(last_of_the_edge, search.trials.end());
  for (auto trial = last_of_the_edge; trial != search.trials.end(); ++trial)
    EXPECT_GE(trial->clients, 800u);
}

/// The service's chance to hold falls from 1 to 0 around `limit`, log-normally with `width`.
TEST(Saturation, ANoisyEdgeIsFoundWithinItsNoiseAndTheResolution) {
  constexpr double limit = 1'000.0, width = 0.03, resolution = 0.05;
  std::mt19937_64 random(11);
  double log_sum = 0.0;
  constexpr int searches = 400;
  for (int i = 0; i < searches; ++i) {
    const Search search = find_largest(
        {.first = 50, .most = 20'000, .resolution = resolution},
        [&](std::uint32_t clients, std::uint32_t) {
          std::normal_distribution<double> shift(0.0, width);
          return std::optional(std::log(clients / limit) <= shift(random) ? Verdict::holds
                                                                          : Verdict::fails);
        });
    ASSERT_EQ(search.end, SearchEnd::bracketed);
    const double found =
        std::log(std::sqrt(static_cast<double>(*search.held) * *search.failed) / limit);
    EXPECT_LT(std::abs(found), 4 * width + resolution);
    log_sum += found;
    std::map<std::uint32_t, int> probes;
    for (const Trial& trial : search.trials) EXPECT_LE(++probes[trial.clients], 3);
  }
  EXPECT_LT(std::abs(log_sum / searches), 0.02)
      << "repeating failures alone would lean towards holding";
}

TEST(Saturation, AnInterruptKeepsTheBracketAsFarAsItGot) {
  int left = 5;
  const Search search = find_largest(
      {.first = 100}, [&left](std::uint32_t clients, std::uint32_t) -> std::optional<Verdict> {
        if (left-- == 0) return std::nullopt;
        return clients <= 500 ? Verdict::holds : Verdict::fails;
      });
  EXPECT_EQ(search.end, SearchEnd::interrupted);
  EXPECT_EQ(search.held, 400u);
  EXPECT_EQ(search.failed, 800u);
  EXPECT_EQ(search.trials.size(), 5u);
}

RunRecord record_with(double on_time, std::optional<double> p99, double max) {
  RunRecord record;
  record.valid = true;
  record.ticks_on_time_fraction = on_time;
  record.update_age_ms.p99 = p99;
  record.update_age_ms.max = max;
  return record;
}

TEST(ServiceLevel, IsKeptAtItsTickBoundAndBelowItsAgeBound) {
  const ServiceLevel level;
  EXPECT_EQ(judgement_of(record_with(0.99, 99.9, 400.0), level).verdict, Verdict::holds);
  EXPECT_THAT(judgement_of(record_with(0.9899, 5.0, 6.0), level).why,
              HasSubstr("ticks: 98.99 % on time, below 99 %"));
  EXPECT_THAT(judgement_of(record_with(1.0, 100.0, 400.0), level).why,
              HasSubstr("age: p99 100 ms"));
  const std::string both = judgement_of(record_with(0.5, 300.0, 400.0), level).why;
  EXPECT_THAT(both, HasSubstr("ticks"));
  EXPECT_THAT(both, HasSubstr("age"));
}

TEST(ServiceLevel, AnAbsentPercentileIsBoundedByTheMaximum) {
  const ServiceLevel level;
  EXPECT_EQ(judgement_of(record_with(1.0, std::nullopt, 99.0), level).verdict, Verdict::holds);
  const Judgement undecided = judgement_of(record_with(1.0, std::nullopt, 101.0), level);
  EXPECT_EQ(undecided.verdict, Verdict::invalid);
  EXPECT_THAT(undecided.why, HasSubstr("too short"));
  EXPECT_EQ(judgement_of(record_with(0.5, std::nullopt, 101.0), level).verdict, Verdict::fails)
      << "its ticks decide";
  RunRecord lost = record_with(0.2, 300.0, 400.0);
  lost.valid = false;
  lost.why_invalid = "3 clients lost by the server";
  EXPECT_EQ(judgement_of(lost, level).verdict, Verdict::invalid);
  EXPECT_THAT(judgement_of(lost, level).why, HasSubstr("3 clients lost"));
  RunRecord behind = record_with(1.0, 300.0, 400.0);
  behind.keys_trouble = "9 of 70 keys went out more than 10 ms late";
  EXPECT_EQ(judgement_of(behind, level).verdict, Verdict::invalid)
      << "the age may be that of the bots' own queue";
  EXPECT_THAT(judgement_of(behind, level).why, HasSubstr("9 of 70"));
}

/// A machine on which each scheme holds up to a limit of its own; beyond, its ticks are late.
class SaturateTest : public testing::Test {
 protected:
  SaturateTest() {
    experiment_.scene = "crowd";
    experiment_.schemes = {"none", "region"};
    experiment_.clients = {2'000, 100};
    experiment_.seeds = {7};
  }
  std::vector<Saturation> search(std::span<const RunRecord> earlier = {}) {
    const CellRunning run = [this](const Cell& cell) -> std::optional<RunRecord> {
      if (left_-- == 0) return std::nullopt;
      RunRecord record = record_with(
          cell.clients <= (cell.scheme == "none" ? 150 : 5'000) ? 1.0 : 0.75, 20.0, 30.0);
      record.cell = cell;
      record.send_us_per_tick = 10.0 * cell.clients;
      record.tick_us.p99 = 500.0 + 6.0 * cell.clients;
      ran_.push_back(record);
      return record;
    };
    const SaturationKeeping keep = [this](std::span<const Saturation> found) {
      kept_.push_back(found.size());
    };
    return saturate(experiment_,
                    {.level = level_,
                     .limits = search_limits(experiment_, 0, 0.1),
                     .run = run,
                     .out = said_,
                     .earlier = earlier},
                    keep);
  }

  Experiment experiment_;
  ServiceLevel level_;
  std::vector<RunRecord> ran_;
  std::vector<std::size_t> kept_;
  std::ostringstream said_;
  int left_ = -1;
};

TEST_F(SaturateTest, EachSchemeIsSearchedBetweenTheLeastAndTheLargestNumberOfClients) {
  const auto found = search();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].cell.scheme, "none");
  EXPECT_EQ(found[0].search.end, SearchEnd::bracketed);
  EXPECT_LE(*found[0].search.held, 150u);
  EXPECT_GT(*found[0].search.failed, 150u);
  EXPECT_EQ(found[0].edge->cell.clients, found[0].search.held);
  EXPECT_THAT(found[0].why, HasSubstr("ticks: 75 %"));
  EXPECT_EQ(found[1].search.end, SearchEnd::most_holds);
  EXPECT_EQ(held_text(found[1].search), "at least 2000");
  EXPECT_EQ(kept_, (std::vector<std::size_t>{1, 2})) << "after each search";
  for (const RunRecord& run : ran_) EXPECT_LE(run.cell.clients, 2'000u);
  EXPECT_THAT(said_.str(),
              HasSubstr("none, periodic: 100 clients hold: 100 % of ticks on time, age p99 20 ms"));
  EXPECT_THAT(table_of(found, level_), HasSubstr("at least 2000"));
  EXPECT_THAT(to_csv(found),
              HasSubstr("client-server,region,periodic,0,1,0.05,0.3,0,0,30,0.005,1,1,0,"
                        "most_holds,2000,,5472,1600,\"\","));
  EXPECT_THAT(to_json_text(found, level_, {}), HasSubstr("\"held_clients\": 2000"));
}

TEST_F(SaturateTest, IsForetoldByTheCostOfFewerClients) {
  const auto found = search();
  EXPECT_EQ(found[0].predicted, std::nullopt) << "of fewer clients than held only 100 ran";
  EXPECT_EQ(found[1].predicted_from, 1'600u) << "2,000 held, and are not asked what they hold";
  EXPECT_EQ(found[1].predicted, std::floor((1e6 / 30.0 - 500.0) / 6.0))
      << "99 % of the ticks end within 500 + 6 n us";
  EXPECT_THAT(table_of(found, level_), HasSubstr("5472 (1600)"));
}

TEST_F(SaturateTest, RepetitionsHaveSeedsOfTheirOwn) {
  search();
  std::map<std::string, int> times;
  for (const RunRecord& run : ran_)
    EXPECT_EQ(++times[name_of(run.cell)], 1) << name_of(run.cell) << " was run twice";
}

TEST_F(SaturateTest, AnInterruptedSearchIsKeptAndGoesOnWithoutRunningAnythingTwice) {
  left_ = 4;
  const auto cut = search();
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_EQ(cut[0].search.end, SearchEnd::interrupted);
  EXPECT_EQ(cut[0].search.held, 141u) << "100 held, 200 failed twice, their geometric mean held";
  EXPECT_THAT(held_text(cut[0].search), HasSubstr("interrupted, at least 141"));
  const std::vector<RunRecord> earlier = ran_;
  ran_.clear();
  left_ = -1;
  const auto whole = search(earlier);
  EXPECT_EQ(whole.size(), 2u);
  for (const RunRecord& run : ran_)
    for (const RunRecord& before : earlier) EXPECT_FALSE(run.cell == before.cell);
}

TEST_F(SaturateTest, UnderAVirtualClockNothingSaturates) {
  experiment_.transport = TransportKind::virtual_time;
  const test::TemporaryFolder folder("saturation");
  ResultsDirectory results(folder, false);
  std::vector<Saturation> found;
  SaturateOptions options;
  options.allowed_clients = 100;
  EXPECT_THROW(run_saturation({experiment_, {}, results, [](const Cell&, const auto&) {}}, options,
                              said_, found),
               ExperimentError);
}

}  // namespace
}  // namespace rink::loadgen
