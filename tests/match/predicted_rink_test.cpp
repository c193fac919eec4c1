// What is predicted against the game itself: told late, in part or wrongly, it must find back, and
// smoothly.
#include <gtest/gtest.h>

#include "game/control/game.h"
#include "game/match/predicted_rink.h"
#include "tests/match/match_scene.h"

namespace rink::game {
namespace {

ReceivedRink told_by(const Game& game) {
  ReceivedRink told{.time = game.now(), .bats = {}, .pucks = {}};
  for (const Entity& entity : game.entities()) {
    ReceivedBody body{.position = game.position(entity.id),
                      .velocity = game.velocity(entity.id),
                      .held = {},
                      .is_in_play = game.simulator().is_in_play(entity.id)};
    if (entity.player) body.held = game.keys_held(*entity.player);
    if (entity.kind == physics::BodyKind::bat) told.bats.push_back(body);
    if (entity.kind == physics::BodyKind::puck) told.pucks.push_back(body);
  }
  told.own_felt = game.input_count(0);
  return told;
}

Vector2 bat_of(const Game& game, std::uint32_t player) { return game.position(*game.bat(player)); }

TEST(APredictedRink, ShowsTheOwnBatWhereTheServerWillHaveItThoughNothingIsToldForAWhile) {
  Game game(match_scene());
  PredictedRink rink(match_scene(), 0);
  rink.receive(told_by(game));
  rink.advance(0.0, 0.0);
  const InputEvent events[] = {{0.10, 0, InputKind::key_down, Key::up},
                               {0.25, 0, InputKind::key_down, Key::right},
                               {0.4, 0, InputKind::key_up, Key::up}};
  for (const InputEvent& event : events) {
    rink.advance(event.time, 0.2);
    rink.press(event.key, event.kind == InputKind::key_down, event.time);
    game.submit(event);
  }
  rink.advance(0.6, 0.2);
  game.advance(0.6);
  EXPECT_LT((rink.bats()[0].position - bat_of(game, 0)).norm(), 1e-12);
  EXPECT_EQ(rink.bats()[0].time, 0.6);
  EXPECT_EQ(rink.bats()[1].time, 0.6 - 0.2);
  EXPECT_EQ(rink.keys_waiting(), 3u);
  rink.receive(told_by(game));
  EXPECT_EQ(rink.keys_waiting(), 0u);
  EXPECT_EQ(rink.own_corrections().visible_count, 0u);
}

/// Datagrams overtake each other: what was true before is no news.
TEST(APredictedRink, GoesByTheNewestStateWhateverComesAfterIt) {
  Game game(match_scene());
  game.submit({0.0, 1, InputKind::key_down, Key::down});
  game.advance(0.1);
  const ReceivedRink older = told_by(game);
  game.submit({0.15, 0, InputKind::key_down, Key::up});
  game.submit({0.15, 1, InputKind::key_up, Key::down});
  game.advance(0.2);
  const ReceivedRink newer = told_by(game);
  PredictedRink rink(match_scene(), 0), only_newer(match_scene(), 0);
  rink.receive(newer), rink.receive(older);
  only_newer.receive(newer);
  EXPECT_EQ(rink.received_time(), 0.2);
  game.advance(0.4);
  for (PredictedRink* each : {&rink, &only_newer}) each->advance(0.4, 0.0);
  for (const std::uint32_t bat : {0u, 1u}) {
    EXPECT_LT((rink.bats()[bat].position - bat_of(game, bat)).norm(), 1e-12) << bat;
    EXPECT_EQ(rink.bats()[bat].position, only_newer.bats()[bat].position);
  }
  rink.receive(older);
  rink.advance(0.4, 0.0);
  EXPECT_EQ(rink.bats()[0].position, only_newer.bats()[0].position);
  EXPECT_EQ(rink.own_corrections().visible_count + rink.other_corrections().visible_count, 0u);
}

/// Of the keys that were pressed those are pressed again that were not felt yet, however old the
/// word is that says so.
TEST(APredictedRink, ForgetsAKeyThatWasFeltOnceAndForAll) {
  Game game(match_scene());
  PredictedRink rink(match_scene(), 0);
  rink.receive(told_by(game));
  rink.advance(0.0, 0.0);
  const ReceivedRink before = told_by(game);
  rink.press(Key::up, true, 0.05);
  game.submit({0.05, 0, InputKind::key_down, Key::up});
  game.advance(0.1);
  rink.receive(told_by(game));
  EXPECT_EQ(rink.keys_waiting(), 0u);
  rink.receive(before);
  rink.advance(0.3, 0.0);
  game.advance(0.3);
  EXPECT_EQ(rink.keys_waiting(), 0u);
  EXPECT_LT((rink.bats()[0].position - bat_of(game, 0)).norm(), 1e-12);
}

TEST(APredictedRink, LeavesAWrongPlaceBehindWithinATenthOfASecondWithoutAJump) {
  Game game(match_scene());
  PredictedRink rink(match_scene(), 0);
  rink.receive(told_by(game));
  rink.advance(0.0, 0.0);
  rink.press(Key::up, true, 0.0);  // which the server never gets
  rink.advance(0.2, 0.05);
  const double wrong = rink.bats()[0].position.y();
  game.submit({0.1, 0, InputKind::key_down, Key::down}),
      game.submit({0.1, 0, InputKind::key_up, Key::down});
  game.advance(0.2);
  rink.receive(told_by(game));
  rink.advance(0.2, 0.05);
  EXPECT_NEAR(rink.bats()[0].position.y(), wrong, 1e-9) << "no jump";
  EXPECT_EQ(rink.own_corrections().visible_count, 1u);
  EXPECT_GT(rink.own_corrections().greatest, 0.1);
  double before = wrong;
  for (double now = 0.21; now < 0.3; now += 0.01) {
    rink.advance(now, 0.05);
    EXPECT_LE(rink.bats()[0].position.y(), before) << "nor does it overshoot";
    before = rink.bats()[0].position.y();
  }
  rink.advance(0.31, 0.05);
  game.advance(0.31);
  EXPECT_LT((rink.bats()[0].position - bat_of(game, 0)).norm(), 1e-9);
}

/// A bat's place is always made up for smoothly; a puck that is more than 0.3 m off jumps.
TEST(APredictedRink, GlidesToABatHoweverWrongItWasAndJumpsToAPuckThatIsFarOff) {
  const Scene scene = match_scene();
  Game game(scene);
  ReceivedRink told = told_by(game);
  PredictedRink rink(scene, 0);
  rink.receive(told);
  rink.advance(0.0, 0.0);
  const Vector2 bat = rink.bats()[0].position, puck = rink.pucks()[0].position;
  told.time = 0.01;
  told.bats[0].position.y() -= 0.4, told.pucks[0].position.y() += 0.4;
  rink.advance(0.01, 0.0);
  rink.receive(told);
  rink.advance(0.01, 0.0);
  EXPECT_LT((rink.bats()[0].position - bat).norm(), 1e-9);
  EXPECT_NEAR(rink.own_corrections().greatest, 0.4, 1e-9);
  EXPECT_EQ(rink.own_corrections().visible_count, 1u);
  EXPECT_NEAR((rink.pucks()[0].position - puck).norm(), 0.4, 1e-6);
  EXPECT_EQ(rink.puck_corrections().visible_count, 0u);
  told.time = 0.2;
  told.pucks[0].position.y() -= 0.2;
  rink.advance(0.2, 0.0);
  const Vector2 shown = rink.pucks()[0].position;
  rink.receive(told);
  rink.advance(0.2, 0.0);
  EXPECT_LT((rink.pucks()[0].position - shown).norm(), 1e-9);
  EXPECT_EQ(rink.puck_corrections().visible_count, 1u);
}

TEST(APredictedRink, MakesUpForASecondMistakeWithoutForgettingTheFirst) {
  const Scene scene = match_scene();
  Game game(scene);
  ReceivedRink told = told_by(game);
  PredictedRink rink(scene, 0);
  rink.receive(told);
  rink.advance(0.0, 0.0);
  double now = 0.0;
  for (const double step : {-0.1, -0.05, 0.08}) {
    now += 0.03;
    rink.advance(now, 0.0);
    const Vector2 shown = rink.bats()[0].position;
    told.time = now;
    told.bats[0].position.y() += step;
    rink.receive(told);
    rink.advance(now, 0.0);
    EXPECT_LT((rink.bats()[0].position - shown).norm(), 1e-12) << "a jump at " << now;
  }
  rink.advance(now + 0.1, 0.0);
  EXPECT_NEAR(rink.bats()[0].position.y(), told.bats[0].position.y(), 1e-12);
}

TEST(APredictedRink, LetsAPucksTimeRunAtMostThreeTimesAndAtLeastThreeTenthsAsFast) {
  Scene scene = match_scene();
  scene.bodies.pucks[0].body.velocity = {0.0, 0.0};
  scene.bodies.pucks[0].body.position = {2.05, 0.6};  // at the other's bat: shown as late as that
  Game game(scene);
  PredictedRink rink(scene, 0);
  rink.receive(told_by(game));
  rink.advance(0.0, 0.0);
  double now = 0.0;
  const auto rate_at = [&](double delay) {
    const double before = rink.pucks()[0].time;
    now += 0.01;
    rink.advance(now, delay);
    return (rink.pucks()[0].time - before) / 0.01;
  };
  for (int step = 0; step < 20; ++step)
    EXPECT_NEAR(rate_at(0.2), 0.3, 1e-6) << "the delay has grown: " << step;
  while (now < 1.0) rate_at(0.2);
  EXPECT_NEAR(now - rink.pucks()[0].time, 0.2, 1e-6);
  for (int step = 0; step < 9; ++step)
    EXPECT_NEAR(rate_at(0.0), 3.0, 1e-6) << "the delay is gone: " << step;
}

TEST(APredictedRink, ShowsAPuckAtEachBatInThatBatsOwnTime) {
  Scene scene = match_scene();
  scene.bodies.pucks[0].body.velocity = {0.0, 0.0};
  for (const double x : {0.35, 1.2, 2.05}) {
    scene.bodies.pucks[0].body.position = {x, 0.6};
    Game game(scene);
    PredictedRink rink(scene, 0);
    rink.receive(told_by(game));
    rink.advance(0.0, 0.0);
    for (double now = 0.01; now < 1.0; now += 0.01) rink.advance(now, 0.2);
    const double lag = rink.now() - rink.pucks()[0].time;
    EXPECT_NEAR(lag, x < 0.4 ? 0.0 : x > 2.0 ? 0.2 : 0.1, 1e-3);
  }
}

TEST(APredictedRink, BearsWhatNoServerShouldTell) {
  const Scene scene = match_scene();
  PredictedRink rink(scene, 0);
  ReceivedRink told{
      .time = 1.0, .bats = std::vector<ReceivedBody>(2), .pucks = std::vector<ReceivedBody>(1)};
  told.bats[0].position = {-5.0, 90.0}, told.bats[1].position = {0.1, 0.1};
  told.pucks[0].position = {1.2, -3.0}, told.pucks[0].velocity = {100.0, -100.0};
  rink.receive(told);
  rink.advance(1.5, 0.1);
  for (const ShownBody& bat : rink.bats()) EXPECT_TRUE(bat.position.allFinite());
  told.time = 0.5;
  rink.receive(told);
  rink.advance(1.6, 0.1);
  told.pucks[0].is_in_play = false, told.time = 1.6;
  rink.receive(told);
  rink.advance(1.7, 0.1);
  EXPECT_TRUE(rink.pucks()[0].position.allFinite());
  rink.rewind(1.6);
  EXPECT_EQ(rink.now(), 1.6);
}

TEST(APredictedRink, HasNothingInTheWayThatIsTooFarAwayToBeKnownAndNoJumpWhenItComesNear) {
  Game game(match_scene());
  PredictedRink rink(match_scene(), 0);
  ReceivedRink told = told_by(game);
  told.pucks[0].is_known = told.bats[1].is_known = false;
  told.pucks[0].velocity = {-50.0, 0.0};
  rink.receive(told);
  for (const double now : {0.0, 0.05, 0.1}) rink.advance(now, 0.05);
  EXPECT_EQ(rink.pucks()[0].position, told.pucks[0].position)
      << "it would have gone through the own bat";
  EXPECT_EQ(rink.bats()[0].position, bat_of(game, 0));
  game.advance(0.1);
  rink.receive(told_by(game));
  rink.advance(0.1, 0.05);
  EXPECT_EQ(rink.puck_corrections().visible_count, 0u);
  rink.advance(0.3, 0.05);
  game.advance(0.25);
  EXPECT_LT((rink.bats()[1].position - bat_of(game, 1)).norm(), 1e-12);
}

}  // namespace
}  // namespace rink::game
