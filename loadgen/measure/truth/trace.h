// Writes all true positions at each instant at which a run was evaluated, as lines for programs
// that check the figures.
#pragma once

#include <string>

#include "game/net/trace_lines.h"
#include "loadgen/measure/truth/relevance.h"
#include "loadgen/measure/truth/replay.h"

namespace rink::loadgen {

/// docs/metrics.md describes the file. Throws game::TraceError if it cannot be written.
class TruthTrace {
 public:
  explicit TruthTrace(const std::string& file) : writer_(file) {}

  /// Call it first.
  void begin(const RelevanceArea& area, const Replay& replay);
  /// Writes all present positions; `replay.look_around` was called before.
  void look(double instant_s, const Replay& replay);
  /// `body` met `other`.
  void contact(double instant_s, std::uint32_t body, std::uint32_t other);
  void finish() { writer_.finish(); }

 private:
  game::TraceWriter writer_;
};

}  // namespace rink::loadgen
