// The search for the largest number of clients that still holds a service level, by bracketing over
// noisy probes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

/// The level of service that a run must keep.
struct ServiceLevel {
  double on_time_fraction_min = 0.99;  ///< of the ticks, 0 to 1
  double age_p99_ms_max =
      100.0;  ///< the 99th percentile of the update age lies below this [ms], above 0
};

/// The result of one probe. `invalid`: the run does not count, whatever its figures; the server may
/// or may not be the reason.
enum class Verdict : std::uint8_t { holds, fails, invalid };

/// A verdict and its reason in words, empty if it holds.
struct Judgement {
  Verdict verdict = Verdict::invalid;
  std::string why;
};

/// Holds `record` against `level`. A p99 that the sample does not support is bounded by the
/// maximum; if that does not decide, the run is invalid: too short.
Judgement judgement_of(const RunRecord& record, const ServiceLevel& level);

struct SearchLimits {
  std::uint32_t first = 100;    ///< clients of the first probe, 1 to `most`
  std::uint32_t most = 20'000;  ///< never more clients than this, at least 1
  double resolution =
      0.1;  ///< ends when failed / held - 1 is at most this, above 0 (or when they are neighbours)
};

/// How a search ended.
enum class SearchEnd : std::uint8_t {
  bracketed,   ///< `held` holds, `failed` fails
  most_holds,  ///< even `SearchLimits::most` holds: at least that many
  one_fails,   ///< not even one client holds
  not_valid,   ///< runs of `failed` clients do not count: at least `held`, and more was not
               ///< measured
  interrupted  ///< `held` and `failed` are as far as the search got
};

/// One probe.
struct Trial {
  std::uint32_t clients = 0;
  std::uint32_t attempt = 0;  ///< 0, 1, ... of these clients
  Verdict verdict = Verdict::invalid;
  friend bool operator==(const Trial&, const Trial&) = default;
};

struct Search {
  SearchEnd end = SearchEnd::interrupted;
  std::optional<std::uint32_t> held;    ///< the largest number that holds
  std::optional<std::uint32_t> failed;  ///< the smallest above it that does not
  std::vector<Trial> trials;            ///< in the order in which they were made
};

/// Probes `clients` for the `attempt`-th time. Nothing if it was interrupted.
using Probing = std::function<std::optional<Verdict>(std::uint32_t clients, std::uint32_t attempt)>;

/// Doubles from `first` until a number fails (or halves until one holds), then bisects on a
/// logarithmic scale. Noise does not decide: a number's verdict is the first that comes twice. On
/// the way up one probe that holds is enough to go on; the edge that is returned has held twice and
/// its neighbour has failed (or not counted) twice. If the edge does not hold again, the search
/// goes on below it. Every number is probed at most four times.
Search find_largest(const SearchLimits& limits, const Probing& probe);

}  // namespace rink::loadgen
