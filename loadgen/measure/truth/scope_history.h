// One player's replica set, replayed forward in time.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rink::loadgen {

/// An entity came into a player's scope, or left it.
struct ScopeStep {
  double instant_s = 0.0;
  std::uint32_t entity = 0;
  bool is_in = false;
};

/// Entities are small dense numbers.
class ScopeHistory {
 public:
  /// Steps are ordered by instant; repetitions are ignored.
  explicit ScopeHistory(std::vector<ScopeStep> steps) : steps_(std::move(steps)) {
    assert(std::ranges::is_sorted(steps_, {}, &ScopeStep::instant_s));
  }

  /// Takes every step up to and including `instant_s`, which never decreases.
  void advance(double instant_s);
  bool contains(std::uint32_t entity) const {
    return entity < entered_s_.size() && entered_s_[entity].has_value();
  }
  /// The time at which `entity` came into scope, if it is in scope.
  std::optional<double> entered_s(std::uint32_t entity) const {
    return contains(entity) ? entered_s_[entity] : std::nullopt;
  }
  /// Writes all in scope but `own` to `entities`, ascending.
  void list(std::uint32_t own, std::vector<std::uint32_t>& entities) const;

 private:
  std::vector<ScopeStep> steps_;
  std::size_t next_ = 0;
  std::vector<std::optional<double>> entered_s_;  ///< by entity
};

/// Changes of scope within a span of time.
struct ScopeChanges {
  std::uint64_t entries = 0, exits = 0;
  std::uint64_t flaps = 0;  ///< entries of something that had left less than `flap_s` before
};

inline constexpr double flap_s = 1.0;

/// Counts steps from `from_s` up to, not including, `until_s`; earlier ones only give the state at
/// the beginning.
ScopeChanges count_changes(std::span<const ScopeStep> steps, std::uint32_t own, double from_s,
                           double until_s);

}  // namespace rink::loadgen
