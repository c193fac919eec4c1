// Keeps updates back and releases them.
#include "rti/federate/services/sparing.h"

#include "rti/fom/coded_values.h"
#include "rti/wire/declaration_messages.h"

namespace rink::rti {

/// Values may be kept back only if they end with their federate, and only while news of a
/// subscriber would reach it at once.
bool Sparing::may_spare() const { return uses_.ownership.is_deleting() && uses_.gate.is_open(); }

bool Sparing::spares(InteractionClassHandle interaction_class) {
  if (uses_.classes.is_heard(interaction_class) || !may_spare()) return false;
  ++basis_.counters.interactions_spared;
  return true;
}

bool Sparing::spares(const UpdateHeader& header, ObjectHandle object, bool is_own, Bytes values) {
  const AttributeSet attributes = header.attributes;
  if (!(attributes & uses_.classes.subscribed(header.object_class)).is_empty() || !is_own ||
      !may_spare()) {
    values_.forget(object, attributes);
    return false;
  }
  SparedValues::Spared& spared =
      values_.keep(object, header.object_class, attributes, values, header.stamp.time);
  uses_.sent.note_spared(header.stamp);
  const AttributeSet outdated =
      (attributes & uses_.sent.of(header.object_class)).without(spared.announced);
  spared.announced = spared.announced | outdated;
  uses_.sender.before_stream(object, header.object_class, attributes);
  if (!outdated.is_empty()) basis_.frames.enqueue(SpareUpdateMessage{object.value, outdated.bits});
  ++basis_.counters.updates_spared;
  return true;
}

void Sparing::release(ObjectClassHandle object_class, AttributeSet subscribed) {
  if (values_.is_empty()) return;
  for (const ObjectHandle object : values_.list(object_class, subscribed)) release(object);
}

void Sparing::release(ObjectHandle object) {
  const SparedValues::Spared* spared = values_.find(object);
  if (spared == nullptr || !basis_.phase.is_joined()) return;
  const SparedValues::Spared kept = *spared;
  values_.forget(object);
  const ObjectClass& object_class = basis_.fom.at(kept.object_class);
  AttributeSet group;
  const auto send_all = [&] {
    if (!group.is_empty())
      uses_.sender.send_by_stream({kept.object_class, group, uses_.sent.newest()}, object, coded_);
    coded_.clear();
    group = {};
  };
  coded_.clear();
  for (const AttributeHandle attribute : kept.attributes) {
    const std::size_t index = attribute.value;
    const AttributeSet one{attribute};
    std::vector<std::byte> value = kept.values[index];
    if (is_coded(object_class, one))
      value.clear(), encode(object_class, one, kept.values[index], kept.times[index], value);
    if (coded_.size() + value.size() > values_max) send_all();
    coded_.insert(coded_.end(), value.begin(), value.end());
    group = group | one;
  }
  send_all();
}

}  // namespace rink::rti
