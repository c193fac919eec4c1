// Where boxes may begin or cease to touch a disc that moves: between a circle that holds it then
// and now and one that it holds then and now.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/matching/index/cell_level.h"

namespace rink::im {

/// Around a common middle; what is outside of the one or inside of the other does not change. The
/// inner one is below 0 if there is none. Rounding is in them.
struct Ring {
  float x, y, outer, inner;

  /// Of the discs that the rectangles hold. `before` may be nowhere.
  Ring(const FloatBox& before, const FloatBox& now)
      : x(0.5f * now.low_x + 0.5f * now.high_x),
        y(0.5f * now.low_y + 0.5f * now.high_y),
        outer(radius(now)),
        inner(-1.0f) {
    assert(now.low_x <= now.high_x && now.low_y <= now.high_y);
    float size = std::abs(x) + std::abs(y) + longer_side(now);
    if (before.low_x <= before.high_x) {
      const float way_x = x - (0.5f * before.low_x + 0.5f * before.high_x),
                  way_y = y - (0.5f * before.low_y + 0.5f * before.high_y);
      const float way = std::sqrt(way_x * way_x + way_y * way_y);
      inner = std::min(outer, radius(before) - way), outer = std::max(outer, radius(before) + way);
      size += longer_side(before) + way;
    }
    const float margin = size * 0x1p-18f;
    inner -= margin, outer += margin;
  }
  /// False if squares could overflow or vanish.
  bool is_plain() const { return outer < 1e17f && outer > 1e-17f; }

 private:
  static float radius(const FloatBox& box) {
    return 0.5f * std::min(box.high_x - box.low_x, box.high_y - box.low_y);
  }
};

/// The cells of a level that a ring touches, those apart whose boxes lie well inside of it.
struct RingQuery {
  Ring ring;
  CellRange rows;
  bool has_newcomers;  ///< then the inside counts as well

  RingQuery(const CellLevel& level, const Ring& ring)
      : ring(ring),
        rows(level.y.touched(ring.y - ring.outer, ring.y + ring.outer)),
        has_newcomers(level.has_newcomers) {}

  /// Calls `visit(first, last)` with closed ranges of adjacent cells of `level`.
  template <class Visit>
  void for_each_run(const CellLevel& level, const Visit& visit) const {
    for (std::int32_t row = rows.first; row <= rows.last; ++row) {
      const float low = level.y.lowest_in(row), high = level.y.highest_in(row),
                  near = std::max(std::max(low - ring.y, ring.y - high), 0.0f),
                  far = std::max(high - ring.y, ring.y - low);
      if (near > ring.outer) continue;
      const float half = half_width(ring.outer, near) * (1.0f + 0x1p-18f);
      const CellRange columns = level.x.touched(ring.x - half, ring.x + half);
      CellQuery query{columns, {row, row}};
      if (far < ring.inner && !has_newcomers) {
        const float inner_half = half_width(ring.inner, far) * (1.0f - 0x1p-18f);
        query.inner_columns = level.x.within(ring.x - inner_half, ring.x + inner_half),
        query.inner_rows = {row, row};
      }
      query.for_each_run(level, visit);
    }
  }

 private:
  /// Of a circle at so much from its middle. As a product it loses nothing near its ends.
  static float half_width(float radius, float distance) {
    assert(0.0f <= distance && distance <= radius);
    return std::sqrt((radius - distance) * (radius + distance));
  }
};

}  // namespace rink::im
