// What can be asked of all bodies at once.
#include <algorithm>
#include <bit>

#include "game/physics/body_hash.h"
#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

bool Engine::is_free(const RealVector& centre, const RoundedBox& shape) const {
  const RealVector extent = shape.half_extent + RealVector::Constant(shape.radius);
  if ((centre - extent).minCoeff() < 0.0 || centre.x() + extent.x() > spec_.field.length ||
      centre.y() + extent.y() > spec_.field.width)
    return false;
  const CellGrid& grid = places_.grid();
  const double range =
      static_cast<double>(extent.maxCoeff() + places_.reach()) + grid.side() / 32.0;
  const double x = static_cast<double>(centre.x()), y = static_cast<double>(centre.y());
  const std::uint32_t column = grid.column(x - range), row = grid.row(y - range);
  const int columns = static_cast<int>(grid.column(x + range) - column),
            rows = static_cast<int>(grid.row(y + range) - row);
  bool is_clear = true;
  grid.around(column, row, 0, columns, 0, rows, [&](std::uint32_t body) {
    const RoundedBox both{bodies_.build(body).half_extent + shape.half_extent,
                          bodies_[body].radius + shape.radius};
    is_clear = is_clear &&
               both.gap(centre - motion_at(bodies_, body, clock_.now).position).distance >= 0.0;
  });
  return is_clear;
}

Real Engine::kinetic_energy() const {
  Real sum = 0.0;
  for (std::uint32_t body = 0; body < bodies_.count(); ++body)
    if (!bodies_.is_gone(body) && bodies_.build(body).inverse_mass > 0.0)
      sum += 0.5 * bodies_.build(body).mass *
             motion_at(bodies_, body, clock_.now).velocity.squaredNorm();
  for (std::uint32_t body = 0; body < bodies_.table().spins.size(); ++body)
    if (!bodies_.is_gone(body) && bodies_[body].kind == BodyKind::puck)
      sum +=
          0.25 * bodies_.build(body).mass * std::pow(bodies_[body].radius * bodies_.spin(body), 2);
  return sum;
}

RealVector Engine::momentum() const {
  RealVector sum(0.0, 0.0);
  for (std::uint32_t body = 0; body < bodies_.count(); ++body)
    if (!bodies_.is_gone(body) && bodies_.build(body).inverse_mass > 0.0)
      sum += bodies_.build(body).mass * motion_at(bodies_, body, clock_.now).velocity;
  return sum;
}

Real Engine::work_of_thrust() const {
  if (!ledger_.is_kept()) return 0.0;
  Sum sum = ledger_.work();
  for (std::uint32_t body = 0; body < bodies_.count(); ++body)
    if (!bodies_.is_gone(body)) sum.add(expense_until(bodies_, body, clock_.now).work);
  return sum.value();
}

Real Engine::dissipated() const {
  if (!ledger_.is_kept()) return 0.0;
  Sum sum = ledger_.loss();
  for (std::uint32_t body = 0; body < bodies_.count(); ++body)
    if (!bodies_.is_gone(body)) sum.add(expense_until(bodies_, body, clock_.now).loss);
  return sum.value();
}

Real Engine::max_overlap() const {
  const CellGrid& grid = places_.grid();
  Real deepest = 0.0;
  for (std::uint32_t body = 0; body < bodies_.count(); ++body) {
    if (bodies_.is_gone(body) || bodies_[body].kind == BodyKind::post) continue;
    const RealVector position = motion_at(bodies_, body, clock_.now).position;
    const RealVector extent =
        bodies_.build(body).half_extent + RealVector::Constant(bodies_[body].radius);
    const Real end =
        bodies_[body].mouth == Body::no_mouth
            ? std::min(position.x() - extent.x(), spec_.field.length - extent.x() - position.x())
            : Real(0.0);
    const Real side =
        std::min(position.y() - extent.y(), spec_.field.width - extent.y() - position.y());
    deepest = std::max({deepest, -end, -side});
    grid.around(grid.column_of(body), grid.row_of(body), -1, 1, -1, 1, [&](std::uint32_t other) {
      if (other != body)
        deepest =
            std::max(deepest, -shape_of(bodies_, body, other)
                                   .gap(position - motion_at(bodies_, other, clock_.now).position)
                                   .distance);
    });
  }
  return deepest;
}

std::uint64_t Engine::hash() const {
  BodyHash hash;
  for (std::uint32_t body = 0; body < bodies_.count(); ++body) {
    const Body& b = bodies_[body];
    const bool is_curved = (b.flags & Body::curved) != 0;
    const Law& law = bodies_.law(body);
    hash.add(b, is_curved ? &law.acceleration : nullptr, is_curved ? &law.drag : nullptr,
             static_cast<std::uint8_t>(b.flags & (Body::gone | Body::held | Body::frozen)),
             spec_.surface_friction ? std::optional<Real>(bodies_.spin(body)) : std::nullopt);
  }
  return hash.value();
}

}  // namespace rink::physics::inline RINK_PRECISION
