// Players: the chaser wins, the mobility models move as their papers say, and what was played can
// be played again.
#include "game/players/player.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "game/control/playing.h"
#include "game/players/gathering.h"
#include "game/players/hotspot.h"
#include "game/players/player_kinds.h"
#include "game/players/steering.h"
#include "game/players/waypoint.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

Score score_after(const std::vector<std::string>& players, std::uint64_t seed) {
  constexpr double longest_match_s = 120.0;
  Playing playing(preset("match"), players, seed, longest_match_s);
  while (!playing.game().is_over() && playing.game().now() < longest_match_s)
    playing.advance(playing.game().now() + 1.0);
  return playing.game().score();
}

/// Of ten matches, seeds 1 to 10, of up to five goals or 120 s; a draw is no win.
struct Tally {
  int left = 0, right = 0;
};

/// Matches won of ten, seeds 1 to 10, of up to five goals or 120 s; a draw is won by neither.
Tally matches_won(const std::string& left, const std::string& right) {
  Tally won;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Score score = score_after({left, right}, seed);
    won.left += score.left > score.right ? 1 : 0;
    won.right += score.right > score.left ? 1 : 0;
  }
  return won;
}

TEST(Chaser, BeatsRandomKeysInNineOfTenMatchesFromEitherEnd) {
  EXPECT_GE(matches_won("chaser", "random").left, 9);
  EXPECT_GE(matches_won("random", "chaser").right, 9);
}

TEST(Chaser, WhoIsFasterAndAimsBetterWinsMoreMatches) {
  const Tally expert_left = matches_won("chaser-expert", "chaser-beginner"),
              expert_right = matches_won("chaser-beginner", "chaser-expert");
  EXPECT_GE(expert_left.left, 7);
  EXPECT_GE(expert_right.right, 7);
}

/// A resting puck, and a bat that attacks towards larger x.
Scene puck_and_bat(const std::string& puck, const std::string& bat) {
  return small_scene("[drag]\nbats = 3.0\n[match]\ngoals_to_win = 1\n[[puck]]\nposition = " + puck +
                     "\nmass = 0.05\n[[bat]]\nposition = " + bat +
                     "\nhalf_extent = [0.03, 0.1]\nteam = \"left\"\n");
}

TEST(Chaser, GoesRoundAPuckBehindItSoThatItsFirstTouchSendsItForward) {
  for (const char* place :
       {"[0.4, 1.0]", "[0.3, 0.8]", "[0.5, 1.15]", "[0.2, 1.7]", "[0.6, 0.1]"}) {
    Playing playing(puck_and_bat(place, "[1.5, 1.0]"), {"chaser-expert"}, 1, 10.0);
    const EntityId puck = playing.game().entities().back().id;
    while (playing.game().now() < 10.0 && playing.game().velocity(puck) == Vector2(0.0, 0.0))
      playing.advance(playing.game().now() + 1e-3);
    EXPECT_GT(playing.game().velocity(puck).x(), 0.0) << "puck at " << place;
  }
}

TEST(Playing, TheRecordedKeysGiveTheSameGameAgainBitForBit) {
  const Scene scene = small_crowd(12, 5);
  for (const std::string& kind : player_kinds()) {
    Playing playing(scene, {kind, "random"}, 3, 4.0);
    playing.advance(4.0);
    Game again(scene);
    for (const InputEvent& event : playing.keys()) again.submit(event);
    again.advance(4.0);
    EXPECT_EQ(again.hash(), playing.game().hash()) << kind;
    EXPECT_GT(playing.keys().size(), 12u) << kind;
  }
}

TEST(Playing, TheSameSeedGivesTheSameKeysAndAnotherSeedOthers) {
  const auto keys = [](const std::string& kind, std::uint64_t seed) {
    Playing playing(small_crowd(12, 5), {kind}, seed, 3.0);
    playing.advance(3.0);
    return playing.keys();
  };
  for (const std::string& kind : player_kinds()) {
    EXPECT_TRUE(keys(kind, 1) == keys(kind, 1)) << kind;
    if (kind == "chaser-expert") continue;  // it never errs and so draws nothing
    EXPECT_FALSE(keys(kind, 1) == keys(kind, 2)) << kind;
  }
}

