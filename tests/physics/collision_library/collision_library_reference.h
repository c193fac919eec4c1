// The truth for the collision library: 113-bit arithmetic and bisection, which share no formula
// with what they judge.
#pragma once

#include <cmath>
#include <optional>

#include "game/physics/collision/shapes.h"

namespace rink::physics::collision::reference {

#ifdef __SIZEOF_FLOAT128__
using Quad = __float128;
#else
using Quad = long double;  // has 113 bits where the type above is missing
#endif

inline constexpr int halvings = 120;  // beyond the last of 113 bits

inline Quad magnitude(Quad x) { return x < 0 ? -x : x; }

struct QuadPoint {
  Quad x, y;
};

inline QuadPoint exact(const Vector<double>& v) { return {v.x(), v.y()}; }
inline QuadPoint operator-(const QuadPoint& a, const QuadPoint& b) {
  return {a.x - b.x, a.y - b.y};
}
inline QuadPoint operator+(const QuadPoint& a, const QuadPoint& b) {
  return {a.x + b.x, a.y + b.y};
}
inline QuadPoint operator*(Quad f, const QuadPoint& a) { return {f * a.x, f * a.y}; }
inline Quad dot(const QuadPoint& a, const QuadPoint& b) { return a.x * b.x + a.y * b.y; }

/// The square root by bisection.
inline Quad root(Quad square) {
  Quad low = 0, high = square > 1 ? square : 1;
  for (int i = 0; i < 2 * halvings; ++i) {
    const Quad middle = (low + high) / 2;
    (middle * middle < square ? low : high) = middle;
  }
  return low;
}

/// What a flying point may meet around the origin: a box grown by a radius. A disc has no half
/// extent, a box no radius.
struct Obstacle {
  QuadPoint half_extent{0, 0};
  Quad radius = 0;

