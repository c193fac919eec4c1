// Nodes in one process, by TCP, of which some die or fall silent: the others show the game of one
// engine that is given the same keys, and release those of the lost nodes' players.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "game/model/random_stream.h"
#include "game/model/scene_file.h"
#include "game/node/node.h"
#include "tests/node/mortal_network.h"
#include "tests/peer_command/uneven_scene.h"

namespace rink::game::lost_nodes {
namespace {

using testing::HasSubstr;

constexpr double tick_s = 1.0 / 60.0;
constexpr double absence_s = 0.3;

/// Faster than the players' clocks, so that windows follow each other at once.
double now_s() {
  constexpr double speed = 8.0;
  return speed *
         std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Eight bats and 60 pucks; with goals of that width [m], and `rules` of a match.
Scene scene_of_eight(const std::string& goal_width = "0.0", const std::string& rules = "") {
  return parse_scene(R"(
name = "eight"
[field]
length = 4.0
width = 3.0
goal_width = )" + goal_width +
                         "\n" + rules + R"(
[drag]
pucks = 0.1
bats = 3.0
[[population]]
name = "bat"
kind = "bat"
count = 8
mass = 5.0
[[population]]
name = "puck"
kind = "puck"
count = 60
mean_speed = 1.0
speeds = "maxwell"
)",
                     "eight.toml");
}

/// A node, what its server would show, and what becomes of it.
struct MortalNode {
  MortalNode(const Scene& scene, std::unique_ptr<SocketMeeting> meets, double patience_s)
      : game(scene, {}),
        meeting(std::move(meets), mortality),
        node(game, meeting,
             {.player_count = 1,
              .patience_s = patience_s,
              .absence_s = absence_s,
              .notify =
                  [this](const std::string& text) {
                    const std::lock_guard lock(mutex);
                    told.push_back(text);
                  }},
             now_s),
        shown(scene) {}

  /// False once nothing more will come.
  bool show(double until) {
    if (!failure.empty()) return false;
    try {
      while (const auto felt = node.show_next(until, shown))
        keys.insert(keys.end(), felt->keys.begin(), felt->keys.end());
    } catch (const std::exception& error) {
      failure = error.what();
    }
    return failure.empty() && !node.has_shown_all();
  }

  std::vector<std::string> news() {
    const std::lock_guard lock(mutex);
    return told;
  }

