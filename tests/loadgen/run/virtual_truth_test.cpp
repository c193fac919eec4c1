// The figures of truth of runs under a virtual clock: what is relevant, decided, delivered and
// changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/net/bots_trace.h"
#include "game/net/server_trace.h"
#include "loadgen/run/game_plan.h"
#include "tests/loadgen/run/virtual_experiment.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(VirtualRunTest, TruthThatTakesInTheOwnSideAndPostsIsFoundByTheExpressionThatSaysSo) {
  experiment_.clients = {12};
  experiment_.relevance = Relevance::disc;
  experiment_.also_relevant = {"team", "always"};
  settings_.wants_truth = true;
  const auto truth = [this](const std::string& scheme) {
    Cell cell = first_cell();
    cell.scheme = scheme;
    cell.parameters.view_margin = 0.0;
    return run(cell).truth;
  };
  const TruthFigures all = truth("aura or team or always"), near = truth("aura"),
                     mates = truth("team"), own = truth("owner");
  EXPECT_THAT(all.relevance,
              AllOf(HasSubstr("disc of"), HasSubstr("or a bat of the player's team, or any post")));
  EXPECT_GT(all.filter_recall.value_or(0.0), 0.98) << "what is missing is as old as a decision";
  EXPECT_GT(all.filter_precision.value_or(0.0), 0.8) << "the rim of boxes that reach into the disc";
  EXPECT_LT(near.filter_recall.value_or(1.0), all.filter_recall.value_or(0.0) - 0.2)
      << "five of his side, and the posts, are elsewhere";
  EXPECT_EQ(mates.filter_precision, 1.0);
  EXPECT_LT(mates.filter_recall.value_or(1.0), 0.8);
  EXPECT_FALSE(own.filter_precision) << "his own bat is in no count, and nothing else is chosen";
}

/// The same sets by another way: every figure but the dates of entries agrees.
TEST_F(VirtualRunTest, RelevanceByTheExpressionRegionIsThatOfTheRectangle) {
  experiment_.clients = {12};
  settings_.wants_truth = true;
  const Cell region = cells_of(experiment_).back();
  const TruthFigures rectangle = run(region).truth;
  experiment_.relevance = Relevance::filter;
  experiment_.relevant = "region";
  const TruthFigures by_filter = run(region).truth;
  EXPECT_EQ(by_filter.filter_recall, rectangle.filter_recall);
  EXPECT_EQ(by_filter.filter_precision, rectangle.filter_precision);
  EXPECT_EQ(by_filter.delivered_recall, rectangle.delivered_recall);
  EXPECT_EQ(by_filter.displayed_error_mm.rms, rectangle.displayed_error_mm.rms);
  EXPECT_EQ(by_filter.wasted_bytes_fraction, rectangle.wasted_bytes_fraction);
  ASSERT_TRUE(rectangle.filter_recall && rectangle.wasted_bytes_fraction)
      << "or the test shows nothing";
}

TEST_F(VirtualRunTest, ByContactLessOfWhatIsRelevantIsInTheViewTheFartherOneLooksAhead) {
  experiment_.clients = {12};
  experiment_.relevance = Relevance::contact;
  settings_.wants_truth = true;
  experiment_.view_margins = {0.0};
  const Cell none = first_cell(), region = cells_of(experiment_).back();
  double recall_before = 1.01, precision_before = 0.0;
  for (const double contact_s : {0.1, 0.3, 0.9}) {
    experiment_.contact_s = contact_s;
    const TruthFigures truth = run(region).truth;
    EXPECT_THAT(truth.relevance, HasSubstr("can touch the bat within 0." +
                                           std::to_string(std::lround(10.0 * contact_s)) + " s"));
    EXPECT_LT(truth.filter_recall.value_or(2.0), recall_before);
    EXPECT_GE(truth.filter_precision.value_or(-1.0), precision_before);
    recall_before = truth.filter_recall.value_or(0.0),
    precision_before = truth.filter_precision.value_or(2.0);
    EXPECT_EQ(run(none).truth.filter_recall, 1.0);
  }
}

/// Every entry and every exit that the server said reached a watched bot, without delay, and is in
/// its evidence.
TEST_F(VirtualRunTest, ChurnIsWhatTheServersFilterSaidWithinTheSpan) {
  experiment_.schemes = {"region"};
  experiment_.delay_ms = 0.0;
  experiment_.duration_s = 3.0;
  settings_.wants_truth = true;
  const RunRecord record = run(first_cell());
  const nlohmann::json server = report(first_cell(), "server");
  ASSERT_GT(server["scope_exits"], 10);
  ASSERT_GT(server["scope_entries"], 10);
  const double changes =
      server["scope_exits"].get<double>() + server["scope_entries"].get<double>();
  EXPECT_NEAR(*record.truth.churn_per_client_per_s, changes / 6.0 / 3.0, 1e-9);
  std::uint64_t exits = 0;
  for (const game::BotsTrace::Bot& bot :
       game::read_bots_trace((folder_ / (name_of(first_cell()) + ".bots.jsonl")).string()).bots)
    for (const game::BotsTrace::ScopeChange& change : bot.changes)
      exits += !change.is_in && change.instant_s >= experiment_.warm_up_s &&
               change.instant_s < experiment_.warm_up_s + experiment_.duration_s;
  EXPECT_EQ(server["scope_exits"], exits);
}

