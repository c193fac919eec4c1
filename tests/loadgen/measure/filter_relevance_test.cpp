// Relevance by an expression: against the shapes that say the same, against brute force, and as
// sets of what its parts say.
#include "loadgen/measure/truth/filter_relevance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "game/control/game.h"
#include "game/net/server_trace.h"
#include "game/players/random_plan.h"
#include "loadgen/measure/truth/replay.h"
#include "loadgen/measure/truth/truth.h"
#include "tests/loadgen/run/judged_rink.h"

namespace rink::loadgen {
namespace {

using Entities = std::vector<std::uint32_t>;

constexpr double reach = 1.5, played_s = 1.0;
constexpr std::uint32_t players = 12;

game::ServerTrace crowd(std::uint64_t seed) {
  game::ServerTrace trace;
  trace.choice.scene = "crowd";
  trace.choice.seed = seed;
  trace.choice.bats = players;
  trace.rate_hz = 30.0;
  trace.keys = game::random_plan(seed, players, played_s);
  // One goes, one goes and comes back as another body.
  trace.keys.push_back({.time = 0.1, .player = 3, .kind = game::InputKind::leave});
  trace.keys.push_back({.time = 0.1, .player = 5, .kind = game::InputKind::leave});
  trace.keys.push_back({.time = 0.305, .player = 5, .kind = game::InputKind::enter});
  std::ranges::stable_sort(trace.keys, {}, &game::InputEvent::time);
  return trace;
}

/// What is relevant to each player at each of some instants.
std::vector<Entities> relevant_by(const game::ServerTrace& trace, const RelevanceArea& area) {
  Replay replay(trace, area);
  std::vector<Entities> all;
  std::vector<Relevant> found;
  for (const double now : {0.05, 0.3, 0.31, 0.9}) {
    replay.advance(now);
    replay.look_around();
    for (std::uint32_t player = 0; player < players; ++player) {
      if (!replay.bat_of(player)) continue;
      replay.find(*replay.bat_of(player), found);
      all.emplace_back();
      for (const Relevant& each : found) all.back().push_back(each.entity);
    }
  }
  return all;
}
std::vector<Entities> relevant_by(const game::ServerTrace& trace, const std::string& expression) {
  return relevant_by(
      trace, {.shape = RelevanceArea::Shape::filter, .reach = reach, .expression = expression});
}

TEST(FilterRelevance, RegionFindsWhomTheRectangleFinds) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const game::ServerTrace trace = crowd(seed);
    const auto found = relevant_by(trace, "region");
    EXPECT_EQ(found, relevant_by(trace, {RelevanceArea::Shape::square, reach})) << "seed " << seed;
    EXPECT_TRUE(std::ranges::any_of(found, [](const Entities& each) { return each.size() > 3; }))
        << "or the test shows nothing";
  }
}

/// With half sides h, the nearest point of the box is (max(|x| - h_x, 0), max(|y| - h_y, 0)) off.
TEST(FilterRelevance, AuraFindsWhoseBoxComesWithinTheDiscAndHoldsTheDiscOfCentres) {
  const game::ServerTrace trace = crowd(3);
  const auto found = relevant_by(trace, "aura"),
             by_centre = relevant_by(trace, {RelevanceArea::Shape::disc, reach});
  std::vector<Entities> expected;
  Replay replay(trace, {});
  for (const double now : {0.05, 0.3, 0.31, 0.9}) {
    replay.advance(now);
    replay.look_around();
    for (std::uint32_t player = 0; player < players; ++player) {
      if (!replay.bat_of(player)) continue;
      const std::uint32_t own = *replay.bat_of(player);
      expected.emplace_back();
      for (std::uint32_t entity = 0; entity < 1000; ++entity) {
        if (!replay.is_there(entity) || entity == own) continue;
        const Vector2 off =
            ((replay.centre(entity) - replay.centre(own)).cwiseAbs() - replay.half_extent(entity))
                .cwiseMax(0.0);
        if (off.norm() <= reach) expected.back().push_back(entity);
      }
    }
  }
  EXPECT_EQ(found, expected);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(std::ranges::includes(found[i], by_centre[i]));
}

