// How long players did not know what they should have: delays of discovery, as whole distributions.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace rink::loadgen {

/// Delays to the microsecond, which is how the bots' evidence has them, and how many of the sample never ended: censored, they are in the sample without a delay.
class DiscoveryDelays {
 public:
  void add(double delay_s);  ///< at least 0 (asserted)
  void add_never() { ++never_; }
  void merge(const DiscoveryDelays& other);

  std::uint64_t samples() const { return ended_ + never_; }
  std::uint64_t never() const { return never_; }

  /// A point of the distribution function: the part of the sample that ended within the delay.
  struct Point {
    double delay_ms = 0.0, fraction = 0.0;
    friend bool operator==(const Point&, const Point&) = default;
  };
  /// Exact at each of at most `points_max` delays (at least 3, asserted): at 0, at the longest, and in between at those that occurred, as far apart as equal steps of the fraction allow. Its last
  /// fraction is 1 - never/samples. None of an empty sample.
  std::vector<Point> distribution(std::size_t points_max) const;

  friend bool operator==(const DiscoveryDelays&, const DiscoveryDelays&) = default;

  /// `{"never": count, "delays_us": [[delay, count], ...]}`, delays ascending.
  nlohmann::ordered_json to_json() const;
  /// What `to_json` wrote, or nothing if it is not that.
  static std::optional<DiscoveryDelays> from_json(const nlohmann::json& written);

 private:
  std::map<std::uint64_t, std::uint64_t> counts_;  ///< by delay in microseconds
  std::uint64_t ended_ = 0, never_ = 0;
};

/// Of one run, or of all replications of a cell (docs/metrics.md, "Truth").
struct Discoveries {
  DiscoveryDelays late_discovery;  ///< of every stay: from its beginning to the first delivered state; 0 if it was there before
  DiscoveryDelays missed_contact;  ///< of every contact with a body that the player did not know of: from the contact to the next delivered state
  void merge(const Discoveries& other) { late_discovery.merge(other.late_discovery), missed_contact.merge(other.missed_contact); }
  friend bool operator==(const Discoveries&, const Discoveries&) = default;
};

}  // namespace rink::loadgen
