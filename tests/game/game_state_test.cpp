// A game saved at an instant and restored is the game that was never interrupted, bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/game_state.h"
#include "game/physics/snapshot_stream.h"
#include "game/players/random_plan.h"
#include "tests/game/rink_scenes.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Halves {
  Game whole, second;
};

/// The game of `keys` in one go, and saved at `saved_s` with the keys up to then, restored, and
/// played on with the others.
Halves played(const Scene& scene, const std::vector<InputEvent>& keys, double saved_s,
              double until_s) {
  Game whole(scene), first(scene);
  for (const InputEvent& event : keys) {
    whole.submit(event);
    if (event.time <= saved_s) first.submit(event);
  }
  first.advance(saved_s);
  Game second = game_in_state(GameState::save(first, scene), scene, "saved");
  EXPECT_EQ(second.hash(), first.hash());
  EXPECT_EQ(second.now(), saved_s);
  for (const InputEvent& event : keys)
    if (event.time > saved_s) second.submit(event);
  whole.advance(until_s);
  second.advance(until_s);
  return {std::move(whole), std::move(second)};
}

void expect_same(const Halves& halves) {
  EXPECT_EQ(halves.second.hash(), halves.whole.hash());
  EXPECT_EQ(halves.second.score(), halves.whole.score());
  ASSERT_EQ(halves.second.entities().size(), halves.whole.entities().size());
  for (const Entity& entity : halves.whole.entities())
    EXPECT_EQ(halves.second.position(entity.id), halves.whole.position(entity.id));
  for (std::uint32_t player = 0; player < halves.whole.player_count(); ++player) {
    EXPECT_EQ(halves.second.keys_held(player), halves.whole.keys_held(player));
    EXPECT_EQ(halves.second.input_count(player), halves.whole.input_count(player));
  }
}

TEST(GameState, CrowdSavedAtTwentySecondsGoesOnAsTheOneThatWasNeverSaved) {
  const Scene scene = small_crowd(20, 3);
  expect_same(played(scene, random_plan(3, 20, 23.0), 20.0, 23.0));
}

/// Plays each part of a world in turn, and counts how often it was asked to.
class OneByOne final : public physics::Workers {
 public:
  std::uint32_t count() const override { return 3; }
  void run(void (*task)(void* context, std::uint32_t worker), void* context) override {
    for (std::uint32_t worker = 0; worker < count(); ++worker) task(context, worker);
    ++run_count;
  }
  int run_count = 0;
};

TEST(GameState, WorkersOfTheScenePlayTheRestoredGameWithTheSameBits) {
  Scene scene = small_scene(
      "[[population]]\nname = \"gas\"\nkind = \"puck\"\ncount = 2000\nradius = "
      "0.005\nmean_speed = 1.0\n");
  OneByOne workers;
  scene.world.slabs = physics::SlabPlan{
      .tile_cells = 8, .bodies_min = 0, .last_pass_max = 1.0, .workers = &workers, .shared_min = 0};
  Game whole(scene);
  whole.advance(0.1);
  Game second = game_in_state(GameState::save(whole, scene), scene, "saved");
  const int before = workers.run_count;
  second.advance(0.3);
  EXPECT_GT(workers.run_count, before);
  scene.world.slabs.reset();
  Game in_order = game_in_state(GameState::save(whole, scene), scene, "saved");
  in_order.advance(0.3);
  whole.advance(0.3);
  EXPECT_EQ(second.hash(), whole.hash());
  EXPECT_EQ(in_order.hash(), whole.hash());
}

TEST(GameState, PucksUnderFrictionAndDragAndThoseAtRestGoOn) {
  const Scene scene = small_scene(
      "[drag]\nbats = 3.0\npucks = 0.2\n[friction]\npucks = 0.8\n"
      "[[puck]]\nradius = 0.04\nmass = 1.0\nposition = [1.0, 1.0]\nvelocity = [2.0, "
      "0.5]\n[[puck]]\nradius = 0.04\nmass = 1.0\nposition = [2.0, 1.0]\n[[puck]]\nradius = "
      "0.04\nmass = 1.0\nposition = [3.0, 1.5]\nvelocity = [-1.0, 0.3]\n"
      "[[bat]]\nposition = [0.5, 1.0]\nhalf_extent = [0.05, 0.05]\nmass = 1.0\nthrust = 8.0\nteam "
      "= \"left\"\n[[bat]]\nposition = [3.5, 1.0]\nhalf_extent = [0.05, 0.05]\nmass = 1.0\nthrust "
      "= 8.0\nteam = \"right\"\n");
  const Halves halves = played(scene, random_plan(5, 2, 9.0), 6.0, 9.0);
  expect_same(halves);
}

/// A bat that a held key presses against the wall rests there, by a hold and not by having stopped.
TEST(GameState, BatPressedToTheWallStaysThereAndLeavesWhenItsKeyIsReleased) {
  const Scene scene = small_scene(
      "[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.05, 0.05]\nmass = 1.0\nthrust = 8.0\nteam "
      "= \"left\"\n");
  const std::vector<InputEvent> keys{
      {.time = 0.1, .player = 0, .kind = InputKind::key_down, .key = Key::up},
      {.time = 5.0, .player = 0, .kind = InputKind::key_up, .key = Key::up},
      {.time = 5.1, .player = 0, .kind = InputKind::key_down, .key = Key::down}};
  const Halves halves = played(scene, keys, 4.0, 5.5);
  expect_same(halves);
  EXPECT_LT(halves.second.position(*halves.second.bat(0)).y(), 1.9);
}

