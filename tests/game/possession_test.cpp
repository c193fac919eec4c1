// The rule of possession: a puck that has stayed in one half for too long goes to the other side
// (docs/play.md, "Possession").
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/game_state.h"
#include "game/physics/snapshot_stream.h"
#include "game/players/random_plan.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

using physics::Half, physics::HalfStay;
using ::testing::HasSubstr;

constexpr EntityId first_puck{0};

/// One puck of 0.04 m in a field of 4 m x 2 m, the line at 2 m.
Scene with_puck(const std::string& puck, const std::string& possession,
                const std::string& more = "") {
  return small_scene("[match]\npossession_s = " + possession + "\nface_off_distance = 0.25\n" +
                     "[[puck]]\nradius = 0.04\n" + puck + more);
}

std::vector<ServedPuck> all_served(Game& game, double until, double step) {
  std::vector<ServedPuck> served;
  for (double now = step; now <= until; now += step) {
    game.advance(now);
    served.insert(served.end(), served_in(game).begin(), served_in(game).end());
  }
  return served;
}

TEST(Possession, PuckGoesToTheOtherSideWhenItsTimeIsOver) {
  Game game(with_puck("position = [1.5, 1.6]\n", "7.0"));
  EXPECT_EQ(stays_in(game), (std::vector<HalfStay>{{first_puck, Half::left, 7.0}}));
  game.advance(std::nextafter(7.0, 0.0));
  EXPECT_EQ(game.position(first_puck), Vector2(1.5, 1.6));
  game.advance(7.0);
  ASSERT_EQ(served_in(game).size(), 1u);
  EXPECT_EQ(served_in(game)[0].team, Team::right);
  EXPECT_EQ(served_in(game)[0].time, 7.0);
  EXPECT_EQ(game.position(first_puck), Vector2(3.0, 1.0)) << "the spot of face-offs";
  EXPECT_EQ(game.velocity(first_puck), Vector2(0.0, 0.0));
  EXPECT_EQ(stays_in(game), (std::vector<HalfStay>{{first_puck, Half::right, 14.0}}));
  game.advance(14.0);
  EXPECT_EQ(game.position(first_puck), Vector2(1.0, 1.0)) << "nobody shoots on that side either";
  EXPECT_EQ(game.score(), Score{});
}

/// 1 m to the line at 0.5 m/s takes 2 s, and the way back from the wall, by 1.96 m there and back,
/// 7.84 s.
TEST(Possession, ItsTimeBeginsAnewWithEachCrossing) {
  Game game(with_puck("position = [1.0, 1.6]\nvelocity = [0.5, 0.0]\n", "8.0"));
  game.advance(1.9);
  EXPECT_EQ(stays_in(game)[0].half, Half::left);
  game.advance(20.0);
  ASSERT_EQ(stays_in(game).size(), 1u);
  EXPECT_EQ(stays_in(game)[0].half, Half::right);
  EXPECT_NEAR(stays_in(game)[0].until, 2.0 + 2 * 7.84 + 8.0, 1e-12);
  EXPECT_TRUE(served_in(game).empty());
  Game hasty(with_puck("position = [1.0, 1.6]\nvelocity = [0.5, 0.0]\n", "7.8"));
  const std::vector<ServedPuck> served = all_served(hasty, 10.0, 0.5);
  ASSERT_EQ(served.size(), 1u);
  EXPECT_NEAR(served[0].time, 9.8, 1e-12);
}

TEST(Possession, PuckThatCrossesAtTheLastInstantHasCrossed) {
  for (const double possession : {1.999999, 2.0, 2.000001}) {
    Game game(
        with_puck("position = [1.0, 1.6]\nvelocity = [0.5, 0.0]\n", std::to_string(possession)));
    game.advance(3.0);
    EXPECT_EQ(served_in(game).size(), possession < 2.0 ? 1u : 0u) << possession;
  }
}

TEST(Possession, PuckThatRestsOnTheLineIsNobodys) {
  Game game(with_puck("position = [2.0, 1.6]\n", "1.0"));
  game.advance(50.0);
  EXPECT_TRUE(stays_in(game).empty());
  EXPECT_EQ(game.position(first_puck), Vector2(2.0, 1.6));
}

