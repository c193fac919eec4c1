// A command that may run as a rank of MPI, from when it becomes one to an end in which all ranks
// have written what they have.
#pragma once

#include <cassert>
#include <exception>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "game/net/exit_status.h"
#include "game/net/peer/ranks/rank_network.h"

namespace rink::game {

/// The error of `flags` that say what a launcher says.
std::invalid_argument said_by_launcher(const std::string& flags);

class RankCommand {
 public:
  /// `status_of` gives the exit status for an exception.
  explicit RankCommand(std::function<int(const std::exception&)> status_of)
      : status_of_(std::move(status_of)) {}

  /// Becomes a rank: waits until all ranks have started. What cannot be done is best found out
  /// before. Throws TransportError if this build has no MPI.
  rti::Ranks& begin();
  /// After that.
  rti::Ranks& ranks() {
    assert(ranks_);
    return *ranks_;
  }
  /// Runs the command, and returns its exit status. Of a rank it prints what `play` threw, with the
  /// rank's number; what all ranks were thrown by the first one alone.
  int run(const std::function<ExitStatus()>& play);

 private:
  int explained(const std::exception& error) const;
  int end(int own);

  std::function<int(const std::exception&)> status_of_;
  std::optional<rti::Ranks> ranks_;
};

}  // namespace rink::game
