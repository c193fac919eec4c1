// Tiny worlds in which every figure of truth is known by arithmetic.
#include "loadgen/truth/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "areas.h"
#include "game/model/random_stream.h"
#include "game/net/evidence.h"
#include "game/net/evidence_lines.h"
#include "game/net/peer/peer_evidence.h"
#include "loadgen/truth/classification.h"
#include "loadgen/truth/replay.h"
#include "loadgen/truth/scope_history.h"
#include "loadgen/truth/stays.h"
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
  EXPECT_EQ(text_of({RelevanceArea::Shape::square, 1.58}), "square of 3.16 m around the bat, touched by the entity's box");
}

TEST(Relevance, MayTakeInTheOwnSideAndWhatIsAlwaysRelevant) {
  using enum physics::BodyKind;
  using game::Team;
  RelevanceArea area = square;
  EXPECT_FALSE(is_relevant_anywhere(area, Team::left, bat, Team::left));
  area.has_team = true;
  EXPECT_TRUE(is_relevant_anywhere(area, Team::left, bat, Team::left));
  EXPECT_FALSE(is_relevant_anywhere(area, Team::left, bat, Team::right));
  EXPECT_FALSE(is_relevant_anywhere(area, Team::none, bat, Team::none)) << "of no team, not of one that is called none";
  EXPECT_FALSE(is_relevant_anywhere(area, Team::left, puck, Team::none));
  area.always.emplace().add(puck);
  area.always->add(post);
  EXPECT_TRUE(is_relevant_anywhere(area, Team::left, puck, Team::none));
  EXPECT_FALSE(is_relevant_anywhere(area, Team::left, bat, Team::right));
  EXPECT_EQ(text_of(area), "square of 2 m around the bat, touched by the entity's box, or a bat of the player's team, or any puck or post");
}

TEST(Surroundings, FindWhatLookingAtEachEntityFinds) {
  game::RandomStream random(7);
  std::vector<Placed> placed;
  for (std::uint32_t i = 0; i < 500; ++i)
    placed.push_back({i, {random.uniform(-1.0, 11.0), random.uniform(-1.0, 6.0)}, {random.uniform(0.0, 0.6), random.uniform(0.0, 0.2)}});
  for (const RelevanceArea& area : {square, disc}) {
    Surroundings surroundings(area, 10.0, 5.0);
    surroundings.build(placed);
    std::vector<Relevant> found;
    for (std::uint32_t own = 0; own < 500; own += 7) {
      std::vector<Relevant> expected;
      for (const Placed& each : placed)
        if (const double within = depth(area, placed[own].centre, each.centre, each.half_extent); each.entity != own && within >= 0.0) expected.push_back({each.entity, within});
      surroundings.find(placed[own].centre, own, found);
      ASSERT_EQ(found, expected) << "around " << own << ", seed 7";
    }
  }
}

TEST(Classification, PoolsPairsOverSamples) {
  Classification counts;
  EXPECT_FALSE(counts.precision());
  counts.add(std::vector<std::uint32_t>{1, 3, 5, 9}, std::vector<Relevant>{{3, 0.1}, {4, 0.1}, {5, 0.1}});
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
  EXPECT_NEAR(*figures.rms, std::sqrt(1001.0 * 2001.0 / 6.0), 1e-9);  // sum of squares n (n + 1)(2n + 1)/6
  EXPECT_NEAR(*figures.p99, 990.0, 1e-9);
  EXPECT_NEAR(*figures.max, 1000.0, 1e-9);
  PositionErrors few;
  few.add(0.002);
  EXPECT_FALSE(few.figures().p99);
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
  const std::vector<ScopeStep> steps{{-1.0, 1, true}, {-1.0, 9, true}, {0.5, 1, false}, {1.2, 1, true}, {1.3, 1, true}, {1.5, 2, true},
                                      {1.6, 9, false}, {2.5, 1, false}, {4.0, 1, true}, {5.0, 2, false}};
  const ScopeChanges changes = count_changes(steps, 9, 1.0, 5.0);
  EXPECT_EQ(changes.entries, 3u);
  EXPECT_EQ(changes.exits, 1u);
  EXPECT_EQ(changes.flaps, 1u) << "back after 0.7 s, and after 1.5 s";
}

