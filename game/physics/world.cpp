// World's questions, and the way from its specs into the engine.
#include "game/physics/world.h"

#include <cassert>
#include <limits>
#include <utility>

#include "game/physics/engine/engine.h"

namespace rink::physics {

template <class Real>
BasicWorld<Real>::BasicWorld(const WorldSpec& spec)
    : engine_(std::make_unique<BasicEngine<Real>>(spec)) {}
template <class Real>
BasicWorld<Real>::~BasicWorld() = default;
template <class Real>
BasicWorld<Real>::BasicWorld(BasicWorld&&) noexcept = default;
template <class Real>
BasicWorld<Real>& BasicWorld<Real>::operator=(BasicWorld&&) noexcept = default;

template <class Real>
BodyId BasicWorld<Real>::add(const PuckSpec& spec) {
  assert(spec.radius > 0.0);
  return engine_->add(BodyKind::puck, spec.position.cast<Real>(), spec.velocity.cast<Real>(),
                      spec.radius, {0.0, 0.0}, spec.mass, spec.material, Half::both, spec.spin);
}

template <class Real>
BodyId BasicWorld<Real>::add(const BatSpec& spec) {
  assert(spec.half_extent.minCoeff() > 0.0);
  return engine_->add(BodyKind::bat, spec.position.cast<Real>(), spec.velocity.cast<Real>(), 0.0,
                      spec.half_extent.cast<Real>(), spec.mass, spec.material, spec.half, 0.0);
}

template <class Real>
BodyId BasicWorld<Real>::add(const PostSpec& spec) {
  assert(spec.radius >= 0.0);
  return engine_->add(BodyKind::post, spec.position.cast<Real>(), {0.0, 0.0}, spec.radius,
                      {0.0, 0.0}, std::numeric_limits<double>::infinity(), spec.material,
                      Half::both, 0.0);
}

template <class Real>
void BasicWorld<Real>::remove(BodyId body) {
  engine_->remove(body.index);
}
template <class Real>
void BasicWorld<Real>::set_thrust(BodyId bat, const Vector2& acceleration) {
  engine_->set_thrust(bat.index, acceleration.cast<Real>());
}
template <class Real>
void BasicWorld<Real>::place(BodyId puck, const Vector2& position, const Vector2& velocity) {
  engine_->place(puck.index, position.cast<Real>(), velocity.cast<Real>());
}
template <class Real>
std::optional<BasicGoal<Real>> BasicWorld<Real>::advance(Real until) {
  return engine_->advance(until);
}

template <class Real>
void BasicWorld<Real>::record_events(bool is_wanted) {
  engine_->records_events_ = is_wanted;
}
template <class Real>
std::span<const BasicEvent<Real>> BasicWorld<Real>::events() const {
  return engine_->events_;
}
template <class Real>
void BasicWorld<Real>::forget_events() {
  engine_->events_.clear();
}

template <class Real>
Real BasicWorld<Real>::now() const {
  return engine_->now_;
}

template <class Real>
BasicMotion<Real> BasicWorld<Real>::motion(BodyId body) const {
  return engine_->motion(body.index);
}
template <class Real>
std::uint32_t BasicWorld<Real>::motion_version(BodyId body) const {
  return engine_->bodies_[body.index].version;
}

template <class Real>
std::span<const BodyId> BasicWorld<Real>::changed(ChangeCursor& cursor) const {
  return engine_->changes_.read(cursor, body_count());
}

template <class Real>
BasicVector2<Real> BasicWorld<Real>::position(BodyId body) const {
  const BasicMotion<Real> m = motion(body);
  return is_in_play(body) ? m.at(engine_->now_).position : m.position;
}

template <class Real>
BasicVector2<Real> BasicWorld<Real>::velocity(BodyId body) const {
  const BasicMotion<Real> m = motion(body);
  return is_in_play(body) ? m.at(engine_->now_).velocity : m.velocity;
}

template <class Real>
std::uint32_t BasicWorld<Real>::body_count() const {
  return static_cast<std::uint32_t>(engine_->bodies_.size());
}
template <class Real>
BodyKind BasicWorld<Real>::kind(BodyId body) const {
  return engine_->bodies_[body.index].kind;
}
template <class Real>
Real BasicWorld<Real>::radius(BodyId body) const {
  return engine_->bodies_[body.index].radius;
}
template <class Real>
BasicVector2<Real> BasicWorld<Real>::half_extent(BodyId body) const {
  return engine_->builds_[body.index].half_extent + BasicVector2<Real>::Constant(radius(body));
}
template <class Real>
Real BasicWorld<Real>::mass(BodyId body) const {
  return engine_->builds_[body.index].mass;
}
template <class Real>
MaterialId BasicWorld<Real>::material(BodyId body) const {
  return engine_->bodies_[body.index].material;
}
template <class Real>
BasicVector2<Real> BasicWorld<Real>::thrust(BodyId body) const {
  return engine_->builds_[body.index].thrust;
}
template <class Real>
bool BasicWorld<Real>::is_in_play(BodyId body) const {
  return !engine_->is_gone(body.index);
}
template <class Real>
bool BasicWorld<Real>::is_removed(BodyId body) const {
  return (engine_->bodies_[body.index].flags & BasicEngine<Real>::removed) != 0;
}

template <class Real>
bool BasicWorld<Real>::is_resting(BodyId body) const {
  const BasicMotion<Real> m = motion(body);
  return m.velocity == BasicVector2<Real>(0.0, 0.0) &&
         m.acceleration == BasicVector2<Real>(0.0, 0.0);
}

template <class Real>
bool BasicWorld<Real>::is_held(BodyId body) const {
  return (engine_->bodies_[body.index].flags &
          (BasicEngine<Real>::held | BasicEngine<Real>::frozen)) != 0;
}

template <class Real>
bool BasicWorld<Real>::is_free(const Vector2& centre, double radius) const {
  return engine_->is_free(centre.cast<Real>(), {BasicVector2<Real>(0.0, 0.0), radius});
}
template <class Real>
bool BasicWorld<Real>::is_free(const Vector2& centre, const Vector2& half_extent) const {
  return engine_->is_free(centre.cast<Real>(), {half_extent.cast<Real>(), 0.0});
}

template <class Real>
BasicWorld<Real>::BasicWorld(std::unique_ptr<BasicEngine<Real>> engine)
    : engine_(std::move(engine)) {}
template <class Real>
std::vector<std::uint8_t> BasicWorld<Real>::save() const {
  return engine_->save();
}
template <class Real>
std::optional<BasicWorld<Real>> BasicWorld<Real>::restore(std::span<const std::uint8_t> bytes) {
  auto engine = BasicEngine<Real>::restore(bytes);
  if (!engine) return std::nullopt;
  return BasicWorld(std::move(engine));
}

template <class Real>
const WorldSpec& BasicWorld<Real>::spec() const {
  return engine_->spec_;
}
template <class Real>
const Counters& BasicWorld<Real>::counters() const {
  return engine_->counters_;
}
template <class Real>
Real BasicWorld<Real>::kinetic_energy() const {
  return engine_->kinetic_energy();
}
template <class Real>
Real BasicWorld<Real>::spin(BodyId body) const {
  return engine_->spin(body.index);
}
template <class Real>
Real BasicWorld<Real>::energy_introduced() const {
  return engine_->introduced_.value();
}
template <class Real>
Real BasicWorld<Real>::work_of_thrust() const {
  return engine_->work_of_thrust();
}
template <class Real>
Real BasicWorld<Real>::dissipated() const {
  return engine_->dissipated();
}
template <class Real>
BasicVector2<Real> BasicWorld<Real>::momentum() const {
  return engine_->momentum();
}
template <class Real>
Real BasicWorld<Real>::max_overlap() const {
  return engine_->max_overlap();
}
template <class Real>
std::uint64_t BasicWorld<Real>::hash() const {
  return engine_->hash();
}

template class BasicWorld<double>;
template class BasicWorld<long double>;

}  // namespace rink::physics
