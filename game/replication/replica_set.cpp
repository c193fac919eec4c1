// Applies discoveries, reflections and changes of scope to the replicas.
#include "game/replication/replica_set.h"

#include <bit>
#include <cassert>
#include <cmath>

#include "im/basics/checked.h"
#include "rti/wire/message.h"

namespace rink::game {

void ReplicaSet::discover(rti::ObjectHandle object, rti::ObjectClassHandle object_class) {
  if (known_.find(object) != nullptr) return;
  if (object_class == model_.entity) {
    known_[object] = {Kind::entity, static_cast<std::uint32_t>(entities_.size())};
    EntityReplica& entity = entities_.emplace_back();
    entity.object = object;
    // Checking all at every discovery would take quadratic time.
    if constexpr (checks_whole_structures)
      if (std::has_single_bit(entities_.size())) check();
  } else if (object_class == model_.score) {
    known_[object].kind = Kind::score;
  } else if (object_class == model_.field) {
    known_[object].kind = Kind::field;
  } else if (object_class == model_.match) {
    known_[object].kind = Kind::match;
  }
}

void ReplicaSet::check() const {
  std::size_t count = 0;
  known_.for_each([&]([[maybe_unused]] rti::ObjectHandle object, const Known& known) {
    if (known.kind != Kind::entity) return;
    ++count;
    assert(known.slot < entities_.size() && entities_[known.slot].object == object);
  });
  assert(count == entities_.size());
}

void ReplicaSet::reflect(rti::ObjectHandle object, rti::AttributeSet attributes, rti::Bytes values,
                         const rti::Stamp& stamp) {
  const Known* found = known_.find(object);
  if (found == nullptr) return;
  ++counters_.updates;
  newest_ = stamp;
  bool is_sound = true;
  if (found->kind == Kind::entity) {
    assert(found->slot < entities_.size() && entities_[found->slot].object == object);
    EntityReplica& entity = entities_[found->slot];
    entity.stamp = stamp;
    is_sound = reflect_entity(entity, attributes, values);
    entity.is_placed |= is_sound && (attributes.contains(model_.position) ||
                                     attributes.contains(model_.trajectory) ||
                                     attributes.contains(model_.snapshot));
  } else if (found->kind == Kind::score) {
    is_sound = decode(values, goals_);
  } else if (found->kind == Kind::field) {
    is_sound = reflect_field(attributes, values);
  } else if (found->kind == Kind::match) {
    is_sound = reflect_match(attributes, values);
  }
  if (!is_sound) ++counters_.malformed;
}

bool ReplicaSet::reflect_entity(EntityReplica& entity, rti::AttributeSet attributes,
                                rti::Bytes values) {
  if (attributes == position_) {  // nearly all of the traffic
    Position replica;
    if (!decode(values, replica)) return false;
    place(entity, replica);
    return true;
  }
  rti::Reader reader(values);
  if (attributes == trajectory_) {
    Trajectory replica;
    if (!exchange(reader, replica) || !reader.is_at_end()) return false;
    entity.trajectory = replica;
    follow_law(entity);
    return true;
  }
  if (attributes == snapshot_) {
    if (!reflect_snapshot(reader, entity) || !reader.is_at_end()) return false;
    follow_law(entity);
    return true;
  }
  EntityReplica replica = entity;
  if (attributes.contains(model_.shape) && !exchange(reader, replica.shape)) return false;
  if (attributes.contains(model_.input) && !exchange(reader, replica.input)) return false;
  Position position;
  const bool has_position = attributes.contains(model_.position);
  if (has_position && !exchange(reader, position)) return false;
  if (attributes.contains(model_.trajectory) && !exchange(reader, replica.trajectory.emplace()))
    return false;
  if (attributes.contains(model_.snapshot) && !reflect_snapshot(reader, replica)) return false;
  if (!reader.is_at_end()) return false;
  if (has_position) place(replica, position);
  follow_law(replica);
  entity = replica;
  return true;
}

/// With linear drag g the way in a time t is v (e^(gt) - 1)/g, v being the velocity at its end.
void ReplicaSet::place(EntityReplica& entity, const Position& position) const {
  const physics::Vector2 from(static_cast<double>(entity.position.x),
                              static_cast<double>(entity.position.y));
  const double gap_s = entity.stamp.time - entity.placed_s;
  const bool has_way =
      extrapolates_ && entity.is_placed && gap_s > 0.0 && gap_s <= predicted_gap_max;
  entity.position = position;
  entity.placed_s = entity.stamp.time;
  entity.is_predicted = false;
  if (!has_way) return;
  const physics::Vector2 at(static_cast<double>(position.x), static_cast<double>(position.y)),
      way = at - from;
  if (way.isZero(0.0) || way.norm() > predicted_speed_max * gap_s) return;
  const double g = drag_.of(static_cast<physics::BodyKind>(entity.shape.kind)).drag;
  entity.motion = {.time = entity.stamp.time,
                   .position = at,
                   .velocity = way * (g > 0.0 ? g / std::expm1(g * gap_s) : 1.0 / gap_s),
                   .acceleration = {0.0, 0.0},
                   .drag = {g, g}};
  entity.is_predicted = true;
}

/// Until the next snapshot the entity moves by its kind's own law.
bool ReplicaSet::reflect_snapshot(rti::Reader& reader, EntityReplica& entity) const {
  Snapshot replica;
  if (!exchange(reader, replica)) return false;
  entity.trajectory = Trajectory{
      .time = entity.stamp.time, .position = replica.position, .velocity = replica.velocity};
  return true;
}

bool ReplicaSet::reflect_field(rti::AttributeSet attributes, rti::Bytes values) {
  rti::Reader reader(values);
  Extent extent;
  Drag drag = drag_;
  if (attributes.contains(model_.extent) && !exchange(reader, extent)) return false;
  if (attributes.contains(model_.drag) && !exchange(reader, drag)) return false;
  if (!reader.is_at_end()) return false;
  if (attributes.contains(model_.extent)) field_ = extent;
  drag_ = drag;
  for (EntityReplica& each : entities_) follow_law(each);
  return true;
}

bool ReplicaSet::reflect_match(rti::AttributeSet attributes, rti::Bytes values) {
  rti::Reader reader(values);
  MatchState state = match_;
  SceneText scene;
  if (attributes.contains(model_.match_state) && !exchange(reader, state)) return false;
  if (attributes.contains(model_.match_scene)) {
    if (!exchange(reader, scene)) return false;
    match_scene_.assign(reinterpret_cast<const char*>(scene.text.data()), scene.text.size());
  }
  TickPeriod tick{match_tick_};
  if (attributes.contains(model_.match_tick) && !exchange(reader, tick)) return false;
  match_tick_ = tick.seconds;
  match_ = state;
  has_match_ = has_match_ || attributes.contains(model_.match_state);
  return reader.is_at_end();
}

void ReplicaSet::follow_law(EntityReplica& entity) const {
  if (!entity.trajectory) return;
  entity.motion =
      motion_of(*entity.trajectory, drag_.of(static_cast<physics::BodyKind>(entity.shape.kind)));
  entity.position = rounded(entity.motion.position);
}

void ReplicaSet::show(const Computed& computed, const rti::Stamp& stamp) {
  EntityReplica* const shown = entity(computed.object);
  if (shown == nullptr) return;  // a wrong sender gave it the handle of something else
  shown->shape = computed.shape, shown->input = computed.input;
  shown->stamp = stamp;
  shown->motion = computed.motion;
  shown->trajectory = Trajectory{.time = computed.motion.time,
                                 .position = computed.motion.position,
                                 .velocity = computed.motion.velocity,
                                 .acceleration = computed.motion.acceleration};
  shown->position = rounded(computed.motion.position);
  shown->is_placed = true;
  ++counters_.updates;
}

void ReplicaSet::set_scope(rti::ObjectHandle object, bool in_scope) {
  EntityReplica* changed = entity(object);
  if (changed == nullptr || changed->in_scope == in_scope) return;
  changed->in_scope = in_scope;
  changed->is_placed &= in_scope;
  changed->is_predicted &= in_scope;
  ++(in_scope ? counters_.entered : counters_.left);
}

void ReplicaSet::remove(rti::ObjectHandle object) {
  if (entity(object) == nullptr) return;
  const std::uint32_t slot = known_.find(object)->slot;
  assert(slot < entities_.size() && known_.find(entities_.back().object) != nullptr);
  known_.find(entities_.back().object)->slot = slot;
  entities_[slot] = entities_.back();
  entities_.pop_back();
  known_.erase(object);
  if constexpr (checks_whole_structures)
    if (std::has_single_bit(entities_.size())) check();
}

EntityReplica* ReplicaSet::entity(rti::ObjectHandle object) {
  const Known* found = known_.find(object);
  return found != nullptr && found->kind == Kind::entity ? &entities_[found->slot] : nullptr;
}

const EntityReplica* ReplicaSet::find(rti::ObjectHandle object) const {
  return const_cast<ReplicaSet*>(this)->entity(object);
}

}  // namespace rink::game
