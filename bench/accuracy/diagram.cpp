// Medians of repeats in a fresh process each, so that no contender inherits another's heap.
#include "bench/accuracy/diagram.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bench/accuracy/guarded.h"
#include "bench/accuracy/run_time.h"

namespace rink::accuracy {
namespace {

constexpr int halvings_max = 20;

struct Timed {
  std::unique_ptr<physics::Simulator> world;
  std::vector<Vector2> places;
  double start_energy = 0.0;
  RunTime time{};
};

Timed run(const Trial& trial, const Contender& contender, double dt) {
  Timed timed{make_world(trial, contender, dt), {}};
  timed.places.reserve(trial.body_count());
  timed.start_energy = timed.world->kinetic_energy();
  const Stopwatch watch;
  Play play(trial, *timed.world);
  play.advance(trial.horizon);
  for (std::size_t i = trial.first_mover(); i < trial.body_count(); ++i)
    timed.places.push_back(timed.world->position({static_cast<std::uint32_t>(i)}));
  timed.time = watch.passed();
  assert(timed.world->body_count() == trial.body_count());
  return timed;
}

}  // namespace

Point measure(const DiagramTrial& trial, const std::vector<Vector2>& true_places,
              const Contender& contender, double dt, const Effort& effort) {
  assert(dt > 0.0 && effort.repeats > 0 && effort.run_max_s > 0.0);
  assert(true_places.size() == trial.trial.body_count() - trial.trial.first_mover());
  Point point{.dt = contender.is_stepped() ? dt : 0.0};
  std::vector<double> times;
  Timed last;
  int wanted = effort.repeats;
  while (point.repeats < wanted && point.refused < refused_max) {
    last = run(trial.trial, contender, dt);
    if (last.time.processor_s > effort.run_max_s / 5.0) wanted = (effort.repeats + 1) / 2;
    if (!last.time.counts()) {
      ++point.refused;
      continue;
    }
    times.push_back(last.time.processor_s);
    ++point.repeats;
  }
  std::ranges::sort(times);
  if (!times.empty())
    point.run_s = times[times.size() / 2], point.fastest_s = times.front(),
    point.slowest_s = times.back();
  point.error = position_error(last.places, true_places);
  point.energy_error =
      last.start_energy > 0.0 ? last.world->kinetic_energy() / last.start_energy - 1.0 : 0.0;
  point.overlap = last.world->max_overlap();
  point.escapes = physics::escape_count(*last.world);
  return point;
}

Series measure_series(const DiagramTrial& trial, const std::vector<Vector2>& true_places,
                      const Contender& contender, const Effort& effort,
                      const std::atomic<bool>& is_interrupted) {
  Series series{contender};
  double dt = frame;
  for (int halving = 0; halving <= halvings_max; ++halving, dt /= 2.0) {
    const Outcome outcome =
        guarded([&] { return to_bytes(measure(trial, true_places, contender, dt, effort)); },
                effort.limit_s, &is_interrupted);
    const auto point = outcome.output ? from_bytes<Point>(*outcome.output) : std::nullopt;
    if (!point) {
      series.why_not_finer = outcome.why_not;
      return series;
    }
    if (point->repeats == 0) {
      series.why_not_finer = "refused: processor and real time differ by more than 10 %";
      return series;
    }
    series.points.push_back(*point);
    if (!contender.is_stepped() || point->run_s > effort.run_max_s) return series;
  }
  return series;
}

std::optional<TimeAtError> time_at_error(std::span<const Point> points, double error) {
  assert(error > 0.0);
  if (points.empty()) return std::nullopt;
  using Kind = TimeAtError::Kind;
  const auto too_far = std::find_if(points.rbegin(), points.rend(), [error](const Point& point) {
    return !(point.error.p90 <= error);
  });
  if (too_far == points.rend()) return TimeAtError{Kind::faster, points.front().run_s};
  if (too_far == points.rbegin()) return TimeAtError{Kind::never, points.back().run_s};
  const Point &before = *too_far, &after = *std::prev(too_far);
  assert(after.error.p90 <= error);  // all that come later are good enough
  if (!std::isfinite(before.error.p90) || after.error.p90 <= 0.0)
    return TimeAtError{Kind::met, after.run_s};
  const double share =
      std::log(before.error.p90 / error) / std::log(before.error.p90 / after.error.p90);
  return TimeAtError{Kind::met, before.run_s * std::pow(after.run_s / before.run_s, share)};
}

std::optional<double> order_of(std::span<const Point> points) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Point& point : points) {
    if (!(point.error.p90 > 0.0) || point.error.p90 > 0.1 * points.front().error.p90) continue;
    assert(point.dt > 0.0);
    const double step = std::log(point.dt), error = std::log(point.error.p90);
    n += 1.0, x += step, y += error, xx += step * step, xy += step * error;
  }
  if (n < 3.0) return std::nullopt;
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace rink::accuracy
