// What federates publish and subscribe, and who is told that somebody hears it (IEEE 1516.1-2010,
// clause 5; docs/rti.md, "Nobody listens").
#include <algorithm>

#include "rti/federation/federation_management_objects.h"
#include "rti/wire/declaration_messages.h"

namespace rink::rti {

Outcome FederationParts::publish_object_class(std::uint32_t slot, Reader& reader) {
  PublishObjectClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= fom_.object_classes().size()) return Violation::unknown_name;
  const ObjectClassHandle object_class{message.object_class};
  if (!fom_.attributes(object_class).includes(AttributeSet(message.attributes)))
    return Violation::unknown_name;
  if (fom_.is_management(object_class)) return Violation::not_owned;
  const AttributeSet before =
      publications_.set_class(slot, message.object_class, AttributeSet(message.attributes));
  published_changed(slot, message.object_class, before);
  tell_relevance(slot, message.object_class);
  return std::nullopt;
}

Outcome FederationParts::subscribe_object_class(std::uint32_t slot, Reader& reader) {
  SubscribeObjectClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= fom_.object_classes().size()) return Violation::unknown_name;
  const AttributeSet attributes{message.attributes};
  if (!fom_.attributes(ObjectClassHandle{message.object_class}).includes(attributes))
    return Violation::unknown_name;
  const Subscription subscription{attributes,
                                  message.is_passive != 0 ? AttributeSet() : attributes};
  if (!interest_.subscribe(slot, message.object_class, subscription, {message.region}))
    return Violation::unknown_name;
  subscribed(slot);
  return std::nullopt;
}

Outcome FederationParts::publish_interaction_class(std::uint32_t slot, Reader& reader) {
  PublishInteractionClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.interaction_class >= fom_.interaction_classes().size())
    return Violation::unknown_name;
  if (message.is_declared > 1) return Violation::malformed;
  const InteractionClassHandle interaction_class{message.interaction_class};
  if (fom_.is_management(interaction_class) && !fom_.is_for_rti(interaction_class))
    return Violation::not_owned;
  publications_.set_interaction(slot, message.interaction_class, message.is_declared != 0);
  tell_relevance(slot, fom_.object_classes().size() + message.interaction_class);
  return std::nullopt;
}

/// Takes what it subscribes now into account, and tells publishers who are concerned, at once:
/// whatever a subscriber says next reaches them after that.
void FederationParts::subscribed(std::uint32_t slot) {
  const std::size_t object_classes = fom_.object_classes().size();
  for (std::size_t row = 0; row < relevance_.row_count(); ++row) {
    const auto number =
        static_cast<std::uint16_t>(row < object_classes ? row : row - object_classes);
    Subscription now;
    if (federates_[slot].is_joined)
      now = row < object_classes ? interest_.subscribed_anywhere(slot, number)
                                 : Relevance::of(interactions_.listening(slot, number));
    if (relevance_.set(slot, row, now)) tell_publishers(row);
  }
  manage_subscriptions(slot);
}

void FederationParts::manage_subscriptions(std::uint32_t slot) {
  if (!management_objects_ && ManagementObjects::is_heard(*this))
    management_objects_ = std::make_unique<ManagementObjects>(*this);
  if (management_objects_) management_objects_->subscribed(slot);
}

/// What others than `slot` hear of a row. The RTI itself hears what the management object model
/// lets federates ask of it.
Subscription FederationParts::others_hear(std::uint32_t slot, std::size_t row) const {
  const std::size_t object_classes = fom_.object_classes().size();
  if (row >= object_classes &&
      fom_.is_for_rti(InteractionClassHandle{static_cast<std::uint32_t>(row - object_classes)}))
    return Relevance::of(Listening::active);
  return relevance_.of_others(slot, row);
}

void FederationParts::tell_publishers(std::size_t row) {
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot) {
    const Federate& federate = federates_[slot];
    if (federate.is_joined && publishes(slot, row) &&
        federate.told_relevance[row] != others_hear(slot, row))
      tell_relevance(slot, row);
  }
}

bool FederationParts::publishes(std::uint32_t slot, std::size_t row) const {
  const std::size_t object_classes = fom_.object_classes().size();
  const auto number = static_cast<std::uint32_t>(row < object_classes ? row : row - object_classes);
  return row < object_classes ? !publications_.of_class(slot, number).is_empty()
                              : publications_.has_interaction(slot, number);
}

void FederationParts::tell_relevance(std::uint32_t slot, std::size_t row) {
  if (!publishes(slot, row)) return;
  const std::size_t object_classes = fom_.object_classes().size();
  const bool is_interaction = row >= object_classes;
  const Subscription others = federates_[slot].told_relevance[row] = others_hear(slot, row);
  const auto number = static_cast<std::uint16_t>(is_interaction ? row - object_classes : row);
  federates_[slot].outbox.before_updates(
      ClassRelevanceMessage{is_interaction, number, others.heard.bits, others.active.bits});
}

Outcome FederationParts::switch_advisory(std::uint32_t slot, Reader& reader) {
  AdvisorySwitchMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  auto& told = federates_[slot].told_objects;
  told = message.is_on != 0 ? std::make_unique<ObjectMap<AttributeSet>>() : nullptr;
  if (message.is_on == 0) return std::nullopt;
  interest_.watch_scope(true);
  for_each_owned(slot, [this](ObjectSlot object) { interest_.touched().push_back(object); });
  return std::nullopt;
}

/// Tells owners who asked for it which of their attributes are in the scope of an active subscriber
/// now. Nothing is kept or done where nobody asked.
void FederationParts::tell_object_relevance() {
  std::vector<ObjectSlot>& touched = interest_.touched();
  if (touched.empty()) return;
  interest_.watch_scope(std::ranges::any_of(
      federates_, [](const Federate& each) { return each.told_objects != nullptr; }));
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const ObjectSlot object : touched) {
    if (!objects_[object].is_alive) continue;
    const ObjectHandle handle = objects_[object].handle;
    for (std::uint32_t owner = 0; owner < federates_.size(); ++owner) {
      if (!federates_[owner].told_objects) continue;
      AttributeSet heard;
      const AttributeSet owned =
          ownership_.owned_by(owner, object).without(AttributeSet{privilege_to_delete_object});
      for (std::uint32_t slot = 0; slot < federates_.size() && heard != owned; ++slot)
        if (slot != owner && federates_[slot].is_joined)
          heard = heard | (interest_.told_actively(slot, object) & owned);
      ObjectMap<AttributeSet>& told = *federates_[owner].told_objects;
      const AttributeSet* before = told.find(handle);
      if (heard == (before != nullptr ? *before : AttributeSet())) continue;
      if (heard.is_empty()) told.erase(handle);
      else told[handle] = heard;
      federates_[owner].outbox.before_updates(ObjectRelevanceMessage{handle.value, heard.bits});
    }
  }
  touched.clear();
}

}  // namespace rink::rti
