// What players do live, at instants where other things happen too, and its log give the same game:
// nothing depends on when an input was handed in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "game/control/game.h"
#include "game/control/playing.h"
#include "game/model/random_stream.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// All that moves, as at its last event: time, place, velocity and law.
std::vector<double> states(const Game& game) {
  std::vector<double> all;
  for (const Entity& entity : game.entities()) {
    const physics::Motion motion = game.world().motion(entity.id);
    for (const auto& pair : {motion.position, motion.velocity, motion.acceleration, motion.drag})
      all.insert(all.end(), {pair.x(), pair.y()});
    all.push_back(motion.time);
  }
  return all;
}

/// The same scene again, in one go.
Game played_again(const Scene& scene, const std::vector<InputEvent>& log, double until) {
  Game game(scene);
  for (const InputEvent& event : log) game.submit(event);
  game.advance(until);
  return game;
}

Scene two_bats_that_touch() {
  return small_scene(
      "[drag]\nbats = 3.0\n"
      "[[bat]]\nname = \"a\"\nposition = [1.0, 1.0]\nhalf_extent = [0.125, 0.125]\nmass = "
      "3.0\nthrust = 5.0\n"
      "[[bat]]\nname = \"b\"\nposition = [1.25, 1.0625]\nhalf_extent = [0.125, 0.125]\nmass = "
      "7.0\nthrust = 5.0\n");
}

TEST(SameInstant, IsOverOnceItsInputsHaveBeenPlayed) {
  const Scene scene = two_bats_that_touch();
  Game game(scene);
  game.advance(0.5);
  EXPECT_EQ(game.submit({0.5, 0, InputKind::key_down, Key::right}).time, 0.5);
  game.advance(0.5);  // the key presses the first bat to the second
  const InputEvent late = game.submit({0.5, 1, InputKind::key_down, Key::up}),
                   later = game.submit({0.5, 0, InputKind::key_up, Key::right});
  EXPECT_EQ(late.time, std::nextafter(0.5, infinity));
  EXPECT_EQ(later.time, late.time);
  game.advance(0.5);
  EXPECT_EQ(game.input_count(1), 0u);
  game.advance(1.0);
  EXPECT_EQ(game.input_count(1), 1u);
  const std::vector<InputEvent> log{{0.5, 0, InputKind::key_down, Key::right}, late, later};
  EXPECT_EQ(states(game), states(played_again(scene, log, 1.0)));
}

TEST(SameInstant, IsOverOnceAPuckCameBackAtIt) {
  // 1.0 m at 2.0 m/s to the goal line; the face-off follows 1.0 s later.
  const Scene scene = small_scene(
      "[[puck]]\nposition = [1.0, 1.0]\nvelocity = [-2.0, 0.0]\n[[bat]]\nname = \"b\"\nposition = "
      "[2.0, 1.0]\nhalf_extent = [0.125, 0.125]\n");
  Game game(scene);
  game.advance(0.5 + scene.rules.face_off_delay);
  EXPECT_EQ(game.score().right, 1u);
  EXPECT_GT(game.submit({game.now(), 0, InputKind::key_down, Key::right}).time, game.now());
}

/// 45 bats that fill half of their field, so that they press each other nearly always, and 5 pucks.
Scene throng(std::uint64_t seed) {
  RandomStream random(seed);
  std::string text =
      "[drag]\nbats = 3.0\npucks = 0.25\n[materials]\nnames = [\"all\"]\nrestitution = 0.2\n";
  for (int k = 0; k < 50; ++k) {
    const double x = 0.2 + 0.4 * (k % 10) + random.uniform(-0.04, 0.04),
                 y = 0.2 + 0.4 * (k / 10) + random.uniform(-0.04, 0.04);
    const std::string position =
        "position = [" + std::to_string(x) + ", " + std::to_string(y) + "]\n";
    text += k % 10 == 5 ? "[[puck]]\n" + position
                        : "[[bat]]\nname = \"b" + std::to_string(k) + "\"\n" + position +
                              "half_extent = [0.15, 0.15]\nmass = 5.0\nthrust = 4.9\n";
  }
  return small_scene(text);
}

/// Everybody presses live: several at one instant, some of them after the game was asked to go on
/// to where it is already.
void play_live_and_again(std::uint64_t seed, double duration, std::uint64_t& late) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  RandomStream random(seed);
  const Scene scene = throng(seed);
  Game game(scene);
  std::vector<InputEvent> log;
  for (double now = 0.0; now < duration; now = std::min(duration, now + random.uniform(0.0, 0.1))) {
    game.advance(now);
    // Neighbours, for what one's key brings about at the instant must concern the next one.
    const std::uint32_t first = random.below(game.player_count()), pressed = random.below(6);
    for (std::uint32_t k = 0; k < pressed; ++k) {
      const auto kind = random.below(3) == 0 ? InputKind::key_up : InputKind::key_down;
      const auto key = static_cast<Key>(random.below(4));
      log.push_back(game.submit({now, (first + k) % game.player_count(), kind, key}));
      late += log.back().time > now;
      if (random.below(2) == 0) game.advance(now);
    }
  }
  game.advance(duration);
  std::stable_sort(log.begin(), log.end(),
                   [](const InputEvent& a, const InputEvent& b) { return a.time < b.time; });
  const Game again = played_again(scene, log, duration);
  EXPECT_EQ(again.hash(), game.hash());
  EXPECT_EQ(states(again), states(game));
}

TEST(SameInstant, PressedLiveIsPlayedFromTheLogTwentyTimes) {
  std::uint64_t late = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) play_live_and_again(seed, 1.5, late);
  EXPECT_GT(late, 20u);
}

TEST(SameInstantLong, PressedLiveIsPlayedFromTheLogThousandTimes) {
  std::uint64_t late = 0;
  for (std::uint64_t seed = 101; seed <= 1100; ++seed) play_live_and_again(seed, 1.5, late);
  EXPECT_GT(late, 1000u);
}

TEST(SameInstant, PlayersWhoDecideAtOnceInAThrongGiveALogThatIsTheirGame) {
  Playing playing(throng(5), {"chaser", "random"}, 1, 1.0);
  playing.advance(1.0);
  const Game again = played_again(throng(5), playing.keys(), 1.0);
  EXPECT_EQ(again.hash(), playing.game().hash());
  EXPECT_EQ(states(again), states(playing.game()));
}

}  // namespace
}  // namespace rink::game
