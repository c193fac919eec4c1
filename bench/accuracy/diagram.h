// Run time against error: every contender over every step, until a run gets too long.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/accuracy/position_error.h"
#include "bench/trials/contender.h"
#include "bench/trials/diagram_trials.h"

namespace rink::accuracy {

/// One contender in one trial at one step. Times are of advancing to the horizon, pushes and
/// reading all places at its end included, making the world and its bodies not.
struct Point {
  double dt = 0.0;  ///< s; 0 for an engine without steps
  double run_s = 0.0, fastest_s = 0.0,
         slowest_s = 0.0;  ///< median, least and most of `repeats` processor times
  int repeats = 0;         ///< 0: no run counted
  int refused = 0;         ///< runs that did not count (RunTime::counts())
  PositionError error{};
  double energy_error =
      0.0;  ///< relative change of the kinetic energy; meaningful for a conservative trial
  double overlap = 0.0;  ///< the deepest at the horizon [m]
  std::uint32_t escapes = 0;
};

/// A contender's points in one trial from the longest step to the shortest, and why there are no
/// more.
struct Series {
  Contender contender;
  std::vector<Point> points{};
  std::string why_not_finer{};  ///< empty if the time for a run was the reason
};

struct Panel {
  DiagramTrial trial;
  std::vector<Series> series{};
};

/// How much work a diagram is.
struct Effort {
  double run_max_s = 0.15;  ///< the first step whose run takes longer is the last
  int repeats = 5;          ///< fewer of what takes longer than run_max_s/5
  double limit_s = 20.0;    ///< for all repeats of a point; what takes longer did not survive
};

/// So many runs are refused before a point is given up.
inline constexpr int refused_max = 20;

/// Runs `contender` at `dt` once per repeat in this process, and again for each that does not
/// count.
Point measure(const DiagramTrial& trial, const std::vector<Vector2>& true_places,
              const Contender& contender, double dt, const Effort& effort);

/// Halves the step from a sixtieth of a second on. Each point has a process of its own (guarded.h).
Series measure_series(const DiagramTrial& trial, const std::vector<Vector2>& true_places,
                      const Contender& contender, const Effort& effort,
                      const std::atomic<bool>& is_interrupted);

/// When a series gets to an error.
struct TimeAtError {
  enum class Kind : std::uint8_t { met, faster, never };
  Kind kind = Kind::never;
  double run_s = 0.0;  ///< met: between the points around `error`, on logarithmic axes; faster: of
                       ///< its first point, which is better already; never: of its last
};
/// Nothing if `points` is empty. The last crossing counts: a step that is right by chance, between
/// others that are not, is not an answer.
std::optional<TimeAtError> time_at_error(std::span<const Point> points, double error);

/// The order of convergence: the slope of log error over log step by least squares, from the first
/// step whose error is below a tenth of the first's on; nothing for fewer than three such points.
std::optional<double> order_of(std::span<const Point> points);

}  // namespace rink::accuracy
