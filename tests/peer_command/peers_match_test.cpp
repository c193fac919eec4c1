// Matches of rink peer: each peer plays the whole of one, and they tell each other keys alone.
#include <nlohmann/json.hpp>

#include "game/control/replay.h"
#include "tests/peer_command/peer_processes.h"

namespace rink::game {
namespace {

using Json = nlohmann::json;

class PeersMatch : public PeerCommand {
 protected:
  /// To `until` seconds, at most.
  Process& first(const std::string& until, Words further = {}) {
    further.insert(further.end(), {"--peers", "2", "--until", until, "--listen", "127.0.0.1:0"});
    return play("first", further);
  }
  Process& second(const Process& other, Words further = {}) {
    further.insert(further.end(), {"--join", place_of(other)});
    return play("second", further);
  }
  Process& play(const std::string& name, Words further) {
    const std::string file = (folder_ / name).string();
    further.insert(further.end(), {"--report", file + ".json", "--record", file + ".keys"});
    return start(further, played_);
  }
  Json report(const std::string& name) const {
    std::ifstream file(folder_ / (name + ".json"));
    return Json::parse(file);
  }
  /// Whose record one engine replays to its hash.
  KeyLog record(const std::string& name) const {
    KeyLog log = read_key_log(folder_ / (name + ".keys"));
    EXPECT_TRUE(log.hash);
    EXPECT_EQ(replay(log, recorded_scene(log, name)), log.hash.value_or(0));
    return log;
  }
  std::string played_ = "match";
  bool are_over(const Process& one, const Process& two) { return ends(one, 60s) && ends(two, 60s); }
};

double bytes_per_s(const Json& report) {
  return report.at("bytes_sent").get<double>() / report.at("time").get<double>();
}

TEST_F(PeersMatch, IsTheGameOfOneEngineInFewBytes) {
  const Process& one = first("8", {"--bots", "1"});
  const Process& two = second(one, {"--bots", "1"});
  ASSERT_TRUE(are_over(one, two)) << one.stderr_tail() << two.stderr_tail();
  EXPECT_EQ(one.ending()->exit_status, 0) << one.stderr_tail();
  EXPECT_EQ(two.ending()->exit_status, 0) << two.stderr_tail();
  const KeyLog log = record("first");
  EXPECT_EQ(log, record("second"));
  for (const std::uint32_t player : {0u, 1u})
    EXPECT_GT(std::ranges::count(log.events, player, &InputEvent::player), 4);
  for (const char* name : {"first", "second"}) {
    const Json told = report(name);
    EXPECT_EQ(told.at("hash"), report("first").at("hash"));
    EXPECT_EQ(told.at("peers"), 2u);
    // A server sends each player 340 to 530 B/s, and peers that divided the match 4,700.
    EXPECT_LT(bytes_per_s(told), 2.0 * 530.0);
    EXPECT_GT(told.at("key_presses"), 4u);
  }
}

/// A puck may stay for half a second only, so it changes sides all the time.
TEST_F(PeersMatch, MovesPucksThatStayTooLongForBothAlike) {
  std::string text = scene_text("match");
  const std::string seven = "possession_s = 7.0";
  ASSERT_NE(text.find(seven), std::string::npos);
  text.replace(text.find(seven), seven.size(), "possession_s = 0.5");
  played_ = (folder_ / "hasty.toml").string();
  std::ofstream(played_) << text;
  const Process& one = first("8", {"--bots", "1", "--players", "chaser-beginner"});
  const Process& two = second(one, {"--bots", "1", "--players", "chaser-beginner"});
  ASSERT_TRUE(are_over(one, two)) << one.stderr_tail() << two.stderr_tail();
  EXPECT_EQ(report("first").at("hash"), report("second").at("hash"));
  const KeyLog log = record("first");
  EXPECT_EQ(log, record("second"));
  Game game(recorded_scene(log, "first"));
  for (const InputEvent& event : log.events) game.submit(event);
  std::size_t served = 0;
  for (double now = 0.02; now < *log.until; now += 0.02) {
    game.advance(now);
    served += served_in(game).size();
  }
  EXPECT_GT(served, 5u);
}

/// Of bytes with all heads; both figures are printed. Bots of the same kind play.
TEST_F(PeersMatch, TakesAtMostTwiceThePayloadOfOneWithAServer) {
  const std::string file = (folder_ / "server.json").string();
  const Process& server = *peers_.emplace_back(std::make_unique<Process>(
      test::binary_folder() + "/bin/rink-serve",
      Words{"match", "--port", "0", "--report", file, "--record", (folder_ / "served").string()}));
  ASSERT_TRUE(until([&] { return server.line_after("listening on ").has_value(); }));
  const Process& rivals = *peers_.emplace_back(
      std::make_unique<Process>(test::binary_folder() + "/bin/rink-duel",
                                Words{"--connect", place_of(server), "--duration", "12"}));
  ASSERT_TRUE(ends(rivals)) << rivals.stderr_tail();
  ASSERT_EQ(kill(server.id(), SIGINT), 0);
  ASSERT_TRUE(ends(server));
  const KeyLog played = read_key_log(folder_ / "served" / "match-1.keys");
  const double served = report("server").at("bytes_sent").get<double>() / 2.0 / *played.until;

  const Process& one = first("8", {"--bots", "1"});
  const Process& two = second(one, {"--bots", "1"});
  ASSERT_TRUE(are_over(one, two)) << one.stderr_tail() << two.stderr_tail();
  for (const char* name : {"first", "second"}) {
    const double told = bytes_per_s(report(name));
    std::printf("%s peer: %.0f B/s; a server to each of its players: %.0f B/s\n", name, told,
                served);
    EXPECT_LE(told, 2.0 * served);
  }
}

TEST_F(PeersMatch, IsOfOnePeersTwoBotsToo) {
  const Process& one = first("3", {"--transport", "shm", "--bots", "2", "--players", "random"});
  const Process& two = second(one, {"--transport", "shm"});
  ASSERT_TRUE(are_over(one, two)) << one.stderr_tail() << two.stderr_tail();
  EXPECT_EQ(one.ending()->exit_status, 0) << one.stderr_tail();
  EXPECT_EQ(record("first"), record("second"));
  EXPECT_EQ(report("second").at("key_presses"), 0u);
}

/// Whichever it is; its bat then holds no key, and of two the second may have a rival.
TEST_F(PeersMatch, GoesOnWithoutAPeerThatIsKilled) {
  for (const int killed : {0, 1}) {
    SCOPED_TRACE(killed);
    const Process& one = first("6", {"--bots", "2"});
    const Process& two = second(one, {"--bots", "0"});
    ASSERT_TRUE(are_playing({&one, &two}));
    until([] { return false; }, 4s);  // a second of the match is over
    const Process& left = killed == 0 ? two : one;
    ASSERT_EQ(kill((killed == 0 ? one : two).id(), SIGKILL), 0);
    if (killed == 0) {
      // Both players were there: the match is over, for nobody is left to play it.
      ASSERT_TRUE(ends(left, 60s));
      EXPECT_EQ(left.ending()->exit_status, static_cast<int>(ExitStatus::may_have_split))
          << left.stderr_tail();
    } else {
      ASSERT_TRUE(ends(left, 60s));
      EXPECT_EQ(left.ending()->exit_status, 0) << left.stderr_tail();
      EXPECT_EQ(report("first").at("lost"), Json({1}));
    }
    EXPECT_THAT(left.stderr_tail(), HasSubstr("this peer continues alone"));
    record(killed == 0 ? "second" : "first");
  }
}

/// Unlike one that is killed it says so, and plays on nowhere.
TEST_F(PeersMatch, IsThatOfBothIfTheFirstIsInterrupted) {
  const Process& one = first("6", {"--bots", "2"});
  const Process& two = second(one, {"--bots", "0"});
  ASSERT_TRUE(are_playing({&one, &two}));
  until([] { return false; }, 4s);  // a second of the match is over
  ASSERT_EQ(kill(one.id(), SIGINT), 0);
  ASSERT_TRUE(are_over(one, two));
  EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::interrupted));
  EXPECT_EQ(two.ending()->exit_status, 0) << two.stderr_tail();
  EXPECT_THAT(two.stderr_tail(), HasSubstr("was interrupted: this peer continues alone"));
  EXPECT_EQ(report("second").at("lost"), Json({0}));
  record("second");
}

