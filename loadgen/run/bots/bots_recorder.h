// Watches some of a crowd's bots: notes every change of their scope and, at drawn instants, their
// replica sets; all in memory.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game/net/bots_trace.h"
#include "game/net/client/client.h"
#include "game/net/sampling.h"

namespace rink::loadgen {

/// Reads no clock. Bots are named by their number in the crowd.
class BotsRecorder {
 public:
  /// Marks the watched clients. `clients[k]` is bot k's; they must outlive the recorder.
  BotsRecorder(const game::SamplingSettings& settings, const std::vector<game::Client*>& clients);

  bool watches(std::uint32_t bot) const { return bot < place_.size() && place_[bot] != nobody; }
  /// Call it after each reception of a watched bot; `simulated_s` is the clock's simulated instant,
  /// or nothing before the start.
  void listen(std::uint32_t bot, std::optional<double> simulated_s);
  /// The next instant at which a sample is due; infinity if there is none.
  double next_sample_s() const;
  /// Takes every due sample, of all watched bots as of the same instant.
  void sample(double simulated_s);

  game::BotsTrace trace() const;
  std::size_t memory_bytes() const;

 private:
  static constexpr std::uint32_t nobody = 0xffffffffu;
  static constexpr double window_s =
      0.05;  ///< over which updates are counted: longer than a tick of 20 Hz
  struct Received {
    double instant_s;
    std::uint32_t object, bytes;
  };

  void note(std::uint32_t place, const game::BotsTrace::ScopeChange& change);
  void look_into(std::uint32_t place, double simulated_s);
  void display_computed(std::uint32_t place, double simulated_s, std::size_t first);
  std::uint32_t bytes_of(std::span<const Received> received, std::uint32_t object) const;

  game::SamplingSettings settings_;
  std::vector<game::Client*> clients_;  ///< of the watched bots
  std::vector<std::uint32_t> place_;    ///< by bot: its place among the watched ones, or `nobody`
  std::vector<double> instants_;
  std::size_t next_instant_ = 0, change_count_ = 0;
  std::vector<std::vector<Received>>
      received_;  ///< by place, within the window before the next instant
  std::vector<std::vector<rti::ObjectHandle>>
      awaited_;  ///< by place: in scope, but without a position yet, which a budget may delay
  std::vector<double> matched_s_;  ///< by place: the newest stamp
  game::BotsTrace trace_;
};

}  // namespace rink::loadgen