/// An entity on a line at 1 m/s towards an observer at rest: its depth grows by the second, from -1 at 0 s.
struct Approach {
  static constexpr double look_s = 0.3;
  Stays stays;
  void watch(ScopeHistory delivered, double until_s) {
    for (int i = 0; i * look_s <= until_s; ++i) {
      const double now = i * look_s, depth = std::min(now - 1.0, 3.0 - now);  // and leaves at 3 s
      delivered.advance(now);
      std::vector<Relevant> relevant;
      if (depth >= 0.0) relevant.push_back({5, depth});
      stays.look(now, relevant, delivered, [&](std::uint32_t) { return now - look_s - 1.0; });
    }
    stays.end();
  }
};

TEST(Stays, AnEntryIsLateFromWhenItCrossedTheBorderToWhenItsStateCame) {
  Approach approach;
  approach.watch(ScopeHistory({{1.75, 5, true}}), 6.0);
  ASSERT_EQ(approach.stays.lateness_s().size(), 1u);
  EXPECT_NEAR(approach.stays.lateness_s()[0], 0.75, 1e-12) << "looks are 0.3 s apart, the crossing at 1 s is found between them";
  EXPECT_EQ(approach.stays.never_delivered(), 0u);
}

TEST(Stays, WhatIsThereAlreadyIsNotLate) {
  Approach approach;
  approach.watch(ScopeHistory({{0.4, 5, true}}), 6.0);
  EXPECT_THAT(approach.stays.lateness_s(), ElementsAre(0.0));
}

TEST(Stays, AnEntityThatNeverCameIsLateForItsWholeStay) {
  Approach gone, seen_to_the_last;
  gone.watch(ScopeHistory({}), 6.0);
  ASSERT_EQ(gone.stays.never_delivered(), 1u);
  EXPECT_NEAR(gone.stays.lateness_s()[0], 2.3, 1e-12) << "seen at 3.0 s, gone at 3.3 s";
  seen_to_the_last.watch(ScopeHistory({}), 2.1);
  EXPECT_NEAR(seen_to_the_last.stays.lateness_s()[0], 1.1, 1e-12);
}

TEST(Stays, WhatWasThereAtTheFirstLookHasNoKnownBeginning) {
  Stays stays;
  stays.look(0.0, std::vector<Relevant>{{1, 0.5}}, ScopeHistory({}), [](std::uint32_t) { return std::nullopt; });
  stays.end();
  EXPECT_TRUE(stays.lateness_s().empty());
}

/// One bat at rest in the middle of a field without drag; three pucks: one at rest beside it, one that flies by, one far away.
class TinyRink : public testing::Test {
 protected:
  static constexpr double view_half_side = 1.0;
  static constexpr std::uint32_t bat = 0, still = 1, flying = 2, far = 3;  // bodies in the order of their making

  void SetUp() override {
    scene_file_ = (folder_ / "tiny.toml").string();
    std::ofstream(scene_file_) << R"(
[field]
length = 20.0
width = 20.0
material = "ice"
[materials]
names = ["ice"]
restitution = 1.0
[drag]
pucks = 0.0
bats = 0.0
[[bat]]
position = [10.0, 10.0]
half_extent = [0.1, 0.1]
material = "ice"
[[puck]]
position = [10.5, 10.5]
radius = 0.1
material = "ice"
[[puck]]
position = [8.0, 9.5]
velocity = [1.0, 0.0]
radius = 0.1
material = "ice"
[[puck]]
position = [2.0, 2.0]
radius = 0.1
material = "ice"
)";
    server_.choice.scene = scene_file_;
    server_.clients = 1;
    server_.rate_hz = 10.0;
    server_.until_s = server_.end_s = 4.0;
    for (std::uint32_t body = 0; body < 4; ++body) server_.objects.push_back({100 + body, body});
    game::Game game(game::chosen_scene(server_.choice));
    game.advance(server_.end_s);
    server_.state_hash = game.hash();
    bots_.clients = 1;
    bots_.until_s = 4.0;
    bots_.bots.push_back({100 + bat, {{-1.0, 100 + bat, true}, {-1.0, 100 + still, true}}});
  }

  void decide(double instant_s, const std::vector<std::uint32_t>& bodies) {
    const std::size_t first = server_.in_scope.size();
    for (const std::uint32_t body : bodies) server_.in_scope.push_back(100 + body);
    server_.decisions.push_back({instant_s, 0, first, server_.in_scope.size()});
  }
  TruthFigures judged() const { return truth_of(server_, bots_, {RelevanceArea::Shape::square, view_half_side}); }

  test::TemporaryFolder folder_{"truth"};
  std::string scene_file_;
  game::ServerEvidence server_;
  BotsEvidence bots_;
};

