// Searches square rings, which needs neither sine nor sorting and so gives the same place on every
// machine.
#include "game/control/free_place.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::game {
namespace {

using physics::Vector2;

/// The first point of the rings of `step` around `spot` for which `is_free` holds; rings that lie
/// wholly outside the field end the search.
template <class IsFree>
std::optional<Vector2> first_free(const physics::Field& field, const Vector2& spot, double step,
                                  const IsFree& is_free) {
  assert(step > 0.0 && spot.allFinite());
  const int ring_max = static_cast<int>(std::ceil(std::max(field.length, field.width) / step));
  if (is_free(spot)) return spot;
  for (int ring = 1; ring <= ring_max; ++ring)
    for (int row = -ring; row <= ring; ++row) {
      const bool is_end_row = row == -ring || row == ring;
      for (int column = -ring; column <= ring; column += is_end_row ? 1 : 2 * ring) {
        const Vector2 place = spot + step * Vector2(column, row);
        if (is_free(place)) return place;
      }
    }
  return std::nullopt;
}

}  // namespace

std::optional<Vector2> nearest_free_disc(const physics::Simulator& simulator, const Vector2& spot,
                                         double radius) {
  return first_free(simulator.spec().field, spot, radius / 4,
                    [&](const Vector2& place) { return simulator.is_free(place, radius); });
}

std::vector<Vector2> places_for_disc(const physics::Field& field, const Vector2& spot,
                                     double radius, std::size_t first, std::size_t count) {
  assert(radius > 0.0 && count > 0);
  std::vector<Vector2> places;
  std::size_t number = 0;
  first_free(field, spot, radius / 4, [&](const Vector2& place) {
    if (number++ >= first) places.push_back(place);
    return places.size() == count;
  });
  assert(places.size() <= count);
  return places;
}

std::optional<Vector2> nearest_free_rectangle(const physics::Simulator& simulator,
                                              const Vector2& spot, const Vector2& half_extent,
                                              physics::Half half) {
  const physics::Field& field = simulator.spec().field;
  const auto is_in_half = [&](const Vector2& place) {
    if (!field.bats_keep_to_half || half == physics::Half::both) return true;
    return half == physics::Half::left ? place.x() + half_extent.x() <= field.length / 2
                                       : place.x() - half_extent.x() >= field.length / 2;
  };
  return first_free(field, spot, half_extent.minCoeff() / 4, [&](const Vector2& place) {
    return is_in_half(place) && simulator.is_free(place, half_extent);
  });
}

}  // namespace rink::game
