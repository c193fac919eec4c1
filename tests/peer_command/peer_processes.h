// Processes of rink-peer for tests, on a small scene.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <deque>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "game/control/key_log_file.h"
#include "game/control/playing.h"
#include "game/model/scene_file.h"
#include "game/net/exit_status.h"
#include "game/process/process.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::game {
using testing::HasSubstr;
using namespace std::chrono_literals;
using Words = std::vector<std::string>;

inline const std::string small_scene = R"(name = "small"
[field]
length = 5.0
width = 3.0
[drag]
pucks = 0.1
bats = 3.0
[materials]
restitution = 0.95
[[population]]
name = "post"
kind = "post"
count = 4
radius = 0.1
[[population]]
name = "bat"
kind = "bat"
count = 8
mass = 5.0
[[population]]
name = "puck"
kind = "puck"
count = 150
mean_speed = 1.5
speeds = "maxwell"
)";

class PeerCommand : public testing::Test {
 protected:
  PeerCommand() : folder_("peers") { std::ofstream(folder_ / "small.toml") << small_scene; }

  std::string scene() const { return (folder_ / "small.toml").string(); }

  /// A peer that has said where it listens.
  Process& start(Words arguments, const std::string& scene_file = {}) {
    const Words scene_words{"--scene", scene_file.empty() ? scene() : scene_file};
    arguments.insert(arguments.begin(), scene_words.begin(), scene_words.end());
    Process& peer = *peers_.emplace_back(
        std::make_unique<Process>(test::binary_folder() + "/bin/rink-peer", arguments));
    until([&] { return peer.line_after("listening on ") || peer.ending(); });
    return peer;
  }
  Process& found(int count, const std::string& until, Words further = {}) {
    further.insert(further.end(),
                   {"--peers", std::to_string(count), "--until", until, "--listen", "127.0.0.1:0"});
    return start(further);
  }
  Process& join(const Process& other, Words further = {}) {
    further.insert(further.end(), {"--join", place_of(other)});
    return start(further);
  }
  static std::string place_of(const Process& peer) {
    return peer.line_after("listening on ").value_or("nowhere");
  }

  bool until(const std::function<bool()>& is_reached, std::chrono::seconds limit = 30s) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!is_reached() && std::chrono::steady_clock::now() < end)
      for (const auto& peer : peers_) peer->attend(5ms);
    return is_reached();
  }
  bool ends(const Process& peer, std::chrono::seconds limit = 30s) {
    return until([&] { return peer.ending().has_value(); }, limit);
  }
  bool are_playing(std::initializer_list<const Process*> peers) {
    return until([&] {
      return std::all_of(peers.begin(), peers.end(), [](const Process* peer) {
        return peer->line_after("playing").has_value();
      });
    });
  }
  /// Of one engine.
  std::string truth(double until) const {
    Game one(load_scene(scene()));
    one.advance(until);
    return printed(one.hash());
  }
  static std::string hash_of(const Process& peer) {
    return peer.line_after("  \"hash\": ").value_or(peer.stderr_tail());
  }
  /// As a report prints it.
  static std::string printed(std::uint64_t hash) {
    char text[32];
    std::snprintf(text, sizeof text, "\"%016llx\"", static_cast<unsigned long long>(hash));
    return text;
  }

  test::TemporaryFolder folder_;
  std::deque<std::unique_ptr<Process>> peers_;
};

}  // namespace rink::game
