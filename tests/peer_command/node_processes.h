// Processes of rink-serve that share one simulation, and their bots, for tests.
#pragma once

#include <algorithm>
#include <optional>

#include "game/control/replay.h"
#include "tests/peer_command/peer_processes.h"

namespace rink::game {

class NodeCommand : public PeerCommand {
 protected:
  /// Starts a node, and waits until it has printed its place. It seats 4 players by default.
  Process& serve(const std::string& name, Words arguments, const std::string& scene_file = {}) {
    add(arguments, "--scene", scene_file.empty() ? scene() : scene_file);
    add(arguments, "--clients", "4");
    add(arguments, "--port", "0");
    add(arguments, "--record", record_of(name));
    Process& node = *peers_.emplace_back(
        std::make_unique<Process>(test::binary_folder() + "/bin/rink-serve", arguments));
    until([&] { return place_among_nodes(node) || node.ending(); });
    return node;
  }
  Process& first(Words further = {}) {
    add(further, "--nodes", "2");
    add(further, "--node-listen", "127.0.0.1:0");
    add(further, "--duration", "2");
    return serve("first", further);
  }
  Process& join(const Process& other, Words further = {}) {
    add(further, "--join", place_among_nodes(other).value_or("nowhere:1"));
    return serve("second", further);
  }
  /// Unless the flag is given.
  static void add(Words& arguments, const std::string& flag, const std::string& value) {
    if (std::ranges::find(arguments, flag) == arguments.end())
      arguments.insert(arguments.end(), {flag, value});
  }
  /// Bots of `node`, once it listens to clients; 4 by default.
  Process& bots(const Process& node, Words further = {}) {
    until([&] { return node.line_after("listening on ") || node.ending(); });
    add(further, "--connect", place_of(node));
    add(further, "--count", "4");
    add(further, "--scene", scene());
    add(further, "--players", "waypoint");
    add(further, "--duration", "2");
    add(further, "--view", "0.2");
    return *peers_.emplace_back(
        std::make_unique<Process>(test::binary_folder() + "/bin/rink-bots", further));
  }
  /// One that calls itself after a bat and plays until a simulated time.
  Process& bot(const Process& node, const std::string& number, const std::string& until) {
    return bots(node, {"--count", "1", "--first", number, "--duration", until});
  }
  static std::optional<std::string> place_among_nodes(const Process& node) {
    return node.line_after("nodes reach this one at ");
  }
  std::string record_of(const std::string& name) const {
    return (folder_ / (name + ".keys")).string();
  }
};

/// The log that each node has written, which one engine replays to its hash.
inline KeyLog same_log(const std::vector<std::string>& records) {
  const KeyLog log = read_key_log(std::filesystem::path(records.front()));
  for (const std::string& record : records)
    EXPECT_EQ(log, read_key_log(std::filesystem::path(record)));
  EXPECT_TRUE(log.hash);
  EXPECT_EQ(replay(log, recorded_scene(log, records.front())), log.hash.value_or(0));
  return log;
}

inline std::vector<InputEvent> keys_of(const KeyLog& log, std::uint32_t player) {
  std::vector<InputEvent> keys;
  for (const InputEvent& event : log.events)
    if (event.player == player) keys.push_back(event);
  return keys;
}

}  // namespace rink::game
