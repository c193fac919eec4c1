// Servers that share one simulation, rink-serve with --nodes and --join: clients of each play the
// game of one engine.
#include <algorithm>
#include <optional>
#include <thread>

#include "game/control/replay.h"
#include "tests/peer_command/node_processes.h"

namespace rink::game {
namespace {

TEST_F(NodeCommand, PlaysWithClientsOfEachNodeTheGameOfOneEngine) {
  Process& one = first();
  Process& two = join(one);
  const std::vector<const Process*> bots_of_each{&bots(one), &bots(two)};
  for (const Process* node : {&one, &two}) {
    ASSERT_TRUE(ends(*node, 60s));
    EXPECT_EQ(node->ending()->exit_status, 0) << node->stderr_tail();
  }
  for (const Process* bot : bots_of_each) {
    ASSERT_TRUE(ends(*bot));
    EXPECT_EQ(bot->ending()->exit_status, 0) << bot->stderr_tail();
  }
  const std::optional<std::string> words = one.line_after("node 0 of 2: ");
  EXPECT_EQ(words, two.line_after("node 1 of 2: "));
  const KeyLog log = read_key_log(std::filesystem::path(record_of("first")));
  EXPECT_EQ(log, read_key_log(std::filesystem::path(record_of("second"))));
  ASSERT_TRUE(log.hash && words);
  EXPECT_EQ(replay(log, recorded_scene(log, "first.keys")), *log.hash);
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(*log.hash));
  EXPECT_THAT(*words, HasSubstr(text));
  std::vector<int> counts(8, 0);
  for (const InputEvent& event : log.events) ++counts[event.player];
  EXPECT_THAT(counts, testing::Each(testing::Gt(0))) << "players of both nodes pressed keys";
}

TEST_F(NodeCommand, GivesFreeBatsToLatecomersAtEachNodeAndNoneTwice) {
  Process& one = first({"--clients", "3", "--duration", "7"});
  Process& two = join(one, {"--clients", "3"});
  std::vector<const Process*> all{&one, &two, &bots(one, {"--count", "3", "--duration", "7"}),
                                  &bots(two, {"--count", "3", "--duration", "7"})};
  ASSERT_TRUE(
      until([&] { return one.line_after("listening on ") && two.line_after("listening on "); }));
  std::this_thread::sleep_for(2s);
  all.push_back(&bot(one, "6", "7")), all.push_back(&bot(two, "6", "7"));
  std::this_thread::sleep_for(1s);
  const Process& surplus = bot(one, "7", "7");
  for (const Process* each : all) {
    ASSERT_TRUE(ends(*each, 60s));
    EXPECT_EQ(each->ending()->exit_status, 0) << each->stderr_tail();
  }
  ASSERT_TRUE(ends(surplus));
  EXPECT_THAT(surplus.stderr_tail(), HasSubstr("no bat is free"));
  const KeyLog log = same_log({record_of("first"), record_of("second")});
  for (std::uint32_t player = 0; player < 8; ++player)
    EXPECT_FALSE(keys_of(log, player).empty()) << player;
}

TEST_F(NodeCommand, KeepsTheBatOfAKilledClientUntilItComesBackToAnotherNode) {
  Process& one = first({"--clients", "2", "--duration", "9"});
  Process& two = join(one, {"--clients", "2"});
  const std::vector<const Process*> bots_of_each{&bots(one, {"--count", "2", "--duration", "9"}),
                                                 &bots(two, {"--count", "2", "--duration", "9"})};
  ASSERT_TRUE(
      until([&] { return one.line_after("listening on ") && two.line_after("listening on "); }));
  std::this_thread::sleep_for(1s);
  const Process& killed = bot(one, "7", "9");
  std::this_thread::sleep_for(2s);
  ASSERT_EQ(kill(killed.id(), SIGKILL), 0);
  std::this_thread::sleep_for(500ms);
  const Process& other = bot(two, "5", "9");
  std::this_thread::sleep_for(1s);
  const Process& back = bot(two, "7", "9");
  const std::vector<const Process*> all{&one, &two, &other, &back};
  for (const Process* each : all) {
    ASSERT_TRUE(ends(*each, 60s));
    EXPECT_EQ(each->ending()->exit_status, 0) << each->stderr_tail();
  }
  const KeyLog log = same_log({record_of("first"), record_of("second")});
  const std::vector<InputEvent> keys = keys_of(log, 7);
  KeysHeld held;
  bool was_away = false;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool is_pause = k > 0 && keys[k].time > keys[k - 1].time + 1.2;
    if (is_pause) {
      EXPECT_EQ(held, KeysHeld()) << "released before " << keys[k].time;
    }
    was_away = was_away || is_pause;
    held.set(keys[k].key, keys[k].kind == InputKind::key_down);
  }
  EXPECT_TRUE(was_away && keys.back().time > 7.0) << "it was away, and is back";
  EXPECT_FALSE(keys_of(log, 5).empty());
  EXPECT_TRUE(keys_of(log, 4).empty() && keys_of(log, 6).empty());
}

