// Two nodes in one process, over sockets, and in place of their servers the test: what both show is
// the game of one engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "game/model/scene_file.h"
#include "game/node/node.h"
#include "game/node/socket_meeting.h"
#include "tests/peer_command/uneven_scene.h"

namespace rink::game {
namespace {

constexpr double tick_s = 1.0 / 60.0;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Four bats and 40 pucks; with goals of that width [m], and `rules` of a match.
Scene scene_of_four(const std::string& goal_width = "0.0", const std::string& rules = "") {
  return parse_scene(R"(
name = "four"
[field]
length = 3.0
width = 2.0
goal_width = )" + goal_width +
                         "\n" + rules + R"(
[drag]
pucks = 0.1
bats = 3.0
[[population]]
name = "bat"
kind = "bat"
count = 4
mass = 5.0
[[population]]
name = "puck"
kind = "puck"
count = 40
mean_speed = 1.0
speeds = "maxwell"
)",
                     "four.toml");
}

/// A node, and what its server would show.
struct ShownNode {
  ShownNode(const Scene& scene, std::unique_ptr<SocketMeeting> meets,
            std::uint32_t player_count = 1)
      : game(scene, {}),
        meeting(std::move(meets)),
        node(game, *meeting, {.player_count = player_count}, now_s),
        shown(scene) {}

  void show(double until) {
    while (const auto felt = node.show_next(until, shown))
      keys.insert(keys.end(), felt->keys.begin(), felt->keys.end());
  }

  SharedGame game;
  std::unique_ptr<SocketMeeting> meeting;
  Node node;
  Game shown;
  std::vector<InputEvent> keys;
};

