// Looks at the few cells before the goals.
#include "game/physics/slabs/next_goal.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "game/physics/bodies/partner.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/flight/dragged_flight.h"
#include "game/physics/grid/cell_grid.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// How many columns before a goal, and rows beside it: some 0.3 m at the packing of a match, in
/// which a puck seldom gets into the goal within one window from farther away.
constexpr double cells_before = 2.0, cells_beside = 1.0;

/// Infinite if the puck flies elsewhere.
Real goal_of(const Engine::Parts& parts, std::uint32_t body) {
  const Body& b = parts.bodies[body];
  const NextEvent& slot = parts.events[body];
  if (slot.partner == partner::goal_line) return slot.impact_time;
  if (b.kind != BodyKind::puck || b.is(Body::curved) || b.vx == 0.0) return infinity;
  const Field& field = parts.spec.field;
  const Real way = b.vx < 0.0 ? b.x : Real(field.length) - b.x, warped = way / std::abs(b.vx),
             off = b.y + b.vy * warped - Real(0.5 * field.width);
  return std::abs(off) < Real(0.5 * field.goal_width)
             ? time_on_warped_clock(b.time, warped, Real(parts.spec.puck_drag))
             : Real(infinity);
}

}  // namespace

Real next_goal(const Engine::Parts& parts) {
  const Field& field = parts.spec.field;
  Real first = infinity;
  if (field.goal_width == 0.0) return first;
  const CellGrid& grid = parts.places.grid();
  const double across = cells_before * grid.side(),
               along = 0.5 * field.goal_width + cells_beside * grid.side();
  const std::uint32_t low = grid.row(0.5 * field.width - along),
                      high = grid.row(0.5 * field.width + along);
  const auto look = [&](double from, double to) {
    grid.within({grid.column(from), low, grid.column(to), high}, [&](std::uint32_t body) {
      const Real time = goal_of(parts, body);
      if (time > parts.clock.now) first = std::min(first, time);
    });
  };
  look(0.0, across), look(field.length - across, field.length);
  return first;
}

}  // namespace rink::physics::inline RINK_PRECISION
