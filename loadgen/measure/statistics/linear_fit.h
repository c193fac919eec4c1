// A constant and a part that grows in proportion, through measured points.
#pragma once

#include <optional>
#include <span>

#include "loadgen/measure/statistics/power_fit.h"

namespace rink::loadgen {

/// y = constant + slope x, by least squares on relative distances: each point weighs 1 / y^2 of its
/// fitted value, found by repetition, for costs scatter in proportion to their size (iteratively
/// reweighted least squares; Draper & Smith, Applied Regression Analysis, 1998, 9.2 and 24).
/// Neither part is below 0: what would be is 0.
struct LinearFit {
  double constant = 0.0, slope = 0.0;
  double log_residual = 0.0;  ///< sum over the points of the squared logarithm of y / fitted y

  double at(double x) const { return constant + slope * x; }
  /// Where y is reached; nothing if it never is.
  std::optional<double> reaches(double y) const;
};

/// Nothing if there are fewer than two different x, or if some x or y is not above 0.
std::optional<LinearFit> fit_line(std::span<const FitPoint> points);

/// The same residual of a power law; both have two parameters, so the smaller one fits better.
double log_residual(const PowerFit& fit, std::span<const FitPoint> points);

}  // namespace rink::loadgen