TEST(Playing, WhereItStopsOnTheWayChangesNothing) {
  Playing once(small_crowd(12, 5), {"chaser"}, 1, 3.0),
      often(small_crowd(12, 5), {"chaser"}, 1, 3.0);
  once.advance(3.0);
  for (int step = 1; step <= 90; ++step) often.advance(step / 30.0);
  EXPECT_EQ(once.game().hash(), often.game().hash());
  EXPECT_TRUE(once.keys() == often.keys());
}

/// A bat alone in the world, moved by a player's keys: what the mobility models promise holds for
/// one who is not in others' way.
class LoneBat {
 public:
  LoneBat(const std::string& kind, const PlayerRules& rules, std::uint32_t number,
          std::uint64_t seed)
      : rules_(rules),
        player_(make_player(kind, rules,
                            {.number = number, .team = Team::none, .half_extent = {0.05, 0.15}},
                            seed)),
        motion_{.time = 0.0,
                .position = {rules.field.length / 2, rules.field.width / 2},
                .velocity = {0.0, 0.0},
                .acceleration = {0.0, 0.0},
                .drag = Vector2::Constant(rules.bat_drag)} {}

  const Vector2& decide() {
    const KeysHeld keys = player_->decide(
        {.position = motion_.position, .velocity = motion_.velocity, .pucks = {}}, motion_.time);
    const auto along = [&](Key plus, Key minus) {
      return rules_.thrust *
             (static_cast<double>(keys.is_down(plus)) - static_cast<double>(keys.is_down(minus)));
    };
    motion_.acceleration = {along(Key::right, Key::left), along(Key::up, Key::down)};
    motion_ = motion_.at(motion_.time + decision_period);
    return motion_.position;
  }
  const Player& player() const { return *player_; }
  const Vector2& velocity() const { return motion_.velocity; }

 private:
  PlayerRules rules_;
  std::unique_ptr<Player> player_;
  physics::Motion motion_;
};

PlayerRules wide_rules() {
  PlayerRules rules;
  rules.field = {.length = 20.0, .width = 10.0};
  rules.bat_drag = 3.0;
  rules.thrust = 4.9;
  return rules;
}

/// Three materials, each pair of which bounces otherwise.
TEST(PlayerRules, AreThoseOfTheOwnBatAndThePucks) {
  const Scene scene = small_scene(
      "material = \"wall\"\n[materials]\nnames = [\"wall\", \"puck\", \"bat\"]\nrestitution = 0.9\n"
      "[[materials.pair]]\nbetween = [\"puck\", \"bat\"]\nrestitution = "
      "0.4\n[[materials.pair]]\nbetween = [\"puck\", \"wall\"]\nrestitution = 0.6\n"
      "[drag]\npucks = 0.25\nbats = 2.0\n[[puck]]\nposition = [2.0, 1.0]\nmass = 0.05\nmaterial = "
      "\"puck\"\n"
      "[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.03, 0.1]\nmass = 3.0\nthrust = 5.0\nteam = "
      "\"left\"\nmaterial = \"wall\"\n"
      "[[bat]]\nposition = [3.0, 1.0]\nhalf_extent = [0.03, 0.1]\nmass = 0.5\nthrust = 8.0\nteam = "
      "\"right\"\nmaterial = \"bat\"\n");
  const PlayerRules first = rules_of(scene, 0), second = rules_of(scene, 1);
  EXPECT_EQ(first.restitution, 0.6);
  EXPECT_EQ(second.restitution, 0.4);
  EXPECT_EQ(first.bat_mass, 3.0);
  EXPECT_EQ(second.bat_mass, 0.5);
  EXPECT_EQ(first.thrust, 5.0);
  EXPECT_EQ(second.thrust, 8.0);
  for (const PlayerRules& rules : {first, second}) {
    EXPECT_EQ(rules.puck_mass, 0.05);
    EXPECT_EQ(rules.puck_drag, 0.25);
    EXPECT_EQ(rules.bat_drag, 2.0);
  }
}

