// Shows who entered, left or changed, tick by tick.
#include "game/net/client/computed_replicas.h"

#include "game/model/key.h"

namespace rink::game {
namespace {

/// The fewest keys that drive a bat so.
std::uint8_t keys_of(const Drive& drive) {
  KeysHeld held;
  held.set(Key::left, drive.x < 0), held.set(Key::right, drive.x > 0);
  held.set(Key::down, drive.y < 0), held.set(Key::up, drive.y > 0);
  return held.bits();
}

}  // namespace

ExactReplicas::Result ComputedReplicas::receive(
    rti::Bytes message, std::uint32_t player,
    const std::function<void(const rti::Stamp&)>& before) {
  const ExactReplicas::Result result = exact_.receive(message);
  if (result == ExactReplicas::Result::waiting) return result;
  const rti::Stamp stamp{exact_.time(), exact_.tag()};
  if (result == ExactReplicas::Result::exact) before(stamp);
  for (const auto& [object, is_removed] : exact_.left()) {
    received_.note_scope(object, false);
    if (object == bat_) bat_ = {};
    if (is_removed) replicas_.remove(object);
    else replicas_.set_scope(object, false);
  }
  if (result != ExactReplicas::Result::exact) return result;
  for (const std::uint32_t number : exact_.entered()) enter(number, player, stamp);
  show_changed(stamp);
  received_.note_update(bat_, message.size());
  return result;
}

void ComputedReplicas::enter(std::uint32_t number, std::uint32_t player, const rti::Stamp& stamp) {
  const ExactReplicas::Body& body = *exact_.find(number);
  replicas_.discover(body.object, model_.entity);
  replicas_.set_scope(body.object, true);
  received_.note_scope(body.object, true);
  if (exact_.class_of(body).kind == physics::BodyKind::bat && body.player == player)
    bat_ = body.object, bat_number_ = number;
  show(body, stamp);
}

void ComputedReplicas::show(const ExactReplicas::Body& body, const rti::Stamp& stamp) {
  const ExactClass& kind = exact_.class_of(body);
  const physics::Vector2 extent = kind.half_extent + physics::Vector2::Constant(kind.radius);
  ReplicaSet::Computed shown{
      .object = body.object,
      .shape = {.kind = static_cast<std::uint8_t>(kind.kind),
                .team = kind.team,
                .half_length = static_cast<float>(extent.x()),
                .half_width = static_cast<float>(extent.y())},
      .input = {.count = body.object == bat_ ? exact_.felt() : 0, .held = keys_of(body.drive)},
      .motion = exact_.motion(body)};
  if (!exact_.is_in_play(body))  // it lies where it left play
    shown.motion.velocity = shown.motion.acceleration = physics::Vector2(0.0, 0.0);
  replicas_.show(shown, stamp);
}

/// The own bat always, for the number of its keys.
void ComputedReplicas::show_changed(const rti::Stamp& stamp) {
  for (const std::uint32_t number : exact_.changed())
    if (const ExactReplicas::Body& body = *exact_.find(number); body.is_in_scope) show(body, stamp);
  if (bat_)
    if (const ExactReplicas::Body* const own = exact_.find(bat_number_)) show(*own, stamp);
  replicas_.show_instant(stamp);
}

void ComputedReplicas::look_ahead(double instant) {
  if (!exact_.is_exact()) return;
  exact_.look_ahead(instant);
  show_changed({exact_.time(), exact_.tag()});
}

void ComputedReplicas::look_back() {
  if (!exact_.is_exact()) return;
  exact_.look_back();
  show_changed({exact_.time(), exact_.tag()});
}

void ComputedReplicas::withdraw() {
  for (const ExactReplicas::Body& body : exact_.bodies()) replicas_.set_scope(body.object, false);
  bat_ = {};
}

}  // namespace rink::game
