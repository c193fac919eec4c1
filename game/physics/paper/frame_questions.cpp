// Questions about all bodies at once, answered at now() and changing nothing.
#include <algorithm>
#include <cmath>

#include "game/physics/paper/frame_simulator.h"
#include "im/basics/fnv_hash.h"

namespace rink::physics::paper {

namespace {

/// How far a rectangle of `half_extent` grown by `radius` (sums of two bodies) around the origin is
/// from `offset`; below 0 inside.
double gap(const Vector2& offset, const Vector2& half_extent, double radius) {
  const Vector2 outside = offset.cwiseAbs() - half_extent;
  if (outside.maxCoeff() <= 0.0) return outside.maxCoeff() - radius;
  return outside.cwiseMax(0.0).norm() - radius;
}

}  // namespace

bool FrameSimulator::is_free(const Vector2& centre, double radius) const {
  return is_free(centre, {0.0, 0.0}, radius);
}
bool FrameSimulator::is_free(const Vector2& centre, const Vector2& half_extent) const {
  return is_free(centre, half_extent, 0.0);
}

bool FrameSimulator::is_free(const Vector2& centre, const Vector2& half_extent,
                             double radius) const {
  const Vector2 extent = half_extent + Vector2::Constant(radius);
  if ((centre - extent).minCoeff() < 0.0 || centre.x() + extent.x() > spec_.field.length ||
      centre.y() + extent.y() > spec_.field.width)
    return false;
  return std::none_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    return body.is_in_play && gap(centre - steps_.phase_at(body, now_).position,
                                  half_extent + body.half_extent, radius + body.radius) < 0.0;
  });
}

double FrameSimulator::kinetic_energy() const {
  double sum = 0.0;
  for (const Body& body : bodies_)
    if (body.is_in_play) sum += body.energy(steps_.phase_at(body, now_).velocity);
  return sum;
}

double FrameSimulator::work_of_thrust() const {
  if (!spec_.accounts_energy) return 0.0;
  double sum = work_;
  for (const Body& body : bodies_)
    if (body.is_in_play) sum += steps_.work_until(body, now_);
  return sum;
}

Vector2 FrameSimulator::momentum() const {
  Vector2 sum(0.0, 0.0);
  for (const Body& body : bodies_)
    if (body.is_in_play && body.inverse_mass > 0.0)
      sum += body.mass * steps_.phase_at(body, now_).velocity;
  return sum;
}

double FrameSimulator::max_overlap() const {
  FrameGrid grid;
  grid.clear(spec_.field, body_count());
  double deepest = 0.0;
  for (std::uint32_t index = 0; index < bodies_.size(); ++index) {
    const Body& body = bodies_[index];
    if (!body.is_in_play) continue;
    const Vector2 position = steps_.phase_at(body, now_).position, extent = body.extent();
    const Extent box{position - extent, position + extent};
    grid.around(box, [&](std::uint32_t other) {
      deepest = std::max(deepest, -gap(position - steps_.phase_at(bodies_[other], now_).position,
                                       body.half_extent + bodies_[other].half_extent,
                                       body.radius + bodies_[other].radius));
    });
    grid.insert(index, box);
    if (body.kind == BodyKind::post) continue;
    const bool is_in_mouth = body.kind == BodyKind::puck && is_in_opening(position.y());
    const double end = is_in_mouth ? 0.0 : std::min(box.low.x(), spec_.field.length - box.high.x());
    deepest = std::max({deepest, -end, -box.low.y(), box.high.y() - spec_.field.width});
  }
  return deepest;
}

/// FNV-1a of the last states: equal for equal histories, wherever advance() stopped on the way.
std::uint64_t FrameSimulator::hash() const {
  Fnv64 hash;
  const auto mix = [&](double value) { hash.add_number(value); };
  for (const Body& body : bodies_) {
    for (const double value : {body.start.position.x(), body.start.position.y(),
                               body.start.velocity.x(), body.start.velocity.y(), body.start_time})
      mix(value);
    mix(body.is_in_play ? 1.0 : 0.0);
    if (spec_.surface_friction) mix(body.spin);
  }
  return hash.value();
}

}  // namespace rink::physics::paper
