// Finds when entities truly became relevant to a player, and how late each was delivered.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "loadgen/measure/truth/scope_history.h"
#include "loadgen/measure/truth/surroundings.h"

namespace rink::loadgen {

/// Follows the intervals in which entities are within one player's area. An interval begins between
/// two looks, at the instant at which the depth, taken as linear, passes 0. Its entity is late from
/// then to its first delivered state; one that is never delivered is late for the whole interval,
/// as far as it was seen.
class RelevanceIntervals {
 public:
  /// For an entity that is relevant now and was not at the look before: the fraction of the time
  /// between the two after which its depth passed 0; 1 if it did not exist then.
  using Passed = std::function<double(const Relevant& now)>;

  /// Looks at what is relevant at `instant_s`, ascending by entity, and at what had been delivered
  /// by then: `delivered` must have been advanced to it. Instants ascend. What is relevant at the
  /// first look began at an unknown instant and is left out.
  void look(double instant_s, std::span<const Relevant> relevant, const ScopeHistory& delivered,
            const Passed& passed);
  /// Ends the intervals that are still open; no look may follow.
  void end();

  /// The lateness of each entry [s], in order of delivery; 0 if the entity was delivered already.
  const std::vector<double>& lateness_s() const { return lateness_s_; }
  /// The lateness of entries that were delivered.
  const std::vector<double>& delivered_after_s() const { return delivered_after_s_; }
  /// Intervals that ended, or were last seen, without a delivery.
  std::uint64_t never_delivered() const { return never_delivered_; }

 private:
  struct RelevanceInterval {
    double begin_s = 0.0;
    std::uint64_t seen = 0;  ///< number of the last look that found it; 0: none
    bool is_open = false, is_settled = false;
  };

  void close(RelevanceInterval& interval, double instant_s);

  std::vector<RelevanceInterval> intervals_;  ///< by entity
  std::vector<std::uint32_t> open_;
  std::uint64_t looks_ = 0;
  double last_s_ = 0.0;
  std::vector<double> lateness_s_, delivered_after_s_;
  std::uint64_t never_delivered_ = 0;
};

}  // namespace rink::loadgen