  Mortality mortality;
  SharedGame game;
  MortalMeeting meeting;
  std::mutex mutex;
  std::vector<std::string> told;  ///< guarded by `mutex`: the node's thread tells
  Node node;
  Game shown;
  std::vector<InputEvent> keys;
  std::string failure;
};

/// Node k has a player of bat k, whose token is 100 + k; the other bats are free.
class LostNodes : public testing::Test {
 protected:
  void meet(std::uint32_t count, double until, const Scene& scene = scene_of_eight(),
            double patience_s = 240.0, std::uint32_t balance_windows = 0) {
    nodes_.clear();
    scene_ = scene, until_ = until;
    Terms terms = terms_of_nodes(count, until, tick_s, balance_windows);
    for (std::uint32_t k = 0; k < count; ++k)
      nodes_.push_back(std::make_unique<MortalNode>(
          scene_,
          k == 0 ? std::make_unique<SocketMeeting>(Place{"127.0.0.1", 0}, terms)
                 : std::make_unique<SocketMeeting>(Place{"127.0.0.1", 0},
                                                   nodes_[0]->meeting.place().value()),
          patience_s));
    // One after the other, so that each has its number.
    std::thread first([&] { nodes_[0]->node.meet(); });
    std::vector<std::thread> others;
    for (std::uint32_t k = 1; k < count; ++k) {
      others.emplace_back([&, k] { nodes_[k]->node.meet(); });
      std::this_thread::sleep_for(std::chrono::milliseconds(40));
    }
    first.join();
    for (std::thread& each : others) each.join();
    std::ranges::sort(nodes_, {}, [](const auto& each) { return each->node.number(); });
  }
  MortalNode& at(std::uint32_t number) { return *nodes_[number]; }
  void begin() {
    for (std::uint32_t k = 0; k < nodes_.size(); ++k) at(k).node.keep_seat(k, 100 + k);
    for (std::size_t ready = 0; ready < nodes_.size();) {
      ready = 0;
      for (const auto& each : nodes_) ready += each->node.may_begin();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    for (const auto& each : nodes_) each->node.begin();
  }
  /// All show what comes, and their players press keys, until `is_reached()` or the end.
  template <class IsReached>
  void play(IsReached&& is_reached) {
    while (!is_reached()) {
      bool goes_on = false;
      for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
        if (at(k).mortality.is_dead) continue;
        goes_on = at(k).show(until_) || goes_on;
        press(k);
      }
      if (!goes_on) return;
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
  }
  void play() {
    play([] { return false; });
  }
  void press(std::uint32_t k) {
    if (!at(k).failure.empty() || random_.below(3) != 0) return;
    const Key key = all_keys[random_.below(4)];
    at(k).node.press(k, key, random_.below(2) == 0, 0.0);
  }
  std::optional<std::uint32_t> seat(std::uint32_t k, std::uint64_t token) {
    at(k).node.ask_seat({.token = token});
    std::optional<SharedPlay::SeatAnswer> answer;
    play([&] {
      if (!answer) answer = at(k).node.next_seat();
      return answer.has_value();
    });
    EXPECT_TRUE(answer && answer->token == token);
    return answer ? answer->player : std::nullopt;
  }

  /// Those that have shown all have the same game, which is that of one engine. How many they are.
  std::size_t expect_one_game() {
    std::size_t count = 0;
    const PlayedPart* first = nullptr;
    for (const auto& each : nodes_) {
      if (each->mortality.is_dead || !each->failure.empty()) continue;
      const PlayedPart& part = each->node.finish();
      if (first == nullptr) first = &part;
      EXPECT_EQ(part.hash, first->hash);
      EXPECT_EQ(each->shown.hash(), part.hash);
      EXPECT_EQ(each->shown.score(), part.score);
      EXPECT_EQ(each->keys.size(), part.keys.size());
      ++count;
    }
    if (first == nullptr) return 0;
    keys_ = first->keys;
    Game engine(scene_);
    for (const InputEvent& key : keys_) engine.submit(key);
    engine.advance(first->time);
    EXPECT_EQ(engine.hash(), first->hash);
    EXPECT_EQ(engine.score(), first->score);
    return count;
  }
  /// By the keys of the game.
  KeysHeld held_by(std::uint32_t player) const {
    KeysHeld held;
    for (const InputEvent& key : keys_)
      if (key.player == player) held.set(key.key, key.kind == InputKind::key_down);
    return held;
  }

  Scene scene_;
  std::vector<std::unique_ptr<MortalNode>> nodes_;
  std::vector<InputEvent> keys_;
  RandomStream random_{7};
  double until_ = 0.0;
};

TEST_F(LostNodes, LeaveOthersWithTheGameOfOneEngineWhicheverWordWasTheirLast) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random_ = RandomStream(seed + 1);
    const std::uint32_t count = 2 + static_cast<std::uint32_t>(seed % 3);
    meet(count, 0.6);
    MortalNode& lost = at(random_.below(count));
    lost.mortality.last_word = 1 + random_.below(100 * (count - 1));
    begin();
    play();
    EXPECT_TRUE(lost.mortality.is_dead);
    EXPECT_EQ(expect_one_game(), count - 1);
    for (const auto& each : nodes_) {
      if (each.get() == &lost) continue;
      EXPECT_EQ(each->failure, "");
      EXPECT_EQ(each->news().size(), 1u);
      EXPECT_EQ(each->node.finish().may_have_split, count == 2 && lost.node.number() == 0);
    }
    if (lost.mortality.last_word < 70 * (count - 1)) {
      EXPECT_EQ(held_by(lost.node.number()), KeysHeld());
    }
  }
}

