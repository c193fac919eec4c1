// Pushes of a pointer or a stick: exact forces within the bat's thrust, of which keys are a special
// case, and which records keep.
#include "game/model/push.h"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "game/control/game.h"
#include "game/control/game_state.h"
#include "game/control/key_log_file.h"
#include "game/control/key_log_packed.h"
#include "game/control/replay.h"
#include "game/model/random_stream.h"
#include "game/model/time_grid.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

InputEvent push_at(double time, std::uint32_t player, int x, int y) {
  return {.time = time,
          .player = player,
          .kind = InputKind::push,
          .push = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)}};
}

/// As a hand at 60 Hz does, and keys between.
std::vector<InputEvent> random_pushes(std::uint64_t seed, std::uint32_t players, double duration) {
  RandomStream random(seed);
  std::vector<InputEvent> events;
  for (int frame = 1; frame / 60.0 < duration; ++frame)
    for (std::uint32_t player = 0; player < players; ++player) {
      const double time = next_on(key_grid, frame / 60.0 + 0.005 * player);
      if (random.below(20) == 0)
        events.push_back({time, player,
                          random.below(2) == 0 ? InputKind::key_down : InputKind::key_up,
                          static_cast<Key>(random.below(4))});
      else if (random.below(3) > 0)
        events.push_back(push_at(time, player, static_cast<int>(random.below(255)) - 127,
                                 static_cast<int>(random.below(255)) - 127));
    }
  return events;
}

Game played(const Scene& scene, const std::vector<InputEvent>& events, double until) {
  Game game(scene);
  for (const InputEvent& event : events) game.submit(event);
  game.advance(until);
  game.check();
  return game;
}

TEST(Push, MovesABatAsTheClosedFormSays) {
  // From rest under a share of the thrust, a, and drag g: v = (a/g)(1 - e), x = (a/g)(t - (1 -
  // e)/g), e = exp(-gt).
  const Scene scene = small_scene(
      "[drag]\nbats = 1.5\n[[bat]]\nname = \"b\"\nposition = [1.0, 1.0]\nhalf_extent = [0.05, "
      "0.1]\nthrust = 2.0\n");
  for (const auto& [x, y] : {std::pair(100, 0), {-31, 64}, {1, -1}, {127, -127}}) {
    const Game game = played(scene, {push_at(0.25, 0, x, y)}, 0.75);
    const double g = 1.5, t = 0.5, s = -std::expm1(-g * t) / g;
    const Vector2 a(2.0 * x / 127.0, 2.0 * y / 127.0);
    EXPECT_NEAR((game.position(*game.bat(0)) - Vector2(1.0, 1.0) - a * (t - s) / g).norm(), 0.0,
                1e-14);
    EXPECT_NEAR((game.velocity(*game.bat(0)) - a * s).norm(), 0.0, 1e-14);
    EXPECT_EQ(pushed(game, 0), (Push{static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)}));
  }
}

TEST(Push, OfTheWholeThrustIsAKeyBitForBit) {
  const Scene scene = preset("match");
  RandomStream random(5);
  std::vector<InputEvent> keys, pushes;
  std::array<KeysHeld, 2> held;
  for (double time = 0.1; time < 20.0; time += 0.05 * random.uniform()) {
    const std::uint32_t player = random.below(2);
    const Key key = static_cast<Key>(random.below(4));
    held[player].set(key, random.below(2) == 0);
    keys.push_back(
        {time, player, held[player].is_down(key) ? InputKind::key_down : InputKind::key_up, key});
    const Vector2 way = direction(held[player]);
    pushes.push_back(push_at(time, player, static_cast<int>(127.0 * way.x()),
                             static_cast<int>(127.0 * way.y())));
  }
  const Game by_keys = played(scene, keys, 20.0), by_pushes = played(scene, pushes, 20.0);
  EXPECT_EQ(by_keys.simulator().hash(), by_pushes.simulator().hash());
  EXPECT_EQ(by_keys.score(), by_pushes.score());
}

TEST(Push, AndKeysTogetherNeverExceedTheThrustOfAKey) {
  RandomStream random(6);
  for (int round = 0; round < 10'000; ++round) {
    const double thrust = random.uniform(0.0, 50.0);
    BatController controller(thrust);
    for (const Key key : all_keys) controller.press(key, random.below(2) == 0);
    const Vector2 keys = controller.thrust();
    const int x = static_cast<int>(random.below(255)) - 127,
              y = static_cast<int>(random.below(255)) - 127;
    controller.push({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)});
    EXPECT_LE(controller.thrust().cwiseAbs().maxCoeff(), thrust);
    controller.push({});
    EXPECT_EQ(controller.thrust(), keys);
    EXPECT_EQ(controller.input_count(), 6u);
    controller.push({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)});
    controller.release_all();
    EXPECT_EQ(controller.thrust(), Vector2(0.0, 0.0));
  }
}

