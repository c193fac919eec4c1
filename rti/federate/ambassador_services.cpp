// The services of the federate's side: each becomes a message at the end of `outgoing`.
#include "rti/federate/ambassador_services.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "rti/buffering/best_effort_outbox.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

void AmbassadorParts::require_parameters(Bytes parameters) {
  if (parameters.size() > parameters_max)
    throw RtiException(HlaError::rti_internal_error, "the parameters of an interaction have " +
                                                         std::to_string(parameters.size()) +
                                                         " bytes; allowed are at most " +
                                                         std::to_string(parameters_max));
}

void AmbassadorParts::require_stamp(const Stamp& stamp) {
  if (!std::isfinite(stamp.time))
    throw RtiException(HlaError::invalid_logical_time,
                       "a time stamp is a finite number of seconds");
}

AmbassadorParts::AmbassadorParts(const Fom& fom, FederateAmbassador& callbacks,
                                 const Patience& patience, CallbackModel model)
    : FomLookup(fom),
      gate_(callbacks, model),
      callbacks_(gate_.callbacks()),
      basis_{fom, callbacks_, phase_, frames_, counters_},
      watch_(patience),
      names_(basis_, objects_),
      synchronization_(basis_),
      questions_(basis_),
      session_(basis_, phase_),
      regions_(fom),
      declared_(fom),
      arrivals_(fom),
      update_receiver_(basis_, objects_, arrivals_),
      keyframe_reader_(basis_, objects_, arrivals_) {}

AmbassadorServices::AmbassadorServices(const Fom& fom, FederateAmbassador& callbacks,
                                       const Patience& patience, CallbackModel model)
    : AmbassadorParts(fom, callbacks, patience, model) {}

ObjectHandle AmbassadorServices::register_object_instance(ObjectClassHandle object_class,
                                                          std::string_view name) {
  phase_.require_joined();
  if (object_class.value >= declared_.objects.size())
    throw RtiException(HlaError::object_class_not_defined,
                       "class " + std::to_string(object_class.value));
  if (declared_.objects[object_class.value].published.is_empty())
    throw RtiException(HlaError::object_class_not_published, "class " + fom_.at(object_class).name);
  names_.require_free(name);
  if (!objects_.has_handle()) return {};
  const ObjectHandle object = objects_.add(object_class);
  names_.give_own(object, name);
  frames_.enqueue(
      RegisterObjectMessage{object.value, static_cast<std::uint16_t>(object_class.value), name});
  return object;
}

bool AmbassadorParts::take_further_block(Reader& reader) {
  FurtherBlockMessage message;
  return exchange(reader, message) && objects_.add_block(message.object_block);
}

void AmbassadorServices::delete_object_instance(ObjectHandle object) {
  const KnownObject& known = known_or_throw(object, {});
  if (!owned_of(object, known).contains(privilege_to_delete_object))
    throw RtiException(HlaError::delete_privilege_not_held,
                       "object " + std::to_string(object.value));
  forget(object);
  objects_.leave(object);
  frames_.enqueue(DeleteObjectMessage{object.value});
}

void AmbassadorParts::require_values(ObjectClassHandle object_class, AttributeSet attributes,
                                     Bytes values) const {
  if (!fom_.attributes(object_class).includes(attributes))
    throw RtiException(HlaError::attribute_not_defined,
                       "class " + fom_.at(object_class).name + " lacks an attribute of the update");
  if (values.size() > values_max)
    throw RtiException(HlaError::rti_internal_error,
                       "the values of an update have " + std::to_string(values.size()) +
                           " bytes; allowed are at most " + std::to_string(values_max));
  if (fom_.values_fit(object_class, attributes, values)) return;
  std::string names;
  attributes.for_each([&](AttributeHandle each) {
    names += (names.empty() ? "" : ", ") + fom_.at(object_class).attributes[each.value].name;
  });
  throw RtiException(HlaError::rti_internal_error, std::to_string(values.size()) +
                                                       " bytes are not the values of " +
                                                       fom_.at(object_class).name + "'s " + names);
}

