// A federate's declarations, and the RTI's advice about those of others.
#include "rti/federate/services/federate_declarations.h"

#include <optional>

#include "rti/federate/services/require_declared.h"
#include "rti/wire/declaration_messages.h"

namespace rink::rti {

namespace {

unsigned switches_of(const FomSwitches& model) {
  const auto bit = [](Advisory advisory, bool is_on) {
    return (is_on ? 1u : 0u) << static_cast<unsigned>(advisory);
  };
  return bit(Advisory::object_class_relevance, model.object_class_relevance_advisory) |
         bit(Advisory::attribute_relevance, model.attribute_relevance_advisory) |
         bit(Advisory::attribute_scope, model.attribute_scope_advisory) |
         bit(Advisory::interaction_relevance, model.interaction_relevance_advisory);
}

HlaError already(Advisory advisory, bool is_on) {
  constexpr HlaError is_on_errors[] = {HlaError::object_class_relevance_advisory_switch_is_on,
                                       HlaError::attribute_relevance_advisory_switch_is_on,
                                       HlaError::attribute_scope_advisory_switch_is_on,
                                       HlaError::interaction_relevance_advisory_switch_is_on};
  return static_cast<HlaError>(
      static_cast<unsigned>(is_on_errors[static_cast<std::size_t>(advisory)]) +
      (is_on ? 0u : 1u));  // "is off" follows "is on"
}

}  // namespace

FederateDeclarations::FederateDeclarations(const AmbassadorBasis& basis, const Uses& uses)
    : basis_(basis), uses_(uses), switches_(switches_of(basis.fom.switches())) {}

void FederateDeclarations::publish(ObjectClassHandle object_class, AttributeSet attributes) {
  require_class(basis_.fom, object_class, attributes);
  if (basis_.fom.is_management(object_class))
    throw RtiException(HlaError::unauthorized,
                       "class " + basis_.fom.at(object_class).name + " is the RTI's to publish");
  const AttributeSet withdrawn = uses_.classes.published(object_class).without(attributes);
  if (!withdrawn.is_empty()) {
    uses_.sparing.release(object_class, AttributeSet::all());
    uses_.sender.release(object_class);
  }
  uses_.ownership.withdraw(object_class, withdrawn, attributes.is_empty());
  uses_.classes.publish(object_class, attributes);
  basis_.frames.enqueue(
      PublishObjectClassMessage{static_cast<std::uint16_t>(object_class.value), attributes.bits});
}

void FederateDeclarations::publish(InteractionClassHandle interaction_class, bool is_published) {
  require_class(basis_.fom, interaction_class);
  if (basis_.fom.is_management(interaction_class) && !basis_.fom.is_for_rti(interaction_class))
    throw RtiException(HlaError::unauthorized, "class " + basis_.fom.at(interaction_class).name +
                                                   " is the RTI's to publish");
  uses_.classes.publish(interaction_class, is_published);
  basis_.frames.enqueue(
      PublishInteractionClassMessage{static_cast<std::uint16_t>(interaction_class.value),
                                     static_cast<std::uint8_t>(is_published)});
}

void FederateDeclarations::subscribe(ObjectClassHandle object_class, AttributeSet attributes,
                                     RegionHandle region, bool is_active) {
  require_class(basis_.fom, object_class, attributes);
  const std::uint32_t number = region ? uses_.regions.check(region) : RegionHandle::none;
  if (region) uses_.regions.replace_subscription(object_class, attributes, region);
  basis_.frames.enqueue(SubscribeObjectClassMessage{static_cast<std::uint16_t>(object_class.value),
                                                    attributes.bits, number,
                                                    static_cast<std::uint8_t>(!is_active)});
}

void FederateDeclarations::subscribe(InteractionClassHandle interaction_class,
                                     Listening listening) {
  require_class(basis_.fom, interaction_class);
  basis_.frames.enqueue(SubscribeInteractionClassMessage{
      static_cast<std::uint16_t>(interaction_class.value), static_cast<std::uint8_t>(listening)});
}

void FederateDeclarations::switch_advisory(Advisory advisory, bool is_on) {
  basis_.phase.require_joined();
  if (this->is_on(advisory) == is_on)
    throw RtiException(already(advisory, is_on), "the switch has that value already");
  switches_ ^= 1u << static_cast<unsigned>(advisory);
  if (advisory == Advisory::attribute_relevance) {
    relevant_objects_ = {};
    basis_.frames.enqueue(AdvisorySwitchMessage{is_on});
  }
  advise_all(advisory);
}

void FederateDeclarations::joined() {
  if (is_on(Advisory::attribute_relevance)) basis_.frames.enqueue(AdvisorySwitchMessage{true});
}

void FederateDeclarations::advise_all(Advisory advisory) {
  if (advisory == Advisory::object_class_relevance)
    for (std::uint32_t i = 0; i < uses_.classes.object_class_count(); ++i)
      advise(ObjectClassHandle{i});
  if (advisory == Advisory::interaction_relevance)
    for (std::uint32_t i = 0; i < uses_.classes.interaction_class_count(); ++i)
      advise(InteractionClassHandle{i});
}

/// Starts or stops registration (5.10, 5.11).
void FederateDeclarations::advise(ObjectClassHandle object_class) {
  const std::optional<bool> is_relevant =
      uses_.classes.turn(object_class, is_on(Advisory::object_class_relevance));
  if (!is_relevant) return;
  if (*is_relevant) basis_.callbacks.start_registration_for_object_class(object_class);
  else basis_.callbacks.stop_registration_for_object_class(object_class);
}

/// Turns interactions on or off (5.12, 5.13).
void FederateDeclarations::advise(InteractionClassHandle interaction_class) {
  const std::optional<bool> is_relevant =
      uses_.classes.turn(interaction_class, is_on(Advisory::interaction_relevance));
  if (!is_relevant) return;
  if (*is_relevant) basis_.callbacks.turn_interactions_on(interaction_class);
  else basis_.callbacks.turn_interactions_off(interaction_class);
}

/// Advice that crossed the own withdrawal on its way is ignored.
bool FederateDeclarations::handle_class_relevance(Reader& reader) {
  ClassRelevanceMessage message;
  if (!exchange(reader, message)) return false;
  const Subscription others{AttributeSet(message.subscribed), AttributeSet(message.active)};
  if (message.is_interaction != 0) {
    const InteractionClassHandle interaction_class{message.number};
    if (message.number >= uses_.classes.interaction_class_count()) return false;
    if (!uses_.classes.is_published(interaction_class)) return true;
    uses_.classes.set_others(interaction_class, others);
    advise(interaction_class);
    return true;
  }
  const ObjectClassHandle object_class{message.number};
  if (message.number >= uses_.classes.object_class_count()) return false;
  if (uses_.classes.published(object_class).is_empty()) return true;
  uses_.classes.set_others(object_class, others);
  uses_.sparing.release(object_class, others.subscribed);
  advise(object_class);
  return true;
}

/// Turns updates on or off (6.21, 6.22).
bool FederateDeclarations::handle_object_relevance(Reader& reader) {
  ObjectRelevanceMessage message;
  if (!exchange(reader, message)) return false;
  const ObjectHandle object{message.object};
  const KnownObject* known = uses_.objects.find(object);
  if (known == nullptr) return uses_.objects.is_gone(object);
  const AttributeSet now{message.attributes};
  if (!basis_.fom.attributes(ObjectClassHandle{known->object_class}).includes(now)) return false;
  const AttributeSet* advised = relevant_objects_.find(object);
  const AttributeSet before = advised != nullptr ? *advised : AttributeSet();
  if (now.is_empty()) relevant_objects_.erase(object);
  else relevant_objects_[object] = now;
  if (!is_on(Advisory::attribute_relevance)) return true;
  if (!now.without(before).is_empty())
    basis_.callbacks.turn_updates_on_for_object_instance(object, now.without(before));
  if (!before.without(now).is_empty())
    basis_.callbacks.turn_updates_off_for_object_instance(object, before.without(now));
  return true;
}

}  // namespace rink::rti
