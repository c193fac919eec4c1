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

void AmbassadorParts::require_name(std::string_view name) {
  if (name.empty() || name.size() > text_max || name.starts_with(NameBook::own_prefix))
    throw RtiException(HlaError::illegal_name,
                       "'" + std::string(name) +
                           "': an object's name has 1 to 255 bytes and does not begin with HLA");
}

void AmbassadorParts::ask_names(std::uint8_t word, std::span<const std::string_view> names) {
  phase_.require_joined();
  if (names.empty())
    throw RtiException(HlaError::name_set_was_empty, "a set of names has one at least");
  std::vector<std::byte> texts;
  Writer writer(texts);
  for (std::string_view name : names) {
    require_name(name);
    writer.text(name, text_max);
  }
  if (texts.size() > names_size_max)
    throw RtiException(HlaError::rti_internal_error, "a set of names takes at most 32,768 bytes");
  frames_.enqueue(InstanceNamesMessage{word, texts});
}

void AmbassadorServices::reserve_object_instance_name(std::string_view name) {
  ask_names(static_cast<std::uint8_t>(NameRequest::reserve), std::span(&name, 1));
  names_.reserve(name);
}

void AmbassadorServices::reserve_multiple_object_instance_names(
    std::span<const std::string_view> names) {
  ask_names(static_cast<std::uint8_t>(NameRequest::reserve_set), names);
  for (const std::string_view name : names) names_.reserve(name);
}

void AmbassadorServices::release_multiple_object_instance_names(
    std::span<const std::string_view> names) {
  for (const std::string_view name : names)
    if (!names_.is_reserved(name))
      throw RtiException(HlaError::object_instance_name_not_reserved,
                         "'" + std::string(name) + "'");
  ask_names(static_cast<std::uint8_t>(NameRequest::release), names);
  for (const std::string_view name : names) names_.end_reservation(name);
}

bool AmbassadorParts::take_names(Reader& reader) {
  InstanceNamesAnswerMessage message;
  std::vector<std::string> names;
  if (!exchange(reader, message) ||
      !for_each_name(message.names, [&](std::string_view name) { names.emplace_back(name); }))
    return false;
  const auto answer = static_cast<NameAnswer>(message.word);
  const bool is_set = answer == NameAnswer::set_granted || answer == NameAnswer::set_refused;
  if (!is_set && names.size() != 1) return false;
  if (answer == NameAnswer::registration_refused) {
    if (const auto object = names_.find(names[0]);
        object && (is_ours(*object) || was_ours(*object)))
      names_.forget(*object);
  }
  const bool is_granted = answer == NameAnswer::granted || answer == NameAnswer::set_granted;
  for (const std::string& name : names) {
    if (is_granted) names_.granted(name);
    else if (!names_.is_reserved(name))
      names_.end_reservation(name);  // not one that was granted before
  }
  if (is_set && is_granted) callbacks_.multiple_object_instance_name_reservation_succeeded(names);
  else if (is_set) callbacks_.multiple_object_instance_name_reservation_failed(names);
  else if (is_granted) callbacks_.object_instance_name_reservation_succeeded(names[0]);
  else callbacks_.object_instance_name_reservation_failed(names[0]);
  return true;
}

ObjectHandle AmbassadorServices::get_object_instance_handle(std::string_view name) const {
  const std::optional<ObjectHandle> object = names_.find(name);
  if (!object || const_cast<AmbassadorServices*>(this)->find(*object) == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "no object is called '" + std::string(name) + "'");
  return *object;
}

std::string AmbassadorServices::get_object_instance_name(ObjectHandle object) const {
  if (const_cast<AmbassadorServices*>(this)->find(object) == nullptr)
    throw RtiException(HlaError::object_instance_not_known, name_of(object));
  return names_.name_of(object);
}

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
  if (!is_ours(object) && !was_ours(object)) gone_.push_back({object});
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
  const KnownObject* known = find(object);
  if (known == nullptr) return is_gone(object);
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
