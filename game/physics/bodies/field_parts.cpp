// Where the parts of a field are.
#include "game/physics/bodies/field_parts.h"

#include <cassert>

namespace rink::physics::inline RINK_PRECISION {

HalfPlane plane_of(const Field& field, Partner wall, const RealVector& extent, Half half) {
  assert(wall >= partner::wall_left && wall <= partner::halfway);
  switch (wall) {
    case partner::wall_left:
      return {{1.0, 0.0}, extent.x()};
    case partner::wall_right:
      return {{-1.0, 0.0}, extent.x() - field.length};
    case partner::wall_bottom:
      return {{0.0, 1.0}, extent.y()};
    case partner::wall_top:
      return {{0.0, -1.0}, extent.y() - field.width};
    default:
      break;
  }
  if (half == Half::left) return {{-1.0, 0.0}, extent.x() - 0.5 * field.length};
  return {{1.0, 0.0}, extent.x() + 0.5 * field.length};
}

RealVector goal_edge(const Field& field, Partner edge) {
  assert(edge >= partner::edge_left_low && edge <= partner::edge_right_high);
  const bool is_left = edge == partner::edge_left_low || edge == partner::edge_left_high;
  const bool is_low = edge == partner::edge_left_low || edge == partner::edge_right_low;
  return {is_left ? 0.0 : field.length,
          0.5 * (Real(field.width) + (is_low ? -field.goal_width : field.goal_width))};
}

}  // namespace rink::physics::inline RINK_PRECISION
