// The classic table-free algorithms (Sun Microsystems' fdlibm, 1993: s_expm1.c, s_log1p.c), in
// plain IEEE double arithmetic. Constants and method: Copyright (C) 1993 by Sun Microsystems, Inc.
// All rights reserved. Permission to use, copy, modify, and distribute this software is freely
// granted, provided that this notice is preserved.
#include "game/physics/flight/exponential.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rink::physics {

namespace {

constexpr double ln2_high =
    6.93147180369123816490e-01;  // the upper 33 bits, so that a multiple of it is exact
constexpr double ln2_low = 1.90821492927058770002e-10;
constexpr double tiny = 0x1p-54;

double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// c(x) such that expm1(x) = x - (x c(x) - x^2/2), on |x| <= ln2/2.
double expm1_correction(double x) {
  const double half = 0.5 * x, square = x * half;
  const double r =
      1.0 + square * (-3.33333333333331316428e-02 +
                      square * (1.58730158725481460165e-03 +
                                square * (-7.93650757867487942473e-05 +
                                          square * (4.00821782732936239552e-06 +
                                                    square * -2.01099218183624371326e-07))));
  const double t = 3.0 - r * half;
  return square * ((r - t) / (6.0 - x * t));
}

/// The odd part of log((1 + s)/(1 - s)) without 2 s, z = s^2.
double log1p_series(double z) {
  return z *
         (6.666666666666735130e-01 +
          z * (3.999999999940941908e-01 +
               z * (2.857142874366239149e-01 +
                    z * (2.222219843214978396e-01 +
                         z * (1.818357216161805012e-01 +
                              z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
}

}  // namespace

double expm1_of(double x) {
  if (x > -tiny) return x;
  if (x < -39.0) return -1.0;
  const int k = x > -0.34657359027997264 ? 0 : static_cast<int>(1.44269504088896338700 * x - 0.5);
  const double high = x - k * ln2_high, low = k * ln2_low;
  const double reduced = high - low, lost = (high - reduced) - low;
  const double square = 0.5 * reduced * reduced;
  const double e = expm1_correction(reduced);
  if (k == 0) return reduced - (reduced * e - square);
  const double f = reduced * (e - lost) - lost - square;
  if (k == -1) return 0.5 * (reduced - f) - 0.5;
  return (1.0 - (f - reduced)) * power_of_two(k) - 1.0;
}

double log1p_of(double x) {
  if (x <= -1.0) return -std::numeric_limits<double>::infinity();
  if (std::abs(x) < tiny) return x;
  int k = 0;
  double f = x, lost = 0.0;
  if (x <= -0.29289321881345254 || x >= 0.41421356237309503) {
    const double u = 1.0 + x;
    const auto bits = std::bit_cast<std::uint64_t>(u);
    k = static_cast<int>(bits >> 52) - 1023;
    lost = (k > 0 ? 1.0 - (u - x) : x - (u - 1.0)) / u;
    double mantissa = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
    if (mantissa > 1.4142135623730951) {
      mantissa *= 0.5;
      ++k;
    }
    f = mantissa - 1.0;
  }
  const double half_square = 0.5 * f * f;
  const double s = f / (2.0 + f);
  const double tail = s * (half_square + log1p_series(s * s));
  if (k == 0) return f - (half_square - tail);
  return k * ln2_high - ((half_square - (tail + (k * ln2_low + lost))) - f);
}

long double expm1_of(long double x) { return std::expm1(x); }
long double log1p_of(long double x) { return std::log1p(x); }

}  // namespace rink::physics
