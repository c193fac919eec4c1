// Players who see nothing but their client's replicas, in a rink stepped tick by tick.
#include "loadgen/run/bots/live_player.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::loadgen {
namespace {

/// Plays the match with one live player per bat, by 20 ticks and 20 decisions a second; the score
/// after `seconds`.
game::Score score_of(const std::vector<std::string>& kinds, double seconds) {
  const game::Scene scene = game::match();
  game::LockstepRink rink(scene, {.rate_hz = 20.0, .view_fraction = 1.0});
  rink.start();
  std::vector<LivePlayers> settings;
  for (std::uint32_t k = 0; k < 2; ++k)
    settings.push_back({.kind = kinds[k], .rules = game::rules_of(scene, k), .seed = 1});
  std::vector<LivePlayer> players;
  for (std::uint32_t k = 0; k < 2; ++k) players.emplace_back(settings[k], k);
  std::vector<game::KeysHeld> held(2);
  while (rink.now < seconds && !rink.server().game().is_over()) {
    rink.tick();
    rink.now = rink.server().game().now();
    for (std::uint32_t k = 0; k < 2; ++k) {
      const game::KeysHeld wanted = players[k].decide(rink.client(k), rink.now);
      for (const game::Key key : game::all_keys)
        if (wanted.is_down(key) != held[k].is_down(key))
          wanted.is_down(key) ? rink.client(k).press(key) : rink.client(k).release(key);
      held[k] = wanted;
    }
  }
  return rink.server().game().score();
}

TEST(LivePlayer, TakesGoalsForAsWideInALargerFieldAsTheyAreThere) {
  game::PlayerRules rules{.field = {.length = 2.4, .width = 1.2, .goal_width = 0.4},
                          .puck_mass = 0.25};
  const game::PlayerRules larger = rules_on(rules, {.length = 24.0f, .width = 6.0f});
  EXPECT_EQ(larger.field.length, 24.0);
  EXPECT_EQ(larger.field.width, 6.0);
  EXPECT_NEAR(larger.field.goal_width, 2.0, 1e-12);
  EXPECT_EQ(larger.puck_mass, 0.25);
}

TEST(LivePlayer, SitsDownToNoFieldWhoseSizesAreNonsense) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const game::Shape bat{.half_length = 0.05f, .half_width = 0.1f};
  EXPECT_TRUE(is_playable({.length = 2.4f, .width = 1.2f}, bat));
  for (const float wrong : {nan, infinite, -infinite, -2.4f, 0.0f, 1e10f}) {
    EXPECT_FALSE(is_playable({.length = wrong, .width = 1.2f}, bat)) << wrong;
    EXPECT_FALSE(is_playable({.length = 2.4f, .width = wrong}, bat)) << wrong;
  }
  for (const float wrong : {nan, infinite, -0.1f, 0.7f}) {
    EXPECT_FALSE(
        is_playable({.length = 1.2f, .width = 1.2f}, {.half_length = wrong, .half_width = 0.1f}))
        << wrong;
    EXPECT_FALSE(
        is_playable({.length = 1.2f, .width = 1.2f}, {.half_length = 0.1f, .half_width = wrong}))
        << wrong;
  }
}

TEST(LivePlayer, AChaserThatSeesOnlyItsMirrorOutscoresOneWhoDoesNotLook) {
  const game::Score score = score_of({"chaser-expert", "waypoint"}, 90.0);
  EXPECT_GT(score.left, score.right);
  const game::Score mirrored = score_of({"waypoint", "chaser-expert"}, 90.0);
  EXPECT_GT(mirrored.right, mirrored.left);
}

}  // namespace
}  // namespace rink::loadgen
