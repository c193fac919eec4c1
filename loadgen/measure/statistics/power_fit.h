// A power law through measured points: its exponent with an interval, and whether the points
// contradict it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rink::loadgen {

struct FitPoint {
  double x = 0.0, y = 0.0;  ///< both above 0
};

/// y = factor x^exponent, by least squares on logarithms (Jain, The Art of Computer Systems
/// Performance Analysis, 1991, 14 and 15).
struct PowerFit {
  double exponent = 0.0, factor = 0.0;
  std::optional<double> exponent_low,
      exponent_high;       ///< 95 % t interval with n - 2 degrees of freedom; absent for two points
  double r_squared = 1.0;  ///< of the logarithms
  std::size_t points = 0, places = 0;  ///< points, and different x among them
  double bend = 0.0;  ///< how far the mean at some x lies from the line, at most, as a fraction:
                      ///< 0.1 is 10 % above or below
  std::optional<double> misfit_p;  ///< of the F test for lack of fit: pure error from replications
                                   ///< at equal x against the means' distance from the line
  struct Local {
    double x_low, x_high, exponent;  ///< between neighbouring x: slope of the mean logarithms
  };
  std::vector<Local> locals;

  /// Whether the points contradict a power law: their means bend by more than a tenth, and
  /// replications, if there are any, do not excuse it (p < 0.05).
  bool is_rejected() const;
};

/// Nothing if there are fewer than two different x, or if some x or y is not above 0.
std::optional<PowerFit> fit_power(std::span<const FitPoint> points);

}  // namespace rink::loadgen
