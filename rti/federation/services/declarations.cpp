// Handles publications and subscriptions, and advises publishers of others' subscriptions.
#include "rti/federation/services/declarations.h"
#include "im/basics/sorted_set.h"

#include <algorithm>
#include <cassert>

namespace rink::rti {

Declarations::Declarations(const FederationBasis& basis, const Uses& uses)
    : basis_(basis),
      uses_(uses),
      relevance_(basis.fom.object_classes().size() + basis.fom.interaction_classes().size()) {}

void Declarations::joined(std::uint32_t slot) {
  if (slot >= advised_.size()) advised_.resize(slot + 1);
  advised_[slot] = {};
  advised_[slot].classes.resize(relevance_.row_count());
}

Status Declarations::handle_publish_class(std::uint32_t slot, Reader& reader) {
  PublishObjectClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  const ObjectClassHandle object_class{message.object_class};
  const AttributeSet attributes{message.attributes};
  if (!basis_.fom.attributes(object_class).includes(attributes)) return Violation::unknown_name;
  if (basis_.fom.is_management(object_class)) return Violation::not_owned;
  const AttributeSet before = uses_.publications.set_class(slot, message.object_class, attributes);
  uses_.owners.published_changed(slot, message.object_class, before);
  advise(slot, message.object_class);
  return std::nullopt;
}

Status Declarations::handle_subscribe_class(std::uint32_t slot, Reader& reader) {
  SubscribeObjectClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  const AttributeSet attributes{message.attributes};
  if (!basis_.fom.attributes(ObjectClassHandle{message.object_class}).includes(attributes))
    return Violation::unknown_name;
  const Subscription subscription{attributes,
                                  message.is_passive != 0 ? AttributeSet() : attributes};
  return uses_.distribution.subscribe(slot, message.object_class, subscription, {message.region})
             ? Status()
             : Violation::unknown_name;
}

Status Declarations::handle_publish_interaction(std::uint32_t slot, Reader& reader) {
  PublishInteractionClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.interaction_class >= basis_.fom.interaction_classes().size())
    return Violation::unknown_name;
  if (message.is_declared > 1) return Violation::malformed;
  const InteractionClassHandle interaction_class{message.interaction_class};
  if (basis_.fom.is_management(interaction_class) && !basis_.fom.is_for_rti(interaction_class))
    return Violation::not_owned;
  uses_.publications.set_interaction(slot, message.interaction_class, message.is_declared != 0);
  advise(slot, basis_.fom.object_classes().size() + message.interaction_class);
  return std::nullopt;
}

Status Declarations::handle_advisory_switch(std::uint32_t slot, Reader& reader) {
  AdvisorySwitchMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  advised_[slot].objects =
      message.is_on != 0 ? std::make_unique<ObjectMap<AttributeSet>>() : nullptr;
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
      advise_publishers(row);
}

void Declarations::restored() {
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot)
    for (std::size_t row = 0; basis_.federates[slot].is_joined && row < relevance_.row_count();
         ++row)
      relevance_.set(slot, row, subscribed(slot, row));
  for (std::size_t row = 0; row < relevance_.row_count(); ++row) advise_publishers(row);
}

Subscription Declarations::subscribed(std::uint32_t slot, std::size_t row) const {
  const std::uint16_t number = number_of(row);
  return is_interaction(row) ? Relevance::of(uses_.interactions.listening(slot, number))
                             : uses_.distribution.subscribed_anywhere(slot, number);
}

/// The subscriptions of all but `slot` to a row. The RTI itself receives the requests of the
/// management object model.
Subscription Declarations::others_subscribe(std::uint32_t slot, std::size_t row) const {
  if (is_interaction(row) && basis_.fom.is_for_rti(InteractionClassHandle{number_of(row)}))
    return Relevance::of(Listening::active);
  return relevance_.of_others(slot, row);
}

bool Declarations::publishes(std::uint32_t slot, std::size_t row) const {
  const std::uint16_t number = number_of(row);
  return is_interaction(row) ? uses_.publications.has_interaction(slot, number)
                             : !uses_.publications.of_class(slot, number).is_empty();
}

void Declarations::advise_publishers(std::size_t row) {
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot)
    if (basis_.federates[slot].is_joined && publishes(slot, row) &&
        advised_[slot].classes[row] != others_subscribe(slot, row))
      advise(slot, row);
}

void Declarations::advise(std::uint32_t slot, std::size_t row) {
  assert(row < relevance_.row_count());
  if (!publishes(slot, row)) return;
  const Subscription others = advised_[slot].classes[row] = others_subscribe(slot, row);
  basis_.federates[slot].outbox.before_updates(ClassRelevanceMessage{
      is_interaction(row), number_of(row), others.subscribed.bits, others.active.bits});
}

void Declarations::advise_object_relevance() {
  std::vector<ObjectSlot>& touched = uses_.distribution.touched();
  if (touched.empty()) return;
  uses_.distribution.watch_scope(is_any_advised());
  make_sorted_set(touched);
  for (const ObjectSlot object : touched)
    if (basis_.objects[object].is_alive) advise_owners_of(object);
  touched.clear();
}

bool Declarations::is_any_advised() const {
  return std::ranges::any_of(advised_, [](const Advised& each) { return each.objects != nullptr; });
}

void Declarations::advise_owners_of(ObjectSlot object) {
  const ObjectHandle handle = basis_.objects[object].handle;
  for (std::uint32_t owner = 0; owner < advised_.size(); ++owner) {
    if (!advised_[owner].objects) continue;
    const AttributeSet subscribed = subscribed_of(owner, object);
    ObjectMap<AttributeSet>& advised = *advised_[owner].objects;
    const AttributeSet* before = advised.find(handle);
    if (subscribed == (before != nullptr ? *before : AttributeSet())) continue;
    if (subscribed.is_empty()) advised.erase(handle);
    else advised[handle] = subscribed;
    basis_.federates[owner].outbox.before_updates(
        ObjectRelevanceMessage{handle.value, subscribed.bits});
  }
}

/// The owner's attributes of the object that are in the scope of some active subscriber.
AttributeSet Declarations::subscribed_of(std::uint32_t owner, ObjectSlot object) const {
  AttributeSet subscribed;
  const AttributeSet owned =
      uses_.ownership.owned_by(owner, object).without(AttributeSet{privilege_to_delete_object});
  for (std::uint32_t slot = 0; slot < basis_.federates.size() && subscribed != owned; ++slot)
    if (slot != owner && basis_.federates[slot].is_joined)
      subscribed = subscribed | (uses_.distribution.actively_in_scope(slot, object) & owned);
  return subscribed;
}

}  // namespace rink::rti
