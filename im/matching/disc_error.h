// How far the squared distance from a disc to a box may be wrong in single precision.
#pragma once

namespace rink::im {

// All lengths are doubled, as in disc.cpp: m is the middle of the disc, w and h the sides of the
// rectangle that holds it, d = min(w, h), x and y the offsets of the box's nearest point, and what
// is judged is the excess x^2 + y^2 - d^2. With u = 2^-24, an edge of the rectangle is at most (|m|
// + w) / 2 away from the origin and one of the box that is nearest (|m| + x) / 2, and each is
// rounded by u of that. So m errs by 2 u (|m| + w), x by 4 u (|m| + w + x), d by 2 u (|m| + w).
// With A = w + h + |m_x| + |m_y| + x + y and L = x + y + d the excess errs by less than 2 L 4 u A +
// 3 (4 u A)^2 + 4 u L^2, L <= A; the numbers below are four and eight times that.
inline constexpr float disc_error_first = 0x1p-19f, disc_error_second = 0x1p-39f;
/// Squares below the least float are lost.
inline constexpr float disc_error_least = 1e-30f;
/// Larger discs are always in doubt, farther boxes never reach a smaller one; up to here no square
/// overflows.
inline constexpr float disc_size_max = 1e18f, disc_offset_max = 1e19f;

}  // namespace rink::im
