// Fits a straight line to logarithms, and tests it by replications.
#include "loadgen/measure/statistics/power_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "loadgen/measure/statistics/distributions.h"

namespace rink::loadgen {
namespace {

constexpr double bend_max = 0.1, misfit_significance = 0.05, confidence = 0.95;

/// Sums over the logarithms, about their means.
struct Moments {
  double x_mean = 0.0, y_mean = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};

Moments moments_of(std::span<const FitPoint> logs) {
  assert(!logs.empty());
  Moments moments;
  const auto count = static_cast<double>(logs.size());
  for (const FitPoint& point : logs)
    moments.x_mean += point.x / count, moments.y_mean += point.y / count;
  for (const FitPoint& point : logs) {
    const double dx = point.x - moments.x_mean, dy = point.y - moments.y_mean;
    moments.xx += dx * dx;
    moments.xy += dx * dy;
    moments.yy += dy * dy;
  }
  return moments;
}

/// The replications at one x.
struct Place {
  double sum = 0.0, squares = 0.0, count = 0.0;
  double mean() const { return sum / count; }
  double scatter() const { return std::max(0.0, squares - sum * sum / count); }
};

/// The F test for lack of fit (Draper & Smith, Applied Regression Analysis, 1998, 2.1): needs
/// replications and more places than the line has parameters.
std::optional<double> misfit_probability(const std::map<double, Place>& places, double residual,
                                         std::size_t count) {
  double pure = 0.0;
  for (const auto& [x, place] : places) pure += place.scatter();
  if (places.size() < 3 || count <= places.size()) return std::nullopt;
  const auto above = static_cast<double>(places.size() - 2),
             below = static_cast<double>(count - places.size());
  if (pure <= 0.0) return residual > 0.0 ? 0.0 : 1.0;
  return f_tail(std::max(0.0, residual - pure) / above / (pure / below), above, below);
}

}  // namespace

bool PowerFit::is_rejected() const {
  return bend > bend_max && misfit_p.value_or(0.0) < misfit_significance;
}

std::optional<PowerFit> fit_power(std::span<const FitPoint> points) {
  std::vector<FitPoint> logs;
  for (const FitPoint& point : points) {
    if (!(point.x > 0.0) || !(point.y > 0.0)) return std::nullopt;
    logs.push_back({std::log(point.x), std::log(point.y)});
  }
  std::map<double, Place> places;
  const Moments moments = logs.empty() ? Moments{} : moments_of(logs);
  for (const FitPoint& point : logs) {
    Place& place = places[point.x];
    place.sum += point.y - moments.y_mean;  // about the mean, so that the squares do not cancel
    place.squares += (point.y - moments.y_mean) * (point.y - moments.y_mean);
    place.count += 1.0;
  }
  if (places.size() < 2) return std::nullopt;

  assert(moments.xx > 0.0 && "places lie apart");
  PowerFit fit;
  fit.points = points.size();
  fit.places = places.size();
  fit.exponent = moments.xy / moments.xx;
  fit.factor = std::exp(moments.y_mean - fit.exponent * moments.x_mean);
  const double residual = std::max(0.0, moments.yy - fit.exponent * moments.xy);
  if (moments.yy > 0.0) fit.r_squared = 1.0 - residual / moments.yy;
  if (logs.size() > 2) {
    const auto freedom = static_cast<double>(logs.size() - 2);
    const double half = student_t_quantile(0.5 + 0.5 * confidence, freedom) *
                        std::sqrt(residual / freedom / moments.xx);
    fit.exponent_low = fit.exponent - half;
    fit.exponent_high = fit.exponent + half;
  }
  for (const auto& [x, place] : places)
    fit.bend = std::max(fit.bend,
                        std::expm1(std::abs(place.mean() - fit.exponent * (x - moments.x_mean))));
  fit.misfit_p = misfit_probability(places, residual, logs.size());
  for (auto next = std::next(places.begin()), place = places.begin(); next != places.end();
       ++place, ++next) {
    fit.locals.push_back(
        {std::exp(place->first), std::exp(next->first),
         (next->second.mean() - place->second.mean()) / (next->first - place->first)});
  }
  assert(fit.locals.size() + 1 == fit.places && fit.points >= fit.places);
  return fit;
}

}  // namespace rink::loadgen