TEST_F(LostNodes, LeaveOthersWithOneResultWhicheverOfTheLastWordsTheySay) {
  meet(3, 0.2);
  begin();
  play();
  EXPECT_EQ(expect_one_game(), 3u);
  const std::uint64_t words = at(1).mortality.words;
  for (std::uint64_t last = 1; last <= 14; ++last) {
    SCOPED_TRACE("the last word but " + std::to_string(last - 1));
    meet(3, 0.2);
    const MortalNode& lost = at(static_cast<std::uint32_t>(last % 3));
    at(static_cast<std::uint32_t>(last % 3)).mortality.last_word = words - last;
    begin();
    play();
    // Keys come by real time, so it may have said fewer words than the node that was counted.
    EXPECT_EQ(expect_one_game(), lost.mortality.is_dead ? 2u : 3u);
  }
}

TEST_F(LostNodes, HaveTheirGoalsCountedAndTheirPucksPutBackByOthers) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random_ = RandomStream(seed + 100);
    meet(3, 1.0, scene_of_eight("1.5", "[match]\nface_off_delay = 0.21\nface_off_distance = 0.25"));
    at(random_.below(3)).mortality.last_word = 100 + random_.below(250);
    begin();
    play();
    EXPECT_EQ(expect_one_game(), 2u);
    EXPECT_GT(at(0).shown.score().left + at(0).shown.score().right, 0u);
  }
}

TEST_F(LostNodes, MayBeLostWhileZonesShift) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random_ = RandomStream(seed + 200);
    meet(3, 1.0, parse_scene(uneven_scene(), "uneven.toml"), 240.0, 4);
    at(random_.below(3)).mortality.last_word = 20 + random_.below(250);
    begin();
    play();
    EXPECT_EQ(expect_one_game(), 2u);
    for (const auto& each : nodes_)
      if (!each->mortality.is_dead) {
        EXPECT_GT(each->node.finish().counters.shifts, 0u);
      }
  }
}

TEST_F(LostNodes, MayBeLostOneAfterTheOther) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random_ = RandomStream(seed + 300);
    meet(4, 0.8);
    const std::uint32_t first = random_.below(2) == 0 ? 1 : 3, second = 4 - first;
    const std::uint64_t word = 20 + random_.below(200);
    at(first).mortality.last_word = word;
    at(second).mortality.last_word = word + 4 + random_.below(60);
    begin();
    play();
    EXPECT_EQ(expect_one_game(), 2u) << at((first + 1) % 4).failure;
    EXPECT_EQ(held_by(first), KeysHeld());
    EXPECT_EQ(held_by(second), KeysHeld());
  }
}

TEST_F(LostNodes, EndAllWhereTheirStandbyIsLostToo) {
  meet(4, 0.8);
  for (const std::uint32_t lost : {1u, 2u}) at(lost).mortality.last_word = 60;
  begin();
  play();
  for (const std::uint32_t left : {0u, 3u})
    EXPECT_THAT(at(left).failure, HasSubstr("are gone, and with them what peer"));
}

TEST_F(LostNodes, HavePlayersThatGetTheirBatsBackAtAnotherNode) {
  meet(3, 3.0);
  at(1).mortality.last_word = 40;
  begin();
  play([&] { return !at(0).news().empty() && !at(2).news().empty(); });
  EXPECT_EQ(seat(2, 101), 1u) << "its own";
  at(2).node.press(1, Key::up, true, 0.0);
  EXPECT_EQ(seat(0, 999), 3u) << "the first that is free";
  play();
  EXPECT_EQ(expect_one_game(), 2u);
  KeysHeld up;
  up.set(Key::up, true);
  EXPECT_EQ(held_by(1), up) << "pressed at its new node, after all others were released";
}

TEST_F(LostNodes, AreLostWhenTheyFallSilentAndDoNotComeBack) {
  meet(3, 1.0, scene_of_eight(), 16.0);
  at(0).mortality.last_word = 70, at(0).mortality.is_frozen = true;
  begin();
  play([&] { return at(1).node.has_shown_all() && at(2).node.has_shown_all(); });
  EXPECT_THAT(at(1).news(), testing::ElementsAre(HasSubstr("peer 0")));
  at(0).mortality.is_thawed = true;
  play();
  EXPECT_NE(at(0).failure, "");
  EXPECT_EQ(expect_one_game(), 2u);
}

}  // namespace
}  // namespace rink::game::lost_nodes
