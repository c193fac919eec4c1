// Areas of relevance that tests share.
#pragma once

#include <cstdint>

#include "loadgen/measure/truth/relevance.h"

namespace rink::loadgen {

inline constexpr double interest_radius = 1.0;  ///< m

/// Of that half side, and of that radius.
inline const RelevanceArea square{RelevanceArea::Shape::square, interest_radius},
    disc{RelevanceArea::Shape::disc, interest_radius};

/// No entity: for whoever has none of its own to leave out.
inline constexpr std::uint32_t nobody = 0xffffffffu;

}  // namespace rink::loadgen
