// Rounds a body where there is room for that.
#include "game/physics/rounding/motion_grid.h"

#include <cassert>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {
namespace {

bool may_change(const Bodies& bodies, std::uint32_t body, Real since) {
  const Body& b = bodies[body];
  return b.kind != BodyKind::post && !b.is(Body::lasting) && b.mouth == Body::no_mouth &&
         b.time > since && !is_still(bodies, body);
}

/// Whether nothing is nearer than MotionGrid::room to the body at `position`, now.
bool has_room(const Engine::Parts& parts, std::uint32_t body, const RealVector& position) {
  constexpr double room = MotionGrid::room;
  const Field& field = parts.spec.field;
  const RealVector extent = extent_of(parts.bodies, body) + RealVector::Constant(room);
  if ((position - extent).minCoeff() < 0.0 || position.x() + extent.x() > field.length ||
      position.y() + extent.y() > field.width)
    return false;
  const Half half = parts.bodies.build(body).half;
  if (field.bats_keep_to_half && half != Half::both &&
      (half == Half::left ? position.x() + extent.x() > field.length / 2
                          : position.x() - extent.x() < field.length / 2))
    return false;
  bool is_clear = true;
  parts.places.grid().around(body, [&](std::uint32_t other) {
    is_clear =
        is_clear &&
        (other == body || shape_of(parts.bodies, body, other)
                                  .gap(position - position_at(parts.bodies, other, parts.clock.now))
                                  .distance >= room);
  });
  return is_clear;
}

MotionGrid::Result put_on_grid(Engine& engine, std::uint32_t body, double since) {
  const Engine::Parts parts = engine.parts();
  assert(body < parts.bodies.count() && since <= parts.clock.now);
  if (!may_change(parts.bodies, body, since)) return MotionGrid::Result::untouched;
  const Motion now = motion_at(parts.bodies, body, parts.clock.now);
  const auto rounded = [](const RealVector& vector, double step) {
    return RealVector(MotionGrid::rounded(vector.x(), step), MotionGrid::rounded(vector.y(), step));
  };
  const RealVector position = rounded(now.position, MotionGrid::position_step);
  if (!has_room(parts, body, position)) return MotionGrid::Result::left_off;
  const Real spin = parts.spec.surface_friction
                        ? MotionGrid::rounded(parts.bodies.spin(body), MotionGrid::spin_step)
                        : Real(0.0);
  engine.move(body, {position, rounded(now.velocity, MotionGrid::velocity_step), spin});
  return MotionGrid::Result::put;
}

}  // namespace

MotionGrid::Result MotionGrid::put(World& world, BodyId body, double since) {
  return put_on_grid(*world.engine_, body.index, since);
}

MotionGrid::Result MotionGrid::put(Subdomain& part, std::uint32_t body, double since) {
  assert(part.is_there(body));
  return put_on_grid(part.engine(), part.slot(body), since);
}

}  // namespace rink::physics::inline RINK_PRECISION
