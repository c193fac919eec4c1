// Reweighted normal equations; parts that would be negative are left out.
#include "loadgen/measure/statistics/linear_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::loadgen {
namespace {

constexpr int rounds = 50;

double squared_log(double y, double fitted) {
  const double off = std::log(y / fitted);
  return off * off;
}

/// One round: weights from the values fitted last.
LinearFit weighted(std::span<const FitPoint> points, const LinearFit& last) {
  double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0;
  for (const FitPoint& point : points) {
    const double weight = 1.0 / (last.at(point.x) * last.at(point.x));
    w += weight, wx += weight * point.x, wy += weight * point.y, wxx += weight * point.x * point.x,
        wxy += weight * point.x * point.y;
  }
  const double x_mean = wx / w, y_mean = wy / w;
  LinearFit fit;
  fit.slope = (wxy - wx * y_mean) / (wxx - wx * x_mean);
  fit.constant = y_mean - fit.slope * x_mean;
  if (fit.slope < 0.0) fit.slope = 0.0, fit.constant = y_mean;
  if (fit.constant < 0.0) fit.constant = 0.0, fit.slope = wxy / wxx;
  return fit;
}

}  // namespace

std::optional<double> LinearFit::reaches(double y) const {
  if (!(slope > 0.0) || y < constant) return std::nullopt;
  return (y - constant) / slope;
}

std::optional<LinearFit> fit_line(std::span<const FitPoint> points) {
  bool has_two = false;
  double mean = 0.0;
  for (const FitPoint& point : points) {
    if (!(point.x > 0.0) || !(point.y > 0.0)) return std::nullopt;
    has_two = has_two || point.x != points.front().x;
    mean += point.y / static_cast<double>(points.size());
  }
  if (!has_two) return std::nullopt;
  LinearFit fit{.constant = mean};
  for (int round = 0; round < rounds; ++round) fit = weighted(points, fit);
  assert(!(fit.constant < 0.0) && !(fit.slope < 0.0));
  for (const FitPoint& point : points) fit.log_residual += squared_log(point.y, fit.at(point.x));
  return fit;
}

double log_residual(const PowerFit& fit, std::span<const FitPoint> points) {
  double sum = 0.0;
  for (const FitPoint& point : points)
    sum += squared_log(point.y, fit.factor * std::pow(point.x, fit.exponent));
  return sum;
}

}  // namespace rink::loadgen
