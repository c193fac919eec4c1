// One continued fraction; the quantile is found by bisection, since it is not time-critical.
#include "loadgen/measure/statistics/distributions.h"

#include <cassert>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace rink::loadgen {
namespace {

/// The continued fraction of I_x(a, b) without its factor; converges fast for x < (a + 1)/(a + b +
/// 2).
double beta_fraction(double x, double a, double b) {
  constexpr double tiny = 1e-300, enough = 1e-16;
  constexpr int terms_max = 10'000;  // it takes O(sqrt(max(a, b))) terms
  const auto away_from_zero = [](double value) { return std::abs(value) < tiny ? tiny : value; };
  double c = 1.0, d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0)), fraction = d;
  for (int m = 1; m < terms_max; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    double change = 1.0;
    for (const double term : {even, odd}) {
      d = 1.0 / away_from_zero(1.0 + term * d);
      c = away_from_zero(1.0 + term / c);
      change = c * d;
      fraction *= change;
    }
    if (std::abs(change - 1.0) < enough) break;
  }
  return fraction;
}

/// The probability that Student's t exceeds `t` >= 0.
double student_t_tail(double t, double freedom) {
  assert(t >= 0.0 && freedom > 0.0);
  return 0.5 * regularized_beta(freedom / (freedom + t * t), 0.5 * freedom, 0.5);
}

}  // namespace

double regularized_beta(double x, double a, double b) {
  assert(x >= 0.0 && x <= 1.0 && a > 0.0 && b > 0.0);
  if (x == 0.0 || x == 1.0) return x;
  const double factor = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                 a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return factor * beta_fraction(x, a, b) / a;
  return 1.0 - factor * beta_fraction(1.0 - x, b, a) / b;
}

double student_t_quantile(double probability, double freedom) {
  assert(probability > 0.0 && probability < 1.0 && freedom > 0.0);
  if (probability == 0.5) return 0.0;
  const double tail = probability < 0.5 ? probability : 1.0 - probability;
  double low = 0.0, high = 1.0;
  while (student_t_tail(high, freedom) > tail && high < std::numeric_limits<double>::max() / 4.0)
    low = high, high *= 2.0;
  while (high - low > 1e-15 * high) {
    const double middle = low + 0.5 * (high - low);
    if (middle == low || middle == high) break;
    (student_t_tail(middle, freedom) > tail ? low : high) = middle;
  }
  assert(low >= 0.0 && low <= high);
  return probability < 0.5 ? -high : high;
}

double binomial_tail(std::uint64_t count, std::uint64_t trials, double probability) {
  assert(probability > 0.0 && probability < 1.0);
  if (count == 0) return 1.0;
  if (count > trials) return 0.0;
  return regularized_beta(probability, static_cast<double>(count),
                          static_cast<double>(trials - count + 1));
}

double f_tail(double f, double above, double below) {
  assert(f >= 0.0 && above > 0.0 && below > 0.0);
  return regularized_beta(below / (below + above * f), 0.5 * below, 0.5 * above);
}

}  // namespace rink::loadgen
