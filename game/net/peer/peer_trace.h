// What one peer says of its own run for others to judge: what it sent, when it knew what, and what
// its player saw.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/net/peer/player_recorder.h"
#include "game/net/peer/traffic.h"

namespace rink::game {

/// Of all that a peer carried until some instant.
struct PeerLoad {
  double instant_s = 0.0;            ///< simulated
  TrafficBytes bytes{}, messages{};  ///< sent, by what they are about; frames included
  std::uint64_t bytes_sent = 0, bytes_received = 0, writes = 0, segments = 0;  ///< by the transport
  std::uint64_t acknowledgements = 0,
                kernel_segments = 0;  ///< sent, by the transport's model and by the kernel
  std::uint64_t events = 0;           ///< of physics, those of ghosts alone included
};

/// Plain facts; instants in simulated seconds, of which the start is that of the first peer.
struct PeerTrace {
  /// A key was due at `due_s` and sent at `instant_s`; or by that instant the own bat had felt so
  /// many keys, and all was known of the window that ended at `due_s` (`known`), or of the own
  /// bodies (`final`).
  enum class Kind : std::uint8_t { key, final, known };
  struct Event {
    Kind kind = Kind::key;
    double due_s = 0.0, instant_s = 0.0;
    std::uint32_t felt = 0;
  };
  /// Which of the own bodies the player of `peer` was told of, or saw, by the decision in force
  /// then.
  struct Decision {
    double instant_s = 0.0;
    std::uint32_t peer = 0;
    std::vector<std::uint32_t> bodies;
  };

  std::uint32_t peer = 0, peer_count = 0;
  PeerLoad begin, end;        ///< of the measured span
  std::vector<Event> events;  ///< in order
  std::vector<Decision> decisions;
  std::optional<PlayerTrace> player;  ///< if it was watched
};

/// Throws std::runtime_error naming `file` if it cannot be written.
void write_trace(const std::string& file, const PeerTrace& trace);
/// Throws TraceError naming file, line and what was expected.
PeerTrace read_peer_trace(const std::string& file);

}  // namespace rink::game
