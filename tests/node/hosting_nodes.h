// Nodes in one process, by TCP, that host matches, and of which some die or fall silent.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
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
#include "tests/places.h"

namespace rink::game::lost_hosts {

inline constexpr double tick_s = 1.0 / 60.0;
inline constexpr double speed = 8.0;
inline constexpr std::uint32_t nobody = 99;

/// Faster than the players' clocks.
inline double now_s() {
  return speed *
         std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The match at the paper's pace with wider goals: without keys the first falls within two seconds.
inline Scene scene_of_two(const std::string& goals_to_win) {
  const std::string name = rink::test::source_folder() + "/scenes/paper.toml";
  std::ifstream file(name);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto replace = [&text](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("goals_to_win = 5", "goals_to_win = " + goals_to_win);
  replace("goal_width = 0.4", "goal_width = 1.0");
  replace("velocity = [-0.8, 0.3]", "velocity = [-1.0, -0.2]");
  return parse_scene(text, name);
}

/// What a node has shown of a match.
struct Shown {
  explicit Shown(const Scene& scene) : game(scene) {}
  Game game;
  std::vector<InputEvent> keys;
};

struct HostNode {
  HostNode(const Scene& of, std::unique_ptr<SocketMeeting> meets, double patience_s)
      : scene(of),
        game(of, {}),
        meeting(std::move(meets), mortality),
        node(game, meeting,
             {.patience_s = patience_s,
              .hosting = FlowTimes{.countdown_s = 0.2, .patience_s = 240.0},
              .notify =
                  [this](const std::string& text) {
                    const std::lock_guard lock(mutex);
                    told.push_back(text);
                  }},
             now_s) {}
  /// Its thread may stand still.
  ~HostNode() { mortality.is_thawed = true; }

  /// Shows what there is.
  void show() {
    if (!failure.empty()) return;
    try {
      state = node.match()->state();
      if (state.number == 0) return;
      Shown& shown = matches.try_emplace(state.number, scene).first->second;
      while (const auto felt = node.show_next(1e9, shown.game))
        shown.keys.insert(shown.keys.end(), felt->keys.begin(), felt->keys.end());
    } catch (const std::exception& error) {
      failure = error.what();
    }
  }
  std::vector<std::string> news() {
    const std::lock_guard lock(mutex);
    return told;
  }
  double now() const { return matches.empty() ? 0.0 : matches.rbegin()->second.game.now(); }

  Scene scene;
  Mortality mortality;
  SharedGame game;
  MortalMeeting meeting;
  std::mutex mutex;
  std::vector<std::string> told;  ///< guarded by `mutex`: the node's thread tells
  Node node;
  MatchState state{.winner = std::nullopt};
  std::map<std::uint32_t, Shown> matches;  ///< by number
  std::string failure;
};

class LostHosts : public testing::Test {
 protected:
  void host(std::uint32_t count, const std::string& goals_to_win, double patience_s = 240.0) {
    nodes_.clear();
    scene_ = scene_of_two(goals_to_win);
    places_ = {nobody, nobody};
    Terms terms = terms_of_matches(count, tick_s);
    for (std::uint32_t k = 0; k < count; ++k)
      nodes_.push_back(std::make_unique<HostNode>(
          scene_,
          k == 0 ? std::make_unique<SocketMeeting>(Place{"127.0.0.1", 0}, terms)
                 : std::make_unique<SocketMeeting>(Place{"127.0.0.1", 0},
                                                   nodes_[0]->meeting.place().value()),
          patience_s));
    std::vector<std::thread> meeting;
    for (std::uint32_t k = 0; k < count; ++k) {
      meeting.emplace_back([&, k] { nodes_[k]->node.meet(); });
      std::this_thread::sleep_for(std::chrono::milliseconds(40));
    }
    for (std::thread& each : meeting) each.join();
    std::ranges::sort(nodes_, {}, [](const auto& each) { return each->node.number(); });
    for (std::size_t ready = 0; ready < count;) {
      ready = 0;
      for (const auto& each : nodes_) ready += each->node.may_begin();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    for (const auto& each : nodes_) each->node.begin();
  }
  HostNode& at(std::uint32_t number) { return *nodes_[number]; }
  bool is_there(const HostNode& node) const {
    return !node.mortality.is_dead && !node.mortality.is_due && node.failure.empty();
  }

  /// All show what comes, and their players press keys, until `is_reached()`; false after 40 s.
  bool play(const std::function<bool()>& is_reached) {
    const double limit_s = now_s() + 40.0 * speed;
    while (!is_reached()) {
      if (now_s() > limit_s) return false;
      for (const auto& each : nodes_)
        if (!each->mortality.is_dead) each->show();
      for (std::uint32_t player = 0; player < 2; ++player)
        if (are_pressing_ && places_[player] != nobody && is_there(at(places_[player])) &&
            random_.below(4) == 0)
          press(player, all_keys[random_.below(4)], random_.below(2) == 0);
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
    return true;
  }
  void press(std::uint32_t player, Key key, bool is_down) {
    HostNode& node = at(places_[player]);
    node.node.press(player, key, is_down, node.now() + 2.0 * tick_s);
  }
  bool all_are(const std::function<bool(HostNode&)>& so) {
    return std::ranges::all_of(nodes_,
                               [&](const auto& each) { return !is_there(*each) || so(*each); });
  }
  bool play_to(MatchPhase phase, std::uint32_t match = 1) {
    return play([&] {
      return all_are([&](const HostNode& node) {
        return node.state.phase == phase && node.state.number == match;
      });
    });
  }
  /// All have shown so much more of the match [s].
  bool play_for(double span_s) {
    double from = 0.0;
    for (const auto& each : nodes_)
      if (is_there(*each)) from = std::max(from, each->now());
    return play(
        [&] { return all_are([&](const HostNode& node) { return node.now() > from + span_s; }); });
  }
  std::optional<std::uint32_t> seat(std::uint32_t k, std::uint64_t token) {
    at(k).node.ask_seat({.token = token});
    std::optional<SharedPlay::SeatAnswer> answer;
    EXPECT_TRUE(play([&] {
      if (!answer) answer = at(k).node.next_seat();
      return answer.has_value();
    }));
    if (!answer || !answer->player) return std::nullopt;
    places_[*answer->player] = k;
    return answer->player;
  }
  void seat_both(std::uint32_t first, std::uint32_t second) {
    ASSERT_EQ(seat(first, 100), 0u);
    ASSERT_EQ(seat(second, 101), 1u);
  }
  /// The players of nodes that are gone come to another one, and get their bats.
  void come_back(std::uint32_t to) {
    for (std::uint32_t player = 0; player < 2; ++player) {
      if (places_[player] == nobody || is_there(at(places_[player]))) continue;
      ASSERT_TRUE(play([&] {
        return all_are([&](HostNode& node) {
          return !node.news().empty() && node.state.phase != MatchPhase::playing;
        });
      }));
      ASSERT_EQ(seat(to, 200 + player), player);
    }
  }
  std::uint32_t first_there() const {
    for (std::uint32_t k = 0; k < nodes_.size(); ++k)
      if (is_there(*nodes_[k])) return k;
    return nobody;
  }

  /// What each node has shown of each match is what one engine plays with its keys, and one is a
  /// beginning of the other. How many nodes are left.
  std::size_t expect_one_game() {
    std::size_t count = 0;
    std::map<std::uint32_t, const Shown*> longest;
    for (const auto& each : nodes_) {
      if (!is_there(*each)) continue;
      ++count;
      for (const auto& [number, shown] : each->matches) {
        SCOPED_TRACE("match " + std::to_string(number));
        Game engine(scene_);
        for (const InputEvent& key : shown.keys) engine.submit(key);
        engine.advance(shown.game.now());
        EXPECT_EQ(engine.hash(), shown.game.hash());
        EXPECT_EQ(engine.score(), shown.game.score());
        const Shown*& most = longest[number];
        if (most == nullptr || most->keys.size() < shown.keys.size()) most = &shown;
      }
    }
    for (const auto& each : nodes_)
      if (is_there(*each))
        for (const auto& [number, shown] : each->matches) {
          EXPECT_TRUE(
              std::equal(shown.keys.begin(), shown.keys.end(), longest[number]->keys.begin()));
          if (number < each->matches.rbegin()->first) {
            EXPECT_EQ(shown.game.hash(), longest[number]->game.hash());
          }
        }
    return count;
  }
  KeysHeld held_by(std::uint32_t player) {
    KeysHeld held;
    for (const InputEvent& key : at(first_there()).matches.rbegin()->second.keys)
      if (key.player == player) held.set(key.key, key.kind == InputKind::key_down);
    return held;
  }

  Scene scene_;
  std::vector<std::unique_ptr<HostNode>> nodes_;
  std::array<std::uint32_t, 2> places_{};  ///< the players' nodes
  bool are_pressing_ = true;
  RandomStream random_{7};
};

}  // namespace rink::game::lost_hosts