void AmbassadorServices::update_attribute_values(ObjectHandle object, AttributeSet attributes,
                                                 Bytes values, const Stamp& stamp) {
  const KnownObject* known = objects_.find(object);
  if (!phase_.is_joined() || known == nullptr || !known->is_own) check_update(object, attributes);
  const ObjectClassHandle object_class{known->object_class};
  require_values(object_class, attributes, values);
  require_stamp(stamp);
  if (known->is_own && !declared_.objects[object_class.value].published.includes(attributes))
    throw RtiException(
        HlaError::attribute_not_owned,
        "object " + std::to_string(object.value) + ": an attribute of the update is not published");
  if (attributes.is_empty()) return;
  if (declared_.is_special(object_class, attributes) &&
      spare(object, *known, attributes, values, stamp))
    return;
  if (is_coded(fom_.at(object_class), attributes)) {
    coded_.clear();
    encode(fom_.at(object_class), attributes, values, stamp.time, coded_);
    values = coded_;
  }
  if (outbox_) attributes = say_best_effort(object, object_class, attributes, values, stamp);
  if (!attributes.is_empty()) say_update(object, object_class, attributes, values, stamp);
}

void AmbassadorParts::say_update(ObjectHandle object, ObjectClassHandle object_class,
                                 AttributeSet attributes, Bytes values, const Stamp& stamp) {
  if (outbox_) before_stream(object, object_class, attributes);
  if (frames_.enqueue_update({object_class, attributes, stamp}, object, values))
    declared_.note_sent(object_class, attributes, stamp);
  ++counters_.updates_sent;
}

void AmbassadorServices::send_interaction(InteractionClassHandle interaction_class,
                                          Bytes parameters, const Stamp& stamp) {
  send_directed_interaction(interaction_class, {}, parameters, stamp);
}

void AmbassadorServices::send_directed_interaction(InteractionClassHandle interaction_class,
                                                   FederateHandle receiver, Bytes parameters,
                                                   const Stamp& stamp) {
  require_published(interaction_class);
  require_parameters(parameters);
  require_stamp(stamp);
  if (spares_interaction(interaction_class)) return;
  frames_.enqueue(InteractionMessage{static_cast<std::uint16_t>(interaction_class.value),
                                     receiver.value, stamp, parameters});
  ++counters_.interactions_sent;
}

void AmbassadorServices::clear_outgoing() {
  if (!frames_.is_empty()) watch_.sent();
  counters_.bytes_sent += frames_.bytes().size();
  counters_.frames_sent = frames_.frame_count();
  frames_.clear();
}

void AmbassadorServices::advance_clock(double now) {
  watch_.advance(now, !frames_.is_empty());
  if (outbox_ && phase_.is_joined()) repair_best_effort();
  if (!postponed_.empty()) release_postponed();
  if (!phase_.may_send()) return;
  if (receipts_.is_due() && now - receipts_due_since_ >= DatagramReceipts::longest_delay_s)
    acknowledge_datagrams();
  if (watch_.is_rti_lost()) return lose("the RTI has been silent for too long");
  if (phase_.is_joined() && watch_.is_heartbeat_due()) {
    frames_.enqueue(HeartbeatMessage{});
    watch_.beat();
  }
}

/// What is kept of an object beside its entry in the book.
void AmbassadorParts::forget(ObjectHandle object) {
  holdings_.erase(object);
  regions_.forget(object);
  declared_.spared.forget(object);
  names_.forget(object);
  made_reliable_.erase(object);
  if (outbox_) outbox_->forget(object, AttributeSet(~0u));
}

std::size_t AmbassadorServices::memory_bytes() const {
  return gate_.memory_bytes() + postponed_.capacity() + content_.capacity() +
         holdings_.memory_bytes() + objects_.memory_bytes() + names_.memory_bytes() +
         regions_.memory_bytes() + region_records_.capacity() + frames_.memory_bytes() +
         incoming_.memory_bytes() + keyframe_reader_.memory_bytes() +
         update_receiver_.memory_bytes() + arrivals_.memory_bytes() + declared_.memory_bytes() +
         (outbox_ ? outbox_->memory_bytes() : 0);
}

ObjectClassHandle AmbassadorServices::get_known_object_class_handle(ObjectHandle object) const {
  const KnownObject* known = objects_.find(object);
  if (known == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "object " + std::to_string(object.value));
  return {known->object_class};
}

}  // namespace rink::rti
