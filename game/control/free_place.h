// Finds a free place for a body whose intended place may be taken.
#pragma once

#include <optional>
#include <vector>

#include "game/physics/simulator.h"

namespace rink::game {

/// The free place for a disc of `radius` [m] nearest to `spot` at the simulator's now(): the spot
/// itself, or else the first free point of the square rings around it, a quarter of the radius
/// apart. The order is fixed, so equal states give equal places. Nothing if the whole field is
/// taken.
std::optional<physics::Vector2> nearest_free_disc(const physics::Simulator& simulator,
                                                  const physics::Vector2& spot, double radius);

/// The places that `nearest_free_disc` tries, in its order: `count` from the `first` on, fewer
/// where they end.
std::vector<physics::Vector2> places_for_disc(const physics::Field& field,
                                              const physics::Vector2& spot, double radius,
                                              std::size_t first, std::size_t count);

/// The nearest free place for a rectangle of `half_extent` [m] that must lie within `half` if the
/// field's bats keep to their halves.
std::optional<physics::Vector2> nearest_free_rectangle(const physics::Simulator& simulator,
                                                       const physics::Vector2& spot,
                                                       const physics::Vector2& half_extent,
                                                       physics::Half half);

}  // namespace rink::game
