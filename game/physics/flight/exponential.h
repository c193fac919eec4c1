// Exponential and logarithm with bits of their own: those of the C library differ between versions,
// and the world's state must not.
#pragma once

namespace rink::physics {

/// exp(x) - 1 for x <= 0 down to -infinity, error below 1 ulp.
double expm1_of(double x);
/// The C library's, for references: its bits are nobody's promise.
long double expm1_of(long double x);

/// log(1 + x) for x > -1, error below 1 ulp; -infinity at -1.
double log1p_of(double x);
long double log1p_of(long double x);

}  // namespace rink::physics
