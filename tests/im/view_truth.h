// What a field of view and a post's shadow are, worked out in 1600 bits by other means than the
// schemes use.
#pragma once

#include <utility>

#include "im/filter.h"

namespace rink::im {

/// A subscription as its owner left it: where it is, where it looks, and whose it is; and an entity
/// likewise.
struct Observer : Region {
  Heading heading;
  Role role;
};
struct Body : Region {
  Role role;
};

/// The middle of a subscription, where its owner stands.
std::pair<double, double> eye_of(const Region& subscription);

/// The rectangle, cut by the half-planes of the field of view, comes within reach of its point.
bool sector_touches(const FilterSettings& settings, const Observer& observer, const Region& update);

/// True if the way from the middle of `subscription` to (x, y) comes nearer to the post's middle
/// than its radius.
bool is_in_shadow(const Disc& post, const Region& subscription, double x, double y);

/// Rectangles overlap, and of each post some corner is in the light, unless the eye is inside of
/// it.
bool is_in_sight(const FilterSettings& settings, const Region& subscription, const Region& update);

}  // namespace rink::im
