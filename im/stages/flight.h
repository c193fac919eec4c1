// When two regions that fly in straight lines against the same drag touch: closed forms, no
// sampling.
#pragma once

#include "im/filter.h"

namespace rink::im {

/// The place and velocity of `flight` at `time` [s], not before its own.
Flight at_time(const Flight& flight, double time, double drag);

/// Half the sides of a box around a flight's middle [m].
struct HalfExtent {
  double x = 0.0, y = 0.0;
};

/// From when to when [s]; `enters > leaves` if never.
struct TimeSpan {
  double enters, leaves;
};

/// When the closed box around one flight touches that around the other, from the later of their
/// times on. With the same drag g their relative path is a straight line in warped time s = (1 -
/// exp(-g t)) / g, so that it is inside of a convex set once; t = -log(1 - g s) / g (docs/im.md).
TimeSpan touching_boxes(const Flight& a, const HalfExtent& a_half, const Flight& b,
                        const HalfExtent& b_half, double drag);

/// When the closed box around `a` touches the closed disc of `radius` [m] around `b`.
TimeSpan touching_disc(const Flight& a, const HalfExtent& a_half, const Flight& b, double radius,
                       double drag);

}  // namespace rink::im
