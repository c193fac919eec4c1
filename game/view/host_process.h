// A server of matches beside the window: rink-serve as a process of its own, which ends with its
// owner, also after a crash.
#pragma once

#include <string>
#include <vector>

#include "game/process/process.h"

namespace rink::view {

struct HostSettings {
  std::string scene = "match";      ///< name or file
  std::string address = "0.0.0.0";  ///< where players reach it, at `port`; 0: any free one
  std::string port = "0";
  std::string records;                 ///< folder
  std::string key_file{};              ///< if any, only for players with the same key
  bool is_announced = true;            ///< to the local network
  std::string continued{};             ///< the record that the match goes on from, if any
  std::vector<std::string> sharing{};  ///< flags of rink serve by which it is one of several nodes
};

class HostProcess {
 public:
  /// Waits until it listens to players, or to other nodes if it shares; throws std::runtime_error
  /// with its output if it does not, for instance because the port is in use.
  explicit HostProcess(const HostSettings& settings);
  ~HostProcess();

  /// Where other nodes reach it, ADDRESS:PORT; empty if it does not share.
  const std::string& node_place() const { return node_place_; }
  bool has_ended() const { return server_.ending().has_value(); }

  /// Its output since the last call. Call it now and then, since a full pipe would block the
  /// server.
  std::string take_words();

 private:
  game::Process server_;
  std::string words_, node_place_;
};

}  // namespace rink::view
