// Applies discoveries, reflections and changes of scope to the mirror.
#include "game/replication/mirror.h"

#include "rti/message.h"

namespace rink::game {

void Mirror::discover(rti::ObjectHandle object, rti::ObjectClassHandle object_class) {
  const std::uint32_t block = object.value / rti::object_block, number = object.value % rti::object_block;
  if (block >= known_.size()) known_.resize(block + 1);
  if (number >= known_[block].size()) known_[block].resize(number + 1);
  Known& known = known_[block][number];
  if (known.kind != Kind::unknown) return;
  if (object_class == model_.entity) {
    known = {Kind::entity, static_cast<std::uint32_t>(entities_.size())};
    entities_.push_back({.object = object, .shape = {}, .input = {}, .position = {}, .stamp = {}, .in_scope = false});
  } else if (object_class == model_.score) {
    known.kind = Kind::score;
  } else if (object_class == model_.field) {
    known.kind = Kind::field;
  }
}

void Mirror::reflect(rti::ObjectHandle object, rti::AttributeSet attributes, rti::Bytes values, const rti::Stamp& stamp) {
  const Known* told = known(object);
  if (told == nullptr) return;
  ++counters_.updates;
  newest_ = stamp;
  bool is_sound = true;
  if (told->kind == Kind::entity) {
    MirroredEntity& entity = entities_[told->slot];
    entity.stamp = stamp;
    is_sound = reflect_entity(entity, attributes, values);
  } else if (told->kind == Kind::score) {
    is_sound = decode(values, goals_);
  } else if (told->kind == Kind::field) {
    is_sound = decode(values, field_.emplace());
  }
  if (!is_sound) ++counters_.malformed;
}

bool Mirror::reflect_entity(MirroredEntity& entity, rti::AttributeSet attributes, rti::Bytes values) {
  if (attributes == position_) return decode(values, entity.position);  // nearly all of the traffic
  rti::Reader reader(values);
  MirroredEntity heard = entity;
  if (attributes.contains(model_.shape) && !exchange(reader, heard.shape)) return false;
  if (attributes.contains(model_.input) && !exchange(reader, heard.input)) return false;
  if (attributes.contains(model_.position) && !exchange(reader, heard.position)) return false;
  if (!reader.is_at_end()) return false;
  entity = heard;
  return true;
}

void Mirror::set_scope(rti::ObjectHandle object, bool in_scope) {
  MirroredEntity* changed = entity(object);
  if (changed == nullptr || changed->in_scope == in_scope) return;
  changed->in_scope = in_scope;
  ++(in_scope ? counters_.entered : counters_.left);
}

void Mirror::remove(rti::ObjectHandle object) {
  if (entity(object) == nullptr) return;
  const std::uint32_t slot = known(object)->slot;
  known(entities_.back().object)->slot = slot;
  entities_[slot] = entities_.back();
  entities_.pop_back();
  *known(object) = {};
}

Mirror::Known* Mirror::known(rti::ObjectHandle object) {
  const std::uint32_t block = object.value / rti::object_block, number = object.value % rti::object_block;
  return block < known_.size() && number < known_[block].size() ? &known_[block][number] : nullptr;
}

MirroredEntity* Mirror::entity(rti::ObjectHandle object) {
  const Known* told = known(object);
  return told != nullptr && told->kind == Kind::entity ? &entities_[told->slot] : nullptr;
}

const MirroredEntity* Mirror::find(rti::ObjectHandle object) const { return const_cast<Mirror*>(this)->entity(object); }

}  // namespace rink::game
