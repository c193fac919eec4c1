// Servers that share one simulation and are killed or stopped: the others go on with the game of
// one engine, or say why not.
#include <thread>

#include "tests/peer_command/node_processes.h"

namespace rink::game {
namespace {

class NodeLoss : public NodeCommand {
 protected:
  /// Nothing before all are there.
  static std::string number_of(const Process& node) {
    const std::string line = node.line_after("this is node ").value_or("");
    return line.substr(0, line.find(' '));
  }
};

TEST_F(NodeLoss, UnmirroredEndsWithTheNodeThatIsKilledAndSaysSo) {
  Process& one = first({"--duration", "1000", "--unmirrored"});
  Process& two = join(one);
  bots(one, {"--view", "1"}), bots(two);  // so that the first node is told of everything
  ASSERT_TRUE(
      until([&] { return one.line_after("listening on ") && two.line_after("listening on "); }));
  std::this_thread::sleep_for(2s);
  ASSERT_EQ(kill(two.id(), SIGKILL), 0);
  ASSERT_TRUE(ends(one, 60s));
  EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(one.stderr_tail(), HasSubstr("peer 1"));
  const KeyLog log = read_key_log(std::filesystem::path(record_of("first")));
  ASSERT_TRUE(log.hash);
  EXPECT_EQ(replay(log, recorded_scene(log, "first.keys")), *log.hash) << "nothing it had is lost";
}

TEST_F(NodeLoss, UnmirroredLosesASilentNodeAfterThePatienceWithNodes) {
  Process& one =
      first({"--clients", "0", "--duration", "1000", "--node-patience", "1", "--unmirrored"});
  Process& two = join(one, {"--clients", "0"});
  ASSERT_TRUE(
      until([&] { return one.line_after("listening on ") && two.line_after("listening on "); }));
  std::this_thread::sleep_for(1s);
  ASSERT_EQ(kill(two.id(), SIGSTOP), 0);
  ASSERT_TRUE(ends(one));
  EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(one.stderr_tail(), HasSubstr("was silent for 1 s"));
}

TEST_F(NodeLoss, GoesOnWithoutANodeThatIsKilledWithTheGameOfOneEngine) {
  Process& one = first({"--nodes", "3", "--clients", "2", "--duration", "9"});
  Process& two = join(one, {"--clients", "2"});
  const std::string place = place_among_nodes(one).value_or("nowhere:1");
  Process& third = serve("third", {"--join", place, "--clients", "2"});
  ASSERT_TRUE(until([&] { return !number_of(one).empty() && !number_of(third).empty(); }));
  const std::string lost = number_of(third);  // whoever comes first is counted first
  const std::uint32_t lost_player = 2 * static_cast<std::uint32_t>(std::stoul(lost));
  const Words two_bots{"--count", "2", "--duration", "9"};
  const Process &bots_of_one = bots(one, two_bots), &bots_of_two = bots(two, two_bots),
                &bots_of_third = bots(third, two_bots);
  ASSERT_TRUE(until([&] {
    return one.line_after("listening on ") && two.line_after("listening on ") &&
           third.line_after("listening on ");
  }));
  const Process& alone = bot(third, "7", "9");  // in a bat that is free
  std::this_thread::sleep_for(3s);
  ASSERT_EQ(kill(third.id(), SIGKILL), 0);
  for (const Process* node : {&one, &two})
    EXPECT_TRUE(until(
        [&] { return node->stderr_tail().find("2 peers go on from") != std::string::npos; }))
        << node->stderr_tail();
  const Process& back = bot(one, "7", "9");
  for (const Process* each :
       std::vector<const Process*>{&one, &two, &bots_of_one, &bots_of_two, &back}) {
    ASSERT_TRUE(ends(*each, 60s));
    EXPECT_EQ(each->ending()->exit_status, 0) << each->stderr_tail();
  }
  for (const Process* each : {&bots_of_third, &alone}) {
    ASSERT_TRUE(ends(*each));
    EXPECT_NE(each->ending()->exit_status, 0) << "their server is gone";
  }
  EXPECT_THAT(one.stderr_tail() + two.stderr_tail(), HasSubstr("peer " + lost + " ("));
  const KeyLog log = same_log({record_of("first"), record_of("second")});
  // Which of the lost node's three players has which bat depends on who came first.
  std::uint32_t players = 0, went_on = 0;
  for (std::uint32_t player = 0; player < 8; ++player) {
    const std::vector<InputEvent> keys = keys_of(log, player);
    if (keys.empty()) continue;
    ++players;
    if (keys.back().time > 6.0) {
      ++went_on;
      continue;
    }
    EXPECT_TRUE(player / 2 == lost_player / 2 || player >= 6) << player;
    KeysHeld held;
    for (const InputEvent& key : keys) held.set(key.key, key.kind == InputKind::key_down);
    EXPECT_EQ(held, KeysHeld()) << "those of the lost node's players are released";
  }
  EXPECT_EQ(players, 7u);
  EXPECT_EQ(went_on, 5u) << "four at nodes that are left, and the one that is back";
}

TEST_F(NodeLoss, LeavesTheSecondOfTwoAloneWhichCannotKnowThatTheFirstIsDead) {
  Process& one = first({"--duration", "5"});
  Process& two = join(one);
  const Process& lost_bots = bots(one, {"--duration", "5"});
  const Process& own_bots = bots(two, {"--duration", "5"});
  ASSERT_TRUE(
      until([&] { return one.line_after("listening on ") && two.line_after("listening on "); }));
  std::this_thread::sleep_for(2s);
  ASSERT_EQ(kill(one.id(), SIGKILL), 0);
  for (const Process* each : std::vector<const Process*>{&two, &own_bots, &lost_bots})
    ASSERT_TRUE(ends(*each, 60s));
  EXPECT_EQ(two.ending()->exit_status, static_cast<int>(ExitStatus::may_have_split));
  EXPECT_THAT(two.stderr_tail(), HasSubstr("this peer continues alone"));
  EXPECT_THAT(two.stderr_tail(), HasSubstr("the other may have done so too"));
  EXPECT_EQ(own_bots.ending()->exit_status, 0) << own_bots.stderr_tail();
  same_log({record_of("second")});
}

TEST_F(NodeLoss, GoesOnWithoutANodeThatIsFrozenWhichDoesNotEndWell) {
  Process& one =
      first({"--nodes", "3", "--clients", "0", "--duration", "5", "--node-patience", "1"});
  const Words none{"--clients", "0", "--node-patience", "1"};
  Process& two = join(one, none);
  Process& third = serve("third", {"--join", place_among_nodes(one).value_or("nowhere:1"),
                                   "--clients", "0", "--node-patience", "1"});
  ASSERT_TRUE(until([&] {
    return one.line_after("listening on ") && two.line_after("listening on ") &&
           third.line_after("listening on ");
  }));
  std::this_thread::sleep_for(1s);
  ASSERT_EQ(kill(one.id(), SIGSTOP), 0);
  for (const Process* node : {&two, &third}) {
    ASSERT_TRUE(ends(*node, 60s));
    EXPECT_EQ(node->ending()->exit_status, 0) << node->stderr_tail();
  }
  EXPECT_THAT(two.stderr_tail() + third.stderr_tail(), HasSubstr("was silent for 1 s"));
  ASSERT_EQ(kill(one.id(), SIGCONT), 0);
  ASSERT_TRUE(ends(one));
  EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost))
      << one.stderr_tail();
  same_log({record_of("second"), record_of("third")});
}

