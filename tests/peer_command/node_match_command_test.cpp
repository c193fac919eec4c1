// Matches that two servers host together, rink-serve match with --nodes and --join: their players
// find what they would find at one.
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "game/control/replay.h"
#include "game/net/address.h"
#include "game/net/client/network_match.h"
#include "game/net/fom_file.h"
#include "game/replication/trajectory_codec.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/peer_command/peer_processes.h"

namespace rink::game {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A player at one of the nodes.
struct Rival {
  Rival(const rti::Fom& fom, const ObjectModel& model, const std::string& place,
        const std::string& name)
      : match(fom, model, transport, connect(place), {.name = name}) {}

  rti::ConnectionId connect(const std::string& place) {
    const auto [address, port] = address_and_port("--connect", place);
    return transport.connect(address, port);
  }
  MatchPhase phase() const { return match.sight().phase; }

  rti::TcpTransport transport;
  NetworkMatch match;
};

class MatchesAtNodes : public PeerCommand {
 protected:
  MatchesAtNodes() : fom_(load_rink_fom(fom_file())), model_(fom_) {}

  /// Two nodes that host matches to so many goals, of which the first falls within 2 s.
  void host(const std::string& goals, Words first = {}) {
    const std::string scene = (folder_ / "duel.toml").string();
    std::ifstream file(test::source_folder() + "/scenes/paper.toml");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    text.replace(text.find("goals_to_win = 5"), 16, "goals_to_win = " + goals);
    text.replace(text.find("goal_width = 0.4"), 16, "goal_width = 1.0");
    text.replace(text.find("velocity = [-0.8, 0.3]"), 22, "velocity = [-1.0, -0.2]");
    std::ofstream(scene) << text;
    first.insert(first.end(), {"--nodes", "2", "--node-listen", "127.0.0.1:0"});
    one_ = &serve(scene, "first", first);
    const auto place = one_->line_after("nodes reach this one at ").value_or("nowhere:1");
    two_ = &serve(scene, "second", {"--join", place});
    ASSERT_TRUE(until([&] {
      return one_->line_after("listening on ") && two_->line_after("listening on ");
    })) << one_->stderr_tail()
        << two_->stderr_tail();
  }
  Process& serve(const std::string& scene, const std::string& name, Words further) {
    further.insert(further.begin(), {scene, "--port", "0", "--countdown", "0.5", "--record",
                                     (folder_ / name).string()});
    Process& node = *peers_.emplace_back(
        std::make_unique<Process>(test::binary_folder() + "/bin/rink-serve", further));
    until([&] { return node.line_after("nodes reach this one at ") || node.ending(); });
    return node;
  }
  std::unique_ptr<Rival> enter(const Process& node) {
    return std::make_unique<Rival>(fom_, model_, place_of(node),
                                   "rival-" + std::to_string(++rival_count_));
  }
  /// Both play until `is_reached()`.
  bool play(const std::function<bool()>& is_reached, std::chrono::seconds limit = 60s) {
    return until(
        [&] {
          for (const auto& rival : rivals_)
            if (rival) rival->match.advance(now_s());
          return is_reached();
        },
        limit);
  }
  bool are_in(MatchPhase phase) const {
    return rivals_[0]->phase() == phase && rivals_[1]->phase() == phase;
  }
  void begin_match() {
    rivals_[0] = enter(*one_);  // it plays on the left, for it is the first
    ASSERT_TRUE(play([&] { return rivals_[0]->match.player() == 0u; }));
    rivals_[1] = enter(*two_);
    ASSERT_TRUE(play([&] { return are_in(MatchPhase::playing); }))
        << one_->stderr_tail() << two_->stderr_tail() << rivals_[0]->match.sight().notice
        << rivals_[1]->match.sight().notice;
  }
  std::uint32_t goals_seen_by(std::size_t rival) const {
    const Score& score = rivals_[rival]->match.sight().score;
    return score.left + score.right;
  }
  /// Both nodes are interrupted. The second may have noticed before that the first has gone.
  void interrupt() {
    for (const Process* node : {one_, two_}) ASSERT_EQ(kill(node->id(), SIGINT), 0);
    ASSERT_TRUE(ends(*one_) && ends(*two_));
    EXPECT_EQ(one_->ending()->exit_status, static_cast<int>(ExitStatus::interrupted));
    EXPECT_THAT(two_->ending()->exit_status,
                testing::AnyOf(static_cast<int>(ExitStatus::interrupted),
                               static_cast<int>(ExitStatus::may_have_split)));
  }
  /// That a node has recorded, which one engine replays to its hash.
  KeyLog record(const std::string& node, const std::string& match) const {
    KeyLog log = read_key_log(folder_ / node / match);
    EXPECT_TRUE(log.hash);
    EXPECT_EQ(replay(log, recorded_scene(log, match)), log.hash.value_or(0)) << node << match;
    return log;
  }

