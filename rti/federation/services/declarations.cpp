// Publications and subscriptions, and advisories to those whom others' subscriptions concern.
#include "rti/federation/services/declarations.h"

#include <algorithm>
#include <cassert>

namespace rink::rti {

Declarations::Declarations(const FederationBasis& basis, const Uses& uses)
    : basis_(basis),
      uses_(uses),
      relevance_(basis.fom.object_classes().size() + basis.fom.interaction_classes().size()) {}

void Declarations::joined(std::uint32_t slot) {
  if (slot >= told_.size()) told_.resize(slot + 1);
  told_[slot] = {};
  told_[slot].classes.resize(relevance_.row_count());
}

Outcome Declarations::handle_publish_class(std::uint32_t slot, Reader& reader) {
  PublishObjectClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  const ObjectClassHandle object_class{message.object_class};
  const AttributeSet attributes{message.attributes};
  if (!basis_.fom.attributes(object_class).includes(attributes)) return Violation::unknown_name;
  if (basis_.fom.is_management(object_class)) return Violation::not_owned;
  const AttributeSet before = uses_.publications.set_class(slot, message.object_class, attributes);
  uses_.owners.published_changed(slot, message.object_class, before);
  tell_relevance(slot, message.object_class);
  return std::nullopt;
}

Outcome Declarations::handle_subscribe_class(std::uint32_t slot, Reader& reader) {
  SubscribeObjectClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  const AttributeSet attributes{message.attributes};
  if (!basis_.fom.attributes(ObjectClassHandle{message.object_class}).includes(attributes))
    return Violation::unknown_name;
  const Subscription subscription{attributes,
                                  message.is_passive != 0 ? AttributeSet() : attributes};
  return uses_.distribution.subscribe(slot, message.object_class, subscription, {message.region})
             ? Outcome()
             : Violation::unknown_name;
}

Outcome Declarations::handle_publish_interaction(std::uint32_t slot, Reader& reader) {
  PublishInteractionClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.interaction_class >= basis_.fom.interaction_classes().size())
    return Violation::unknown_name;
  if (message.is_declared > 1) return Violation::malformed;
  const InteractionClassHandle interaction_class{message.interaction_class};
  if (basis_.fom.is_management(interaction_class) && !basis_.fom.is_for_rti(interaction_class))
    return Violation::not_owned;
  uses_.publications.set_interaction(slot, message.interaction_class, message.is_declared != 0);
  tell_relevance(slot, basis_.fom.object_classes().size() + message.interaction_class);
  return std::nullopt;
}

Outcome Declarations::handle_advisory_switch(std::uint32_t slot, Reader& reader) {
  AdvisorySwitchMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  told_[slot].objects = message.is_on != 0 ? std::make_unique<ObjectMap<AttributeSet>>() : nullptr;
  if (message.is_on == 0) return std::nullopt;
  uses_.distribution.watch_scope(true);
  uses_.owners.for_each_owned(
      slot, [this](ObjectSlot object) { uses_.distribution.touched().push_back(object); });
  return std::nullopt;
}

void Declarations::subscriptions_changed(std::uint32_t slot) {
  const bool is_joined = basis_.federates[slot].is_joined;
  for (std::size_t row = 0; row < relevance_.row_count(); ++row)
    if (relevance_.set(slot, row, is_joined ? subscribed(slot, row) : Subscription()))
      tell_publishers(row);
}

Subscription Declarations::subscribed(std::uint32_t slot, std::size_t row) const {
  const std::uint16_t number = number_of(row);
  return is_interaction(row) ? Relevance::of(uses_.interactions.listening(slot, number))
                             : uses_.distribution.subscribed_anywhere(slot, number);
}

/// What others than `slot` hear of a row. The RTI itself hears what the management object model
/// lets federates ask of it.
Subscription Declarations::others_hear(std::uint32_t slot, std::size_t row) const {
  if (is_interaction(row) && basis_.fom.is_for_rti(InteractionClassHandle{number_of(row)}))
    return Relevance::of(Listening::active);
  return relevance_.of_others(slot, row);
}

bool Declarations::publishes(std::uint32_t slot, std::size_t row) const {
  const std::uint16_t number = number_of(row);
  return is_interaction(row) ? uses_.publications.has_interaction(slot, number)
                             : !uses_.publications.of_class(slot, number).is_empty();
}

void Declarations::tell_publishers(std::size_t row) {
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot)
    if (basis_.federates[slot].is_joined && publishes(slot, row) &&
        told_[slot].classes[row] != others_hear(slot, row))
      tell_relevance(slot, row);
}

void Declarations::tell_relevance(std::uint32_t slot, std::size_t row) {
  assert(row < relevance_.row_count());
  if (!publishes(slot, row)) return;
  const Subscription others = told_[slot].classes[row] = others_hear(slot, row);
  basis_.federates[slot].outbox.before_updates(ClassRelevanceMessage{
      is_interaction(row), number_of(row), others.heard.bits, others.active.bits});
}

void Declarations::tell_object_relevance() {
  std::vector<ObjectSlot>& touched = uses_.distribution.touched();
  if (touched.empty()) return;
  uses_.distribution.watch_scope(
      std::ranges::any_of(told_, [](const Told& each) { return each.objects != nullptr; }));
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const ObjectSlot object : touched)
    if (basis_.objects[object].is_alive) tell_of(object);
  touched.clear();
}

void Declarations::tell_of(ObjectSlot object) {
  const ObjectHandle handle = basis_.objects[object].handle;
  for (std::uint32_t owner = 0; owner < told_.size(); ++owner) {
    if (!told_[owner].objects) continue;
    const AttributeSet heard = heard_of(owner, object);
    ObjectMap<AttributeSet>& told = *told_[owner].objects;
    const AttributeSet* before = told.find(handle);
    if (heard == (before != nullptr ? *before : AttributeSet())) continue;
    if (heard.is_empty()) told.erase(handle);
    else told[handle] = heard;
    basis_.federates[owner].outbox.before_updates(ObjectRelevanceMessage{handle.value, heard.bits});
  }
}

/// Of what it owns: what some active subscriber is told.
AttributeSet Declarations::heard_of(std::uint32_t owner, ObjectSlot object) const {
  AttributeSet heard;
  const AttributeSet owned =
      uses_.ownership.owned_by(owner, object).without(AttributeSet{privilege_to_delete_object});
  for (std::uint32_t slot = 0; slot < basis_.federates.size() && heard != owned; ++slot)
    if (slot != owner && basis_.federates[slot].is_joined)
      heard = heard | (uses_.distribution.told_actively(slot, object) & owned);
  return heard;
}

}  // namespace rink::rti
