// The network grid: whoever has changed is on it at its instants, nobody is put into anybody, and a
// game on it depends on scene and keys alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/game_state.h"
#include "game/control/replay.h"
#include "game/physics/rounding/motion_grid.h"
#include "game/physics/subdomain.h"
#include "game/players/random_plan.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

using physics::MotionGrid;
using ::testing::AllOf;
using ::testing::HasSubstr;

Scene crowd_on_grid(std::uint64_t seed, double rate_hz = 20.0) {
  Scene scene = small_crowd(12, seed);
  scene.network_grid = rate_hz;
  return scene;
}

Game with_keys(const Scene& scene, double seconds) {
  Game game(scene);
  for (const InputEvent& event : random_plan(7, game.player_count(), seconds)) game.submit(event);
  return game;
}

bool is_multiple(double value, double step) { return std::remainder(value, step) == 0.0; }

TEST(NetworkGrid, WhoeverHasChangedIsOnItAndWhoHasNotIsAsItWas) {
  Game game = with_keys(crowd_on_grid(1), 10.0);
  std::uint64_t put = 0, unchanged = 0, left_off = 0;
  std::vector<physics::BodyState> before;
  for (int instant = 1; instant <= 200; ++instant) {
    const double now = instant / 20.0;
    game.advance(now);
    left_off += game.network_grid().left_off().size();
    for (const Entity& entity : game.entities()) {
      const physics::BodyState body = physics::Subdomain::state_in(game.world(), entity.id.index);
      const physics::Flight& f = body.flight;
      const bool was_put = f.time == now;
      if (!was_put && instant > 1 && f.time <= now - 1.0 / 20.0) {
        const physics::Flight& old = before[entity.id.index].flight;
        EXPECT_TRUE(f.x == old.x && f.y == old.y && f.vx == old.vx && f.vy == old.vy);
        ++unchanged;
      }
      if (!was_put || body.flags != 0 || body.mouth != 0) continue;
      EXPECT_TRUE(is_multiple(f.x, MotionGrid::position_step) &&
                  is_multiple(f.y, MotionGrid::position_step) &&
                  is_multiple(f.vx, MotionGrid::velocity_step) &&
                  is_multiple(f.vy, MotionGrid::velocity_step))
          << "body " << entity.id.index << " at " << now;
      ++put;
    }
    before.clear();
    for (std::uint32_t body = 0; body < game.world().body_count(); ++body)
      before.push_back(physics::Subdomain::state_in(game.world(), body));
    EXPECT_LE(game.world().max_overlap(), 1e-12) << "at " << now;
  }
  EXPECT_GT(put, 1000u);
  EXPECT_GT(unchanged, 5000u);
  RecordProperty("left_off", std::to_string(left_off));
}

TEST(NetworkGrid, GameDoesNotDependOnWhereAdvanceStopsNorOnBudgets) {
  const Scene scene = crowd_on_grid(2);
  Game whole = with_keys(scene, 6.0), parts = with_keys(scene, 6.0), cut = with_keys(scene, 6.0);
  whole.advance(6.0);
  for (int stop = 1; stop <= 600; ++stop) parts.advance(0.01 * stop);
  physics::EventBudget budget(3);
  int stops = 0;
  for (; !cut.advance(6.0, budget); ++stops) budget.grant(3);
  EXPECT_GT(stops, 50);
  EXPECT_EQ(parts.hash(), whole.hash());
  EXPECT_EQ(cut.hash(), whole.hash());
  Scene without = scene;
  without.network_grid = 0.0;
  Game other = with_keys(without, 6.0);
  other.advance(6.0);
  EXPECT_NE(other.hash(), whole.hash());
}

/// Keys of an instant come after its rounding, whether they were known before or not.
TEST(NetworkGrid, KeyOfAnInstantOfTheGridMayComeLate) {
  const Scene scene = crowd_on_grid(3);
  const InputEvent key{.time = 1.0, .player = 2, .kind = InputKind::key_down, .key = Key::up};
  Game early(scene), late(scene);
  early.submit(key);
  late.advance(1.0);
  late.submit(key);
  early.advance(3.0), late.advance(3.0);
  EXPECT_EQ(early.hash(), late.hash());
}

