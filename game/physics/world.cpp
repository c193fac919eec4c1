// World's questions, and the way from its specs into the engine.
#include "game/physics/world.h"

#include <cassert>
#include <limits>
#include <utility>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

World::World(const WorldSpec& spec) : engine_(std::make_unique<Engine>(spec)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

BodyId World::add(const PuckSpec& spec) {
  assert(spec.radius > 0.0);
  return engine_->add(BodyKind::puck, spec.position.cast<Real>(), spec.velocity.cast<Real>(),
                      spec.radius, {0.0, 0.0}, spec.mass, spec.material, Half::both, spec.spin);
}

BodyId World::add(const BatSpec& spec) {
  assert(spec.half_extent.minCoeff() > 0.0);
  return engine_->add(BodyKind::bat, spec.position.cast<Real>(), spec.velocity.cast<Real>(), 0.0,
                      spec.half_extent.cast<Real>(), spec.mass, spec.material, spec.half, 0.0);
}

BodyId World::add(const PostSpec& spec) {
  assert(spec.radius >= 0.0);
  return engine_->add(BodyKind::post, spec.position.cast<Real>(), {0.0, 0.0}, spec.radius,
                      {0.0, 0.0}, std::numeric_limits<double>::infinity(), spec.material,
                      Half::both, 0.0);
}

void World::remove(BodyId body) { engine_->remove(body.index); }
void World::set_thrust(BodyId bat, const Vector2& acceleration) {
  engine_->set_thrust(bat.index, acceleration.cast<Real>());
}
void World::place(BodyId puck, const Vector2& position, const Vector2& velocity) {
  engine_->place(puck.index, position.cast<Real>(), velocity.cast<Real>());
}
std::optional<Goal> World::advance(Real until) { return engine_->advance(until); }

void World::record_events(bool is_wanted) { engine_->record_.keep(is_wanted); }
std::span<const Event> World::events() const { return engine_->record_.events(); }
void World::forget_events() { engine_->record_.forget(); }

Real World::now() const { return engine_->clock_.now; }

Motion World::motion(BodyId body) const { return engine_->motion(body.index); }
std::uint32_t World::motion_version(BodyId body) const {
  return engine_->bodies_[body.index].version;
}

std::span<const BodyId> World::changed(ChangeCursor& cursor) const {
  return engine_->changes_.read(cursor, body_count());
}

RealVector World::position(BodyId body) const {
  const Motion m = motion(body);
  return is_in_play(body) ? m.at(engine_->clock_.now).position : m.position;
}

RealVector World::velocity(BodyId body) const {
  const Motion m = motion(body);
  return is_in_play(body) ? m.at(engine_->clock_.now).velocity : m.velocity;
}

std::uint32_t World::body_count() const {
  return static_cast<std::uint32_t>(engine_->bodies_.size());
}
BodyKind World::kind(BodyId body) const { return engine_->bodies_[body.index].kind; }
Real World::radius(BodyId body) const { return engine_->bodies_[body.index].radius; }
RealVector World::half_extent(BodyId body) const {
  return engine_->builds_[body.index].half_extent + RealVector::Constant(radius(body));
}
Real World::mass(BodyId body) const { return engine_->builds_[body.index].mass; }
MaterialId World::material(BodyId body) const { return engine_->bodies_[body.index].material; }
RealVector World::thrust(BodyId body) const { return engine_->builds_[body.index].thrust; }
bool World::is_in_play(BodyId body) const { return !engine_->is_gone(body.index); }
bool World::is_removed(BodyId body) const {
  return (engine_->bodies_[body.index].flags & Engine::removed) != 0;
}

bool World::is_resting(BodyId body) const {
  const Motion m = motion(body);
  return m.velocity == RealVector(0.0, 0.0) && m.acceleration == RealVector(0.0, 0.0);
}

bool World::is_held(BodyId body) const {
  return (engine_->bodies_[body.index].flags & (Engine::held | Engine::frozen)) != 0;
}

bool World::is_free(const Vector2& centre, double radius) const {
  return engine_->is_free(centre.cast<Real>(), {RealVector(0.0, 0.0), radius});
}
bool World::is_free(const Vector2& centre, const Vector2& half_extent) const {
  return engine_->is_free(centre.cast<Real>(), {half_extent.cast<Real>(), 0.0});
}

World::World(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
std::vector<std::uint8_t> World::save() const { return engine_->save(); }
std::optional<World> World::restore(std::span<const std::uint8_t> bytes) {
  auto engine = Engine::restore(bytes);
  if (!engine) return std::nullopt;
  return World(std::move(engine));
}
std::unique_ptr<Simulator> World::copy() const {
  std::optional<World> world = restore(save());
  assert(world);
  return std::make_unique<World>(std::move(*world));
}

const WorldSpec& World::spec() const { return engine_->spec_; }
const Counters& World::counters() const { return engine_->counters_; }
Real World::kinetic_energy() const { return engine_->kinetic_energy(); }
Real World::spin(BodyId body) const { return engine_->spin(body.index); }
Real World::energy_introduced() const { return engine_->ledger_.introduced(); }
Real World::work_of_thrust() const { return engine_->work_of_thrust(); }
Real World::dissipated() const { return engine_->dissipated(); }
RealVector World::momentum() const { return engine_->momentum(); }
Real World::max_overlap() const { return engine_->max_overlap(); }
std::uint64_t World::hash() const { return engine_->hash(); }

}  // namespace rink::physics::inline RINK_PRECISION
