// A peer's trace of its run, from which quality is computed: its traffic, the instants of its
// knowledge, and its player's replicas.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/net/bots_trace.h"
#include "game/net/peer/traffic.h"

namespace rink::game {

/// A peer's traffic until some instant.
struct PeerLoad {
  double instant_s = 0.0;            ///< simulated
  TrafficBytes bytes{}, messages{};  ///< sent, by purpose; frames included
  std::uint64_t bytes_sent = 0, bytes_received = 0, writes = 0, segments = 0;  ///< by the transport
  std::uint64_t acknowledgements = 0,
                kernel_segments = 0;  ///< sent, by the transport's model and by the kernel
  std::uint64_t events = 0;           ///< of physics, those of ghosts alone included
};

/// Facts without evaluation; instants are in simulated seconds from the first peer's start.
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
  /// The own bodies in the scope of the player of `peer` by the decision in force then.
  struct Decision {
    double instant_s = 0.0;
    std::uint32_t peer = 0;
    std::vector<std::uint32_t> bodies;
  };

  std::uint32_t peer = 0, peer_count = 0;
  PeerLoad begin, end;        ///< of the measured span
  std::vector<Event> events;  ///< in order
  std::vector<Decision> decisions;
  std::optional<BotsTrace> player;  ///< if it was watched; its objects are bodies
};

/// Throws std::runtime_error naming `file` if it cannot be written.
void write_trace(const std::string& file, const PeerTrace& trace);
/// Throws TraceError naming file, line and what was expected.
PeerTrace read_peer_trace(const std::string& file);

}  // namespace rink::game