/// Eight decisions at rest under pressed keys, then six and the one at hand of the same random
/// keys, then the player's own for as long again.
TEST(Hands, TryRandomKeysForAWhileWhereTheyAreStuckAndThenThePlayersAgain) {
  Hands hands;
  RandomStream random(7);
  const KeysHeld wanted = keys_towards(1, 0);
  std::vector<bool> follows;
  std::uint32_t own = 0, others = 0;
  for (int decision = 0; decision < 1500; ++decision) {
    const KeysHeld held = hands.hold(wanted, {0.0, 0.0}, random);
    hands.check();
    follows.push_back(held == wanted);
    ++(held == wanted ? own : others);
  }
  // Of nine draws one is the player's own key, one none at all, after which nothing is stuck until
  // a key is held.
  for (std::size_t begin = 0; begin + 1 < follows.size();) {
    std::size_t end = begin;
    while (end < follows.size() && follows[end] == follows[begin]) ++end;
    if (!follows[begin] && end < follows.size()) {
      EXPECT_EQ(end - begin, 7u) << "at decision " << begin;
    } else if (begin > 0 && end < follows.size()) {
      EXPECT_GE(end - begin, 7u) << "at decision " << begin;
    }
    begin = end;
  }
  EXPECT_GT(own, others / 2);
  EXPECT_GT(others, 300u);
}

TEST(Reach, EndsAtTheWallsAndWhereBatsKeepToTheirHalfAtTheHalfwayLine) {
  PlayerRules rules{.field = {.length = 4.0, .width = 2.0}};
  const Vector2 half(0.1, 0.2);
  for (const Team team : {Team::left, Team::right, Team::none})
    for (const bool keeps : {false, true}) {
      rules.field.bats_keep_to_half = keeps;
      const Reach reach = reach_of(rules, {.number = 0, .team = team, .half_extent = half});
      EXPECT_EQ(reach.low, Vector2(keeps && team == Team::right ? 2.1 : 0.1, 0.2));
      EXPECT_EQ(reach.high, Vector2(keeps && team == Team::left ? 1.9 : 3.9, 1.8));
    }
}

/// Four pucks lie nearest when play begins, and glide to where the bat may not go. A fifth one
/// comes from there.
TEST(Chaser, LooksForPucksWhereTheyAreNow) {
  std::string text =
      "bats_keep_to_half = true\n[materials]\nrestitution = 0.9\n[drag]\nbats = 3.0\npucks = "
      "0.8\n[[bat]]\nposition = [0.3, 1.0]\nhalf_extent = [0.03, 0.1]\nteam = \"left\"\n";
  for (const char* row : {"0.15", "0.4", "1.6", "1.85"})
    text += "[[puck]]\nposition = [0.6, " + std::string(row) + "]\nvelocity = [2.0, 0.0]\n";
  text += "[[puck]]\nposition = [3.5, 1.3]\nvelocity = [-2.0, 0.0]\n";
  Playing playing(small_scene(text), {"chaser-expert"}, 1, 20.0);
  const std::span<const Entity> entities = playing.game().entities();
  const auto latest = std::ranges::find_if(entities, [&](const Entity& entity) {
    return entity.kind == physics::BodyKind::puck && playing.game().position(entity.id).x() > 3.0;
  });
  ASSERT_NE(latest, entities.end());
  while (playing.game().now() < 20.0 && playing.game().velocity(latest->id).x() <= 0.0)
    playing.advance(playing.game().now() + 0.01);
  EXPECT_LT(playing.game().now(), 20.0) << "nobody hit it";
}

