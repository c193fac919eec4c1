// The last seconds of a possession, and what follows, as players of each kind of match see them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <string>

#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/match/local_match.h"
#include "game/match/replay_match.h"
#include "loadgen/duel/duel.h"
#include "tests/match/match_scene.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using loadgen::Duel;

/// The match as people play it, in which a puck may stay in one half for two seconds.
std::string hasty_text() {
  std::string text = scene_text(test::source_folder() + "/scenes/match.toml");
  const std::string seven = "possession_s = 7.0", goals = "goals_to_win = 5";
  text.replace(text.find(seven), seven.size(), "possession_s = 2.0");
  text.replace(text.find(goals), goals.size(), "goals_to_win = 50");
  return text;
}
Scene hasty() { return parse_scene(hasty_text(), "hasty.toml"); }

/// What was shown of the rule in the frames of one window.
struct Shown {
  int counts = 0, serves = 0;  ///< frames with the count; and messages
  double worst_s = 0.0;        ///< how far the shown end was from the true one
  std::optional<Team> served;
  void look(const MatchSight& sight, const Game* game) {
    counts += sight.holder.has_value();
    serves += sight.served && !served;
    served = sight.served;
    EXPECT_FALSE(sight.holder && sight.phase != MatchPhase::playing);
    if (!sight.holder || game == nullptr || sight.possession_s < 0.5) return;
    const std::optional<EndingPossession> ending = ending_possession(*game);
    if (ending) truths.push_back(*ending);
    if (truths.size() > known_after) truths.pop_front();
    if (!ending || ending->team != sight.holder) return;
    double off_s = std::numeric_limits<double>::infinity();
    for (const EndingPossession& truth : truths)
      if (truth.team == sight.holder)
        off_s = std::min(off_s, std::abs(sight.time + sight.possession_s - truth.until));
    worst_s = std::max(worst_s, off_s);
  }
  /// A puck may cross the line twice before the first crossing is known here: frames of a delay,
  /// its jitter and a tick.
  static constexpr std::size_t known_after = 9;
  std::deque<EndingPossession> truths;
};

std::size_t served_by(const KeyLog& log, const Scene& scene) {
  Game game(scene);
  for (const InputEvent& event : log.events) game.submit(event);
  std::size_t served = 0;
  for (double now = 0.02; now < *log.until; now += 0.02) {
    game.advance(now);
    served += served_in(game).size();
  }
  return served;
}

TEST(PossessionMatch, IsCountedDownAndSaidToBothPlayersAndAWatcherOverANetwork) {
  for (const double delay_s : {0.0, 0.1}) {
    SCOPED_TRACE(testing::Message() << "delay " << delay_s << " s");
    Duel duel(rink_fom(), hasty(), hasty_text(),
              {.delay_s = delay_s, .jitter_s = 0.003, .players = {"chaser-beginner", ""}});
    std::array<Shown, 3> shown;
    duel.watch = [&](std::size_t k) {
      const Game& game = duel.server().game();
      shown[k].look(duel.client(k).sight(), k == Duel::watcher ? nullptr : &game);
    };
    duel.connect(0), duel.connect(1);
    duel.run(10.0);
    duel.connect(Duel::watcher);
    duel.run(40.0);
    duel.server().finish_record();
    const std::vector<KeyLog> records = duel.server().hosted()->take_finished();
    ASSERT_EQ(records.size(), 1u);
    EXPECT_EQ(replay(records[0], hasty()), *records[0].hash);
    const std::size_t served = served_by(records[0], hasty());
    EXPECT_GT(served, 5u);
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      EXPECT_GT(shown[k].counts, 100) << "client " << k;
      EXPECT_GE(shown[k].serves + 2, static_cast<int>(served)) << "client " << k;
      EXPECT_LE(shown[k].serves, static_cast<int>(served) + 1) << "client " << k;
      EXPECT_LT(shown[k].worst_s, 0.05) << "client " << k;
    }
    EXPECT_GT(shown[Duel::watcher].counts, 100);
    EXPECT_GT(shown[Duel::watcher].serves, 3);
  }
}

TEST(PossessionMatch, IsShownInALocalMatchAndInItsReplay) {
  LocalMatch match(hasty(), {.players = {"chaser-beginner", "hand"}, .scene_text = hasty_text()});
  Shown shown;
  for (double now = 0.0; now < 33.0; now += 1.0 / 60.0) {
    match.advance(now);
    shown.look(match.sight(), &match.playing().game());
  }
  match.finish();
  const std::vector<KeyLog> logs = match.take_finished();
  ASSERT_EQ(logs.size(), 1u);
  const auto served = static_cast<int>(served_by(logs[0], hasty()));
  EXPECT_GT(served, 2);
  EXPECT_EQ(shown.serves, served);
  EXPECT_LT(shown.worst_s, 1e-9);
  EXPECT_EQ(replay(logs[0], hasty()), *logs[0].hash);

  const test::TemporaryFolder folder("possession");
  const std::string file = (folder / "hasty.keys").string();
  write_key_log(file, logs[0]);
  ReplayMatch again(file);
  Shown seen;
  for (double now = 0.0; now < 29.0; now += 1.0 / 60.0) {
    again.advance(now);
    seen.look(again.sight(), nullptr);
  }
  EXPECT_NEAR(seen.serves, served, 1);
  EXPECT_GT(seen.counts, 100);
}

/// Time in which the game stands still does not count.
TEST(PossessionMatch, StopsInAPause) {
  LocalMatch match(hasty(), {.players = {"hand", "hand"}, .scene_text = hasty_text()});
  double now = 0.0;
  const auto run = [&](double seconds) {
    for (const double end = now + seconds; now < end; now += 1.0 / 60.0) match.advance(now);
  };
  run(3.5);
  const double before_s = match.playing().game().now();
  match.pause(true);
  run(20.0);
  EXPECT_FALSE(match.sight().holder);
  match.pause(false);
  run(3.1);
  EXPECT_LT(match.playing().game().now(), before_s + 0.2);
}

}  // namespace
}  // namespace rink::game
