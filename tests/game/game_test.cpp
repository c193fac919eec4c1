// The game as players know it: keys move bats, goals count, pucks come back, and nothing depends on
// how often anybody looks.
#include "game/control/game.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/model/random_stream.h"
#include "game/model/scene_file.h"
#include "game/physics/subdomain.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

/// Keys of all players of `scene` at random instants until `duration` [s], about four per second
/// and player.
std::vector<InputEvent> random_keys(const Scene& scene, std::uint64_t seed, double duration) {
  RandomStream random(seed);
  const auto players = static_cast<std::uint32_t>(scene.bodies.bats.size());
  std::vector<InputEvent> keys(static_cast<std::size_t>(4.0 * duration * players));
  for (InputEvent& event : keys)
    event = {random.uniform(0.0, duration), random.below(players),
             random.below(2) == 0 ? InputKind::key_down : InputKind::key_up,
             static_cast<Key>(random.below(4))};
  std::sort(keys.begin(), keys.end(),
            [](const InputEvent& a, const InputEvent& b) { return a.time < b.time; });
  return keys;
}

void submit_all(Game& game, const std::vector<InputEvent>& events) {
  for (const InputEvent& event : events) game.submit(event);
}

std::uint64_t hash_after(const Scene& scene, const std::vector<InputEvent>& keys, double until) {
  Game game(scene);
  submit_all(game, keys);
  game.advance(until);
  game.check();
  return game.hash();
}

const char* const puck_into_left_goal = R"([[puck]]
position = [1.0, 1.0]
velocity = [-2.0, 0.0]
)";

TEST(Game, MovesABatUnderAKeyAsTheClosedFormSays) {
  // From rest under thrust a and drag g: v = (a/g)(1 - e), x = (a/g)(t - (1 - e)/g) with e = exp(-g
  // t).
  const Scene scene = small_scene(
      "[drag]\nbats = 1.5\n[[bat]]\nname = \"b\"\nposition = [1.0, 1.0]\nhalf_extent = [0.05, "
      "0.1]\nthrust = 2.0\n");
  Game game(scene);
  game.submit({0.25, 0, InputKind::key_down, Key::right});
  game.advance(1.25);
  const double e = std::exp(-1.5), a = 2.0, g = 1.5;
  EXPECT_NEAR(game.position(*game.bat(0)).x(), 1.0 + a / g * (1.0 - (1.0 - e) / g), 1e-14);
  EXPECT_NEAR(game.velocity(*game.bat(0)).x(), a / g * (1.0 - e), 1e-14);
  EXPECT_EQ(game.position(*game.bat(0)).y(), 1.0);
}

TEST(Game, PushesABatDiagonallyUnderTwoKeysAndNotAtAllUnderOpposedOnes) {
  BatController controller(3.0);
  controller.press(Key::left, true);
  controller.press(Key::up, true);
  EXPECT_EQ(controller.thrust(), Vector2(-3.0, 3.0));
  controller.press(Key::right, true);
  EXPECT_EQ(controller.thrust(), Vector2(0.0, 3.0));
  controller.press(Key::left, false);
  EXPECT_EQ(controller.thrust(), Vector2(3.0, 3.0));
  EXPECT_EQ(controller.input_count(), 4u);
}

TEST(Game, PlaysScriptedKeysAsIfTheyHadBeenSubmitted) {
  Scene scene = small_crowd(6, 3);
  const std::vector<InputEvent> keys = random_keys(scene, 11, 3.0);
  const std::uint64_t submitted = hash_after(scene, keys, 3.0);
  scene.keys = keys;
  EXPECT_EQ(hash_after(scene, {}, 3.0), submitted);
}

TEST(Game, DoesNotDependOnHowItsTimeIsSliced) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const Scene scene = small_crowd(10, seed);
    std::vector<InputEvent> keys = random_keys(scene, seed, 4.0);
    keys.push_back({1.0, 3, InputKind::leave});
    keys.push_back({2.0, 3, InputKind::enter});
    const std::uint64_t whole = hash_after(scene, keys, 4.0);
    for (const double rate : {30.0, 60.0}) {
      Game game(scene);
      submit_all(game, keys);
      for (int tick = 1; tick <= static_cast<int>(4.0 * rate); ++tick) game.advance(tick / rate);
      EXPECT_EQ(game.hash(), whole) << rate;
    }
    Game game(scene);
    submit_all(game, keys);
    RandomStream random(seed);
    while (game.now() < 4.0) {
      game.advance(std::min(4.0, game.now() + random.uniform(0.0, 0.05)));
      for (const Entity& entity : game.entities()) static_cast<void>(game.position(entity.id));
    }
    EXPECT_EQ(game.hash(), whole);
  }
}

