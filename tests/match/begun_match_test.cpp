// A match that goes on from its record.
#include "game/control/begun_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "game/control/replay.h"
#include "game/net/server/hosted_match.h"
#include "tests/match/match_scene.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using testing::HasSubstr;

const Scene& scene() {
  static const Scene scene = match_scene();
  return scene;
}

/// As it is once it was written and read.
KeyLog sealed(KeyLog log) {
  log.is_sealed = true;
  return log;
}

/// Player 0 holds a key and player 1 pushes when it breaks off.
KeyLog broken_off(double until = 3.0) {
  Game game(scene());
  std::vector<InputEvent> events{
      game.submit({.time = 0.5, .player = 0, .kind = InputKind::key_down, .key = Key::right}),
      game.submit({.time = 0.75, .player = 1, .kind = InputKind::push, .push = {-100, 20}})};
  game.advance(until);
  return sealed(log_of(game, scene(), match_text(), events));
}

std::string objection_to(const KeyLog& log, const Scene& to) {
  try {
    begun_match(log, to, "file.keys");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(ABegunMatch, IsTheRecordedGameOfWhichAllKeysAreLetGo) {
  const KeyLog log = broken_off();
  BegunMatch begun = begun_match(log, scene(), "file.keys");
  EXPECT_EQ(begun.game.now(), 3.0);
  EXPECT_EQ(begun.game.hash(), *log.hash) << "what is let go takes effect next";
  begun.game.advance(4.0);
  EXPECT_FALSE(begun.game.keys_held(0).is_down(Key::right));
  EXPECT_EQ(pushed(begun.game, 1), Push{});
  const KeyLog whole = log_of(begun.game, scene(), match_text(), begun.events);
  EXPECT_EQ(replay(whole, scene()), begun.game.hash()) << "its events are those of the whole";
}

TEST(ABegunMatch, RefusesRecordsThatCannotGoOn) {
  KeyLog log = broken_off();
  log.is_sealed = false;
  EXPECT_THAT(objection_to(log, scene()), HasSubstr("file.keys: cannot be replayed"));
  log = broken_off();
  log.hash = *log.hash + 1;
  EXPECT_THAT(objection_to(log, scene()), HasSubstr("plays otherwise"));
  EXPECT_THAT(objection_to(broken_off(), load_scene("match")), HasSubstr("file.keys"));
  Scene one = scene();
  one.rules.goals_to_win = 1;
  one.bodies.pucks[0].body.velocity = {-2.0, 0.0};
  one.bodies.pucks[0].body.position = {0.4, 0.5 * one.world.field.width};
  one.bodies.bats[0].body.position.y() = 0.25;
  Game game(one);
  game.advance(5.0);
  ASSERT_TRUE(game.is_over());
  EXPECT_THAT(objection_to(sealed(log_of(game, one, "", {})), one), HasSubstr("its match is over"));
}

TEST(ABegunMatch, IsHostedFromItsScoreAndTimeOnAndIsRecordedWhole) {
  HostedMatch match(
      {.times = {.countdown_s = 3.0}, .scene_text = match_text(), .begun = broken_off()}, scene());
  Game game(scene());
  match.enter(0, 1.0), match.enter(1, 2.0);
  ASSERT_TRUE(match.advance(2.0));
  game = match.begin(game);
  const std::vector<InputEvent> events = match.take_begun();
  EXPECT_EQ(events.size(), 4u) << "a key, a push, and their ends";
  EXPECT_TRUE(match.take_begun().empty());
  EXPECT_EQ(game.now(), 3.0);
  EXPECT_EQ(match.simulated(4.9), 3.0);
  EXPECT_FALSE(match.advance(6.0));
  game.advance(match.goal(6.0, game.now()));
  EXPECT_EQ(game.now(), 4.0);
  match.finish(game, events);
  const std::vector<KeyLog> records = match.take_finished();
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(replay(records[0], scene()), game.hash());
  match.leave(0, 7.0), match.leave(1, 7.0);
  match.enter(0, 8.0), match.enter(1, 8.0);
  ASSERT_TRUE(match.advance(8.0));
  EXPECT_EQ(match.begin(game).now(), 0.0) << "the next one begins anew";
}

TEST(ABegunMatch, IsFoundAsTheNewestRecordOfItsFolder) {
  const test::TemporaryFolder folder("begun");
  using Clock = std::filesystem::file_time_type::clock;
  EXPECT_FALSE(newest_record(folder.path()));
  EXPECT_FALSE(newest_record(folder / "none"));
  const auto now = Clock::now();
  for (const auto& [name, age_s] :
       {std::pair{"match-1.keys", 5}, {"match-2.keys", 9}, {"match-3.txt", 1}, {"other.keys", 1}}) {
    std::ofstream(folder / name) << name;
    std::filesystem::last_write_time(folder / name, now - std::chrono::seconds(age_s));
  }
  EXPECT_EQ(newest_record(folder.path()), folder / "match-1.keys");
  EXPECT_FALSE(newest_record(folder.path(), now - std::chrono::seconds(3)));
}

}  // namespace
}  // namespace rink::game
