// A server of matches beside the window: rink-serve as a process of its own, which ends with its
// owner, in whatever way that ends.
#pragma once

#include <string>

#include "game/process/process.h"

namespace rink::view {

class HostProcess {
 public:
  /// Hosts matches of the scene "match" for everybody on `port`, with records in the folder
  /// `records`; only for who has the same key if there is a `key_file`. Waits until it listens;
  /// throws std::runtime_error with its own words if it does not, for instance because the port is
  /// in use.
  HostProcess(const std::string& port, const std::string& records,
              const std::string& key_file = "");
  ~HostProcess();

  /// What it has said since the last time. To be asked now and then: a pipe that nobody empties
  /// stops who fills it.
  std::string take_words();

 private:
  game::Process server_;
  std::string words_;
};

}  // namespace rink::view