TEST(Game, PlaysARecordedLogToTheSameHash) {
  const Scene scene = small_crowd(8, 5);
  KeyLog log = key_log_for(scene);
  log.events = random_keys(scene, 6, 3.0);
  std::stringstream file;
  write_key_log(file, log);
  EXPECT_EQ(hash_after(scene, read_key_log(file, "log").events, 3.0),
            hash_after(scene, log.events, 3.0));
}

TEST(Game, LetsTwoGamesRunInOneProcess) {
  const Scene scene = small_crowd(5, 1), other = small_crowd(7, 2);
  const auto keys = random_keys(scene, 1, 2.0), other_keys = random_keys(other, 2, 2.0);
  Game a(scene), b(other);
  submit_all(a, keys);
  submit_all(b, other_keys);
  for (int tick = 1; tick <= 40; ++tick) a.advance(tick * 0.05), b.advance(tick * 0.05);
  EXPECT_EQ(a.hash(), hash_after(scene, keys, 2.0));
  EXPECT_EQ(b.hash(), hash_after(other, other_keys, 2.0));
  EXPECT_NE(a.hash(), b.hash());
}

TEST(Game, AppliesTheInputsOfOneInstantByPlayerThenBySubmission) {
  const Scene scene = small_crowd(3, 1);
  Game game(scene), shuffled(scene);
  submit_all(game, {{1.0, 0, InputKind::key_down, Key::up},
                    {1.0, 1, InputKind::key_down, Key::left},
                    {1.0, 1, InputKind::key_up, Key::left}});
  submit_all(shuffled, {{1.0, 1, InputKind::key_down, Key::left},
                        {1.0, 1, InputKind::key_up, Key::left},
                        {1.0, 0, InputKind::key_down, Key::up}});
  game.advance(2.0);
  shuffled.advance(2.0);
  EXPECT_FALSE(game.keys_held(1).is_down(Key::left));
  EXPECT_EQ(game.input_count(1), 2u);
  EXPECT_EQ(game.hash(), shuffled.hash());
}

TEST(Game, FeelsAKeyAtItsInstantAndNotBefore) {
  Game game(small_crowd(2, 1));
  game.submit({0.5, 1, InputKind::key_down, Key::down});
  game.advance(std::nextafter(0.5, 0.0));
  EXPECT_EQ(game.input_count(1), 0u);
  game.advance(0.5);
  EXPECT_EQ(game.input_count(1), 1u);
  EXPECT_TRUE(game.keys_held(1).is_down(Key::down));
}

TEST(Match, CountsAGoalAtTheInstantThePuckCrossesTheLine) {
  Game game(small_scene(puck_into_left_goal));
  game.advance(1.0);
  ASSERT_EQ(game.scored().size(), 1u);
  EXPECT_NEAR(game.scored()[0].time, 0.5, 1e-15);
  EXPECT_EQ(game.scored()[0].team, Team::right);
  EXPECT_EQ(game.score(), (Score{0, 1}));
  game.advance(1.0);
  EXPECT_TRUE(game.scored().empty());
}

TEST(Match, PutsThePuckBackOnTheConcedingSidesSpotAfterTheDelay) {
  Game game(small_scene(std::string("[match]\nface_off_delay = 0.75\nface_off_distance = 0.25\n") +
                        puck_into_left_goal));
  const EntityId puck = game.entities().front().id;
  game.advance(1.24);
  EXPECT_FALSE(game.world().is_in_play(puck));
  game.advance(1.26);
  EXPECT_TRUE(game.world().is_in_play(puck));
  EXPECT_EQ(game.position(puck), Vector2(1.0, 1.0));
  EXPECT_EQ(game.velocity(puck), Vector2(0.0, 0.0));
}