TEST(Chaser, ExpectsPucksWhereDragAndFrictionTakeThem) {
  for (const double drag : {0.0, 0.3})
    for (const double friction : {0.0, 0.2, 3.0})
      for (const double ahead : {0.05, 0.4, 2.0}) {
        PlayerRules rules;
        rules.puck_drag = drag, rules.puck_friction = friction;
        physics::Motion motion{.velocity = {1.2, -0.5}, .drag = {drag, drag}};
        if (friction > 0.0) motion.slide(friction);
        const physics::Motion truth = motion.at(ahead);
        const physics::WarpedTime flown =
            under_friction(physics::warp(ahead, drag), ahead, motion.velocity, rules);
        EXPECT_LT((motion.velocity * flown.s - truth.position).norm(), 1e-15);
        EXPECT_LT((motion.velocity * flown.e - truth.velocity).norm(), 1e-15);
      }
}

TEST(Waypoint, ChoosesDestinationsUniformly) {
  RandomStream random(7);
  const Reach reach{{1.0, 2.0}, {5.0, 4.0}};
  constexpr int count = 16'000, cells = 16;
  std::vector<int> visits(cells, 0);
  for (int k = 0; k < count; ++k) {
    const Vector2 place = anywhere(reach, random);
    ++visits[static_cast<std::size_t>((place.x() - 1.0) / 1.0) * 4 +
             static_cast<std::size_t>((place.y() - 2.0) / 0.5)];
  }
  double chi_square = 0.0;
  for (const int seen : visits) chi_square += std::pow(seen - count / cells, 2) / (count / cells);
  EXPECT_LT(chi_square, 37.7);  // 15 degrees of freedom, p = 0.001
}

/// Speeds drawn uniformly from [low, high] are held for times inversely proportional to them, so
/// the mean speed over time is (high - low)/ln(high/low) (Yoon, Liu and Noble 2003, equation 5),
/// from the first minutes on: with low > 0 it does not decay.
TEST(Waypoint, MeanSpeedOverTimeIsThatOfTheFormulaAndDoesNotDecay) {
  const PlayerRules rules = wide_rules();
  const double high = top_speed(rules), low = Traveller::slowest * high,
               expected = (high - low) / std::log(high / low);
  double length[2] = {0.0, 0.0}, time[2] = {0.0, 0.0};
  for (std::uint32_t number = 0; number < 60; ++number) {
    LoneBat bat("waypoint", rules, number, 11);
    const Traveller& traveller = dynamic_cast<const Waypoint&>(bat.player()).traveller();
    for (int step = 0; step < 12'000; ++step) {
      bat.decide();
      if (traveller.is_resting()) continue;
      length[step / 6'000] += std::sqrt(bat.velocity().squaredNorm()) * decision_period;
      time[step / 6'000] += decision_period;
    }
  }
  const double early = length[0] / time[0], late = length[1] / time[1];
  EXPECT_NEAR(early, expected,
              0.1 * expected);  // starts, stops and steering by keys take their part
  EXPECT_NEAR(late, early, 0.03 * early);
}

TEST(Hotspot, HotPlacesHoldTheShareOfVisitsThatZipfsLawGivesThem) {
  const HotPlaces places({.length = 20.0, .width = 10.0}, 3);
  RandomStream random(5);
  ASSERT_EQ(places.centres().size(), 8u);
  double harmonic = 0.0;
  for (int k = 1; k <= 8; ++k) harmonic += 1.0 / k;
  EXPECT_NEAR(places.weight(0), 1.0 / harmonic, 1e-12);
  EXPECT_NEAR(places.weight(7), 1.0 / 8.0 / harmonic, 1e-12);
  constexpr int count = 20'000;
  int at_first = 0;
  for (int k = 0; k < count; ++k) {
    const Vector2 place = places.point_in(places.choose(random), random);
    double nearest = 1e9;
    for (const Vector2& centre : places.centres())
      nearest = std::min(nearest, std::sqrt((place - centre).squaredNorm()));
    EXPECT_LE(nearest, places.radius());
    at_first +=
        (place - places.centres()[0]).squaredNorm() <= places.radius() * places.radius() ? 1 : 0;
  }
  EXPECT_GE(at_first, count / harmonic * 0.95);  // other places may overlap the first
}

/// The part of their time that players of `kind` spend within a hot disc of `seed`.
double time_in_hot_places(const std::string& kind, std::uint64_t seed) {
  const PlayerRules rules = wide_rules();
  const HotPlaces places(rules.field, seed);
  int within = 0, all = 0;
  for (std::uint32_t number = 0; number < 30; ++number) {
    LoneBat bat(kind, rules, number, seed);
    for (int step = 0; step < 4'000; ++step, ++all) {
      const Vector2& here = bat.decide();
      within += std::ranges::any_of(places.centres(),
                                    [&](const Vector2& centre) {
                                      return (here - centre).squaredNorm() <=
                                             places.radius() * places.radius();
                                    })
                    ? 1
                    : 0;
    }
  }
  return static_cast<double>(within) / all;
}

TEST(Hotspot, PlayersAreSeveralTimesDenserInHotPlacesThanElsewhere) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const double hot = time_in_hot_places("hotspot", seed),
                 even = time_in_hot_places("waypoint", seed);
    EXPECT_GT(hot / (1.0 - hot), 3.0 * even / (1.0 - even))
        << "seed "
        << seed;  // odds: the ratio of densities inside and outside, against that of even players
  }
}