class TwoNodes : public testing::Test {
 protected:
  /// Node 0 has a player of bat 0, node 1 one of bat 1; 2 and 3 are free.
  void meet(double until, const Scene& scene = scene_of_four()) {
    scene_ = scene;
    const Place any{"127.0.0.1", 0};
    one_ = std::make_unique<ShownNode>(
        scene_, std::make_unique<SocketMeeting>(any, terms_of_nodes(2, until, tick_s)));
    two_ = std::make_unique<ShownNode>(
        scene_, std::make_unique<SocketMeeting>(any, one_->meeting->place().value()));
    std::thread other([&] { one_->node.meet(); });
    two_->node.meet();
    other.join();
    for (bool one = false, two = false; !one || !two;) {
      one = one_->node.may_begin(), two = two_->node.may_begin();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    for (ShownNode* each : {one_.get(), two_.get()}) each->node.begin();
    until_ = until;
  }
  /// Both show all until `is_reached()`, or the end.
  template <class IsReached>
  void play(IsReached&& is_reached) {
    while (!is_reached() && one_->shown.now() + two_->shown.now() < 2.0 * until_) {
      one_->show(until_), two_->show(until_);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  std::optional<std::uint32_t> seat(ShownNode& at, std::uint64_t token) {
    at.node.ask_seat({.token = token});
    std::optional<SharedPlay::SeatAnswer> answer;
    play([&] {
      if (!answer) answer = at.node.next_seat();
      return answer.has_value();
    });
    EXPECT_TRUE(answer && answer->token == token);
    return answer ? answer->player : std::nullopt;
  }
  static std::size_t count_of(const ShownNode& node, std::uint32_t player) {
    return static_cast<std::size_t>(std::ranges::count(node.keys, player, &InputEvent::player));
  }
  /// Until that many keys of the player have been shown.
  void await(std::uint32_t player, std::size_t count) {
    play([&] { return count_of(*one_, player) == count; });
    EXPECT_EQ(count_of(*one_, player), count);
  }

  /// That both nodes have shown what one engine plays with their keys.
  void expect_one_game() {
    const PlayedPart& part = one_->node.finish();
    EXPECT_EQ(two_->node.finish().hash, part.hash);
    for (const ShownNode* each : {one_.get(), two_.get()}) {
      EXPECT_EQ(each->shown.hash(), part.hash);
      EXPECT_EQ(each->shown.score(), part.score);
    }
    Game engine(scene_);
    for (const InputEvent& key : part.keys) engine.submit(key);
    engine.advance(part.time);
    EXPECT_EQ(engine.hash(), part.hash);
    EXPECT_EQ(engine.score(), part.score);
  }

  Scene scene_;
  std::unique_ptr<ShownNode> one_, two_;
  double until_ = 0.0;
};

TEST_F(TwoNodes, GiveBatsToLatecomersAndMoveThemFromNodeToNode) {
  meet(3.0);
  one_->node.press(0, Key::right, true, 0.0);
  EXPECT_EQ(seat(*two_, 7), 2u) << "the first that is free";
  two_->node.press(2, Key::up, true, 0.0);
  two_->node.press(2, Key::up, false, 0.0);
  await(2, 2);
  two_->node.leave_seat(2, 7);
  EXPECT_EQ(seat(*one_, 8), 3u) << "2 is kept";
  EXPECT_EQ(seat(*two_, 9), std::nullopt);
  EXPECT_EQ(seat(*one_, 7), 2u) << "it is back, at another node";
  two_->node.press(2, Key::down, true, 0.0);  // of a player that is not there any more
  one_->node.press(2, Key::left, true, 0.0);
  await(2, 3);
  play([] { return false; });
  EXPECT_EQ(count_of(*one_, 0), 1u);
  EXPECT_EQ(one_->keys, two_->keys);
  expect_one_game();
}

/// Node 0 hears of them all between two windows.
TEST_F(TwoNodes, AnswerFiveThousandWishesForABatAtOnce) {
  constexpr std::uint64_t wishes = 5000;
  meet(2.0);
  for (std::uint64_t token = 1; token <= wishes; ++token) two_->node.ask_seat({.token = token});
  std::uint64_t answers = 0, bats = 0;
  play([&] {
    while (const auto answer = two_->node.next_seat()) ++answers, bats += answer->player ? 1 : 0;
    return answers == wishes;
  });
  EXPECT_EQ(answers, wishes);
  EXPECT_EQ(bats, 2u) << "those that are free";
  play([] { return false; });
  expect_one_game();
}

TEST_F(TwoNodes, CountGoalsAndPutPucksBackAsOneEngine) {
  meet(2.0, scene_of_four("1.0", "[match]\nface_off_delay = 0.21\nface_off_distance = 0.25"));
  play([] { return false; });
  EXPECT_GT(one_->shown.score().left + one_->shown.score().right, 3u);
  expect_one_game();
}

TEST_F(TwoNodes, ShiftZonesTowardEqualLoadUnderTheirPlayers) {
  meet(3.0, parse_scene(uneven_scene(), "uneven.toml"));
  for (std::size_t count = 1; count <= 12; ++count) {
    one_->node.press(0, Key::right, count % 2 == 1, 0.0);
    two_->node.press(1, Key::up, count % 2 == 1, 0.0);
    await(0, count), await(1, count);
  }
  play([] { return false; });
  EXPECT_GT(one_->node.finish().counters.shifts, 0u);
  expect_one_game();
}

TEST_F(TwoNodes, EndWithTheWindowInWhichASideWins) {
  meet(20.0, scene_of_four("1.0", "[match]\ngoals_to_win = 2\nface_off_delay = 0.21"));
  play([&] { return one_->node.has_shown_all() && two_->node.has_shown_all(); });
  EXPECT_TRUE(one_->shown.is_over() && two_->shown.is_over());
  EXPECT_LT(one_->shown.now(), 20.0);
  expect_one_game();
}

/// A row of pucks, and a bat at each end.
Scene long_row() {
  std::string text = R"(
name = "row"
[field]
length = 24.0
width = 1.0
[drag]
bats = 3.0
)";
  for (const char* x : {"23.5", "0.5"})
    text += std::string("[[bat]]\nposition = [") + x + ", 0.5]\nhalf_extent = [0.1, 0.1]\n";
  for (int k = 1; k < 24; ++k)
    text += "[[puck]]\nposition = [" + std::to_string(k) + ".0, 0.2]\nvelocity = [0.1, 0.0]\n";
  return parse_scene(text, "row.toml");
}

TEST(ThreeNodesInARow, CarryManyKeysOfALatecomerToTheOwnerThatIsNoNeighbour) {
  constexpr double until = 2.0;
  const Place any{"127.0.0.1", 0};
  const Scene scene = long_row();
  std::vector<std::unique_ptr<ShownNode>> nodes;
  nodes.push_back(std::make_unique<ShownNode>(
      scene, std::make_unique<SocketMeeting>(any, terms_of_nodes(3, until, tick_s)), 0u));
  for (int k = 1; k < 3; ++k)
    nodes.push_back(std::make_unique<ShownNode>(
        scene, std::make_unique<SocketMeeting>(any, nodes.front()->meeting->place().value()), 0u));
  std::vector<std::thread> meeting;
  for (const auto& each : nodes) meeting.emplace_back([&each] { each->node.meet(); });
  for (std::thread& each : meeting) each.join();
  for (std::size_t ready = 0; ready < nodes.size();) {
    ready = 0;
    for (const auto& each : nodes) ready += each->node.may_begin();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  for (const auto& each : nodes) each->node.begin();
  // Numbers follow the order in which nodes came; the first is node 0, in the zone of the other
  // bat.
  ShownNode& first = *nodes.front();
  first.node.ask_seat({.token = 7, .player = 0});
  while (!first.node.next_seat()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  for (int k = 0; k < 20; ++k) first.node.press(0, Key::up, k % 2 == 0, 0.0);
  for (const auto& each : nodes)
    while (each->shown.now() < until) {
      each->show(until);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  EXPECT_EQ(first.keys.size(), 20u);
  Game engine(scene);
  for (const InputEvent& key : first.keys) engine.submit(key);
  engine.advance(until);
  for (const auto& each : nodes) EXPECT_EQ(each->node.finish().hash, engine.hash());
}

}  // namespace
}  // namespace rink::game
