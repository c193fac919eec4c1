// World's questions, and the way from its specs into the engine.
#include "game/physics/world.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "game/physics/engine.h"

namespace rink::physics {

World::World(const WorldSpec& spec) : engine_(std::make_unique<Engine>(spec)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

BodyId World::add(const PuckSpec& spec) {
  assert(spec.radius > 0.0);
  return engine_->add(BodyKind::puck, spec.position, spec.velocity, spec.radius, {0.0, 0.0}, spec.mass, spec.material, Half::both);
}

BodyId World::add(const BatSpec& spec) {
  assert(spec.half_extent.minCoeff() > 0.0);
  return engine_->add(BodyKind::bat, spec.position, spec.velocity, 0.0, spec.half_extent, spec.mass, spec.material, spec.half);
}

BodyId World::add(const PostSpec& spec) {
  assert(spec.radius >= 0.0);
  return engine_->add(BodyKind::post, spec.position, {0.0, 0.0}, spec.radius, {0.0, 0.0}, std::numeric_limits<double>::infinity(), spec.material, Half::both);
}

void World::remove(BodyId body) { engine_->remove(body.index); }
void World::set_thrust(BodyId bat, const Vector2& acceleration) { engine_->set_thrust(bat.index, acceleration); }
void World::place(BodyId puck, const Vector2& position, const Vector2& velocity) { engine_->place(puck.index, position, velocity); }
std::optional<Goal> World::advance(double until) { return engine_->advance(until); }

void World::record_impacts(bool is_wanted) { engine_->records_impacts_ = is_wanted; }
std::span<const Impact> World::impacts() const { return engine_->impacts_; }
void World::forget_impacts() { engine_->impacts_.clear(); }

double World::now() const { return engine_->now_; }

Motion World::motion(BodyId body) const { return engine_->motion(body.index); }
std::uint32_t World::motion_version(BodyId body) const { return engine_->bodies_[body.index].version; }

Vector2 World::position(BodyId body) const {
  const Motion m = motion(body);
  return is_in_play(body) ? m.at(engine_->now_).position : m.position;
}

Vector2 World::velocity(BodyId body) const {
  const Motion m = motion(body);
  return is_in_play(body) ? m.at(engine_->now_).velocity : m.velocity;
}

std::uint32_t World::body_count() const { return static_cast<std::uint32_t>(engine_->bodies_.size()); }
BodyKind World::kind(BodyId body) const { return engine_->bodies_[body.index].kind; }
double World::radius(BodyId body) const { return engine_->bodies_[body.index].radius; }
Vector2 World::half_extent(BodyId body) const { return engine_->builds_[body.index].half_extent + Vector2::Constant(radius(body)); }
double World::mass(BodyId body) const { return engine_->builds_[body.index].mass; }
MaterialId World::material(BodyId body) const { return engine_->bodies_[body.index].material; }
Vector2 World::thrust(BodyId body) const { return engine_->builds_[body.index].thrust; }
bool World::is_in_play(BodyId body) const { return !engine_->is_gone(body.index); }
bool World::is_removed(BodyId body) const { return (engine_->bodies_[body.index].flags & Engine::removed) != 0; }

bool World::is_resting(BodyId body) const {
  const Motion m = motion(body);
  return m.velocity == Vector2(0.0, 0.0) && m.acceleration == Vector2(0.0, 0.0);
}

bool World::is_held(BodyId body) const { return (engine_->bodies_[body.index].flags & (Engine::held | Engine::frozen)) != 0; }

bool World::is_free(const Vector2& centre, double radius) const { return engine_->is_free(centre, {Vector2(0.0, 0.0), radius}); }
bool World::is_free(const Vector2& centre, const Vector2& half_extent) const { return engine_->is_free(centre, {half_extent, 0.0}); }

const WorldSpec& World::spec() const { return engine_->spec_; }
const Counters& World::counters() const { return engine_->counters_; }
double World::kinetic_energy() const { return engine_->kinetic_energy(); }
Vector2 World::momentum() const { return engine_->momentum(); }
double World::max_overlap() const { return engine_->max_overlap(); }
std::uint64_t World::hash() const { return engine_->hash(); }

bool Engine::is_free(const Vector2& centre, const RoundedBox& shape) const {
  const Vector2 extent = shape.half_extent + Vector2::Constant(shape.radius);
  if ((centre - extent).minCoeff() < 0.0 || centre.x() + extent.x() > spec_.field.length || centre.y() + extent.y() > spec_.field.width) return false;
  const double range = extent.maxCoeff() + reach_ + grid_.side() / 32.0;
  const std::uint32_t column = grid_.column(centre.x() - range), row = grid_.row(centre.y() - range);
  const int columns = static_cast<int>(grid_.column(centre.x() + range) - column), rows = static_cast<int>(grid_.row(centre.y() + range) - row);
  bool is_clear = true;
  grid_.around(column, row, 0, columns, 0, rows, [&](std::uint32_t body) {
    const RoundedBox both{builds_[body].half_extent + shape.half_extent, bodies_[body].radius + shape.radius};
    is_clear = is_clear && both.gap(centre - at(body, now_).position).distance >= 0.0;
  });
  return is_clear;
}

double Engine::kinetic_energy() const {
  double sum = 0.0;
  for (std::uint32_t body = 0; body < bodies_.size(); ++body)
    if (!is_gone(body) && builds_[body].inverse_mass > 0.0) sum += 0.5 * builds_[body].mass * at(body, now_).velocity.squaredNorm();
  return sum;
}

Vector2 Engine::momentum() const {
  Vector2 sum(0.0, 0.0);
  for (std::uint32_t body = 0; body < bodies_.size(); ++body)
    if (!is_gone(body) && builds_[body].inverse_mass > 0.0) sum += builds_[body].mass * at(body, now_).velocity;
  return sum;
}

double Engine::max_overlap() const {
  double deepest = 0.0;
  for (std::uint32_t body = 0; body < bodies_.size(); ++body) {
    if (is_gone(body) || bodies_[body].kind == BodyKind::post) continue;
    const Vector2 position = at(body, now_).position;
    const Vector2 extent = builds_[body].half_extent + Vector2::Constant(bodies_[body].radius);
    const double end = bodies_[body].mouth == no_mouth ? std::min(position.x() - extent.x(), spec_.field.length - extent.x() - position.x()) : 0.0;
    const double side = std::min(position.y() - extent.y(), spec_.field.width - extent.y() - position.y());
    deepest = std::max({deepest, -end, -side});
    grid_.around(grid_.column_of(body), grid_.row_of(body), -1, 1, -1, 1, [&](std::uint32_t other) {
      if (other != body) deepest = std::max(deepest, -shape_of(body, other).gap(position - at(other, now_).position).distance);
    });
  }
  return deepest;
}

std::uint64_t Engine::hash() const {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  const auto mix = [&](double value) {
    auto bits = std::bit_cast<std::uint64_t>(value);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) hash = (hash ^ (bits & 0xff)) * 0x100000001b3ULL;
  };
  for (std::uint32_t body = 0; body < bodies_.size(); ++body) {
    const Body& b = bodies_[body];
    for (const double value : {b.x, b.y, b.vx, b.vy, b.time}) mix(value);
    if ((b.flags & curved) != 0)
      for (int axis = 0; axis < 2; ++axis) mix(laws_[body].acceleration[axis]), mix(laws_[body].drag[axis]);
    mix(b.flags & (gone | held | frozen));
  }
  return hash;
}

}  // namespace rink::physics
