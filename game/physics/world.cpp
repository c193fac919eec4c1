// World's questions, and the way from its specs into the engine.
#include "game/physics/world.h"

#include <cassert>
#include <limits>
#include <utility>

#include "game/physics/engine/engine.h"
#include "game/physics/slabs/slabs.h"

namespace rink::physics::inline RINK_PRECISION {

World::World(const WorldSpec& spec) : World(std::make_unique<Engine>(spec)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

namespace {

template <class Spec>
BodyState state_at(const Spec& spec, BodyKind kind) {
  BodyState state;
  state.flight.x = spec.position.x(), state.flight.y = spec.position.y();
  state.kind = kind;
  state.material = spec.material;
  return state;
}

std::unique_ptr<Engine> engine_of(WorldState state) {
  auto engine = std::make_unique<Engine>(state.spec);
  engine->restore(std::move(state));
  return engine;
}

}  // namespace

BodyId World::add(const PuckSpec& spec) {
  assert(spec.radius > 0.0);
  BodyState state = state_at(spec, BodyKind::puck);
  state.flight.vx = spec.velocity.x(), state.flight.vy = spec.velocity.y();
  state.flight.radius = spec.radius;
  state.mass = spec.mass;
  state.spin = spec.spin;
  return engine_->add(state);
}

BodyId World::add(const BatSpec& spec) {
  assert(spec.half_extent.minCoeff() > 0.0);
  BodyState state = state_at(spec, BodyKind::bat);
  state.flight.vx = spec.velocity.x(), state.flight.vy = spec.velocity.y();
  state.half_extent = spec.half_extent.cast<Real>();
  state.mass = spec.mass;
  state.half = spec.half;
  return engine_->add(state);
}

BodyId World::add(const PostSpec& spec) {
  assert(spec.radius >= 0.0);
  BodyState state = state_at(spec, BodyKind::post);
  state.flight.radius = spec.radius;
  state.mass = std::numeric_limits<double>::infinity();
  return engine_->add(state);
}

void World::remove(BodyId body) {
  assert(body.index < body_count());
  engine_->remove(body.index);
}
void World::set_thrust(BodyId bat, const Vector2& acceleration) {
  assert(bat.index < body_count());
  engine_->set_thrust(bat.index, acceleration.cast<Real>());
}
void World::place(BodyId puck, const Vector2& position, const Vector2& velocity) {
  engine_->place(puck.index, position.cast<Real>(), velocity.cast<Real>());
}
std::optional<Goal> World::advance(Real until) {
  return slabs_ ? slabs_->advance(until) : engine_->advance(until);
}
std::optional<Goal> World::advance(Real until, EventBudget& budget) {
  return slabs_ ? slabs_->advance(until, &budget) : engine_->advance(until, &budget);
}

void World::record_events(bool is_wanted) { engine_->record().keep(is_wanted); }
std::span<const Event> World::events() const { return engine_->record().events(); }
void World::forget_events() { engine_->record().forget(); }

Real World::now() const { return engine_->clock().now; }

Motion World::motion(BodyId body) const {
  assert(body.index < body_count());
  return engine_->bodies().motion(body.index);
}
std::uint32_t World::motion_version(BodyId body) const {
  assert(body.index < body_count());
  return engine_->bodies()[body.index].version;
}

std::span<const BodyId> World::changed(ChangeCursor& cursor) const {
  return engine_->changes().read(cursor, body_count());
}

RealVector World::position(BodyId body) const {
  assert(body.index < body_count());
  const Body& b = engine_->bodies()[body.index];
  if (b.is(Body::gone)) return {b.x, b.y};
  return position_at(engine_->bodies(), body.index, engine_->clock().now);
}

RealVector World::velocity(BodyId body) const {
  const Motion m = motion(body);
  return is_in_play(body) ? m.at(engine_->clock().now).velocity : m.velocity;
}

std::uint32_t World::body_count() const { return engine_->bodies().count(); }
BodyKind World::kind(BodyId body) const {
  assert(body.index < body_count());
  return engine_->bodies()[body.index].kind;
}
Real World::radius(BodyId body) const {
  assert(body.index < body_count());
  return engine_->bodies()[body.index].radius;
}
RealVector World::half_extent(BodyId body) const {
  assert(body.index < body_count());
  return extent_of(engine_->bodies(), body.index);
}
Real World::mass(BodyId body) const {
  assert(body.index < body_count());
  return engine_->bodies().build(body.index).mass;
}
MaterialId World::material(BodyId body) const {
  assert(body.index < body_count());
  return engine_->bodies()[body.index].material;
}
RealVector World::thrust(BodyId body) const {
  assert(body.index < body_count());
  return engine_->bodies().build(body.index).thrust;
}
bool World::is_in_play(BodyId body) const {
  assert(body.index < body_count());
  return !engine_->bodies()[body.index].is(Body::gone);
}
bool World::is_removed(BodyId body) const {
  assert(body.index < body_count());
  return (engine_->bodies()[body.index].flags & Body::removed) != 0;
}

bool World::is_resting(BodyId body) const {
  const Motion m = motion(body);
  return m.velocity == RealVector(0.0, 0.0) && m.acceleration == RealVector(0.0, 0.0);
}

bool World::is_held(BodyId body) const {
  assert(body.index < body_count());
  return (engine_->bodies()[body.index].flags & (Body::held | Body::frozen)) != 0;
}

bool World::is_free(const Vector2& centre, double radius) const {
  assert(radius >= 0.0);
  return physics::is_free(engine_->present(), centre.cast<Real>(), {RealVector(0.0, 0.0), radius});
}
bool World::is_free(const Vector2& centre, const Vector2& half_extent) const {
  assert(half_extent.minCoeff() >= 0.0);
  return physics::is_free(engine_->present(), centre.cast<Real>(), {half_extent.cast<Real>(), 0.0});
}

World::World(std::unique_ptr<Engine> engine)
    : engine_(std::move(engine)),
      slabs_(engine_->spec().slabs ? std::make_unique<Slabs>(*engine_, *engine_->spec().slabs)
                                   : nullptr) {}
std::vector<std::uint8_t> World::save() const { return to_snapshot(engine_->state()); }
std::optional<World> World::restore(std::span<const std::uint8_t> bytes,
                                    const std::optional<SlabPlan>& slabs) {
  std::optional<WorldState> state = from_snapshot(bytes);
  if (!state) return std::nullopt;
  state->spec.slabs = slabs;
  return World(engine_of(std::move(*state)));
}
/// Of the plan for slabs all but the workers, who may be at work for this one.
std::unique_ptr<Simulator> World::copy() const {
  std::optional<SlabPlan> slabs = spec().slabs;
  if (slabs) slabs->workers = nullptr;
  std::optional<World> world = restore(save(), slabs);
  assert(world);
  return std::make_unique<World>(std::move(*world));
}

const WorldSpec& World::spec() const { return engine_->spec(); }
const Counters& World::counters() const { return engine_->record().counters(); }
Real World::kinetic_energy() const { return physics::kinetic_energy(engine_->bodies(), now()); }
Real World::spin(BodyId body) const {
  return engine_->spec().surface_friction ? engine_->bodies().spin(body.index) : Real(0.0);
}
Real World::energy_introduced() const { return engine_->ledger().introduced(); }
Real World::work_of_thrust() const {
  return physics::work_of_thrust(engine_->ledger(), engine_->bodies(), now());
}
Real World::dissipated() const {
  return physics::dissipated(engine_->ledger(), engine_->bodies(), now());
}
RealVector World::momentum() const { return physics::momentum(engine_->bodies(), now()); }
Real World::max_overlap() const { return physics::max_overlap(engine_->present()); }
std::uint64_t World::hash() const { return hash_of(engine_->bodies()); }

}  // namespace rink::physics::inline RINK_PRECISION
