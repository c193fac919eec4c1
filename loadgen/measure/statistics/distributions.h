// The distributions that intervals and tests of fit are read from, by way of the incomplete beta
// function.
#pragma once

#include <cstdint>

namespace rink::loadgen {

/// The regularised incomplete beta function I_x(a, b), a, b > 0, 0 <= x <= 1, to about 1e-13 for a
/// + b up to a thousand: its continued fraction (DLMF 8.17.22) by Lentz's method.
double regularized_beta(double x, double a, double b);

/// The t below which Student's distribution with `freedom` > 0 degrees of freedom has the
/// `probability`, above 0 and below 1, to about 1e-11 of itself for up to a thousand degrees.
double student_t_quantile(double probability, double freedom);

/// The probability that at least `count` of `trials` succeed if each does with `probability`, above
/// 0 and below 1: the binomial tail, I_p(k, n - k + 1) (DLMF 8.17.5).
double binomial_tail(std::uint64_t count, std::uint64_t trials, double probability);

/// The probability that Fisher's F with `above` and `below` degrees of freedom (numerator,
/// denominator; both > 0) exceeds `f` >= 0.
double f_tail(double f, double above, double below);

}  // namespace rink::loadgen
