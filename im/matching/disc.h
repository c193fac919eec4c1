// The shape of a subscription that an entity's rectangle must touch: the rectangle, or the disc
// that it holds.
#pragma once

#include <cstdint>

#include "im/filter.h"

namespace rink::im {

enum class Shape : std::uint8_t { rectangle, disc };

/// True if `box` touches the closed disc around the middle of `subscription` whose radius is half
/// its shorter side. Never if either is nowhere. Exact wherever the coordinates are multiples of a
/// common step and less than 2^30 of them apart; elsewhere two distances that differ by less than
/// 2^-62 of their size may be taken for equal.
bool touches_disc(const Region& subscription, const Region& box);

}  // namespace rink::im
