// Records what a player received and what its replicas show, for the evaluation of quality.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "game/net/bots_trace.h"
#include "game/net/peer/interest/shared_interest.h"

namespace rink::game {

class PlayerRecorder {
 public:
  /// `interest` must outlive it.
  explicit PlayerRecorder(SharedInterest& interest) : interest_(interest) {
    trace_.bots.push_back({.object = interest.bat(), .changes = {}});
  }

  /// At `instant_s` all is known of the window that ended at `matched_s`.
  void note_commit(double instant_s, double matched_s);
  /// Samples the player's replicas at `instant_s`.
  void sample(double instant_s);
  /// Of one bot, the player; instants are in simulated seconds.
  const BotsTrace& trace() const { return trace_; }

 private:
  SharedInterest& interest_;
  BotsTrace trace_;
  double matched_s_ = -1.0;
  std::vector<std::uint32_t> scope_, listed_;
  std::vector<physics::Vector2> matched_;  ///< by body in scope then
  std::vector<std::pair<double, PeerReplicas::Received>> received_;
};

}  // namespace rink::game