TEST(Push, LeavesTheHashOfAGameOfKeysAsItWas) {
  BatController controller(8.0);
  controller.press(Key::up, true), controller.press(Key::left, true);
  EXPECT_EQ(controller.digest(), 5ull << 32 | 2);  // left is bit 0, up is bit 2
  controller.push({-1, 3});
  EXPECT_EQ(controller.digest(), 3ull << 48 | 0xffull << 40 | 5ull << 32 | 3);
}

TEST(Push, IsReplayedToTheSameHashFromRecordsOfBothForms) {
  const Scene scene = preset("match");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<InputEvent> events = random_pushes(seed, 2, 15.0);
    const Game game = played(scene, events, 15.0);
    const KeyLog log = log_of(game, scene, "", events);
    std::ostringstream text, packed;
    write_key_log(text, log);
    write_packed_key_log(packed, log);
    EXPECT_THAT(text.str(), testing::StartsWith("rink-keys 3\n"));
    EXPECT_THAT(packed.str(), testing::StartsWith("rink-keys 4\n"));
    EXPECT_LE(packed.str().size(), 300 + 6 * events.size());
    for (const std::string& bytes : {text.str(), packed.str()}) {
      std::istringstream stream(bytes);
      const KeyLog read = read_key_log(stream, "match.keys");
      EXPECT_EQ(read.events, log.events);
      EXPECT_EQ(replay(read, scene), *log.hash);
    }
    Replay again(log, scene);
    for (const double instant : {11.0, 3.0, 15.0}) again.seek(instant);
    EXPECT_EQ(again.is_as_recorded(), true);
  }
}

TEST(Push, GoesOnInASavedGame) {
  const Scene scene = preset("match");
  const std::vector<InputEvent> events = random_pushes(9, 2, 8.0);
  Game first = played(scene, events, 3.0);
  Game second = game_in_state(GameState::save(first, scene), scene, "saved");
  EXPECT_EQ(pushed(first, 0), pushed(second, 0));
  first.advance(8.0), second.advance(8.0);
  EXPECT_EQ(first.hash(), second.hash());
}

TEST(Push, OfARecordIsRefusedWhereItCannotBe) {
  const auto refusal = [](const std::string& text) {
    return refusal_of([&] {
      std::istringstream stream(text);
      read_key_log(stream, "bad.log");
    });
  };
  EXPECT_EQ(refusal("rink-keys 3\n1 0 push 5 -127\n2 0 down up\n"), "(accepted)");
  EXPECT_THAT(refusal("rink-keys 1\n1 0 push 5 5\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("down, up, enter or leave")))
      << "a log of the old version has none";
  EXPECT_THAT(refusal("rink-keys 3\n1 0 push 5\n"), HasSubstr("two numbers of steps"));
  EXPECT_THAT(refusal("rink-keys 3\n1 0 push 5 -128\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("-128"), HasSubstr("-127 to 127")));
  EXPECT_THAT(refusal("rink-keys 3\n1 0 push 5 x\n"), HasSubstr("whole number of steps"));
  EXPECT_THAT(refusal("rink-keys 3\n1 0 jump 5 5\n"), HasSubstr("leave or push"));
}

TEST(Push, OfAPackedRecordOfTheOldVersionIsNone) {
  KeyLog log;
  log.events = {push_at(0.5, 1, -3, 127)};
  std::ostringstream stream;
  write_packed_key_log(stream, log);
  std::string bytes = stream.str();
  ASSERT_EQ(bytes[10], '4');
  bytes[10] = '2';
  std::istringstream old(bytes);
  EXPECT_THAT(refusal_of([&] { read_key_log(old, "match.keys"); }),
              HasSubstr("has bytes after its last key"));
}

TEST(Push, IsRefusedByNameWhereKeysAloneArePlayed) {
  KeyLog log;
  log.events = {push_at(0.5, 1, 1, 1)};
  EXPECT_THAT(refusal_of([&] { require_keys_alone(log, "a.keys", "an experiment"); }),
              AllOf(HasSubstr("a.keys: "), HasSubstr("an experiment plays keys alone")));
  log.events.clear();
  EXPECT_EQ(refusal_of([&] { require_keys_alone(log, "a.keys", "an experiment"); }), "(accepted)");
}

}  // namespace
}  // namespace rink::game