/// A puck that went into the goal at x = 0 before the save comes back after it: left conceded, so
/// its face-off is a quarter of the field from x = 0.
TEST(GameState, FaceOffThatIsPendingComesAtItsTime) {
  const Scene scene = small_scene(
      "[match]\nface_off_delay = 1.0\n[[puck]]\nradius = 0.04\nmass = 1.0\nposition = [1.0, "
      "1.0]\nvelocity = [-2.0, 0.0]\n[[bat]]\nposition = [3.0, 0.5]\nhalf_extent = [0.05, "
      "0.05]\nmass = 1.0\nthrust = 8.0\nteam = \"right\"\n");
  const Halves halves = played(scene, {}, 1.0, 2.0);
  expect_same(halves);
  EXPECT_EQ(halves.second.score().right, 1u);
  EXPECT_EQ(halves.second.position({1}), physics::Vector2(1.0, 1.0));
}

TEST(GameState, QueuedKeysAndBatsThatLeftAreSaved) {
  const Scene scene = small_scene(
      "[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.05, 0.05]\nmass = 1.0\nthrust = 8.0\nteam "
      "= \"left\"\n[[bat]]\nposition = [3.0, 1.0]\nhalf_extent = [0.05, 0.05]\nmass = 1.0\nthrust "
      "= 8.0\nteam = \"right\"\n");
  Game game(scene);
  game.submit({.time = 0.5, .player = 0, .kind = InputKind::leave});
  for (const double time : {1.5, 1.2, 1.7})
    game.submit({.time = time,
                 .player = 1,
                 .kind = time == 1.7 ? InputKind::key_up : InputKind::key_down,
                 .key = Key::left});
  game.submit({.time = 2.0, .player = 0, .kind = InputKind::enter});
  game.advance(1.0);
  Game again = game_in_state(GameState::save(game, scene), scene, "saved");
  EXPECT_FALSE(again.bat(0));
  game.advance(3.0);
  again.advance(3.0);
  EXPECT_TRUE(again.bat(0));
  EXPECT_EQ(again.hash(), game.hash());
}

/// The instant of the last keys is over: another key of it comes at the next.
TEST(GameState, KeyOfTheInstantOfTheSaveComesRightAfterIt) {
  const Scene scene = small_scene(
      "[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.05, 0.05]\nmass = 1.0\nthrust = 8.0\nteam "
      "= \"left\"\n");
  const InputEvent key{.time = 1.0, .player = 0, .kind = InputKind::key_down, .key = Key::left};
  Game game(scene);
  game.submit(key);
  game.advance(1.0);
  Game again = game_in_state(GameState::save(game, scene), scene, "saved");
  EXPECT_GT(again.submit(key).time, 1.0);
}

TEST(GameState, FileOfAnotherSceneVersionOrDamagedIsRefusedByName) {
  const Scene scene = small_crowd(5, 3);
  const test::TemporaryFolder folder("state");
  const std::filesystem::path file = folder.path() / "seed3.state";
  const auto refusal = [&](const std::vector<std::uint8_t>& bytes, const Scene& of) {
    write_game_state(file, bytes);
    return refusal_of([&] { game_in_state(read_game_state(file), of, file.string()); });
  };
  const std::vector<std::uint8_t> state = GameState::save(Game(scene), scene);
  EXPECT_EQ(refusal(state, scene), "(accepted)");
  EXPECT_THAT(refusal(state, small_crowd(5, 4)),
              AllOf(StartsWith(file.string()), HasSubstr("another scene")));
  std::vector<std::uint8_t> other = state;
  other[state.size() / 2] ^= 1;
  EXPECT_THAT(refusal(other, scene), AllOf(StartsWith(file.string()), HasSubstr("damaged")));
  EXPECT_THAT(refusal(std::vector<std::uint8_t>(state.begin(), state.end() - 9), scene),
              HasSubstr("damaged"));
  EXPECT_THAT(refusal({'k', 'e', 'y', 's', '1', '2', '3', '4', '5'}, scene),
              HasSubstr("no saved game"));
  other = state;
  other[8] = 1;  // the version follows the format's name
  std::uint64_t sum = physics::checksum(std::as_bytes(std::span(other).first(other.size() - 8)));
  for (std::size_t byte = 0; byte < 8; ++byte)
    other[other.size() - 8 + byte] = static_cast<std::uint8_t>(sum >> (8 * byte));
  EXPECT_THAT(refusal(other, scene), AllOf(StartsWith(file.string()), HasSubstr("version 1"),
                                           HasSubstr("expected version 2")));
  EXPECT_THAT(refusal_of([&] { read_game_state(folder.path() / "none.state"); }),
              HasSubstr("none.state: cannot be read"));
}

TEST(GameState, SaysWhyItCannotBeWritten) {
  const std::vector<std::uint8_t> bytes(10'000);
  EXPECT_EQ(refusal_of([&] { write_game_state("/dev/full", bytes); }),
            "/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(refusal_of([&] { write_game_state("/nowhere/at/all", bytes); }),
            "/nowhere/at/all: cannot be written: No such file or directory");
}

}  // namespace
}  // namespace rink::game
