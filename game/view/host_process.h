// A server of matches beside the window: rink-serve as a process of its own, which ends with its
// owner, also after a crash.
#pragma once

#include <string>

#include "game/process/process.h"

namespace rink::view {

class HostProcess {
 public:
  /// Hosts matches of the scene "match" on `port`, with records in the folder `records`; only for
  /// players with the same key if there is a `key_file`. Waits until it listens; throws
  /// std::runtime_error with its output if it does not, for instance because the port is in use.
  HostProcess(const std::string& port, const std::string& records,
              const std::string& key_file = "");
  ~HostProcess();

  /// Its output since the last call. Call it now and then, since a full pipe would block the
  /// server.
  std::string take_words();

 private:
  game::Process server_;
  std::string words_;
};

}  // namespace rink::view
