// Updates the places of boxes in an index, and measures how far they moved and how wide they
// became.
#pragma once

#include <cstdint>

#include "im/matching/index/scan.h"
#include "im/matching/projection.h"
#include "im/matching/region_history.h"

namespace rink::im {

/// Boxes in columns to be written.
struct BoxColumnsOut {
  float *low_x, *low_y, *high_x, *high_y;
};

/// Some boxes of an index. `now` holds where they were binned, which may be where they were before
/// `before`, and receives where they are.
struct Advancing {
  const std::uint32_t* ids;
  const RegionHistory& regions;
  const Projection& projection;
  BoxColumns before;
  BoxColumnsOut now;
};

/// The greatest values over all boxes, along each axis [m]; zero if there are none.
struct Advanced {
  float widest_x = 0.0f, widest_y = 0.0f;  ///< side of the hull of a box before and now
  float shift_x = 0.0f, shift_y = 0.0f;    ///< way of a low corner from before to now
  float begun_x = 0.0f,
        begun_y = 0.0f;  ///< way up of a low corner from where it was binned to before
  bool is_exact = true;  ///< no projection lost anything; may stay true if not asked for
};

/// Of the boxes at places `first` to `end`. `asks_exact`: whether `is_exact` is wanted.
using Advance = Advanced (*)(const Advancing& boxes, std::size_t first, std::size_t end,
                             bool asks_exact);

/// The function for these instructions: one box after the other, or several at a time, with the
/// same numbers.
Advance advance(Instructions instructions);

}  // namespace rink::im
