// Declaration management at the federate's side (IEEE 1516.1-2010, clause 5), and what is not sent
// since nobody hears it (docs/rti.md, "Nobody listens").
#include <algorithm>
#include <optional>
#include <utility>

#include "rti/federate/ambassador_services.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/declaration_messages.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

void AmbassadorServices::publish_object_class_attributes(ObjectClassHandle object_class,
                                                         AttributeSet attributes) {
  require_class(object_class, attributes);
  if (fom_.is_management(object_class))
    throw RtiException(HlaError::unauthorized,
                       "class " + fom_.at(object_class).name + " is the RTI's to publish");
  DeclaredState::Class& declared = declared_.objects[object_class.value];
  if (!declared.published.without(attributes).is_empty())
    release_spared(object_class, AttributeSet(~0u)), release_best_effort(object_class);
  withdraw_publication(object_class, declared.published.without(attributes), attributes.is_empty());
  declared.published = attributes;
  if (attributes.is_empty()) declared.is_relevant = false;
  declared.others = {attributes.is_empty()
                         ? AttributeSet(~0u)
                         : AttributeSet(declared.others.heard.bits | ~attributes.bits),
                     declared.others.active & attributes};
  frames_.enqueue(
      PublishObjectClassMessage{static_cast<std::uint16_t>(object_class.value), attributes.bits});
}

void AmbassadorServices::unpublish_object_class(ObjectClassHandle object_class) {
  publish_object_class_attributes(object_class, {});
}

void AmbassadorServices::subscribe_object_class_attributes(ObjectClassHandle object_class,
                                                           AttributeSet attributes,
                                                           RegionHandle region, bool is_active) {
  require_class(object_class, attributes);
  const std::uint32_t number = region ? regions_.check(region) : RegionHandle::none;
  if (region) regions_.replace_subscription(object_class, attributes, region);
  frames_.enqueue(SubscribeObjectClassMessage{static_cast<std::uint16_t>(object_class.value),
                                              attributes.bits, number,
                                              static_cast<std::uint8_t>(!is_active)});
}

void AmbassadorServices::unsubscribe_object_class(ObjectClassHandle object_class,
                                                  RegionHandle region) {
  subscribe_object_class_attributes(object_class, {}, region);
}

void AmbassadorServices::publish_interaction_class(InteractionClassHandle interaction_class) {
  declare_publication(interaction_class, true);
}
void AmbassadorServices::unpublish_interaction_class(InteractionClassHandle interaction_class) {
  declare_publication(interaction_class, false);
}

void AmbassadorParts::declare_publication(InteractionClassHandle interaction_class,
                                          bool is_published) {
  require_class(interaction_class);
  if (fom_.is_management(interaction_class) && !fom_.is_for_rti(interaction_class))
    throw RtiException(HlaError::unauthorized,
                       "class " + fom_.at(interaction_class).name + " is the RTI's to publish");
  DeclaredState::Class& declared = declared_.interactions[interaction_class.value];
  if (!is_published) declared = {};
  declared.published = AttributeSet(is_published);
  frames_.enqueue(
      PublishInteractionClassMessage{static_cast<std::uint16_t>(interaction_class.value),
                                     static_cast<std::uint8_t>(is_published)});
}

void AmbassadorServices::subscribe_interaction_class(InteractionClassHandle interaction_class,
                                                     bool is_active) {
  declare_subscription(interaction_class, is_active ? Listening::active : Listening::passive);
}
void AmbassadorServices::unsubscribe_interaction_class(InteractionClassHandle interaction_class) {
  declare_subscription(interaction_class, Listening::none);
}

void AmbassadorParts::declare_subscription(InteractionClassHandle interaction_class,
                                           Listening listening) {
  require_class(interaction_class);
  frames_.enqueue(SubscribeInteractionClassMessage{
      static_cast<std::uint16_t>(interaction_class.value), static_cast<std::uint8_t>(listening)});
}

void AmbassadorParts::require_class(ObjectClassHandle object_class, AttributeSet attributes) const {
  if (object_class.value >= declared_.objects.size())
    throw RtiException(HlaError::object_class_not_defined,
                       "class " + std::to_string(object_class.value));
  if (!fom_.attributes(object_class).includes(attributes))
    throw RtiException(HlaError::attribute_not_defined, "of class " + fom_.at(object_class).name);
}