TEST_F(NodeLoss, EndsAllWhenANodeIsLostTogetherWithItsStandby) {
  Process& one = first({"--nodes", "4", "--clients", "0", "--duration", "1000"});
  std::vector<Process*> others;
  for (const char* name : {"second", "third", "fourth"})
    others.push_back(
        &serve(name, {"--join", place_among_nodes(one).value_or("nowhere:1"), "--clients", "0"}));
  ASSERT_TRUE(until([&] {
    return one.line_after("listening on ") &&
           std::ranges::none_of(others, [](Process* each) { return number_of(*each).empty(); });
  }));
  std::this_thread::sleep_for(2s);
  std::vector<const Process*> left{&one};
  for (Process* each : others)
    if (number_of(*each) == "1" || number_of(*each) == "2")
      ASSERT_EQ(kill(each->id(), SIGKILL), 0);
    else left.push_back(each);
  ASSERT_EQ(left.size(), 2u);
  for (const Process* node : left) {
    ASSERT_TRUE(ends(*node));
    EXPECT_EQ(node->ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
    EXPECT_THAT(node->stderr_tail(), HasSubstr("gone"));
  }
}

TEST_F(NodeLoss, AdmitsNoNodeWhileOthersPlay) {
  Process& one = first({"--nodes", "1", "--clients", "0", "--duration", "60"});
  ASSERT_TRUE(until([&] { return one.line_after("listening on ").has_value(); }));
  std::this_thread::sleep_for(500ms);
  const Process& late = join(one, {"--clients", "0"});
  ASSERT_TRUE(ends(late));
  EXPECT_EQ(late.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(late.stderr_tail(), HasSubstr("none can join them any more"));
  EXPECT_FALSE(one.ending());
}

TEST_F(NodeLoss, NoticesALossWhileItWaitsForItsOwnPlayers) {
  Process& one = first();
  Process& two = join(one);
  ASSERT_TRUE(
      until([&] { return one.line_after("listening on ") && two.line_after("listening on "); }));
  ASSERT_EQ(kill(two.id(), SIGKILL), 0);
  ASSERT_TRUE(ends(one));
  EXPECT_EQ(one.ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
}

}  // namespace
}  // namespace rink::game
