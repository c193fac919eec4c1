// Votes per number of clients, and a bracket that they move.
#include "loadgen/run/saturation/saturation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <sstream>

#include "loadgen/run/run_ending.h"

namespace rink::loadgen {
namespace {

std::string four_digits(double number) {
  std::ostringstream text;
  text.precision(4);
  text << number;
  return text.str();
}

/// The votes on one number of clients.
struct Votes {
  std::array<std::uint32_t, 3> of_verdict{};  ///< by Verdict
  std::uint32_t attempts = 0;

  std::uint32_t operator()(Verdict verdict) const {
    return of_verdict[static_cast<std::size_t>(verdict)];
  }
  bool is_only(Verdict verdict) const { return attempts > 0 && (*this)(verdict) == attempts; }
  /// The first verdict that came twice.
  std::optional<Verdict> decided() const {
    for (const Verdict verdict : {Verdict::holds, Verdict::fails, Verdict::invalid})
      if ((*this)(verdict) >= 2) return verdict;
    return std::nullopt;
  }
};

class Bracketing {
 public:
  Bracketing(const SearchLimits& limits, const Probing& probe) : limits_(limits), probe_(probe) {}

  Search run() {
    try {
      for (std::optional<std::uint32_t> next = limits_.first; next; next = next_after(*next))
        place(*next, verdict_of(*next, false));
    } catch (const Interrupted&) {
      search_.end = SearchEnd::interrupted;
    }
    return search_;
  }

 private:
  /// Probes until the verdict is clear; a first probe that holds is, unless it `must_be_twice`.
  Verdict verdict_of(std::uint32_t clients, bool must_be_twice) {
    Votes& votes = votes_[clients];
    while (true) {
      if (const auto decided = votes.decided()) return *decided;
      if (!must_be_twice && votes.is_only(Verdict::holds)) return Verdict::holds;
      const auto verdict = probe_(clients, votes.attempts);
      if (!verdict) throw Interrupted{};
      search_.trials.push_back({clients, votes.attempts, *verdict});
      ++votes.attempts;
      ++votes.of_verdict[static_cast<std::size_t>(*verdict)];
    }
  }

  void place(std::uint32_t clients, Verdict verdict) {
    if (verdict == Verdict::holds) {
      search_.held = clients;
    } else {
      search_.failed = clients;
    }
  }

  bool is_narrow() const {
    if (!search_.failed) return search_.held == limits_.most;
    if (!search_.held) return *search_.failed == 1;
    return *search_.failed == *search_.held + 1 ||
           *search_.failed <= *search_.held * (1.0 + limits_.resolution);
  }

  /// The next number to probe, or nothing if the search has ended.
  std::optional<std::uint32_t> next_after(std::uint32_t clients) {
    while (is_narrow()) {
      if (!search_.held || verdict_of(*search_.held, true) == Verdict::holds) {
        end();
        return std::nullopt;
      }
      fall_back();
    }
    if (!search_.failed)
      return static_cast<std::uint32_t>(
          std::min<std::uint64_t>(2 * std::uint64_t{clients}, limits_.most));
    if (!search_.held) return std::max(1u, *search_.failed / 2);
    const double middle =
        std::sqrt(static_cast<double>(*search_.held) * static_cast<double>(*search_.failed));
    return std::clamp(static_cast<std::uint32_t>(std::lround(middle)), *search_.held + 1,
                      *search_.failed - 1);
  }

  /// The edge held once but not twice: it is the new upper end, and the largest number below it
  /// that held is the new lower one.
  void fall_back() {
    search_.failed = *search_.held;
    search_.held.reset();
    for (const auto& [clients, votes] : votes_)
      if (clients < *search_.failed &&
          (votes.decided() == Verdict::holds || votes.is_only(Verdict::holds)))
        search_.held = clients;
  }

  void end() {
    if (!search_.failed) {
      search_.end = SearchEnd::most_holds;
    } else if (votes_.at(*search_.failed).decided() == Verdict::invalid) {
      search_.end = SearchEnd::not_valid;
    } else {
      search_.end = search_.held ? SearchEnd::bracketed : SearchEnd::one_fails;
    }
  }

  const SearchLimits& limits_;
  const Probing& probe_;
  std::map<std::uint32_t, Votes> votes_;
  Search search_;
};

}  // namespace

Judgement judgement_of(const RunRecord& record, const ServiceLevel& level) {
  if (!record.valid) {
    const auto on_time = record.ticks_on_time_fraction;
    return {Verdict::invalid, record.why_invalid + (on_time ? " (while the server had " +
                                                                  four_digits(100.0 * *on_time) +
                                                                  " % of its ticks on time)"
                                                            : "")};
  }
  if (!record.keys_trouble.empty())
    return {Verdict::invalid,
            "the bots, which measure the age of updates, fell behind: " + record.keys_trouble};
  if (!record.ticks_on_time_fraction)
    return {Verdict::invalid, "the run has no ticks_on_time_fraction"};
  std::string why;
  if (*record.ticks_on_time_fraction < level.on_time_fraction_min) {
    why = "ticks: " + four_digits(100.0 * *record.ticks_on_time_fraction) + " % on time, below " +
          four_digits(100.0 * level.on_time_fraction_min) + " %";
  }
  const Percentiles& age = record.update_age_ms;
  const std::optional<double> bound = age.p99 ? age.p99 : age.max;
  const bool is_old = !bound || *bound >= level.age_p99_ms_max;
  if (is_old && age.p99) {
    why += (why.empty() ? "" : "; ") + ("age: p99 " + four_digits(*age.p99)) + " ms, not below " +
           four_digits(level.age_p99_ms_max) + " ms";
  }
  if (!why.empty()) return {Verdict::fails, why};
  if (is_old)
    return {Verdict::invalid, "too few updates for the p99 of their age: the run is too short"};
  return {Verdict::holds, ""};
}

Search find_largest(const SearchLimits& limits, const Probing& probe) {
  assert(limits.first >= 1 && limits.first <= limits.most && limits.resolution > 0.0);
  return Bracketing(limits, probe).run();
}

}  // namespace rink::loadgen