TEST(NetworkGrid, SavedCopiedAndRecordedGamesGoOnAlike) {
  const Scene scene = crowd_on_grid(4);
  for (const double saved_s : {2.0, 2.02}) {
    Game game = with_keys(scene, 5.0);
    game.advance(saved_s);
    Game saved = game_in_state(GameState::save(game, scene), scene, "saved"), copy = game.copy();
    for (Game* const each : {&game, &saved, &copy}) each->advance(5.0);
    EXPECT_EQ(saved.hash(), game.hash()) << saved_s;
    EXPECT_EQ(copy.hash(), game.hash()) << saved_s;
  }
  Game game = with_keys(scene, 5.0);
  game.advance(5.0);
  const KeyLog log = log_of(game, scene, "", random_plan(7, game.player_count(), 5.0));
  EXPECT_EQ(replay(log, scene), *log.hash);
  Scene without = scene;
  without.network_grid = 0.0;
  EXPECT_THAT(refusal_of([&] { require_fit(log, without, "game.keys"); }),
              HasSubstr("was recorded in another scene"));
}

/// A bat pressed to a wall, and a row of pucks that it pushed there.
TEST(NetworkGrid, WhatRestsStaysAtRest) {
  Scene scene = small_scene(
      "[materials]\nnames = [\"plain\"]\nrestitution = 0.1\n[drag]\npucks = 0.5\nbats = 3.0\n"
      "[[bat]]\nname = \"left\"\nposition = [0.4, 0.3]\nhalf_extent = [0.03, 0.1]\n"
      "[[puck]]\nposition = [0.2, 0.3]\n[[puck]]\nposition = [0.1, 0.3]\n"
      "[[key]]\ntime = 0.1\nbat = \"left\"\nkey = \"left\"\nis_down = true\n");
  scene.network_grid = 60.0;
  Game game(scene);
  game.advance(20.0);
  std::vector<Vector2> places;
  for (const Entity& entity : game.entities()) places.push_back(game.position(entity.id));
  const std::uint64_t events = game.world().counters().recordable();
  game.advance(60.0);
  for (std::size_t k = 0; k < places.size(); ++k)
    EXPECT_EQ(game.position(game.entities()[k].id), places[k]) << k;
  EXPECT_EQ(game.world().counters().recordable(), events) << "nothing happens in a pile at rest";
  EXPECT_LE(game.world().max_overlap(), 1e-12);
}

TEST(NetworkGrid, SceneSaysHowOftenAndNothingElse) {
  EXPECT_EQ(
      parse_scene("network_grid = 20\n[field]\nlength = 4\nwidth = 2\n", "s.toml").network_grid,
      20.0);
  EXPECT_EQ(preset("crowd").network_grid, 0.0);
  for (const std::string value : {"-1", "1001", "nan", "true"})
    EXPECT_THAT(refusal_of([&] {
                  parse_scene("\nnetwork_grid = " + value + "\n[field]\nlength = 4\nwidth = 2\n",
                              "s.toml");
                }),
                AllOf(HasSubstr("s.toml:2"), HasSubstr("network_grid is " + value),
                      HasSubstr("from 0 to 1000")));
  Scene scene = preset("crowd"), grid = preset("crowd-grid");
  EXPECT_EQ(grid.network_grid, 20.0);
  EXPECT_NE(fingerprint(grid), fingerprint(scene));
  grid.network_grid = 0.0;
  EXPECT_EQ(fingerprint(grid), fingerprint(scene)) << "the two scenes differ in nothing else";
}

TEST(NetworkGrid, InstantsAreFoundThoughAClockIsOffByRoundings) {
  const GridInstants grid{60.0};
  for (std::uint64_t number = 1; number < 100'000; number += 7) {
    const double instant = grid.at(number);
    EXPECT_EQ(grid.last(instant), number);
    EXPECT_EQ(grid.last(std::nextafter(instant, 0.0)), number - 1);
    EXPECT_EQ(grid.snapped(static_cast<double>(number) * (1.0 / 60.0)), instant);
    EXPECT_EQ(grid.snapped(instant + 1e-6), instant + 1e-6);
  }
  EXPECT_EQ(GridInstants{}.snapped(0.3), 0.3);
}

}  // namespace
}  // namespace rink::game
