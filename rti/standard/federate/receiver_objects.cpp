// Callbacks of object and ownership management.
#include <memory>
#include <string>

#include "rti/standard/federate/receiver.h"
#include "rti/standard/handles.h"
#include "rti/standard/values.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

using User = rti1516e::FederateAmbassador;

rti1516e::TransportationType type_of(rti::Transportation transportation) {
  return transportation == rti::Transportation::reliable ? rti1516e::RELIABLE
                                                         : rti1516e::BEST_EFFORT;
}

rti1516e::OrderType received_order(const rti::TimedStamp& timed) {
  return timed.is_in_order ? rti1516e::TIMESTAMP : rti1516e::RECEIVE;
}

}  // namespace

/// An interaction as of the class that the federate knows it by.
struct Receiver::Reception {
  rti1516e::InteractionClassHandle interaction_class;
  ReceivedMessage message;
  rti1516e::TransportationType type;
};

/// Null if the federate has not discovered the object. The core discovers each once: what was not
/// wanted then is discovered here when something of it is.
const KnownObject* Receiver::knows(rti::ObjectHandle object) {
  const auto found = state_.objects.find(object);
  if (found != state_.objects.end()) return &found->second;
  try {
    discover_object_instance(object, state_.core->get_known_object_class_handle(object),
                             state_.core->get_object_instance_name(object));
  } catch (const rti::RtiException&) {
    return nullptr;  // it is gone
  }
  const auto late = state_.objects.find(object);
  return late == state_.objects.end() ? nullptr : &late->second;
}

void Receiver::take(WaitingUpdate& update, rti::Bytes values) {
  const KnownObject* const known = knows(update.object);
  if (known == nullptr) return;
  update.registered = known->registered;
  update.wanted = update.attributes & state_.declarations.subscribed(known->object_class);
  if (update.wanted.is_empty()) return;
  const std::vector<rti::Attribute>& all = fom().at(update.registered).attributes;
  update.wanted.for_each([&](rti::AttributeHandle each) {
    update.is_reliable =
        update.is_reliable || all[each.value].transportation == rti::Transportation::reliable;
  });
  update.times = state_.times;
  state_.deliveries.put(update, values, state_.model);
}

void deliver_update(User& user, const rti::Fom& fom, const WaitingUpdate& update,
                    rti::Bytes values) {
  const auto object = to_standard(update.object);
  const auto map = decode_update(fom, update.registered, update.attributes, values, update.wanted);
  const rti1516e::VariableLengthData tag = read_tag(update.timed.stamp).tag;
  const auto type = update.is_reliable ? rti1516e::RELIABLE : rti1516e::BEST_EFFORT;
  const rti1516e::SupplementalReflectInfo nothing_more;
  if (update.kind == WaitingUpdate::Kind::plain)
    return user.reflectAttributeValues(object, map, tag, rti1516e::RECEIVE, type, nothing_more);
  const auto time = update.times.time(update.timed.stamp.time);
  if (update.kind == WaitingUpdate::Kind::with_time)
    return user.reflectAttributeValues(object, map, tag, rti1516e::RECEIVE, type, *time,
                                       rti1516e::RECEIVE, nothing_more);
  user.reflectAttributeValues(object, map, tag, rti1516e::TIMESTAMP, type, *time,
                              received_order(update.timed), to_standard(update.timed.handle),
                              nothing_more);
}

bool Receiver::reads(rti::InteractionClassHandle sent, rti::Bytes parameters,
                     const rti::Stamp& stamp, Reception& reception) const {
  const rti::InteractionClassHandle known = state_.declarations.known_class(fom(), sent);
  if (!known) return false;
  reception.interaction_class = to_standard(known);
  reception.message = decode_message(fom(), sent, known, parameters, stamp);
  reception.type = type_of(fom().at(sent).transportation);
  return true;
}

void Receiver::discover_object_instance(rti::ObjectHandle object,
                                        rti::ObjectClassHandle object_class,
                                        std::string_view name) {
  const rti::ObjectClassHandle known = state_.declarations.known_class(fom(), object_class);
  if (!known) return;
  state_.objects[object] = {known, std::string(name), object_class};
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& of_class, const std::wstring& wide) {
        user.discoverObjectInstance(handle, of_class, wide);
      },
      to_standard(object), to_standard(known), to_wide(name));
}