TEST(Possession, PucksHaveTimesOfTheirOwn) {
  Game game(with_puck("position = [1.0, 1.6]\n", "3.0",
                      "[[puck]]\nradius = 0.04\nposition = [1.9, 0.4]\nvelocity = [0.1, 0.0]\n"));
  EXPECT_EQ(all_served(game, 4.9, 0.7).size(), 2u) << "the first at 3.0 s and 4.0 + 3.0";
  game.advance(7.2);
  EXPECT_EQ(stays_in(game).size(), 2u);
}

/// A bat stands on the spot at which the puck is to be: it comes to the nearest free place.
TEST(Possession, PuckComesBesideABatThatStandsOnTheSpot) {
  Game game(with_puck("position = [1.0, 1.6]\n", "2.0",
                      "[[bat]]\nposition = [3.0, 1.0]\nhalf_extent = [0.05, 0.2]\n"));
  game.advance(2.0);
  ASSERT_EQ(served_in(game).size(), 1u);
  const Vector2 place = game.position({1});
  EXPECT_GE(std::abs(place.x() - 3.0), 0.09 - 1e-12);
  EXPECT_LE((place - Vector2(3.0, 1.0)).norm(), 0.15);
}

/// A bat nearly as large as the field leaves 0.16 m on its left, in which posts and a puck stand.
TEST(Possession, PuckThatHasNoPlaceStaysUntilThereIsOne) {
  std::string text =
      "[match]\npossession_s = 1.0\nface_off_distance = 0.25\n"
      "[[puck]]\nradius = 0.06\nposition = [0.08, 1.0]\n"
      "[[bat]]\nposition = [2.08, 1.0]\nhalf_extent = [1.92, 0.96]\n";
  for (const char* y : {"0.1", "0.35", "0.6", "0.81", "1.19", "1.4", "1.65", "1.9"})
    text += std::string("[[post]]\nradius = 0.07\nposition = [0.08, ") + y + "]\n";
  Game game(small_scene(text));
  constexpr EntityId puck{9};
  game.submit({1.25, 0, InputKind::leave});
  game.advance(1.26);
  EXPECT_TRUE(served_in(game).empty());
  EXPECT_EQ(game.position(puck), Vector2(0.08, 1.0));
  game.advance(1.31);
  ASSERT_EQ(served_in(game).size(), 1u);
  EXPECT_NEAR(served_in(game)[0].time, 1.3, 1e-12);
  EXPECT_EQ(game.position(puck), Vector2(3.0, 1.0));
}

TEST(Possession, ScoredPuckHasNoTimeUntilItIsBack) {
  Game game(with_puck("position = [0.5, 1.0]\nvelocity = [-2.0, 0.0]\n", "1.0"));
  game.advance(0.5);
  ASSERT_EQ(game.score(), (Score{0, 1}));
  EXPECT_TRUE(stays_in(game).empty());
  game.advance(1.5);
  ASSERT_EQ(stays_in(game).size(), 1u);
  EXPECT_NEAR(stays_in(game)[0].until, 0.25 + 1.0 + 1.0, 1e-12);
}

TEST(Possession, HasNoEffectOnceTheMatchIsOver) {
  Scene scene = pucks_into_left_goal(2, "[match]\ngoals_to_win = 1\npossession_s = 2.0\n");
  scene.placed.pucks[1].body.velocity = {0.0, 0.0};
  populate(scene);
  Game game(scene);
  game.advance(20.0);
  ASSERT_TRUE(game.is_over());
  EXPECT_TRUE(stays_in(game).empty());
  EXPECT_EQ(game.position({1}), Vector2(0.8, 1.0));
}

