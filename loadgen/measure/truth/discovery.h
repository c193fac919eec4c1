// Distributions of how late players discovered entities, and of how far off displayed positions
// were.
#pragma once

#include <cstdint>

#include "loadgen/measure/statistics/sample_distribution.h"

namespace rink::loadgen {

/// The distributions of one run, or of all replications of a cell (docs/metrics.md, "Truth").
struct Discoveries {
  SampleDistribution late_discovery;  ///< s, of every interval of relevance: from its beginning to
                                      ///< the first delivered state; 0 if that came before
  SampleDistribution missed_contact;  ///< s, of every contact with a body that the player did not
                                      ///< know of: from the contact to the next delivered state
  SampleDistribution displayed_error{};  ///< m, of every displayed entity that was relevant; those
                                         ///< put back unheard of are left out, as everywhere
  void merge(const Discoveries& other) {
    late_discovery.merge(other.late_discovery), missed_contact.merge(other.missed_contact),
        displayed_error.merge(other.displayed_error);
  }
  friend bool operator==(const Discoveries&, const Discoveries&) = default;
};

/// Whether the instant at which each entity became relevant is found, for `late_entry_ms` and late
/// discoveries; that takes longer than all else.
enum class Entries : std::uint8_t { found, passed_over };

}  // namespace rink::loadgen