TEST(Match, PutsThePuckBesideASpotThatIsTaken) {
  Game game(small_scene(std::string(puck_into_left_goal) +
                        "[[post]]\nposition = [1.0, 1.3]\nradius = 0.1\n[[bat]]\nposition = [1.0, "
                        "0.5]\nhalf_extent = [0.2, 0.05]\nthrust = 4.0\n"));
  const EntityId puck = game.entities().back().id;
  game.submit({0.6, 0, InputKind::key_down, Key::up});
  game.submit({1.1, 0, InputKind::key_up,
               Key::up});  // by the face-off at 1.5 s the bat has gone from 0.5 to 0.5 + 0.5 + 0.8
                           // m and lies over neither spot nor post
  game.advance(1.5);
  EXPECT_TRUE(game.world().is_in_play(puck));
  EXPECT_EQ(game.world().max_overlap(), 0.0);
  EXPECT_LT((game.position(puck) - Vector2(1.0, 1.0)).norm(), 0.6);
}

/// One puck that starts between the ends and is shot into the left goal again and again by a bat
/// behind the face-off spot.
Scene endless_shots(const std::string& rules) {
  return small_scene(rules +
                     "[[puck]]\nposition = [1.0, 1.0]\nvelocity = [-2.0, 0.0]\n[[bat]]\nposition = "
                     "[1.5, 1.0]\nhalf_extent = [0.05, 0.2]\nthrust = 4.0\nmass = 1000.0\n");
}

TEST(Match, IsOverAtTheFifthGoalAndGoalsCountNoMore) {
  Game game(pucks_into_left_goal(7, "[match]\ngoals_to_win = 5\nface_off_delay = 10.0\n"));
  game.advance(0.25 + 0.15 * 3 + 0.01);
  EXPECT_EQ(game.score(), (Score{0, 4}));
  EXPECT_FALSE(game.is_over());
  game.advance(3.0);
  EXPECT_EQ(game.score(), (Score{0, 5}));
  EXPECT_TRUE(game.is_over());
}

TEST(Match, GoesOnForEverInACrowd) {
  const Scene scene = endless_shots("[match]\nface_off_delay = 0.1\n");
  Game game(scene);
  game.submit({0.6, 0, InputKind::key_down, Key::left});
  game.submit({0.9, 0, InputKind::key_up, Key::left});
  game.advance(4.0);
  EXPECT_GE(game.score().right, 2u);
  EXPECT_FALSE(game.is_over());
}

TEST(Game, TakesALeavingBatAwayAndPutsAReturningOneBackAtHome) {
  const Scene scene = preset("match");
  Game game(scene);
  const EntityId first = *game.bat(1);
  game.submit({0.2, 1, InputKind::key_down, Key::up});
  game.submit({0.4, 1, InputKind::leave});
  game.submit({0.5, 1, InputKind::key_down, Key::down});
  game.advance(0.6);
  EXPECT_FALSE(game.bat(1));
  EXPECT_FALSE(game.is_there(first));
  EXPECT_TRUE(game.world().is_removed(first));
  ASSERT_EQ(game.removed().size(), 1u);
  EXPECT_EQ(game.removed()[0].id, first);
  EXPECT_EQ(game.keys_held(1), KeysHeld{});
  EXPECT_EQ(game.input_count(1), 1u) << "a key for a bat that is not there is not felt";
  game.submit({0.7, 1, InputKind::enter});
  game.advance(0.7);
  ASSERT_EQ(game.spawned().size(), 1u);
  EXPECT_EQ(game.spawned()[0].id, *game.bat(1));
  EXPECT_EQ(game.spawned()[0].player, 1u);
  EXPECT_EQ(game.entity(*game.bat(1)).team, Team::right);
  EXPECT_NE(*game.bat(1), first);
  EXPECT_EQ(game.position(*game.bat(1)), scene.bodies.bats[1].body.position);
}

TEST(Game, EntersAtTheNearestFreePlaceWhenHomeIsTaken) {
  Game game(
      small_scene("[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.1, 0.1]\n[[bat]]\nposition = "
                  "[1.5, 1.0]\nhalf_extent = [0.1, 0.1]\nthrust = 4.0\n"));
  submit_all(game, {{0.0, 0, InputKind::leave},
                    {0.0, 1, InputKind::key_down, Key::left},
                    {0.5, 1, InputKind::leave}});
  game.advance(0.4);
  game.submit({0.45, 0, InputKind::enter});
  game.advance(0.45);
  ASSERT_TRUE(game.bat(0));
  EXPECT_EQ(game.world().max_overlap(), 0.0);
  EXPECT_GT((game.position(*game.bat(0)) - Vector2(1.0, 1.0)).norm(), 0.0);
  EXPECT_LT((game.position(*game.bat(0)) - Vector2(1.0, 1.0)).norm(), 0.3);
}

