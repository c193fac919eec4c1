// Sorted along x and swept, so that a crowd costs n log n and not n squared.
#include "bench/peers/overlap.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace rink::peers {
namespace {

bool is_within(const physics::Field& field, const Vector2& place) {
  return place.x() >= 0.0 && place.x() <= field.length && place.y() >= 0.0 &&
         place.y() <= field.width;
}

double depth_in_walls(const physics::Field& field, const Outline& body, const Vector2& place) {
  const Vector2 reach = body.reach(),
                beyond =
                    (place + reach - Vector2(field.length, field.width)).cwiseMax(reach - place);
  return beyond.maxCoeff();
}

}  // namespace

double depth(const Outline& a, const Outline& b, const Vector2& offset) {
  const Vector2 apart = offset.cwiseAbs() - a.half_extent - b.half_extent;
  const double radius = a.radius + b.radius;
  assert(radius >= 0.0);
  // Within the rectangle the way out is the shorter of the two axes, elsewhere the distance to its
  // nearest point counts.
  if (apart.maxCoeff() <= 0.0) return radius - apart.maxCoeff();
  return radius - apart.cwiseMax(0.0).norm();
}

double deepest_overlap(const physics::Field& field, std::span<const Outline> outlines,
                       std::span<const Vector2> places) {
  assert(outlines.size() == places.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (is_within(field, places[i])) order.push_back(i);
  const auto left = [&](std::size_t i) { return places[i].x() - outlines[i].reach().x(); };
  std::ranges::sort(order, {}, left);
  double deepest = 0.0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t i = order[k];
    const bool is_fixed = outlines[i].mass == std::numeric_limits<double>::infinity();
    if (!is_fixed) deepest = std::max(deepest, depth_in_walls(field, outlines[i], places[i]));
    const double right = places[i].x() + outlines[i].reach().x();
    for (std::size_t later = k + 1; later < order.size() && left(order[later]) < right; ++later) {
      const std::size_t j = order[later];
      if (is_fixed && outlines[j].mass == outlines[i].mass) continue;
      deepest = std::max(deepest, depth(outlines[i], outlines[j], places[j] - places[i]));
    }
  }
  return deepest;
}

}  // namespace rink::peers
