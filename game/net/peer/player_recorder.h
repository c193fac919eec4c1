// Records what a player received and what its replicas show, for the evaluation of quality.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "game/net/peer/interest/shared_interest.h"

namespace rink::game {

/// Bodies by their number in the game's world; instants in simulated seconds.
struct PlayerTrace {
  struct ScopeChange {
    double instant_s = 0.0;
    std::uint32_t body = 0;
    bool is_in = false;
  };
  /// The believed position is meaningless if the body was not in scope.
  struct Replica {
    std::uint32_t body = 0;
    std::uint32_t bytes = 0;  ///< of its updates within the window before the sample
    bool is_in_scope = false;
    physics::Vector2 matched{0.0, 0.0}, displayed{0.0, 0.0};  ///< m, at the sample's two instants
  };
  struct Sample {
    double displayed_s = 0.0,
           matched_s = 0.0;  ///< now, and the end of the last window of which all is known
    double window_s = 0.0;
    std::size_t first = 0, last = 0;  ///< in `replicas`
  };
  std::uint32_t bat = 0;
  std::vector<ScopeChange> changes;
  std::vector<Sample> samples;
  std::vector<Replica> replicas;
};

class PlayerRecorder {
 public:
  /// `interest` must outlive it.
  explicit PlayerRecorder(SharedInterest& interest) : interest_(interest) {
    trace_.bat = interest.bat();
  }

  /// At `instant_s` all is known of the window that ended at `matched_s`.
  void note_commit(double instant_s, double matched_s);
  /// Samples the player's replicas at `instant_s`.
  void sample(double instant_s);
  const PlayerTrace& trace() const { return trace_; }

 private:
  SharedInterest& interest_;
  PlayerTrace trace_;
  double matched_s_ = -1.0;
  std::vector<std::uint32_t> scope_, listed_;
  std::vector<physics::Vector2> matched_;  ///< by body in scope then
  std::vector<std::pair<double, PeerReplicas::Received>> received_;
};

}  // namespace rink::game