TEST(Preset, RunsUnderRandomKeysWithoutOverlapOrEscape) {
  for (const char* name : {"match", "crowd"}) {
    SCOPED_TRACE(name);
    const Scene scene = preset(name);
    Game game(scene);
    submit_all(game, random_keys(scene, 1, 5.0));
    game.advance(5.0);
    EXPECT_LE(game.world().max_overlap(), 1e-9);
    EXPECT_EQ(game.entities().size(),
              scene.bodies.pucks.size() + scene.bodies.bats.size() + scene.bodies.posts.size());
  }
}

TEST(Preset, OfTheMatchIsThePapersRink) {
  const Scene scene = preset("match");
  EXPECT_EQ(scene.bodies.bats.size(), 2u);
  EXPECT_EQ(scene.bodies.pucks.size(), 1u);
  EXPECT_EQ(scene.rules.goals_to_win, 5u);
  EXPECT_GT(scene.world.field.goal_width, 0.0);
  EXPECT_TRUE(scene.world.field.bats_keep_to_half);
  ASSERT_EQ(scene.bodies.posts.size(), 2u);
  EXPECT_LT(scene.bodies.posts[0].body.position.x(), scene.world.field.length / 2);
  EXPECT_GT(scene.bodies.posts[1].body.position.x(), scene.world.field.length / 2);
}

TEST(Preset, OfTheCrowdHasTheDensityOfTheTargets) {
  const Scene scene = preset("crowd");
  EXPECT_DOUBLE_EQ(scene.world.field.length * scene.world.field.width, 200.0);
  EXPECT_EQ(scene.bodies.pucks.size(), 1000u);
  EXPECT_EQ(scene.bodies.bats.size(), 100u);
  EXPECT_GT(scene.bodies.posts.size(), 0u);
  EXPECT_FALSE(scene.rules.goals_to_win);
}

/// A key of the very instant at which a game ends belongs to it.
TEST(Records, KeepAllThatWasFeltUpToTheirEndAndNothingThatWasNot) {
  const Scene scene = preset("match");
  Game game(scene);
  std::vector<InputEvent> keys;
  for (const InputEvent& key : {InputEvent{0.25, 0, InputKind::key_down, Key::up},
                                InputEvent{0.5, 1, InputKind::key_down, Key::left},
                                InputEvent{0.75, 0, InputKind::key_up, Key::up}})
    keys.push_back(game.submit(key));
  game.advance(0.5);
  const KeyLog log = log_of(game, scene, "text", keys);
  EXPECT_EQ(log.until, 0.5);
  ASSERT_EQ(log.events.size(), 2u);
  EXPECT_EQ(log.events[1], keys[1]);
}

/// A node shows what other nodes have played: what has changed since the last look is all it needs.
TEST(AShownGame, IsThatOfWhoPlaysItBitForBit) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Scene scene = with_seed(load_scene("arena"), seed);
    const std::vector<InputEvent> keys = random_keys(scene, seed, 2.0);
    Game played(scene), shown(scene);
    submit_all(played, keys);
    physics::ChangeCursor cursor;
    std::size_t next = 0, told = 0;
    for (int tick = 1; tick <= 60; ++tick) {
      const double until = tick / 30.0;
      played.advance(until);
      std::vector<Game::ShownBody> bodies;
      for (const EntityId id : played.world().changed(cursor))
        bodies.push_back({id, physics::Subdomain::state_in(played.world(), id.index)});
      std::vector<InputEvent> felt;
      for (; next < keys.size() && keys[next].time <= until; ++next) felt.push_back(keys[next]);
      shown.show(until, bodies, felt, {});
      told += bodies.size();
      ASSERT_EQ(shown.hash(), played.hash()) << "seed " << seed << ", tick " << tick;
      ASSERT_EQ(shown.now(), played.now());
      for (const Entity& entity : played.entities()) {
        ASSERT_EQ(shown.position(entity.id), played.position(entity.id)) << entity.id.index;
        ASSERT_EQ(shown.world().is_resting(entity.id), played.world().is_resting(entity.id));
      }
    }
    EXPECT_GT(told, played.entities().size()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace rink::game