void AmbassadorParts::require_class(InteractionClassHandle interaction_class) const {
  if (interaction_class.value >= fom_.interaction_classes().size())
    throw RtiException(HlaError::interaction_class_not_defined,
                       "class " + std::to_string(interaction_class.value));
}

void AmbassadorParts::require_published(InteractionClassHandle interaction_class) const {
  phase_.require_joined();
  require_class(interaction_class);
  if (declared_.interactions[interaction_class.value].published.is_empty())
    throw RtiException(HlaError::interaction_class_not_published,
                       "class " + fom_.at(interaction_class).name);
}

void AmbassadorParts::switch_advisory(Advisory advisory, bool is_on) {
  phase_.require_joined();
  if (declared_.is_on(advisory) == is_on) {
    constexpr HlaError is_on_errors[] = {HlaError::object_class_relevance_advisory_switch_is_on,
                                         HlaError::attribute_relevance_advisory_switch_is_on,
                                         HlaError::attribute_scope_advisory_switch_is_on,
                                         HlaError::interaction_relevance_advisory_switch_is_on};
    const auto error = static_cast<unsigned>(is_on_errors[static_cast<std::size_t>(advisory)]) +
                       (is_on ? 0u : 1u);  // "is off" follows "is on"
    throw RtiException(static_cast<HlaError>(error), "it is so already");
  }
  declared_.switches ^= 1u << static_cast<unsigned>(advisory);
  if (advisory == Advisory::attribute_relevance) {
    declared_.relevant_objects = {};
    frames_.enqueue(AdvisorySwitchMessage{is_on});
  }
  if (advisory == Advisory::object_class_relevance)
    for (std::uint32_t i = 0; i < declared_.objects.size(); ++i) advise(ObjectClassHandle{i});
  if (advisory == Advisory::interaction_relevance)
    for (std::uint32_t i = 0; i < declared_.interactions.size(); ++i)
      advise(InteractionClassHandle{i});
}

namespace {

/// Whether the class became relevant (true), or ceased to be (false), since the federate was last
/// told; while its switch is off nothing counts as told.
std::optional<bool> turn_of(DeclaredState::Class& declared, bool is_on) {
  const bool is_relevant = is_on && !(declared.published & declared.others.active).is_empty();
  if (std::exchange(declared.is_relevant, is_relevant) == is_relevant || !is_on)
    return std::nullopt;
  return is_relevant;
}

}  // namespace

/// 5.10, 5.11.
void AmbassadorParts::advise(ObjectClassHandle object_class) {
  const auto is_relevant = turn_of(declared_.objects[object_class.value],
                                   declared_.is_on(Advisory::object_class_relevance));
  if (!is_relevant) return;
  if (*is_relevant) callbacks_.start_registration_for_object_class(object_class);
  else callbacks_.stop_registration_for_object_class(object_class);
}

/// 5.12, 5.13.
void AmbassadorParts::advise(InteractionClassHandle interaction_class) {
  const auto is_relevant = turn_of(declared_.interactions[interaction_class.value],
                                   declared_.is_on(Advisory::interaction_relevance));
  if (!is_relevant) return;
  if (*is_relevant) callbacks_.turn_interactions_on(interaction_class);
  else callbacks_.turn_interactions_off(interaction_class);
}

/// What crossed a withdrawal of ours on its way is of no concern any more.
bool AmbassadorParts::take_class_relevance(Reader& reader) {
  ClassRelevanceMessage message;
  if (!exchange(reader, message)) return false;
  auto& classes = message.is_interaction != 0 ? declared_.interactions : declared_.objects;
  if (message.number >= classes.size()) return false;
  DeclaredState::Class& declared = classes[message.number];
  if (declared.published.is_empty()) return true;
  declared.others = {AttributeSet(message.heard),
                     AttributeSet(message.active) & declared.published};
  if (message.is_interaction != 0) {
    advise(InteractionClassHandle{message.number});
    return true;
  }
  declared.others.heard.bits |=
      ~declared.published.bits;  // whoever says what it does not publish shall be told so
  release_spared(ObjectClassHandle{message.number}, AttributeSet(message.heard));
  advise(ObjectClassHandle{message.number});
  return true;
}