void Receiver::reflect_attribute_values(rti::ObjectHandle object, rti::AttributeSet attributes,
                                        rti::Bytes values, const rti::Stamp& stamp) {
  WaitingUpdate update{.object = object, .attributes = attributes};
  update.timed.stamp = stamp;
  if (tag_gives_time(stamp)) update.kind = WaitingUpdate::Kind::with_time;
  take(update, values);
}

void Receiver::reflect_attribute_values_with_time(rti::ObjectHandle object,
                                                  rti::AttributeSet attributes, rti::Bytes values,
                                                  const rti::TimedStamp& timed) {
  WaitingUpdate update{.object = object, .attributes = attributes, .timed = timed};
  update.kind = WaitingUpdate::Kind::in_order;
  take(update, values);
}

void Receiver::receive_interaction(rti::InteractionClassHandle interaction_class,
                                   rti::Bytes parameters, rti::FederateHandle sender,
                                   const rti::Stamp& stamp) {
  Reception reception;
  if (!reads(interaction_class, parameters, stamp, reception)) return;
  const rti1516e::SupplementalReceiveInfo info(to_standard(sender));
  state_.deliveries.put(
      [times = state_.times, reception = std::move(reception), info,
       time = stamp.time](User& user) {
        const ReceivedMessage& message = reception.message;
        if (!message.has_time)
          user.receiveInteraction(reception.interaction_class, message.values, message.tag,
                                  rti1516e::RECEIVE, reception.type, info);
        else
          user.receiveInteraction(reception.interaction_class, message.values, message.tag,
                                  rti1516e::RECEIVE, reception.type, *times.time(time),
                                  rti1516e::RECEIVE, info);
      },
      {.size = parameters.size()});
}

void Receiver::receive_interaction_with_time(rti::InteractionClassHandle interaction_class,
                                             rti::Bytes parameters, rti::FederateHandle sender,
                                             const rti::TimedStamp& timed) {
  Reception reception;
  if (!reads(interaction_class, parameters, timed.stamp, reception)) return;
  const rti1516e::SupplementalReceiveInfo info(to_standard(sender));
  state_.deliveries.put(
      [times = state_.times, reception = std::move(reception), info, timed](User& user) {
        user.receiveInteraction(reception.interaction_class, reception.message.values,
                                reception.message.tag, rti1516e::TIMESTAMP, reception.type,
                                *times.time(timed.stamp.time), received_order(timed),
                                to_standard(timed.handle), info);
      },
      {.size = parameters.size(), .handle = timed.handle});
}

/// The core has removed the object: a retraction does not take the removal back.
template <class Call>
void Receiver::remove(rti::ObjectHandle object, Call call) {
  if (!state_.objects.contains(object)) return;
  state_.deliveries.put(
      [this, object, call](User& user) {
        const auto forget = [&](const void*) {
          const std::lock_guard lock(mutex_);
          state_.objects.erase(object);
        };
        // Also if the callback throws.
        const std::unique_ptr<const void, decltype(forget)> afterwards(this, forget);
        call(user);
      },
      {.object = object});
}

void Receiver::remove_object_instance(rti::ObjectHandle object) {
  remove(object, [object](User& user) {
    user.removeObjectInstance(to_standard(object), rti1516e::VariableLengthData(),
                              rti1516e::RECEIVE, rti1516e::SupplementalRemoveInfo());
  });
}

void Receiver::remove_object_instance_with_time(rti::ObjectHandle object,
                                                const rti::TimedStamp& timed) {
  remove(object, [times = state_.times, object, timed](User& user) {
    user.removeObjectInstance(to_standard(object), read_tag(timed.stamp).tag, rti1516e::TIMESTAMP,
                              *times.time(timed.stamp.time), received_order(timed),
                              to_standard(timed.handle), rti1516e::SupplementalRemoveInfo());
  });
}

void Receiver::attributes_in_scope(rti::ObjectHandle object) {
  const KnownObject* const known = knows(object);
  if (known == nullptr) return;
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set) { user.attributesInScope(handle, set); },
      to_standard(object), to_standard(state_.declarations.subscribed(known->object_class)));
}

void Receiver::attributes_out_of_scope(rti::ObjectHandle object) {
  const KnownObject* const known = knows(object);
  if (known == nullptr) return;
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set) {
        user.attributesOutOfScope(handle, set);
      },
      to_standard(object), to_standard(state_.declarations.subscribed(known->object_class)));
}

void Receiver::provide_attribute_value_update(rti::ObjectHandle object,
                                              rti::AttributeSet attributes, rti::Bytes tag) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set, const auto& data) {
        user.provideAttributeValueUpdate(handle, set, data);
      },
      to_standard(object), to_standard(attributes), data_of(tag));
}

