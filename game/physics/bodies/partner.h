// What a body can touch: another body, or a fixed part of the field.
#pragma once

#include <cstdint>

namespace rink::physics {

/// A contact partner: a body, or one of the fixed parts of the field.
using Partner = std::uint32_t;
namespace partner {
constexpr Partner none = 0xffffffff;
constexpr Partner field_parts = 0xfffffff0;  ///< every partner from here on is a part of the field
constexpr Partner wall_left = field_parts + 0, wall_right = field_parts + 1,
                  wall_bottom = field_parts + 2, wall_top = field_parts + 3;
constexpr Partner halfway = field_parts + 4;
constexpr Partner edge_left_low = field_parts + 5, edge_left_high = field_parts + 6,
                  edge_right_low = field_parts + 7, edge_right_high = field_parts + 8;
constexpr Partner mouth_in = field_parts + 9,
                  mouth_out = field_parts + 10;  ///< a puck passes between the edges of a goal
constexpr Partner goal_line = field_parts + 11;
constexpr Partner release = field_parts + 12;  ///< a rest contact ends
constexpr Partner stop = field_parts + 13;     ///< friction has brought a puck to rest
}  // namespace partner

constexpr bool is_body(Partner p) { return p < partner::field_parts; }

}  // namespace rink::physics
