// Sums, extremes and the hash over all bodies.
#include "game/physics/engine/questions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "game/physics/body_hash.h"

namespace rink::physics::inline RINK_PRECISION {

bool is_free(const Present& present, const RealVector& centre, const RoundedBox& shape) {
  const Bodies& bodies = present.bodies;
  const Field& field = present.field;
  const Places& places = present.places;
  const Real now = present.now;
  const RealVector extent = shape.half_extent + RealVector::Constant(shape.radius);
  if ((centre - extent).minCoeff() < 0.0 || centre.x() + extent.x() > field.length ||
      centre.y() + extent.y() > field.width)
    return false;
  const CellGrid& grid = places.grid();
  const double range = static_cast<double>(extent.maxCoeff() + places.reach()) + grid.side() / 32.0;
  const double x = static_cast<double>(centre.x()), y = static_cast<double>(centre.y());
  const CellGrid::Range cells{.column_low = grid.column(x - range),
                              .row_low = grid.row(y - range),
                              .column_high = grid.column(x + range),
                              .row_high = grid.row(y + range)};
  bool is_clear = true;
  grid.within(cells, [&](std::uint32_t body) {
    const RoundedBox both{bodies.build(body).half_extent + shape.half_extent,
                          bodies[body].radius + shape.radius};
    is_clear = is_clear && both.gap(centre - position_at(bodies, body, now)).distance >= 0.0;
  });
  return is_clear;
}

Real kinetic_energy(const Bodies& bodies, Real now) {
  Real sum = 0.0;
  for (std::uint32_t body = 0; body < bodies.count(); ++body)
    if (!bodies[body].is(Body::gone) && bodies.build(body).inverse_mass > 0.0)
      sum += 0.5 * bodies.build(body).mass * motion_at(bodies, body, now).velocity.squaredNorm();
  for (std::uint32_t body = 0; body < bodies.table().spins.size(); ++body)
    if (!bodies[body].is(Body::gone) && bodies[body].kind == BodyKind::puck)
      sum += 0.25 * bodies.build(body).mass * std::pow(bodies[body].radius * bodies.spin(body), 2);
  return sum;
}

RealVector momentum(const Bodies& bodies, Real now) {
  RealVector sum(0.0, 0.0);
  for (std::uint32_t body = 0; body < bodies.count(); ++body)
    if (!bodies[body].is(Body::gone) && bodies.build(body).inverse_mass > 0.0)
      sum += bodies.build(body).mass * motion_at(bodies, body, now).velocity;
  return sum;
}

Real work_of_thrust(const EnergyLedger& ledger, const Bodies& bodies, Real now) {
  if (!ledger.is_kept()) return 0.0;
  Sum sum = ledger.work();
  for (std::uint32_t body = 0; body < bodies.count(); ++body)
    if (!bodies[body].is(Body::gone)) sum.add(energy_transfer_until(bodies, body, now).work);
  return sum.value();
}

Real dissipated(const EnergyLedger& ledger, const Bodies& bodies, Real now) {
  if (!ledger.is_kept()) return 0.0;
  Sum sum = ledger.loss();
  for (std::uint32_t body = 0; body < bodies.count(); ++body)
    if (!bodies[body].is(Body::gone)) sum.add(energy_transfer_until(bodies, body, now).loss);
  return sum.value();
}

Real max_overlap(const Present& present) {
  const Bodies& bodies = present.bodies;
  const Field& field = present.field;
  const Real now = present.now;
  const CellGrid& grid = present.places.grid();
  Real deepest = 0.0;
  for (std::uint32_t body = 0; body < bodies.count(); ++body) {
    if (bodies[body].is(Body::gone) || bodies[body].kind == BodyKind::post) continue;
    const RealVector position = position_at(bodies, body, now), extent = extent_of(bodies, body);
    const Real end =
        bodies[body].mouth == Body::no_mouth
            ? std::min(position.x() - extent.x(), field.length - extent.x() - position.x())
            : Real(0.0);
    const Real side = std::min(position.y() - extent.y(), field.width - extent.y() - position.y());
    deepest = std::max({deepest, -end, -side});
    grid.around(body, [&](std::uint32_t other) {
      if (other != body)
        deepest = std::max(deepest, -shape_of(bodies, body, other)
                                         .gap(position - position_at(bodies, other, now))
                                         .distance);
    });
  }
  return deepest;
}

std::uint64_t hash_of(const Bodies& bodies) {
  const std::vector<Real>& spins = bodies.table().spins;
  BodyHash hash;
  for (std::uint32_t body = 0; body < bodies.count(); ++body) {
    const Body& b = bodies[body];
    const bool is_curved = b.is(Body::curved);
    const ForceLaw& law = bodies.law(body);
    hash.add(b, is_curved ? &law.acceleration : nullptr, is_curved ? &law.drag : nullptr,
             b.flags & Body::lasting,
             spins.empty() ? std::nullopt : std::optional<Real>(spins[body]));
  }
  return hash.value();
}

}  // namespace rink::physics::inline RINK_PRECISION