  /// From the nearest point of the box to `p`; 0 inside.
  QuadPoint outside(const QuadPoint& p) const {
    const Quad x = magnitude(p.x) - half_extent.x, y = magnitude(p.y) - half_extent.y;
    return {x > 0 ? (p.x < 0 ? -x : x) : 0, y > 0 ? (p.y < 0 ? -y : y) : 0};
  }
  /// Distance of `p` from touching; below 0 inside (for sharp boxes along the axis that leads out
  /// soonest).
  Quad gap(const QuadPoint& p) const {
    const QuadPoint out = outside(p);
    if (out.x != 0 && out.y != 0) return root(dot(out, out)) - radius;
    const Quad x = magnitude(p.x) - half_extent.x, y = magnitude(p.y) - half_extent.y;
    return (x > y ? x : y) - radius;
  }
  bool rest_contacts(const QuadPoint& p) const {
    const QuadPoint out = outside(p);
    return dot(out, out) <= radius * radius;
  }
  Obstacle grown(Quad by) const {
    return radius > 0 ? Obstacle{half_extent, radius + by}
                      : Obstacle{{half_extent.x + by, half_extent.y + by}, 0};
  }
};

struct Flight {
  QuadPoint offset, velocity;
  QuadPoint at(Quad time) const { return offset + time * velocity; }
};

/// The instant at which `holds` turns from false (at `low`) to true (at `high`).
template <class Holds>
Quad turning(Quad low, Quad high, const Holds& rest_contacts) {
  for (int i = 0; i < halvings; ++i) {
    const Quad middle = (low + high) / 2;
    (rest_contacts(middle) ? high : low) = middle;
  }
  return high;
}

/// First touch of a flight that starts outside. The distance from a convex shape is convex in time:
/// it falls until the closest approach, where its slope turns.
inline std::optional<Quad> first_touch(const Flight& flight, const Obstacle& obstacle) {
  const auto has_passed = [&](Quad time) {
    return obstacle.rest_contacts(flight.at(time)) ||
           dot(obstacle.outside(flight.at(time)), flight.velocity) >= 0;
  };
  if (has_passed(0)) return std::nullopt;
  Quad passed = 1e-12;
  while (!has_passed(passed)) passed = 2 * passed;
  Quad before = 0;
  while (!obstacle.rest_contacts(flight.at(passed))) {
    const Quad middle = (before + passed) / 2;
    if (middle <= before || middle >= passed || passed - before <= passed * Quad(1e-33))
      return std::nullopt;
    (has_passed(middle) ? passed : before) = middle;
  }
  return turning(0, passed, [&](Quad time) { return obstacle.rest_contacts(flight.at(time)); });
}

/// The unit outward normal where the flight touches at `time`.
inline QuadPoint normal_at(const Flight& flight, const Obstacle& obstacle, Quad time) {
  const QuadPoint p = flight.at(time), out = obstacle.outside(p);
  if (obstacle.radius > 0) return (1 / root(dot(out, out))) * out;
  const Quad x = magnitude(p.x) - obstacle.half_extent.x,
             y = magnitude(p.y) - obstacle.half_extent.y;
  return x >= y ? QuadPoint{p.x < 0 ? Quad(-1) : Quad(1), 0}
                : QuadPoint{0, p.y < 0 ? Quad(-1) : Quad(1)};
}

/// First touch of a flight with the edge from `from` to `to`, from its outside (on the right), ends
/// lengthened by `slack` times the edge.
inline std::optional<Quad> first_touch_of_edge(const Flight& flight, const QuadPoint& from,
                                               const QuadPoint& to, Quad slack = 0) {
  const QuadPoint along = to - from, outwards{along.y, -along.x};
  const auto is_inside = [&](Quad time) { return dot(outwards, flight.at(time) - from) <= 0; };
  if (is_inside(0) || dot(outwards, flight.velocity) >= 0) return std::nullopt;
  Quad late = 1e-12;
  while (!is_inside(late)) late = 2 * late;
  const Quad time = turning(0, late, is_inside), place = dot(along, flight.at(time) - from),
             whole = dot(along, along);
  if (place < -slack * whole || place > (1 + slack) * whole) return std::nullopt;
  return time;
}

/// exp(-y) - 1 for y >= 0: Taylor's series of an argument that was halved until it is small.
template <class Number>
Number expm1_of_minus(Number y) {
  if (y > 0.25) {
    const Number half = expm1_of_minus(y / 2);
    return half * (half + 2);
  }
  Number sum = 0, term = 1;
  for (int n = 1; n <= 24; ++n) sum += term *= -y / n;
  return sum;
}

/// Solves dx/dt = v, dv/dt = a - g v along one axis: x0 + v0 s + a q, by series where g t is small.
template <class Number>
Number place_under_drag(Number x, Number v, Number a, Number g, Number t) {
  const Number y = g * t, s = g == 0 ? t : -expm1_of_minus(y) / g;
  Number q = 0;
  if (y > 0.25) {
    q = (t - s) / g;
  } else {
    Number term = t * t / 2;
    for (int n = 3; n <= 26; ++n) q += term, term *= -y / n;
  }
  return x + v * s + a * q;
}

/// `a` seen from `b`, both of them under thrust and drag.
template <class Motion>
struct CurvedFlight {
  const Motion& a;
  const Motion& b;

  template <class Number>
  Number along(int axis, Number time) const {
    const auto way = [&](const Motion& m) {
      return place_under_drag<Number>(0, m.velocity[axis], m.acceleration[axis], m.drag[axis],
                                      time - m.time);
    };
    return Number(a.position[axis]) - Number(b.position[axis]) + (way(a) - way(b));
  }
  QuadPoint at(Quad time) const { return {along<Quad>(0, time), along<Quad>(1, time)}; }
  /// The same to 1e-19, fifty times faster.
  QuadPoint near(long double time) const {
    return {along<long double>(0, time), along<long double>(1, time)};
  }
};

}  // namespace rink::physics::collision::reference
