// One peer of a run, with its player: frames to and from the others, and what is measured of it. No
// clock, no connection of its own.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "game/net/peer/network/frames.h"
#include "game/net/peer/peer_node.h"
#include "game/net/peer/player_recorder.h"
#include "loadgen/run/bots/probe.h"

namespace rink::loadgen {

/// The clock of a run: simulated time is that since its start. All in seconds.
struct RunClock {
  double now_s = 0.0, start_s = 0.0;
  double simulated_s() const { return now_s - start_s; }
};

/// The clock and the measurements of stations; both must outlive them, and may be shared.
struct PeerMeasuring {
  const RunClock& clock;
  Measurements& measurements;
};

class PeerStation {
 public:
  PeerStation(const game::SharedGame& game, const game::InterestSettings& settings,
              const peer::Division& division, peer::PeerNumber number,
              const PeerMeasuring& measuring);

  /// Records the player's updates and replicas.
  void watch();

  void due() { node_.due(); }
  /// The player's key that was due at simulated `instant` [s].
  void press(double instant);
  /// Bytes of another peer's stream, cut anywhere. Throws peer::ProtocolError for bytes that no
  /// peer sends.
  void receive(peer::PeerNumber from, rti::Bytes bytes);
  /// The bytes to send to `to`; the caller takes them.
  std::vector<std::uint8_t>& outbox(peer::PeerNumber to) { return outboxes_[to]; }
  /// Takes a sample of the player's present replicas.
  void sample() { recorder_->sample(clock_.simulated_s()); }

  game::PeerNode& node() { return node_; }
  const game::PeerNode& node() const { return node_; }
  const Probe& probe() const { return probe_; }
  /// Measured windows of which all was known here, and those of them that were before the next
  /// one's end.
  std::uint64_t windows_known() const { return known_; }
  std::uint64_t windows_on_time() const { return on_time_; }
  /// The trace of a watched player.
  const game::BotsTrace& trace() const { return recorder_->trace(); }

 private:
  void note_commit();

  const RunClock& clock_;
  Measurements& measurements_;
  double rate_hz_;
  std::vector<game::FrameQueue> readers_;            ///< by peer
  std::vector<std::vector<std::uint8_t>> outboxes_;  ///< by peer
  Probe probe_;
  game::PeerNode node_;
  std::optional<game::PlayerRecorder> recorder_;
  std::uint64_t known_ = 0, on_time_ = 0;
};

}  // namespace rink::loadgen