void Receiver::confirm_attribute_transportation_type_change(rti::ObjectHandle object,
                                                            rti::AttributeSet attributes,
                                                            rti::Transportation transportation) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set, auto type) {
        user.confirmAttributeTransportationTypeChange(handle, set, type);
      },
      to_standard(object), to_standard(attributes), type_of(transportation));
}

void Receiver::report_attribute_transportation_type(rti::ObjectHandle object,
                                                    rti::AttributeHandle attribute,
                                                    rti::Transportation transportation) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& of_attribute, auto type) {
        user.reportAttributeTransportationType(handle, of_attribute, type);
      },
      to_standard(object), to_standard(attribute), type_of(transportation));
}

void Receiver::confirm_interaction_transportation_type_change(
    rti::InteractionClassHandle interaction_class, rti::Transportation transportation) {
  deliver([](User& user, const auto& handle,
             auto type) { user.confirmInteractionTransportationTypeChange(handle, type); },
          to_standard(interaction_class), type_of(transportation));
}

void Receiver::report_interaction_transportation_type(rti::FederateHandle federate,
                                                      rti::InteractionClassHandle interaction_class,
                                                      rti::Transportation transportation) {
  deliver([](User& user, const auto& of_federate, const auto& handle,
             auto type) { user.reportInteractionTransportationType(of_federate, handle, type); },
          to_standard(federate), to_standard(interaction_class), type_of(transportation));
}

void Receiver::request_attribute_ownership_assumption(rti::ObjectHandle object,
                                                      rti::AttributeSet attributes,
                                                      rti::Bytes tag) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set, const auto& data) {
        user.requestAttributeOwnershipAssumption(handle, set, data);
      },
      to_standard(object), to_standard(attributes), data_of(tag));
}

void Receiver::request_divestiture_confirmation(rti::ObjectHandle object,
                                                rti::AttributeSet attributes) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set) {
        user.requestDivestitureConfirmation(handle, set);
      },
      to_standard(object), to_standard(attributes));
}

void Receiver::attribute_ownership_acquisition_notification(rti::ObjectHandle object,
                                                            rti::AttributeSet attributes,
                                                            rti::Bytes tag) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set, const auto& data) {
        user.attributeOwnershipAcquisitionNotification(handle, set, data);
      },
      to_standard(object), to_standard(attributes), data_of(tag));
}

void Receiver::attribute_ownership_unavailable(rti::ObjectHandle object,
                                               rti::AttributeSet attributes) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set) {
        user.attributeOwnershipUnavailable(handle, set);
      },
      to_standard(object), to_standard(attributes));
}

void Receiver::request_attribute_ownership_release(rti::ObjectHandle object,
                                                   rti::AttributeSet attributes, rti::Bytes tag) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set, const auto& data) {
        user.requestAttributeOwnershipRelease(handle, set, data);
      },
      to_standard(object), to_standard(attributes), data_of(tag));
}

void Receiver::confirm_attribute_ownership_acquisition_cancellation(rti::ObjectHandle object,
                                                                    rti::AttributeSet attributes) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& set) {
        user.confirmAttributeOwnershipAcquisitionCancellation(handle, set);
      },
      to_standard(object), to_standard(attributes));
}

void Receiver::inform_attribute_ownership(rti::ObjectHandle object, rti::AttributeHandle attribute,
                                          rti::FederateHandle owner) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& of_attribute, const auto& federate) {
        user.informAttributeOwnership(handle, of_attribute, federate);
      },
      to_standard(object), to_standard(attribute), to_standard(owner));
}

void Receiver::attribute_is_not_owned(rti::ObjectHandle object, rti::AttributeHandle attribute) {
  deliver_of(
      object,
      [](User& user, const auto& handle, const auto& of_attribute) {
        user.attributeIsNotOwned(handle, of_attribute);
      },
      to_standard(object), to_standard(attribute));
}

void Receiver::attribute_ownership_divested(rti::ObjectHandle object,
                                            rti::AttributeSet attributes) {
  auto& waiting = state_.answers.divestiture;
  if (waiting && waiting->object == object) waiting->divested = waiting->divested | attributes;
}

void Receiver::attribute_ownership_kept(rti::ObjectHandle object, rti::AttributeSet attributes) {
  auto& waiting = state_.answers.divestiture;
  if (waiting && waiting->object == object) waiting->kept = waiting->kept | attributes;
}

}  // namespace rink::standard