/// Without delay a player's mirror follows each decision at once, so at any instant it has in scope
/// what the decision in force then let through.
TEST_F(VirtualRunTest, TheDecisionInForceIsThatOfTheNewestTick) {
  experiment_.schemes = {"region"};
  experiment_.delay_ms = 0.0;
  settings_.wants_truth = true;
  run(first_cell());
  const std::string stem = (folder_ / name_of(first_cell())).string();
  const game::ServerTrace server = game::read_server_trace(stem + ".server.jsonl");
  const game::BotsTrace bots = game::read_bots_trace(stem + ".bots.jsonl");
  const game::Game game(scene_of(experiment_, first_cell()));
  ASSERT_EQ(server.decisions.size(), 20u * 6u) << "20 instants of 6 players";
  std::set<std::vector<std::uint32_t>> different;
  for (const game::ServerTrace::Decision& decision : server.decisions) {
    const std::uint32_t body = game.bat(decision.player)->index;
    const std::uint32_t bat =
        std::ranges::find(server.objects, body, &game::ServerTrace::Naming::body)->object;
    std::set<std::uint32_t> mirrored,
        decided(server.scope_of(decision).begin(), server.scope_of(decision).end());
    for (const game::BotsTrace::ScopeChange& change :
         std::ranges::find(bots.bots, bat, &game::BotsTrace::Bot::object)->changes) {
      if (change.instant_s > decision.instant_s) break;
      if (change.is_in) mirrored.insert(change.object);
      else mirrored.erase(change.object);
    }
    decided.erase(bat), mirrored.erase(bat);
    ASSERT_EQ(decided, mirrored) << "player " << decision.player << " at " << decision.instant_s
                                 << " s";
    different.emplace(decided.begin(), decided.end());
  }
  EXPECT_GT(different.size(), 60u) << "or the test shows nothing";
}

/// A window of 50 ms before a sample holds one tick at 20 Hz, which says each body that moves in 8
/// bytes of values.
TEST_F(VirtualRunTest, WhatCameWithinTheWindowBeforeASampleIsOneTicksUpdates) {
  experiment_.schemes = {"none"};
  experiment_.delay_ms = 0.0;
  settings_.wants_truth = true;
  const RunRecord record = run(first_cell());
  const game::BotsTrace bots =
      game::read_bots_trace((folder_ / (name_of(first_cell()) + ".bots.jsonl")).string());
  ASSERT_GT(bots.replicas.size(), 1'000u);
  std::set<std::uint32_t> sizes;
  for (const game::BotsTrace::Replica& replica : bots.replicas) sizes.insert(replica.bytes);
  EXPECT_LE(*sizes.rbegin(), 16u) << "two f32, and a bat's count of keys";
  EXPECT_EQ(
      std::ranges::count_if(bots.replicas, [](const auto& replica) { return replica.bytes == 8u; }),
      std::ranges::count_if(bots.replicas, [](const auto& replica) {
        return replica.bytes > 0 && replica.bytes < 9;
      }));
  for (const game::BotsTrace::Sample& sample : bots.samples) {
    const auto replicas =
        std::span(bots.replicas).subspan(sample.first, sample.last - sample.first);
    ASSERT_EQ(sample.window_s, 0.05);
    ASSERT_GT(
        std::ranges::count_if(replicas, [](const auto& replica) { return replica.bytes > 0; }),
        static_cast<std::ptrdiff_t>(replicas.size()) * 9 / 10)
        << "all that move, at " << sample.displayed_s;
  }
  EXPECT_GT(*record.truth.wasted_bytes_fraction, 0.5) << "each sees a twentieth of the field";
}

/// Under a budget that holds less than what enters, a player hears that somebody came long before
/// he hears where: until then he holds nothing.
TEST_F(VirtualRunTest, WhoIsInScopeButWasNotToldWhereIsNotDelivered) {
  experiment_.schemes = {"region", "region with priority(budget=20)"};
  experiment_.view_fractions = {0.5};
  settings_.wants_truth = true;
  const std::vector<Cell> cells = cells_of(experiment_);
  const RunRecord all = run(cells[0]), few = run(cells[1]);
  EXPECT_EQ(all.truth.filter_recall, few.truth.filter_recall) << "the same decisions";
  EXPECT_GT(*all.truth.delivered_recall, 0.95);
  EXPECT_LT(*few.truth.delivered_recall, *all.truth.delivered_recall - 0.01);
  EXPECT_LT(*few.truth.displayed_error_mm.rms, 1000.0)
      << "nobody is shown where he was before he was known";
}

}  // namespace
}  // namespace rink::loadgen