TEST_F(PeersMatch, WaitsForItsPlayersForAWhileOnly) {
  const Process& one = first("3", {"--bots", "1", "--patience", "2"});
  const Process& two = second(one, {"--patience", "2"});
  ASSERT_TRUE(are_over(one, two));
  EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::nobody_came));
  EXPECT_THAT(one.stderr_tail(), HasSubstr("two players did not come within 2 s"));
}

TEST_F(PeersMatch, HasNoRoomForAThirdBot) {
  const Process& one = first("30", {"--bots", "2"});
  const Process& two = second(one, {"--bots", "1"});
  ASSERT_TRUE(until([&] { return one.ending() || two.ending(); }));
  const Process& refused = two.ending() ? two : one;  // both ask at once
  EXPECT_EQ(refused.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(refused.stderr_tail(), HasSubstr("--bots: no bat of the match is free"));
}

TEST_F(PeersMatch, RefusesFlagsOfGamesThatAreDivided) {
  for (const Words& flags : {Words{"--scheme", "region"}, Words{"--scheme", "none"}}) {
    const Process& one = first("3", flags);
    ASSERT_TRUE(ends(one));
    EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::bad_input));
    EXPECT_THAT(one.stderr_tail(),
                HasSubstr("in a match, scene 'match', every peer has all bodies"));
  }
  for (const char* flag : {"--balance", "--policy", "--view", "--view-area", "--view-margin"}) {
    const Process& one = first("3", {flag, flag == std::string("--policy") ? "periodic" : "1"});
    ASSERT_TRUE(ends(one));
    EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::bad_input));
    EXPECT_THAT(one.stderr_tail(), HasSubstr(std::string("expected no ") + flag));
  }
  const Process& hasty = first("3", {"--pace", "free"});
  ASSERT_TRUE(ends(hasty));
  EXPECT_EQ(hasty.ending()->exit_status, static_cast<int>(ExitStatus::bad_input));
  EXPECT_THAT(hasty.stderr_tail(), HasSubstr("goes by the clock: expected realtime, not 'free'"));
}

}  // namespace
}  // namespace rink::game