TEST_F(NodeCommand, CountsGoalsAlikeAtAllNodesAndInTheRecord) {
  const std::string goals = (folder_ / "goals.toml").string();
  std::string text = small_scene;
  text.replace(text.find("width = 3.0"), 11, "width = 3.0\ngoal_width = 1.5");
  std::ofstream(goals) << text << "[match]\nface_off_delay = 0.5\nface_off_distance = 0.3\n";
  Process& one = serve(
      "first",
      {"--nodes", "2", "--node-listen", "127.0.0.1:0", "--duration", "3", "--clients", "0"}, goals);
  Process& two = serve(
      "second", {"--join", place_among_nodes(one).value_or("nowhere:1"), "--clients", "0"}, goals);
  for (const Process* node : {&one, &two}) {
    ASSERT_TRUE(ends(*node, 60s));
    EXPECT_EQ(node->ending()->exit_status, 0) << node->stderr_tail();
  }
  const KeyLog log = same_log({record_of("first"), record_of("second")});
  Game game(recorded_scene(log, "first.keys"));
  game.advance(log.until.value_or(0.0));
  EXPECT_GT(game.score().left + game.score().right, 0u);
  const std::optional<std::string> words = one.line_after("node 0 of 2: ");
  EXPECT_EQ(words, two.line_after("node 1 of 2: "));
  EXPECT_THAT(words.value_or(""), HasSubstr("goals " + std::to_string(game.score().left) + ":" +
                                            std::to_string(game.score().right)));
}

TEST_F(NodeCommand, LetsBotsPlayToTheirEndAfterASideHasWon) {
  const std::string goals = (folder_ / "goals.toml").string();
  std::string text = small_scene;
  text.replace(text.find("width = 3.0"), 11, "width = 3.0\ngoal_width = 1.5");
  std::ofstream(goals) << text << "[match]\ngoals_to_win = 2\nface_off_delay = 0.5\n";
  Process& one =
      serve("first", {"--nodes", "2", "--node-listen", "127.0.0.1:0", "--duration", "60"}, goals);
  Process& two = serve("second", {"--join", place_among_nodes(one).value_or("nowhere:1")}, goals);
  const Words further{"--scene", goals, "--duration", "6"};
  const std::vector<const Process*> all{&one, &two, &bots(one, further), &bots(two, further)};
  for (const Process* each : all) {
    ASSERT_TRUE(ends(*each, 50s)) << "long before 60 s";
    EXPECT_EQ(each->ending()->exit_status, 0) << each->stderr_tail();
  }
  const KeyLog log = same_log({record_of("first"), record_of("second")});
  EXPECT_LT(log.until.value_or(60.0), 6.0) << "a side had won";
}

TEST_F(NodeCommand, RefusesOtherScenesAndPeersAndGoesOn) {
  Process& one = first();
  const Process& seeded = join(one, {"--seed", "9"});
  ASSERT_TRUE(ends(seeded));
  EXPECT_EQ(seeded.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(seeded.stderr_tail(), HasSubstr("another scene: its fingerprint is"));
  const Process& greedy = join(one, {"--clients", "5"});
  ASSERT_TRUE(ends(greedy));
  EXPECT_EQ(greedy.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(greedy.stderr_tail(), HasSubstr("it wants to play 5 bats, of 8 here 4 are free"));
  const Process& peer = start({"--join", place_among_nodes(one).value_or("nowhere:1")});
  ASSERT_TRUE(ends(peer));
  EXPECT_EQ(peer.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_FALSE(one.ending());
}

TEST_F(NodeCommand, SaysHowManyNodesCameInTime) {
  Process& one = first({"--nodes", "3", "--patience", "2"});
  Process& two = join(one);
  for (const Process* node : {&one, &two}) ASSERT_TRUE(ends(*node));
  EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::nobody_came));
  EXPECT_THAT(one.stderr_tail(), HasSubstr("2 of 3 came within 2 s"));
  EXPECT_EQ(two.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(two.stderr_tail(), HasSubstr("2 of 3 came within 2 s")) << "it hears why";
}

TEST_F(NodeCommand, EndsAtOnceWhenInterruptedFarBehindTheClock) {
  Process& one = serve("first", {"--nodes", "1", "--node-listen", "127.0.0.1:0", "--duration", "60",
                                 "--rate", "1000", "--clients", "0", "--bats", "3000"});
  ASSERT_TRUE(until([&] { return one.line_after("listening on ").has_value(); }));
  std::this_thread::sleep_for(2s);
  ASSERT_EQ(kill(one.id(), SIGINT), 0);
  ASSERT_TRUE(ends(one));
  EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::interrupted));
}

TEST_F(NodeCommand, SaysWhatNodesCannotPlay) {
  const std::vector<std::pair<Words, std::string>> cases{
      {{"--nodes", "2", "--node-listen", "127.0.0.1:0"}, "expected a --duration above 0"},
      {{"--nodes", "2", "--duration", "1"}, "--node-listen ADDRESS:PORT is missing"},
      {{"--node-listen", "127.0.0.1:0"}, "expected --nodes or --join beside it"},
      {{"--nodes", "2", "--pace", "synchronous", "--duration", "1"}, "in real time"},
      {{"--nodes", "2", "--node-listen", "127.0.0.1:0", "--duration", "1", "--budget", "9"},
       "--budget: nodes play each window whole"},
      {{"--join", "127.0.0.1:1", "--absence", "9"}, "--absence: the first node"},
      {{"--transport", "mpi", "--unmirrored"}, "--unmirrored: MPI ends all ranks"}};
  for (const auto& [arguments, complaint] : cases) {
    const Process& node = serve("first", arguments);
    ASSERT_TRUE(ends(node));
    EXPECT_EQ(node.ending()->exit_status, 2) << complaint;
    EXPECT_THAT(node.stderr_tail(), HasSubstr(complaint));
  }
  const Process& alone = serve("first", {"--join", "127.0.0.1:1"});
  ASSERT_TRUE(ends(alone));
  EXPECT_EQ(alone.ending()->exit_status, static_cast<int>(ExitStatus::no_server));
}

}  // namespace
}  // namespace rink::game