/// 6.21, 6.22.
bool AmbassadorParts::take_object_relevance(Reader& reader) {
  ObjectRelevanceMessage message;
  if (!exchange(reader, message)) return false;
  const ObjectHandle object{message.object};
  const KnownObject* known = objects_.find(object);
  if (known == nullptr) return objects_.is_gone(object);
  const AttributeSet now{message.attributes};
  if (!fom_.attributes(ObjectClassHandle{known->object_class}).includes(now)) return false;
  const AttributeSet* told = declared_.relevant_objects.find(object);
  const AttributeSet before = told != nullptr ? *told : AttributeSet();
  if (now.is_empty()) declared_.relevant_objects.erase(object);
  else declared_.relevant_objects[object] = now;
  if (!declared_.is_on(Advisory::attribute_relevance)) return true;
  if (!now.without(before).is_empty())
    callbacks_.turn_updates_on_for_object_instance(object, now.without(before));
  if (!before.without(now).is_empty())
    callbacks_.turn_updates_off_for_object_instance(object, before.without(now));
  return true;
}

/// Only what ends with its federate may be kept back, and only while it would hear at once that
/// somebody listens.
bool AmbassadorParts::may_spare() const { return declared_.is_deleting && gate_.is_open(); }

bool AmbassadorParts::spares_interaction(InteractionClassHandle interaction_class) {
  if (!declared_.interactions[interaction_class.value].others.heard.is_empty() || !may_spare())
    return false;
  ++counters_.interactions_spared;
  return true;
}

/// False if the update is to be sent: then what was kept back of it is out of date.
bool AmbassadorParts::spare(ObjectHandle object, const KnownObject& known, AttributeSet attributes,
                            Bytes values, const Stamp& stamp) {
  const ObjectClassHandle object_class{known.object_class};
  const DeclaredState::Class& declared = declared_.objects[object_class.value];
  if (!(attributes & declared.others.heard).is_empty() || !known.is_own || !may_spare()) {
    declared_.spared.forget(object, attributes);
    return false;
  }
  SparedValues::Spared& spared =
      declared_.spared.keep(object, object_class, attributes, values, stamp.time);
  declared_.newest = stamp;
  const AttributeSet outdated = (attributes & declared.sent).without(spared.announced);
  spared.announced = spared.announced | outdated;
  before_stream(object, object_class, attributes);
  if (!outdated.is_empty()) frames_.enqueue(SpareUpdateMessage{object.value, outdated.bits});
  ++counters_.updates_spared;
  return true;
}

/// Sends what was kept back of objects of a class, or of all, of which `heard` is a part; as the
/// newest state, with the newest stamp.
void AmbassadorParts::release_spared(ObjectClassHandle object_class, AttributeSet heard) {
  if (declared_.spared.is_empty()) return;
  for (const ObjectHandle object : declared_.spared.list(object_class, heard))
    release_spared(object);
}

void AmbassadorParts::release_spared(ObjectHandle object) {
  const SparedValues::Spared* spared = declared_.spared.find(object);
  if (spared == nullptr || !phase_.is_joined()) return;
  const SparedValues::Spared kept = *spared;
  declared_.spared.forget(object);
  const ObjectClass& object_class = fom_.at(kept.object_class);
  AttributeSet said;
  const auto say_all = [&] {
    if (!said.is_empty()) say_update(object, kept.object_class, said, coded_, declared_.newest);
    coded_.clear();
    said = {};
  };
  coded_.clear();
  for (std::uint32_t bits = kept.attributes.bits; bits != 0; bits &= bits - 1) {
    const auto index = static_cast<std::size_t>(std::countr_zero(bits));
    const AttributeSet one(1u << index);
    std::vector<std::byte> value = kept.values[index];
    if (is_coded(object_class, one))
      value.clear(), encode(object_class, one, kept.values[index], kept.times[index], value);
    if (coded_.size() + value.size() > values_max) say_all();
    coded_.insert(coded_.end(), value.begin(), value.end());
    said = said | one;
  }
  say_all();
}

}  // namespace rink::rti
