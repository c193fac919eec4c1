// The figures of truth of a tiny rink, each against its arithmetic.
#include "tests/loadgen/run/tiny_rink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "game/control/game.h"
#include "game/model/key.h"
#include "game/net/scene_choice.h"
#include "loadgen/measure/truth/truth.h"

namespace rink::loadgen {
namespace {

using testing::ElementsAre;

// The flying puck's box touches the square from x = 8.9 on, at 0.9 s, until x = 11.1, at 3.1 s.
TEST_F(TinyRink, FilterDecisionsAreHeldAgainstWhereThingsWereWhenTheyWereInForce) {
  decide(0.5, {bat, still});               // exact
  decide(1.0, {bat, still});               // missed the flying one
  decide(2.0, {bat, still, flying, far});  // one too many
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

/// It touches the square from 0.9 to 3.1 s.
TEST_F(TinyRink, ALateDiscoveryTakesFromTheTrueEntryToTheFirstStateAndOneThatNeverCameIsCensored) {
  Discoveries found;
  const auto late = [&] {
    truth_of(server_, bots_, {RelevanceArea::Shape::square, view_half_side}, &found);
    return found.late_discovery;
  };
  bots_.bots[0].changes.push_back({1.25, 100 + flying, true});
  EXPECT_THAT(late().distribution(200), ElementsAre(SampleDistribution::Point{0.0, 0.0},
                                                    SampleDistribution::Point{350.0, 1.0}));
  bots_.bots[0].changes.back().instant_s = 0.5;
  EXPECT_THAT(late().distribution(200), ElementsAre(SampleDistribution::Point{0.0, 1.0}))
      << "it was known before";
  bots_.bots[0].changes.back().instant_s = 3.2;
  EXPECT_THAT(late().distribution(200), ElementsAre(SampleDistribution::Point{0.0, 0.0}))
      << "it had left";
  EXPECT_EQ(found.late_discovery.never(), 1u);
  EXPECT_EQ(found.late_discovery.samples(), 1u)
      << "what is beside the bat from the beginning entered at no known instant";
  EXPECT_EQ(found.missed_contact.samples(), 0u);
  bots_.is_complete = false;
  EXPECT_EQ(late().samples(), 0u);
}

/// Within T = 0.2 s the bat, by two keys of 10 m/s^2, gets 14.14 T^2/2 = 0.283 m far, the puck 0.2
/// m: with the radii of their discs, 0.141 and 0.1 m, 0.724 m in all, which is their distance at 2
/// s -+ sqrt(0.724^2 - 0.5^2) s. The still one is too far for both.
TEST_F(TinyRink, ByContactTheFlyingPuckIsRelevantWhileItAndTheBatCanMeet) {
  const RelevanceArea contact{.shape = RelevanceArea::Shape::contact, .contact_s = 0.2};
  const double apart = 0.1 * std::sqrt(2.0) + 0.1 + 10.0 * std::sqrt(2.0) * 0.02 + 0.2,
               half_s = std::sqrt(apart * apart - 0.25);
  bots_.bots[0].changes.push_back({1.75, 100 + flying, true});
  decide(2.0 - half_s - 1e-3, {bat, still});
  decide(2.0 - half_s + 1e-3, {bat, flying});
  decide(2.0 + half_s - 1e-3, {bat, still});
  decide(2.0 + half_s + 1e-3, {bat, flying});
  const TruthFigures truth = judged(contact);
  EXPECT_DOUBLE_EQ(*truth.filter_precision, 1.0 / 4.0);
  EXPECT_DOUBLE_EQ(*truth.filter_recall, 1.0 / 2.0);
  EXPECT_NEAR(*truth.late_entry_ms.max, 1e3 * (1.75 - (2.0 - half_s)), 0.01);
  EXPECT_EQ(truth.relevance, "whoever can touch the bat within 0.2 s, or a puck that can");
}

/// An expression says that it is relevant, not how much: the entry at 0.9 s is dated by the look
/// that found it, at most 4 ms later.
TEST_F(TinyRink, ByAnExpressionAnEntryIsDatedByTheLookThatFoundIt) {
  bots_.bots[0].changes.push_back({1.25, 100 + flying, true});
  decide(0.89, {bat, still});
  decide(0.91, {bat, still, flying});
  const TruthFigures truth = judged({.shape = RelevanceArea::Shape::filter,
                                     .reach = view_half_side,
                                     .expression = "region and not owner"});
  EXPECT_DOUBLE_EQ(truth.filter_precision.value_or(-1.0), 1.0);
  EXPECT_DOUBLE_EQ(truth.filter_recall.value_or(-1.0), 1.0);
  EXPECT_LE(*truth.late_entry_ms.max, 350.0 + 1e-6);
  EXPECT_GE(*truth.late_entry_ms.max, 346.0 - 1e-6);
  EXPECT_EQ(truth.relevance,
            "whoever 'region and not owner' lets through, of a square of 2 m around the bat");
}

/// Looks are 4 ms apart, or an eighth of a tick if that is less, from the beginning of the measured
/// span on; the first one from 0.9 s on dates the entry.
TEST_F(TinyRink, LooksAreFourMillisecondsOrAnEighthOfATickApart) {
  bots_.bots[0].changes.push_back({1.25, 100 + flying, true});
  server_.from_s = 0.0051;
  for (const auto& [rate_hz, apart_s] :
       {std::pair{10.0, 0.004}, {30.0, 0.004}, {50.0, 0.0025}, {100.0, 0.00125}}) {
    server_.rate_hz = rate_hz;
    const double found_s = server_.from_s + apart_s * std::ceil((0.9 - server_.from_s) / apart_s);
    const TruthFigures truth = judged({.shape = RelevanceArea::Shape::filter,
                                       .reach = view_half_side,
                                       .expression = "region and not owner"});
    EXPECT_NEAR(*truth.late_entry_ms.max, 1e3 * (1.25 - found_s), 1e-6) << rate_hz << " Hz";
  }
}

/// It leaves for half a second, then for longer than a second: one flap in three entries.
TEST_F(TinyRink, FlappingIsThePartOfEntriesThatFollowALeavingWithinASecond) {
  const std::pair<double, bool> steps[] = {
      {0.5, true}, {1.0, false}, {1.5, true}, {2.0, false}, {3.5, true}};
  for (const auto& [instant_s, is_in] : steps)
    bots_.bots[0].changes.push_back({instant_s, 100 + flying, is_in});
  EXPECT_DOUBLE_EQ(*judged().flapping_fraction, 1.0 / 3.0);
}

/// What left just before the span and comes back in it flaps, too; what came before it is no entry.
TEST_F(TinyRink, FlappingLooksBackBeyondTheSpan) {
  const std::pair<double, bool> steps[] = {{0.5, true}, {1.4, false}, {1.9, true}, {2.5, false}};
  for (const auto& [instant_s, is_in] : steps)
    bots_.bots[0].changes.push_back({instant_s, 100 + flying, is_in});
  server_.from_s = 1.5;
  EXPECT_DOUBLE_EQ(*judged().flapping_fraction, 1.0);
}

TEST_F(TinyRink, ErrorsAndWasteAreThoseOfWhatWasBelieved) {
  const auto assume = [&](std::uint32_t body, std::uint32_t bytes, Vector2 matched,
                          Vector2 displayed) {
    bots_.replicas.push_back({.object = 100 + body,
                              .bytes = bytes,
                              .is_in_scope = true,
                              .matched = matched,
                              .displayed = displayed});
  };
  bots_.bots[0].changes.push_back({1.0, 100 + flying, true});
  bots_.bots[0].changes.push_back({1.0, 100 + far, true});
  assume(bat, 1000, {0.0, 0.0}, {0.0, 0.0});  // the own bat counts nowhere
  assume(still, 10, {10.5, 10.5}, {10.5, 10.5});
  assume(flying, 20, {10.0, 9.5}, {10.0, 9.5});  // right at 2.0 s, 50 mm behind at 2.05 s
  assume(far, 30, {7.0, 7.0}, {7.0, 7.0});       // wrong, but of no interest
  bots_.samples.push_back(
      {.bot = 0, .displayed_s = 2.05, .matched_s = 2.0, .window_s = 0.05, .first = 0, .last = 4});
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
  server_.keys = {
      {.time = 0.0, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::right},
      {.time = 0.0, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::up}};
  game::Game game(game::chosen_scene(server_.choice));
  game.record_events(true);
  for (const game::InputEvent& key : server_.keys) game.submit(key);
  std::uint64_t contacts = 0, with_still = 0;
  double first_with_still_s = 0.0;
  game.advance(server_.until_s - 1e-9);
  for (const physics::Event& impact : game.events()) {
    if (!physics::is_impact(impact.kind) || !impact.other ||
        (impact.body.index != bat && impact.other->index != bat))
      continue;
    ++contacts;
    if (impact.body.index != still && impact.other->index != still) continue;
    if (with_still++ == 0) first_with_still_s = impact.time;
  }
  game.advance(server_.end_s);
  server_.state_hash = game.hash();
  ASSERT_GT(with_still, 0u);
  EXPECT_EQ(judged().interactions, contacts);
  EXPECT_EQ(judged().missed_interactions, contacts - with_still);
  bots_.bots[0].changes.pop_back();  // never heard of the still puck
  EXPECT_EQ(judged().missed_interactions, contacts);

  // Each contact with it before it is heard of is missed until then, all others for ever.
  Discoveries found;
  const auto of_square = RelevanceArea{RelevanceArea::Shape::square, view_half_side};
  truth_of(server_, bots_, of_square, &found);
  EXPECT_EQ(found.missed_contact.never(), contacts);
  EXPECT_EQ(found.missed_contact.samples(), contacts);
  const double heard_s = first_with_still_s + 0.25;
  bots_.bots[0].changes.push_back({heard_s, 100 + still, true});
  truth_of(server_, bots_, of_square, &found);
  EXPECT_LT(found.missed_contact.never(), contacts);
  EXPECT_EQ(found.missed_contact.samples(), judged().missed_interactions);
  EXPECT_NEAR(found.missed_contact.distribution(200).back().thousandths, 250.0, 1e-3)
      << "that of the first";
}

/// The bat is pushed into the puck again and again; only contacts from the beginning of the
/// measured span up to its end count, that itself excluded.
TEST_F(TinyRink, ContactsOfTheWarmUpAndAfterTheEndAreNotCounted) {
  server_.keys = {
      {.time = 0.0, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::right},
      {.time = 0.0, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::up}};
  game::Game game(game::chosen_scene(server_.choice));
  game.record_events(true);
  for (const game::InputEvent& key : server_.keys) game.submit(key);
  std::vector<double> instants;
  for (int i = 1; i <= 4000; ++i) {
    game.advance(1e-3 * i);
    for (const physics::Event& impact : game.events())
      if (physics::is_impact(impact.kind) && impact.other &&
          (impact.body.index == bat || impact.other->index == bat) &&
          (instants.empty() || impact.time > instants.back()))
        instants.push_back(impact.time);
  }
  server_.state_hash = game.hash();
  ASSERT_GE(instants.size(), 3u);
  server_.from_s = instants[1], server_.until_s = instants.back();
  EXPECT_EQ(judged().interactions, instants.size() - 2)
      << "neither the first nor the one at the end";
  server_.from_s = std::nextafter(instants[1], 4.0);
  EXPECT_EQ(judged().interactions, instants.size() - 3);
  bots_.bots[0].changes.pop_back();  // never heard of the puck
  EXPECT_EQ(judged().missed_interactions, judged().interactions);
}

TEST_F(TinyRink, ChurnIsThatOfTheSpanPerWatchedPlayerAndSecond) {
  for (const double instant_s : {0.5, 1.5, 2.5, 3.5})
    bots_.bots[0].changes.push_back({instant_s, 100 + flying, std::fmod(instant_s, 2.0) < 1.0});
  EXPECT_DOUBLE_EQ(*judged().churn_per_client_per_s, 4.0 / 4.0);
  server_.from_s = 1.0, server_.until_s = 3.5;
  EXPECT_DOUBLE_EQ(*judged().churn_per_client_per_s, 2.0 / 2.5)
      << "at 1.5 and 2.5 s; what happens at the end is after it";
  bots_.bots.push_back({100 + far, {}});  // another player, at rest where nothing comes by
  EXPECT_DOUBLE_EQ(*judged().churn_per_client_per_s, 2.0 / 2.5 / 2.0);
}

}  // namespace
}  // namespace rink::loadgen
