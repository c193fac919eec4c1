// Puts a mobility trace together point by point, and refuses what no trace may have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "game/model/scene.h"
#include "loadgen/mobility/mobility_trace.h"

namespace rink::loadgen {

/// What holds for a trace beside its file.
struct TraceRules {
  double gap_s = 0.0;  ///< an agent without a point for longer was away [s]; 0: it went straight on
  std::optional<Vector2> field{};  ///< all points lie within [0, x] x [0, y] [m]; nothing: anywhere
  std::size_t agents_max = 250'000;  ///< of 262,144 regions that the RTI gives a federate
  std::size_t points_max = 50'000'000;
};

/// Greatest speed of an agent [m/s]: a place that is reached faster is an error of the file.
inline constexpr double agent_speed_max = 1000.0;
/// Longest side of the rectangle around all points [m]: beyond, single precision rounds places by
/// more than 6 cm.
inline constexpr double trace_span_max = 1e6;

/// Errors are game::SceneError and name file, line, agent, value and what is allowed.
class TraceBuilder {
 public:
  /// Whether an agent went to its next point, or was away meanwhile.
  enum class Way : std::uint8_t { straight, away };

  /// `file` names the trace in errors.
  TraceBuilder(std::string file, const TraceRules& rules);

  /// The number of the agent called `id`, which may be new.
  std::uint32_t agent(std::string_view id, std::size_t line);
  /// Adds a point of `agent` after all others of it. The same point again changes nothing.
  void add(std::uint32_t agent, const TracePoint& point, std::size_t line, Way way = Way::straight);
  /// Keeps every agent where it was last until the end of the trace.
  void hold_to_end();
  /// The trace has at least one agent, and every agent has a point.
  MobilityTrace finish();

  [[noreturn]] void refuse(std::size_t line, const std::string& why) const;
  /// Throws an error about the whole file.
  [[noreturn]] void refuse_all(const std::string& why) const;

 private:
  void check(const Agent& agent, const TracePoint& point, std::size_t line) const;
  std::string last_of(const Agent& agent, std::uint32_t number) const;

  std::string file_;
  TraceRules rules_;
  MobilityTrace trace_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::vector<std::uint32_t> lines_;  ///< of each agent's last point
  std::size_t point_count_ = 0;
};

}  // namespace rink::loadgen