  rti::Fom fom_;
  ObjectModel model_;
  Process *one_ = nullptr, *two_ = nullptr;
  int rival_count_ = 0;
  std::array<std::unique_ptr<Rival>, 2> rivals_;
};

TEST_F(MatchesAtNodes, ArePlayedWithARematchAndRecordedAlike) {
  host("1");
  const Process& rivals = *peers_.emplace_back(std::make_unique<Process>(
      test::binary_folder() + "/bin/rink-duel",
      Words{"--connect", place_of(*one_), "--second", place_of(*two_), "--matches", "2"}));
  ASSERT_TRUE(ends(rivals, 100s)) << one_->stderr_tail() << two_->stderr_tail();
  EXPECT_EQ(rivals.ending()->exit_status, 0) << rivals.stderr_tail();
  interrupt();
  for (const char* match : {"match-1.keys", "match-2.keys"}) {
    const KeyLog log = record("first", match);
    EXPECT_EQ(log, record("second", match));
    EXPECT_FALSE(log.events.empty());
    Game game(recorded_scene(log, match));
    for (const InputEvent& event : log.events) game.submit(event);
    game.advance(log.until.value_or(0.0));
    EXPECT_TRUE(game.is_over());
    EXPECT_EQ(game.score().left + game.score().right, 1u);
  }
}

TEST_F(MatchesAtNodes, PauseForBothAndGoOnWhereTheyStopped) {
  host("100");
  begin_match();
  rivals_[1]->match.press(0, Key::up, true);
  rivals_[1]->match.pause(true);
  ASSERT_TRUE(play([&] { return are_in(MatchPhase::paused); }));
  const double paused_at = rivals_[0]->match.sight().time, since = now_s();
  EXPECT_NEAR(rivals_[1]->match.sight().time, paused_at, 0.1);
  ASSERT_TRUE(play([&] { return now_s() > since + 1.0; }));
  EXPECT_TRUE(are_in(MatchPhase::paused));
  EXPECT_NEAR(rivals_[0]->match.sight().time, paused_at, 0.1);
  rivals_[0]->match.pause(false);
  ASSERT_TRUE(play([&] { return are_in(MatchPhase::playing); }));
  EXPECT_NEAR(rivals_[0]->match.sight().time, paused_at, 0.3);
  ASSERT_TRUE(play([&] { return rivals_[1]->match.sight().time > paused_at + 1.0; }));
  interrupt();
  for (const char* node : {"first", "second"}) {
    const KeyLog log = record(node, "match-1.keys");
    EXPECT_EQ(std::ranges::count(log.events, 1u, &InputEvent::player), 1);
    EXPECT_GT(log.until.value_or(0.0), paused_at + 0.5) << "it ends as it was, though unfinished";
  }
}

TEST_F(MatchesAtNodes, LetAPlayerComeBackToAnotherNodeOnTheSameScore) {
  host("100");
  begin_match();
  ASSERT_TRUE(play([&] { return goals_seen_by(0) > 0 && goals_seen_by(1) > 0; }));
  rivals_[1].reset();  // as if it was killed
  ASSERT_TRUE(play([&] { return rivals_[0]->phase() == MatchPhase::away; }));
  const std::uint32_t goals = goals_seen_by(0);
  rivals_[1] = enter(*one_);
  ASSERT_TRUE(play([&] { return are_in(MatchPhase::playing); }));
  EXPECT_EQ(rivals_[1]->match.player(), 1u);
  EXPECT_GE(goals_seen_by(0), goals);
  EXPECT_EQ(goals_seen_by(1), goals_seen_by(0));
  const double back_at = rivals_[1]->match.sight().time;
  rivals_[1]->match.press(0, Key::up, true);
  ASSERT_TRUE(play([&] { return rivals_[0]->match.sight().time > back_at + 1.0; }));
  interrupt();
  const KeyLog log = record("second", "match-1.keys");
  EXPECT_EQ(std::ranges::count(log.events, 1u, &InputEvent::player), 1);
}

TEST_F(MatchesAtNodes, AreWonByWhoStaysAndBeginAnewWithASuccessor) {
  host("100", {"--absence", "1"});
  begin_match();
  rivals_[1].reset();
  ASSERT_TRUE(play([&] { return rivals_[0]->phase() == MatchPhase::over; }));
  EXPECT_EQ(rivals_[0]->match.sight().winner, Team::left);
  rivals_[1] = enter(*two_);
  ASSERT_TRUE(play([&] { return are_in(MatchPhase::playing); }));
  EXPECT_LT(rivals_[1]->match.sight().time, 0.5);
  interrupt();
  EXPECT_EQ(record("first", "match-1.keys"), record("second", "match-1.keys"));
}

/// Whichever node is killed, its player comes to the other one, on the same score.
TEST_F(MatchesAtNodes, GoOnWithoutANodeThatIsKilled) {
  for (const std::size_t killed : {0u, 1u}) {
    SCOPED_TRACE("node " + std::to_string(killed));
    host("100");
    begin_match();
    ASSERT_TRUE(play([&] { return goals_seen_by(0) > 0 && goals_seen_by(1) > 0; }));
    rivals_[killed]->match.press(0, Key::up, true);
    const double pressed_at = rivals_[1 - killed]->match.sight().time;
    ASSERT_TRUE(play([&] { return rivals_[1 - killed]->match.sight().time > pressed_at + 0.5; }));
    const Process& left = killed == 0 ? *two_ : *one_;
    ASSERT_EQ(kill((killed == 0 ? *one_ : *two_).id(), SIGKILL), 0);
    rivals_[killed].reset();
    ASSERT_TRUE(play([&] { return rivals_[1 - killed]->phase() == MatchPhase::away; }))
        << left.stderr_tail();
    const std::uint32_t goals = goals_seen_by(1 - killed);
    rivals_[killed] = enter(left);
    ASSERT_TRUE(play([&] { return are_in(MatchPhase::playing); })) << left.stderr_tail();
    EXPECT_EQ(rivals_[killed]->match.player(), killed);
    EXPECT_GE(goals_seen_by(killed), goals);
    const double back_at = rivals_[killed]->match.sight().time;
    ASSERT_TRUE(play([&] { return rivals_[killed]->match.sight().time > back_at + 1.0; }));
    EXPECT_THAT(left.stderr_tail(), HasSubstr("this peer continues alone"));
    ASSERT_EQ(kill(left.id(), SIGINT), 0);
    ASSERT_TRUE(ends(left));
    EXPECT_EQ(left.ending()->exit_status,
              static_cast<int>(killed == 0 ? ExitStatus::may_have_split : ExitStatus::interrupted));
    const KeyLog log = record(killed == 0 ? "second" : "first", "match-1.keys");
    KeysHeld held;
    for (const InputEvent& key : log.events)
      if (key.player == killed) held.set(key.key, key.kind == InputKind::key_down);
    EXPECT_EQ(held, KeysHeld()) << "released";
    EXPECT_GE(log.events.size(), 2u);
    for (auto& rival : rivals_) rival.reset();
    std::filesystem::remove_all(folder_ / "first");
    std::filesystem::remove_all(folder_ / "second");
  }
}

TEST_F(MatchesAtNodes, AreNotHostedForADuration) {
  const Words words{"match", "--nodes", "2", "--node-listen", "127.0.0.1:0", "--duration", "5"};
  const Process& host = *peers_.emplace_back(
      std::make_unique<Process>(test::binary_folder() + "/bin/rink-serve", words));
  ASSERT_TRUE(ends(host));
  EXPECT_EQ(host.ending()->exit_status, 2);
  EXPECT_THAT(host.stderr_tail(), HasSubstr("--duration: nodes host matches until"));
}

TEST_F(MatchesAtNodes, AreHostedAtTheShortestTick) {
  const Words words{"match",       "--nodes", "2",    "--node-listen",
                    "127.0.0.1:0", "--rate",  "1000", "--patience",
                    "1",           "--port",  "0"};
  const Process& host = *peers_.emplace_back(
      std::make_unique<Process>(test::binary_folder() + "/bin/rink-serve", words));
  ASSERT_TRUE(ends(host));
  EXPECT_EQ(host.ending()->exit_status, static_cast<int>(ExitStatus::nobody_came))
      << host.stderr_tail();
}

TEST_F(MatchesAtNodes, RefuseAThirdPlayerAtEitherNode) {
  host("100");
  begin_match();
  for (const Process* node : {one_, two_}) {
    const std::unique_ptr<Rival> third = enter(*node);
    ASSERT_TRUE(play([&] {
      third->match.advance(now_s());
      return third->phase() == MatchPhase::lost;
    }));
    EXPECT_THAT(third->match.sight().notice, HasSubstr("no bat is free"));
  }
  EXPECT_TRUE(are_in(MatchPhase::playing));
}

}  // namespace
}  // namespace rink::game
