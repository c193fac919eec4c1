// Object management at the federate's side beyond updates (IEEE 1516.1-2010, clause 6): names,
// local deletion, requests for updates, transportation.
#include "rti/federate/ambassador_services.h"
#include "rti/federate/services/require.h"
#include "rti/wire/object_messages.h"

namespace rink::rti {

namespace {

void require_tag(Bytes tag) {
  if (tag.size() > request_tag_max)
    throw RtiException(HlaError::rti_internal_error, "a request's tag has at most 1,024 bytes");
}

}  // namespace

void AmbassadorServices::local_delete_object_instance(ObjectHandle object) {
  const KnownObject& known = known_or_throw(object, {});
  if (!owned_of(object, known).is_empty())
    throw RtiException(HlaError::federate_owns_attributes,
                       name_of(object) + ": what is owned can't be forgotten");
  const Holding* holding = holdings_.find(object);
  if (holding != nullptr && !holding->pending().is_empty())
    throw RtiException(HlaError::ownership_acquisition_pending,
                       name_of(object) + ": cancel the acquisition first");
  arrivals_.leave(object);
  forget(object);
  objects_.leave(object);
  frames_.enqueue(LocalDeleteMessage{object.value});
}

void AmbassadorServices::request_attribute_value_update(ObjectClassHandle object_class,
                                                        AttributeSet attributes, Bytes tag) {
  require_class(object_class, attributes);
  require_tag(tag);
  frames_.enqueue(RequestUpdateMessage{1, object_class.value, attributes.bits, tag});
}

void AmbassadorServices::request_attribute_value_update(ObjectHandle object,
                                                        AttributeSet attributes, Bytes tag) {
  known_or_throw(object, attributes);
  require_tag(tag);
  frames_.enqueue(RequestUpdateMessage{0, object.value, attributes.bits, tag});
}

void AmbassadorServices::request_attribute_transportation_type_change(
    ObjectHandle object, AttributeSet attributes, Transportation transportation) {
  require_owned(object, attributes);
  if (transportation == Transportation::reliable) {  // at once, for that promises more
    release_best_effort(object, attributes);
    made_reliable_[object] = made_reliable_[object] | attributes;
  }
  frames_.enqueue(ChangeTransportationMessage{
      0, object.value, attributes.without(AttributeSet{privilege_to_delete_object}).bits,
      static_cast<std::uint8_t>(transportation)});
}

void AmbassadorServices::query_attribute_transportation_type(ObjectHandle object,
                                                             AttributeHandle attribute) {
  const KnownObject& known = known_or_throw(object, AttributeSet{attribute});
  require_class(ObjectClassHandle{known.object_class}, AttributeSet{attribute});
  frames_.enqueue(QueryTransportationMessage{0, object.value, attribute.value});
}

void AmbassadorServices::request_interaction_transportation_type_change(
    InteractionClassHandle interaction_class, Transportation transportation) {
  require_published(interaction_class);
  frames_.enqueue(ChangeTransportationMessage{1, interaction_class.value, 0,
                                              static_cast<std::uint8_t>(transportation)});
}

void AmbassadorServices::query_interaction_transportation_type(
    FederateHandle federate, InteractionClassHandle interaction_class) {
  require_class(interaction_class);
  frames_.enqueue(QueryTransportationMessage{1, interaction_class.value, federate.value});
}

bool AmbassadorParts::take_transportation(Reader& reader) {
  TransportationMessage message;
  if (!exchange(reader, message)) return false;
  const auto transportation = static_cast<Transportation>(message.transportation);
  if (message.is_interaction != 0) {
    if (message.number >= fom_.interaction_classes().size()) return false;
    const InteractionClassHandle interaction_class{message.number};
    if (message.is_confirmation != 0)
      callbacks_.confirm_interaction_transportation_type_change(interaction_class, transportation);
    else
      callbacks_.report_interaction_transportation_type({message.which}, interaction_class,
                                                        transportation);
    return true;
  }
  const ObjectHandle object{message.number};
  const KnownObject* known = objects_.find(object);
  if (known == nullptr) return objects_.is_gone(object);
  const AttributeSet all = fom_.attributes(ObjectClassHandle{known->object_class});
  if (message.is_confirmation != 0 ? !all.includes(AttributeSet(message.which))
                                   : !all.contains({message.which}))
    return false;
  AttributeSet* reliable = made_reliable_.find(object);
  if (message.is_confirmation != 0 && transportation == Transportation::best_effort &&
      reliable != nullptr)
    *reliable = reliable->without(AttributeSet(message.which));
  if (message.is_confirmation != 0)
    callbacks_.confirm_attribute_transportation_type_change(object, AttributeSet(message.which),
                                                            transportation);
  else callbacks_.report_attribute_transportation_type(object, {message.which}, transportation);
  return true;
}

}  // namespace rink::rti