/// Two bats under random keys among two pucks and a post; pucks must not stay for a second.
Scene crowded(std::uint64_t seed) {
  Scene scene = preset("match");
  scene.rules.goals_to_win.reset();
  scene.rules.possession_s = 0.9;
  Puck second = scene.placed.pucks.front();
  second.name = "second", second.body.position = {1.9, 0.9};
  second.body.velocity = {0.4 + 0.01 * static_cast<double>(seed), -0.9};
  scene.placed.pucks.push_back(second);
  populate(scene);
  for (std::uint32_t player = 0; player < 2; ++player)
    for (const InputEvent& key : random_player_plan(seed, player, 60.0)) scene.keys.push_back(key);
  std::ranges::stable_sort(scene.keys, {}, &InputEvent::time);
  return scene;
}

/// Looks at where pucks are 2,048 times a second, and finds the instant of a change of sides by
/// halving the time on copies of the game.
class SampledPossession {
 public:
  SampledPossession(const Game& game, double line, double possession)
      : line_(line), possession_(possession) {
    for (const Entity& entity : game.entities())
      if (entity.kind == physics::BodyKind::puck) pucks_[entity.id] = {};
  }

  /// The game came from `before` here.
  void look(const Game& before, const Game& game) {
    for (const ScoredGoal& goal : game.scored()) pucks_[goal.puck].back = goal.time + 1.0;
    for (auto& [puck, seen] : pucks_) {
      const bool was_there = before.world().is_in_play(puck);
      if (!game.world().is_in_play(puck)) {
        seen.side = 0;
        continue;
      }
      const int side = side_of(game, puck);
      if (side == seen.side) continue;
      const auto served = std::ranges::find(served_in(game), puck, &ServedPuck::puck);
      if (served != served_in(game).end()) seen.since = served->time;
      else if (!was_there) seen.since = seen.back;
      else seen.since = seen.side != 0 ? crossing(before, game, puck, side) : before.now();
      seen.side = side;
    }
  }
  double due(EntityId puck) const { return pucks_.at(puck).since + possession_; }
  int side(EntityId puck) const { return pucks_.at(puck).side; }
  const auto& pucks() const { return pucks_; }

 private:
  struct Seen {
    int side = 0;
    double since = 0.0, back = 0.0;
  };
  int side_of(const Game& game, EntityId puck) const {
    const double off = game.position(puck).x() - line_;
    return (off > 0.0) - (off < 0.0);
  }
  double crossing(const Game& before, const Game& game, EntityId puck, int side) const {
    double low = before.now(), high = game.now();
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      Game there = before.copy();
      there.advance(middle);
      (side_of(there, puck) == side ? high : low) = middle;
    }
    return high;
  }

  double line_, possession_;
  std::map<EntityId, Seen> pucks_;
};

TEST(Possession, IsThatOfAGameThatIsSampled) {
  int serves = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Game game(crowded(seed));
    SampledPossession sampled(game, 1.2, 0.9);
    sampled.look(game, game);
    for (int k = 1; k <= 16 * 2048; ++k) {
      const Game before = game.copy();
      game.advance(k / 2048.0);
      for (const ServedPuck& served : served_in(game)) {
        EXPECT_NEAR(served.time, sampled.due(served.puck), 1e-9);
        EXPECT_EQ(served.team, sampled.side(served.puck) < 0 ? Team::right : Team::left);
        ++serves;
      }
      sampled.look(before, game);
      for (const auto& [puck, seen] : sampled.pucks())
        ASSERT_TRUE(seen.side == 0 || seen.since + 0.9 > game.now() - 1e-9) << "it was due";
    }
    EXPECT_FALSE(stays_in(game).empty());
  }
  EXPECT_GT(serves, 30);
}

TEST(Possession, IsTheSameHoweverFarTheGameIsPlayedAtATime) {
  for (const std::uint64_t seed : {4, 5}) {
    Game whole(crowded(seed)), ticks(crowded(seed)), fine(crowded(seed));
    whole.advance(30.0);
    for (int k = 1; k <= 30 * 60; ++k) ticks.advance(k / 60.0);
    for (int k = 1; k <= 30 * 997; ++k) fine.advance(k / 997.0);
    EXPECT_EQ(ticks.hash(), whole.hash());
    EXPECT_EQ(fine.hash(), whole.hash());
    EXPECT_EQ(stays_in(fine), stays_in(whole));
  }
}