// The flying puck's box touches the square from x = 8.9 on, at 0.9 s, until x = 11.1, at 3.1 s.
TEST_F(TinyRink, FilterDecisionsAreHeldAgainstWhereThingsWereWhenTheyWereInForce) {
  decide(0.5, {bat, still});                // exact
  decide(1.0, {bat, still});                // missed the flying one
  decide(2.0, {bat, still, flying, far});   // one too many
  const TruthFigures truth = judged();
  EXPECT_DOUBLE_EQ(*truth.filter_recall, 4.0 / 5.0);
  EXPECT_DOUBLE_EQ(*truth.filter_precision, 4.0 / 5.0);
  EXPECT_EQ(truth.relevance, "square of 2 m around the bat, touched by the entity's box");
}

TEST_F(TinyRink, LateEntriesAndChurnFollowFromTheTimesOfArrival) {
  bots_.bots[0].changes.push_back({1.25, 100 + flying, true});
  bots_.bots[0].changes.push_back({3.5, 100 + flying, false});
  const TruthFigures truth = judged();
  EXPECT_NEAR(*truth.late_entry_ms.max, 350.0, 1e-6);
  EXPECT_DOUBLE_EQ(*truth.churn_per_client_per_s, 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(*truth.flapping_fraction, 0.0);
}

TEST_F(TinyRink, ErrorsAndWasteAreThoseOfWhatWasBelieved) {
  const auto believe = [&](std::uint32_t body, std::uint32_t bytes, Vector2 matched, Vector2 displayed) {
    bots_.beliefs.push_back({.object = 100 + body, .bytes = bytes, .is_in_scope = true, .matched = matched, .displayed = displayed});
  };
  bots_.bots[0].changes.push_back({1.0, 100 + flying, true});
  bots_.bots[0].changes.push_back({1.0, 100 + far, true});
  believe(bat, 1000, {0.0, 0.0}, {0.0, 0.0});     // the own bat counts nowhere
  believe(still, 10, {10.5, 10.5}, {10.5, 10.5});
  believe(flying, 20, {10.0, 9.5}, {10.0, 9.5});  // right at 2.0 s, 50 mm behind at 2.05 s
  believe(far, 30, {7.0, 7.0}, {7.0, 7.0});       // wrong, but of no interest
  bots_.samples.push_back({.bot = 0, .displayed_s = 2.05, .matched_s = 2.0, .window_s = 0.05, .first = 0, .last = 4});
  const TruthFigures truth = judged();
  EXPECT_NEAR(*truth.position_error_mm.max, 0.0, 1e-9);
  EXPECT_NEAR(*truth.displayed_error_mm.max, 50.0, 1e-9);
  EXPECT_NEAR(*truth.displayed_error_mm.rms, 50.0 / std::sqrt(2.0), 1e-9);
  EXPECT_DOUBLE_EQ(*truth.wasted_bytes_fraction, 30.0 / 60.0);
  EXPECT_DOUBLE_EQ(*truth.delivered_precision, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(*truth.delivered_recall, 1.0);
}

TEST_F(TinyRink, AContactWithABodyThatThePlayerDoesNotKnowIsMissed) {
  // Right and up at once take the bat along the diagonal into the puck that stands there.
  server_.keys = {{.time = 0.0, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::right}, {.time = 0.0, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::up}};
  game::Game game(game::chosen_scene(server_.choice));
  game.record_events(true);
  for (const game::InputEvent& key : server_.keys) game.submit(key);
  std::uint64_t contacts = 0, with_still = 0;
  game.advance(server_.until_s - 1e-9);
  for (const physics::Event& impact : game.events()) {
    if (!physics::is_impact(impact.kind) || !impact.other || (impact.body.index != bat && impact.other->index != bat)) continue;
    ++contacts;
    with_still += impact.body.index == still || impact.other->index == still ? 1u : 0u;
  }
  game.advance(server_.end_s);
  server_.state_hash = game.hash();
  ASSERT_GT(with_still, 0u);
  EXPECT_EQ(judged().interactions, contacts);
  EXPECT_EQ(judged().missed_interactions, contacts - with_still);
  bots_.bots[0].changes.pop_back();  // never heard of the still puck
  EXPECT_EQ(judged().missed_interactions, contacts);
}

/// The bat is pushed into the puck again and again; only contacts from the beginning of the measured span up to its end count, that itself excluded.
TEST_F(TinyRink, ContactsOfTheWarmUpAndAfterTheEndAreNotCounted) {
  server_.keys = {{.time = 0.0, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::right}, {.time = 0.0, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::up}};
  game::Game game(game::chosen_scene(server_.choice));
  game.record_events(true);
  for (const game::InputEvent& key : server_.keys) game.submit(key);
  std::vector<double> instants;
  for (int i = 1; i <= 4000; ++i) {
    game.advance(1e-3 * i);
    for (const physics::Event& impact : game.events())
      if (physics::is_impact(impact.kind) && impact.other && (impact.body.index == bat || impact.other->index == bat) && (instants.empty() || impact.time > instants.back())) instants.push_back(impact.time);
  }
  server_.state_hash = game.hash();
  ASSERT_GE(instants.size(), 3u);
  server_.from_s = instants[1], server_.until_s = instants.back();
  EXPECT_EQ(judged().interactions, instants.size() - 2) << "neither the first nor the one at the end";
  server_.from_s = std::nextafter(instants[1], 4.0);
  EXPECT_EQ(judged().interactions, instants.size() - 3);
  bots_.bots[0].changes.pop_back();  // never heard of the puck
  EXPECT_EQ(judged().missed_interactions, judged().interactions);
}

TEST_F(TinyRink, ChurnIsThatOfTheSpanPerWatchedPlayerAndSecond) {
  for (const double instant_s : {0.5, 1.5, 2.5, 3.5}) bots_.bots[0].changes.push_back({instant_s, 100 + flying, std::fmod(instant_s, 2.0) < 1.0});
  EXPECT_DOUBLE_EQ(*judged().churn_per_client_per_s, 4.0 / 4.0);
  server_.from_s = 1.0, server_.until_s = 3.5;
  EXPECT_DOUBLE_EQ(*judged().churn_per_client_per_s, 2.0 / 2.5) << "at 1.5 and 2.5 s; what happens at the end is after it";
  bots_.bots.push_back({100 + far, {}});  // another player, at rest where nothing comes by
  EXPECT_DOUBLE_EQ(*judged().churn_per_client_per_s, 2.0 / 2.5 / 2.0);
}

/// A puck slides into the left goal, lies there for the delay, and is put back between two ticks, far from where it was.
TEST_F(TinyRink, APuckThatScoredCountsWhereItLeftPlayUntilTheFirstTickAfterItsFaceOff) {
  std::ofstream(scene_file_) << R"(
[field]
length = 4.0
width = 2.0
goal_width = 1.0
material = "ice"
[materials]
names = ["ice"]
restitution = 1.0
[drag]
pucks = 0.0
bats = 0.0
[match]
goals_to_win = 5
face_off_delay = 1.03
face_off_distance = 0.25
[[bat]]
position = [3.5, 1.0]
half_extent = [0.1, 0.1]
material = "ice"
[[bat]]
position = [3.5, 0.3]
half_extent = [0.1, 0.1]
material = "ice"
[[puck]]
position = [1.0, 1.0]
velocity = [-1.0, 0.0]
radius = 0.1
material = "ice"
)";
  constexpr std::uint32_t puck = 2;
  game::Game game(game::chosen_scene(server_.choice));
  std::optional<double> scored_s, back_s;
  Vector2 left_play;
  for (int ms = 0; ms <= 4000 && !back_s; ++ms) {
    game.advance(1e-3 * ms);
    const bool is_away = !game.world().is_in_play({puck});
    if (is_away && !scored_s) scored_s = 1e-3 * ms, left_play = game.position({puck});
    if (!is_away && scored_s) back_s = 1e-3 * ms;
  }
  ASSERT_TRUE(scored_s && back_s);
  ASSERT_NEAR(*back_s - *scored_s, 1.03, 2e-3);
  const Vector2 face_off = game.position({puck});
  ASSERT_GT((face_off - left_play).norm(), 0.9);
  const double tick_s = 1.0 / server_.rate_hz, first_tick_s = std::ceil(*back_s / tick_s) * tick_s;
  ASSERT_GT(first_tick_s - *back_s, 0.01) << "it comes back between two ticks";
  Replay replay(server_, {RelevanceArea::Shape::square, view_half_side});
  const auto centre_at = [&](double instant_s) {
    replay.advance(instant_s);
    replay.look_around();
    return replay.centre(puck);
  };
  EXPECT_NEAR((centre_at(*scored_s + 0.01) - left_play).norm(), 0.0, 1e-9);
  EXPECT_NEAR((centre_at(*back_s + 1e-3) - left_play).norm(), 0.0, 1e-9) << "put back, and not announced";
  EXPECT_NEAR((centre_at(first_tick_s - 1e-3) - left_play).norm(), 0.0, 1e-9);
  EXPECT_NEAR((centre_at(first_tick_s) - face_off).norm(), 0.0, 0.1) << "the first tick that can tell of it";
}

TEST_F(TinyRink, AnotherGameThanTheServersIsRefused) {
  server_.state_hash ^= 1;
  EXPECT_THROW(judged(), DifferentGame);
}

TEST_F(TinyRink, EvidenceReadsBackAsItWasWritten) {
  decide(0.5, {bat, still, far});
  server_.keys = {{.time = 0.1 + 0.2, .player = 0, .kind = game::InputKind::key_up, .key = game::Key::down}};
  server_.ticks = {{0.1, 1e-6, 2e-6, 3.5e-6}};
  server_.scheme = "grid";
  const std::string file = (folder_ / "server.jsonl").string();
  write_evidence(file, server_);
  const game::ServerEvidence read = game::read_server_evidence(file);
  EXPECT_EQ(read.choice, server_.choice);
  EXPECT_EQ(read.keys, server_.keys);
  EXPECT_EQ(read.in_scope, server_.in_scope);
  EXPECT_EQ(read.scheme, "grid");
  EXPECT_EQ(read.state_hash, server_.state_hash);
  EXPECT_NEAR(read.ticks.at(0).send_s, 3.5e-6, 1e-15);

  bots_.beliefs.push_back({.object = 7, .bytes = 8, .is_in_scope = true, .matched = {1.25, -2.5}, .displayed = {1.5, -2.5}});
  bots_.samples.push_back({.bot = 0, .displayed_s = 0.7, .matched_s = 0.6, .window_s = 0.05, .first = 0, .last = 1});
  const std::string bots_file = (folder_ / "bots.jsonl").string();
  write_evidence(bots_file, bots_);
  const BotsEvidence bots = read_bots_evidence(bots_file);
  ASSERT_EQ(bots.beliefs.size(), 1u);
  EXPECT_EQ(bots.beliefs[0].displayed, Vector2(1.5, -2.5));
  EXPECT_EQ(bots.bots.at(0).changes.size(), 2u);
  EXPECT_EQ(bots.samples.at(0).matched_s, 0.6);
}

TEST_F(TinyRink, EvidenceOfAnotherVersionIsRefusedByBothNumbers) {
  const auto words_of = [&](const char* key, const auto& read) {
    const std::string file = (folder_ / "other.jsonl").string();
    game::EvidenceWriter writer(file);
    writer.line({{key, 2}});
    writer.finish();
    try {
      read(file);
    } catch (const game::EvidenceError& error) {
      return std::string(error.what());
    }
    return std::string("(accepted)");
  };
  EXPECT_THAT(words_of("rink-server-evidence", game::read_server_evidence),
              HasSubstr("other.jsonl:1: expected a server's evidence of version 1, found version 2"));
  EXPECT_THAT(words_of("rink-peer-evidence", game::read_peer_evidence), HasSubstr("expected a peer's evidence of version 1, found version 2"));
  EXPECT_THAT(words_of("rink-bots-evidence", read_bots_evidence), HasSubstr("expected the bots' evidence of version 1, found version 2"));
  EXPECT_THAT(words_of("rink-bots-evidence", game::read_server_evidence),
              HasSubstr("expected a server's evidence of version 1, found something else"));
}

TEST_F(TinyRink, SpoiltEvidenceCostsTheFiguresOfTruthAndNothingElse) {
  const std::string server_file = (folder_ / "server.jsonl").string(), bots_file = (folder_ / "bots.jsonl").string();
  const auto judged_with = [&](auto&& spoil) {
    write_evidence(server_file, server_);
    write_evidence(bots_file, bots_);
    std::ostringstream text;
    text << std::ifstream(server_file).rdbuf();
    const std::string spoilt = spoil(text.str());
    std::ofstream(server_file) << spoilt;
    RunRecord record;
    record.valid = true;
    record.down_bytes_per_client_per_s = 5.0;
    record.cell.parameters.view_fraction = 0.01;
    const Experiment experiment;
    add_truth(record, experiment, server_file, bots_file);
    EXPECT_EQ(record.down_bytes_per_client_per_s, 5.0);
    return record;
  };
  const RunRecord sound = judged_with([](const std::string& text) { return text; });
  EXPECT_TRUE(sound.valid && sound.truth.trouble.empty()) << sound.truth.trouble;
  EXPECT_TRUE(sound.truth.interactions);
  const auto trouble = [&](auto&& spoil) {
    const RunRecord record = judged_with(spoil);
    EXPECT_TRUE(record.valid);
    EXPECT_FALSE(record.truth.interactions);
    return record.truth.trouble;
  };
  EXPECT_THAT(trouble([](std::string text) { return text.substr(0, text.size() / 2); }), HasSubstr("server.jsonl: truncated or altered"));
  EXPECT_THAT(trouble([](std::string text) { return text.replace(text.find("\"rate_hz\":10"), 12, "\"rate_hz\":11"); }), HasSubstr("altered"));
  EXPECT_THAT(trouble([](std::string) { return std::string(); }), HasSubstr("truncated"));
  EXPECT_THAT(trouble([&](std::string text) {
                std::filesystem::remove(bots_file);
                return text;
              }), HasSubstr("bots.jsonl: cannot be read"));
  server_.state_hash ^= 1;
  const RunRecord other = judged_with([](std::string text) { return text; });
  EXPECT_FALSE(other.valid);
  EXPECT_THAT(other.why_invalid, HasSubstr("does not end in the server's state"));
}

TEST(Sampling, TheSameSeedLooksAtTheSamePlayersAndInstants) {
  const game::SamplingSettings settings{.seed = 3, .clients = 100, .from_s = 0.5, .until_s = 3.5};
  EXPECT_EQ(game::sampled_players(settings), game::sampled_players(settings));
  EXPECT_EQ(game::sampled_players(settings).size(), 32u);
  const std::vector<double> instants = game::sampled_instants(settings, 1);
  ASSERT_EQ(instants.size(), 30u);
  for (std::size_t i = 0; i < instants.size(); ++i) EXPECT_EQ(std::floor((instants[i] - 0.5) / 0.1), static_cast<double>(i)) << "one from each tenth of a second";
  EXPECT_NE(instants, game::sampled_instants(settings, 2));
}

}  // namespace
}  // namespace rink::loadgen
