// The bytes that rival policies send at the displayed error and the recall of the compared policy,
// interpolated along each rival's own settings (docs/metrics.md, "Equal error").
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/measure/statistics/statistics.h"

namespace rink::loadgen {

/// One run as a point of its policy's curve. All are of one game.
struct RivalPoint {
  double setting_rate_hz = 0.0,
         setting_threshold = 0.0;    ///< by which a policy trades bytes for error
  double margin = 0.0;               ///< by which it trades bytes for recall [m]
  double recall = 0.0;               ///< delivered
  double error_mm = 0.0;             ///< displayed, RMS; above 0
  double payload = 0.0, wire = 0.0;  ///< bytes per client and second; above 0
};

/// The bytes that a policy sends at a recall and an error, or why they cannot be determined.
struct AtEqualError {
  enum class End : std::uint8_t {
    bracketed,    ///< settings on both sides of the error were run
    not_reached,  ///< no setting among the runs has so small an error at that recall
    not_left      ///< none that errs more sends less: an upper bound, for a coarser one may do
  };
  double payload = 0.0, wire = 0.0;
  End payload_end = End::not_reached, wire_end = End::not_reached;
  /// Settings that have the recall, by whether their error is at most the one asked for.
  std::size_t points_below = 0, points_above = 0;
};

/// With fewer points on one side of the error, the curve is uncertain there.
inline constexpr std::size_t points_wanted = 5;

/// The least that settings along `points` send with a recall of at least `recall` and a displayed
/// error of at most `error_mm`. Along margins, bytes and error are interpolated in recall (their
/// logarithms linearly); along settings, on the frontier of those that no other beats in both error
/// and bytes, linearly in the logarithms.
AtEqualError at_equal_error(std::span<const RivalPoint> points, double recall, double error_mm);

/// A rival's bytes divided by those of the policy that it is compared with, paired by seed.
struct RivalRatio {
  std::string policy;
  std::optional<Ratio> payload, wire;
  AtEqualError::End payload_end = AtEqualError::End::not_reached;  ///< the worst of all seeds'
  AtEqualError::End wire_end = AtEqualError::End::not_reached;
  std::size_t settings = 0;                        ///< that were run
  std::size_t points_below = 0, points_above = 0;  ///< the least of all seeds'
  bool has_few_points() const { return std::min(points_below, points_above) < points_wanted; }
};

/// One policy beside its rivals under one scheme, at one recall.
struct EqualError {
  std::string mode, scheme, subject;
  std::uint32_t clients = 0;
  double delay_ms = 0.0, rate_hz = 0.0;
  bool is_own_recall = false;  ///< the recall is that of the subject without a margin; else the
                               ///< requested one
  double recall = 0.0, error_mm = 0.0, payload = 0.0,
         wire = 0.0;  ///< of the subject, means over seeds
  std::vector<RivalRatio>
      rivals;  ///< the best, that with the least payload, first; those that cannot be compared last
};

/// The recall at which policies are compared beside the scheme's own.
inline constexpr double equal_recall = 0.999;

/// For each scheme, delay and number of clients of the parts that give curves: `subject` at the
/// first of the rates, without a margin and at `equal_recall`, beside every other policy. Empty if
/// no part gives curves or the subject is in none.
std::vector<EqualError> equal_errors_of(const Experiment& experiment,
                                        std::span<const RunRecord> runs,
                                        const std::string& subject = "on-event");

/// Runs that are rows of tables and marks of plots: all but the points of curves.
std::vector<RunRecord> without_curves(const Experiment& experiment,
                                      std::span<const RunRecord> runs);

/// As a table; empty if there is nothing.
std::string equal_error_table(std::span<const EqualError> comparisons);

/// As CSV (RFC 4180), a line for each rival.
std::string to_csv(std::span<const EqualError> comparisons);

}  // namespace rink::loadgen