TEST(FilterRelevance, ACompositionFindsTheSetThatItsPartsFindTogether) {
  const game::ServerTrace trace = crowd(4);
  const auto everybody = relevant_by(trace, "none");
  for (const auto& [a, b] :
       {std::pair{"region", "aura"}, {"grid(cell_size=0.7)", "team"}, {"hex", "always"}}) {
    const auto in_a = relevant_by(trace, a), in_b = relevant_by(trace, b);
    const std::string first = a, second = b;
    const auto both = relevant_by(trace, first + " and " + second),
               either = relevant_by(trace, first + " or " + second),
               without = relevant_by(trace, first + " and not " + second),
               outside = relevant_by(trace, "not " + first);
    for (std::size_t i = 0; i < in_a.size(); ++i) {
      Entities expected;
      std::ranges::set_intersection(in_a[i], in_b[i], std::back_inserter(expected));
      EXPECT_EQ(both[i], expected) << a << b;
      expected.clear();
      std::ranges::set_union(in_a[i], in_b[i], std::back_inserter(expected));
      EXPECT_EQ(either[i], expected) << a << b;
      expected.clear();
      std::ranges::set_difference(in_a[i], in_b[i], std::back_inserter(expected));
      EXPECT_EQ(without[i], expected) << a << b;
      expected.clear();
      std::ranges::set_difference(everybody[i], in_a[i], std::back_inserter(expected));
      EXPECT_EQ(outside[i], expected) << a << b;
    }
  }
}

TEST(FilterRelevance, WhoIsAlwaysRelevantIsOfTheKindsThatAreSaid) {
  const game::ServerTrace trace = crowd(5);
  RelevanceArea area{.shape = RelevanceArea::Shape::filter, .reach = reach, .expression = "always"};
  area.always_by_role.add(physics::BodyKind::bat);
  std::vector<std::size_t> bats, expected;
  for (const Entities& found : relevant_by(trace, area)) bats.push_back(found.size() + 1);
  for (const std::size_t there : {players, players - 2, players - 1, players - 1})
    expected.insert(expected.end(), there, there);
  EXPECT_EQ(bats, expected) << "the own bat is in no set, and who has gone is in none";
}

/// Pushed to the right during the warm-up, then at rest to the last bit: after 2 s of a drag of
/// 20/s some 1e-18 m are left to go. Two pucks lie as far to its right and to its left.
class LookingBat : public JudgedRink {
 protected:
  static constexpr std::uint32_t bat = 0, right = 1, left = 2;

  void SetUp() override {
    lay({.field = "length = 20.0\nwidth = 20.0\n",
         .bat_drag = "20.0",
         .bats = {"10.0, 10.0"},
         .pucks = {{"10.8, 10.0"}, {"9.2, 10.0"}}});
    server_.from_s = 3.9;
    end_at(4.2);
    server_.keys = {
        {.time = 0.5, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::right},
        {.time = 0.6, .player = 0, .kind = game::InputKind::key_up, .key = game::Key::right}};
    know({bat});
  }
  TruthFigures judged() {
    play();
    return truth_of(server_, bots_,
                    {.shape = RelevanceArea::Shape::filter, .reach = 1.5, .expression = "cone"});
  }
};

TEST_F(LookingBat, SeesWhereItLastWentBeforeTheMeasuredSpanBegan) {
  decide(4.0, {bat, right});
  const TruthFigures truth = judged();
  EXPECT_DOUBLE_EQ(truth.filter_precision.value_or(-1.0), 1.0) << "the puck on the right is seen";
  EXPECT_DOUBLE_EQ(truth.filter_recall.value_or(-1.0), 1.0) << "and nothing else";
}

TEST_F(LookingBat, SeesWhereItsKeysPushIt) {
  server_.keys.push_back(
      {.time = 3.95, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::left});
  for (const double instant_s : {3.94, 3.96}) decide(instant_s, {bat, right});
  const TruthFigures truth = judged();
  EXPECT_DOUBLE_EQ(truth.filter_precision.value_or(-1.0), 0.5);
  EXPECT_DOUBLE_EQ(truth.filter_recall.value_or(-1.0), 0.5);
}

}  // namespace
}  // namespace rink::loadgen