TEST(Possession, IsTheSameUnderABudgetOfEvents) {
  Game whole(crowded(6)), budgeted(crowded(6));
  whole.advance(20.0);
  physics::EventBudget budget(5);
  int cuts = 0;
  while (!budgeted.advance(20.0, budget)) ++cuts, budget.grant(5);
  EXPECT_GT(cuts, 5);
  EXPECT_EQ(budgeted.hash(), whole.hash());
}

TEST(Possession, GameSavedInTheMiddleGoesOnAsOneThatWasNot) {
  for (const double saved_s : {0.3, 7.77, 12.5}) {
    const Scene scene = crowded(7);
    Game whole(scene), first(scene);
    first.advance(saved_s);
    ASSERT_FALSE(stays_in(first).empty());
    Game second = game_in_state(GameState::save(first, scene), scene, "saved");
    EXPECT_EQ(stays_in(second), stays_in(first));
    EXPECT_EQ(second.hash(), first.hash());
    whole.advance(20.0), second.advance(20.0), first.advance(20.0);
    EXPECT_EQ(first.hash(), whole.hash());
    EXPECT_EQ(second.hash(), whole.hash());
  }
}

/// The last numbers before the checksum are those of the only stay: puck u32, until f64, half u8.
TEST(Possession, SavedGameWhoseStayCannotBeIsRefused) {
  const Scene scene = with_puck("position = [1.0, 1.6]\n", "3.0");
  Game game(scene);
  game.advance(1.0);
  const std::vector<std::uint8_t> sound = GameState::save(game, scene);
  const auto refusal = [&](std::size_t from_end, std::vector<std::uint8_t> bytes) {
    std::vector<std::uint8_t> forged(sound.begin(), sound.end() - 8);
    std::ranges::copy(bytes, forged.end() - static_cast<std::ptrdiff_t>(from_end));
    physics::add_checksum(forged);
    return GameState::restore(forged, scene).error;
  };
  EXPECT_EQ(refusal(13, {0}), "") << "as it was";
  EXPECT_NE(refusal(13, {9}), "") << "no such puck";
  EXPECT_NE(refusal(9, std::vector<std::uint8_t>(8, 0)), "") << "over since the start";
  EXPECT_NE(refusal(9, std::vector<std::uint8_t>(8, 0xff)), "") << "never";
  EXPECT_NE(refusal(1, {2}), "") << "in both halves";
}

TEST(Possession, SceneWithAnotherLimitHasAnotherFingerprintAndOneWithoutItsOld) {
  const Scene with = with_puck("position = [1.0, 1.6]\n", "3.0");
  Scene other = with, without = with;
  other.rules.possession_s = 4.0, without.rules.possession_s = 0.0;
  EXPECT_NE(fingerprint(with), fingerprint(other));
  EXPECT_NE(fingerprint(with), fingerprint(without));
  EXPECT_EQ(fingerprint(preset("crowd")), fingerprint(preset("crowd")));
}

TEST(Possession, LimitThatCannotBeIsRefused) {
  for (const char* bad : {"-7.0", "0.0", "nan", "inf", "1e300", "0.05", "'seven'"})
    EXPECT_THAT(refusal_of([&] { with_puck("position = [1.0, 1.6]\n", bad); }),
                HasSubstr("possession_s"))
        << bad;
}

TEST(Possession, NeedsFaceOffSpotsWithinTheHalvesThatTheyAreOf) {
  const auto scene = [](const std::string& distance, const std::string& possession) {
    return small_scene("[match]\n" + possession + "face_off_distance = " + distance + "\n");
  };
  EXPECT_THAT(refusal_of([&] { scene("0.5", "possession_s = 7.0\n"); }),
              HasSubstr("face_off_distance"));
  EXPECT_EQ(scene("0.49", "possession_s = 7.0\n").rules.face_off_distance, 0.49);
  EXPECT_EQ(scene("0.75", "").rules.face_off_distance, 0.75);
}

}  // namespace
}  // namespace rink::game
