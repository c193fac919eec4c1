// The trace of watched bots and players from which quality is computed, whatever carries their
// updates: changes of scope, and replica sets at drawn instants.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/net/trace_lines.h"
#include "game/physics/body.h"

namespace rink::game {

/// The trace of all watched bots. docs/metrics.md describes the file. A peer's player is one, and
/// its objects are the bodies of the game's world.
struct BotsTrace {
  struct ScopeChange {
    double instant_s = 0.0;    ///< simulated time of its arrival; below 0 if before the start
    std::uint32_t object = 0;  ///< RTI handle, or a body
    bool is_in = false;
  };
  /// One entity in a replica set. Its believed position is meaningless if it was not in scope.
  struct Replica {
    std::uint32_t object = 0;
    std::uint32_t bytes = 0;  ///< of its updates that arrived within the window before the sample
    bool is_in_scope = false;
    physics::Vector2 matched{0.0, 0.0}, displayed{0.0, 0.0};  ///< m, at the sample's two instants
  };
  struct Bot {
    std::uint32_t object = 0;  ///< of its own bat
    std::vector<ScopeChange> changes;
  };
  struct Sample {
    std::uint32_t bot = 0;  ///< index in `bots`
    double displayed_s = 0.0,
           matched_s = 0.0;  ///< the clock's simulated instant, and the newest stamp it holds
    double window_s = 0.0;
    std::size_t first = 0, last = 0;  ///< in `replicas`
  };

  std::uint32_t clients = 0;
  double from_s = 0.0, until_s = 0.0;  ///< the measured span of simulated time
  bool is_complete = true;             ///< false: changes beyond the room for them are missing
  std::vector<Bot> bots;
  std::vector<Sample> samples;  ///< ordered by displayed_s
  std::vector<Replica> replicas;
};

/// Adds the bots of another trace behind those that are there; samples are in no order then.
void append(BotsTrace& trace, const BotsTrace& further);
/// `trace` as it is read back from a file: positions rounded to a nanometre, changes of scope to a
/// microsecond.
BotsTrace rounded(BotsTrace trace);
/// Writes the rounded trace. Throws std::runtime_error naming `file` if it cannot be written.
void write_trace(const std::string& file, const BotsTrace& trace);
/// Throws TraceError naming file, line and what was expected.
BotsTrace read_bots_trace(const std::string& file);
/// The same as lines of a file that has others before them.
void write_lines(TraceWriter& writer, const BotsTrace& trace);
/// Throws TraceError or what nlohmann::json throws.
BotsTrace read_bots_lines(TraceReader& reader);

}  // namespace rink::game
