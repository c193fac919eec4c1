// Areas of relevance that tests share.
#pragma once

#include <cstdint>

#include "loadgen/truth/relevance.h"

namespace rink::loadgen {

/// Of half side, and of radius, 1 m.
inline constexpr RelevanceArea square{RelevanceArea::Shape::square, 1.0}, disc{RelevanceArea::Shape::disc, 1.0};

/// No entity: for whoever has none of its own to leave out.
inline constexpr std::uint32_t nobody = 0xffffffffu;

}  // namespace rink::loadgen
