// Sums and searches over a peer's bodies.
#include "bench/peers/peer_world.h"

#include <cassert>
#include <cmath>

#include "game/model/state_hash.h"

namespace rink::peers {

using physics::BatSpec;
using physics::PostSpec;
using physics::PuckSpec;

PeerWorld::PeerWorld(const physics::WorldSpec& spec, double dt) : spec_(spec), dt_(dt) {
  assert(dt > 0.0 && std::isfinite(dt));
  assert(spec.restitution.material_count() == 1 && spec.field.goal_width == 0.0 &&
         !spec.field.bats_keep_to_half);
}

BodyId PeerWorld::add(const PuckSpec& spec) {
  return add({BodyKind::puck, spec.radius, {0.0, 0.0}, spec.mass}, spec.position, spec.velocity);
}
BodyId PeerWorld::add(const BatSpec& spec) {
  return add({BodyKind::bat, 0.0, spec.half_extent, spec.mass}, spec.position, spec.velocity);
}
BodyId PeerWorld::add(const PostSpec& spec) {
  return add({.kind = BodyKind::post, .radius = spec.radius}, spec.position, {0.0, 0.0});
}

BodyId PeerWorld::add(const Outline& outline, const Vector2& position, const Vector2& velocity) {
  assert(outline.mass > 0.0 && outline.radius >= 0.0 && position.allFinite());
  const std::size_t index = outlines_.size();
  outlines_.push_back(outline);
  thrusts_.push_back({0.0, 0.0});
  last_places_.push_back(position);
  is_removed_.push_back(false);
  make(index, outline, position, velocity);
  return {static_cast<std::uint32_t>(index)};
}

void PeerWorld::remove(BodyId body) {
  assert(body.index < outlines_.size() && !is_removed_[body.index]);
  last_places_[body.index] = place_of(body.index);
  destroy(body.index);
  is_removed_[body.index] = true;
}

void PeerWorld::place(BodyId, const Vector2&, const Vector2&) {
  assert(false && "a peer has no goals");
}

std::optional<physics::Goal> PeerWorld::advance(double until) {
  // To the nearest frame, for an instant that is a frame's end in decimal digits may lie a rounding
  // error beside it in binary ones.
  assert(std::isfinite(until) && until >= 0.0);
  const auto target = static_cast<std::uint64_t>(std::llround(until / dt_));
  for (; frames_ < target; ++frames_) step();
  return std::nullopt;
}

bool PeerWorld::is_free(const Vector2& centre, double radius) const {
  return is_clear(centre, {.radius = radius});
}
bool PeerWorld::is_free(const Vector2& centre, const Vector2& half_extent) const {
  return is_clear(centre, {.kind = BodyKind::bat, .half_extent = half_extent});
}

bool PeerWorld::is_clear(const Vector2& centre, const Outline& outline) const {
  const Vector2 reach = outline.reach();
  if ((centre - reach).minCoeff() < 0.0 || centre.x() + reach.x() > spec_.field.length ||
      centre.y() + reach.y() > spec_.field.width)
    return false;
  for (std::size_t i = 0; i < outlines_.size(); ++i)
    if (!is_removed_[i] && depth(outline, outlines_[i], place_of(i) - centre) > 0.0) return false;
  return true;
}

double PeerWorld::kinetic_energy() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < outlines_.size(); ++i)
    if (!is_removed_[i] && std::isfinite(outlines_[i].mass))
      energy += 0.5 * outlines_[i].mass * velocity_of(i).squaredNorm();
  return energy;
}

Vector2 PeerWorld::momentum() const {
  Vector2 sum(0.0, 0.0);
  for (std::size_t i = 0; i < outlines_.size(); ++i)
    if (!is_removed_[i] && std::isfinite(outlines_[i].mass))
      sum += outlines_[i].mass * velocity_of(i);
  return sum;
}

double PeerWorld::max_overlap() const {
  std::vector<Outline> outlines;
  std::vector<Vector2> places;
  for (std::size_t i = 0; i < outlines_.size(); ++i)
    if (!is_removed_[i]) outlines.push_back(outlines_[i]), places.push_back(place_of(i));
  return deepest_overlap(spec_.field, outlines, places);
}

std::uint64_t PeerWorld::hash() const {
  game::StateHash hash;
  for (std::size_t i = 0; i < outlines_.size(); ++i)
    hash.add(position({static_cast<std::uint32_t>(i)})),
        hash.add(velocity({static_cast<std::uint32_t>(i)}));
  return hash.value();
}

void PeerWorld::count_impact(BodyKind a, BodyKind b) {
  const auto is_any = [a, b](BodyKind kind) { return a == kind || b == kind; };
  if (is_any(BodyKind::post)) ++counters_.post_impacts;
  else if (a == BodyKind::bat && b == BodyKind::bat) ++counters_.bat_bat_impacts;
  else if (is_any(BodyKind::bat)) ++counters_.bat_impacts;
  else ++counters_.disc_impacts;
}

}  // namespace rink::peers