TEST(GroupRoute, StaysWhereItIsWhereBatsHaveNoThrust) {
  GroupRoute wide({Vector2(0.0, 0.0), Vector2(9.0, 5.0)}, 0.0, 21, 0);
  const Vector2 start = wide.at(0.0);
  EXPECT_EQ(wide.at(1e9), start);
  const Vector2 only(0.1, 0.1);
  GroupRoute narrow({only, only}, 0.0, 21, 0);  // where there is no way to go, 0 m at 0 m/s
  EXPECT_EQ(narrow.at(1e9), only);
}

/// Reference points are uniform in a disc, whose mean distance from the centre is 2/3 of the
/// radius; members stray from them by a fifth of the radius and lag behind.
TEST(Gathering, MembersKeepWithinTheirGroupsDiscWhileTheGroupCrossesTheRink) {
  const PlayerRules rules = wide_rules();
  std::vector<std::unique_ptr<LoneBat>> members, strangers;
  for (std::uint32_t number = 0; number < Gathering::group_size; ++number) {
    members.push_back(std::make_unique<LoneBat>("gathering", rules, number, 21));
    strangers.push_back(
        std::make_unique<LoneBat>("gathering", rules, Gathering::group_size * (number + 1), 21));
  }
  const double spread = dynamic_cast<const Gathering&>(members[0]->player()).spread();
  double sum = 0.0, sum_of_strangers = 0.0;
  int count = 0;
  Vector2 low(1e9, 1e9), high(-1e9, -1e9);
  for (int step = 0; step < 6'000; ++step) {
    Vector2 centre(0.0, 0.0), centre_of_strangers(0.0, 0.0);
    std::vector<Vector2> here, strange;
    for (auto& member : members) here.push_back(member->decide());
    for (auto& stranger : strangers) strange.push_back(stranger->decide());
    if (step < 400) continue;  // until all have come together
    for (const Vector2& place : here) centre += place / Gathering::group_size;
    for (const Vector2& place : strange) centre_of_strangers += place / Gathering::group_size;
    for (std::size_t k = 0; k < here.size(); ++k, ++count) {
      sum += std::sqrt((here[k] - centre).squaredNorm());
      sum_of_strangers += std::sqrt((strange[k] - centre_of_strangers).squaredNorm());
    }
    low = low.cwiseMin(centre);
    high = high.cwiseMax(centre);
  }
  EXPECT_NEAR(sum / count, 2.0 / 3.0 * spread, 0.35 * spread);
  EXPECT_GT(sum_of_strangers / count, 3.0 * sum / count);
  EXPECT_GT((high - low).minCoeff(), 0.4 * rules.field.width);
}

}  // namespace
}  // namespace rink::game
