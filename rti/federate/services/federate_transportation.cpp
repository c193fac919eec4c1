// Requests about transportation types, and their answers.
#include "rti/federate/services/federate_transportation.h"

#include "rti/federate/services/require_declared.h"
#include "rti/wire/object_messages.h"

namespace rink::rti {

void FederateTransportation::change(ObjectHandle object, AttributeSet attributes,
                                    Transportation transportation) {
  uses_.ownership.require_owned(object, attributes);
  if (transportation == Transportation::reliable)
    uses_.sender.make_reliable(object, attributes);  // at once, for that promises more
  basis_.frames.enqueue(ChangeTransportationMessage{
      0, object.value, attributes.without(AttributeSet{privilege_to_delete_object}).bits,
      static_cast<std::uint8_t>(transportation)});
}

void FederateTransportation::query(ObjectHandle object, AttributeHandle attribute) {
  const KnownObject& known = uses_.ownership.require_known(object, AttributeSet{attribute});
  require_class(basis_.fom, ObjectClassHandle{known.object_class}, AttributeSet{attribute});
  basis_.frames.enqueue(QueryTransportationMessage{0, object.value, attribute.value});
}

void FederateTransportation::change(InteractionClassHandle interaction_class,
                                    Transportation transportation) {
  require_published(basis_, uses_.classes, interaction_class);
  basis_.frames.enqueue(ChangeTransportationMessage{1, interaction_class.value, 0,
                                                    static_cast<std::uint8_t>(transportation)});
}

void FederateTransportation::query(FederateHandle federate,
                                   InteractionClassHandle interaction_class) {
  require_class(basis_.fom, interaction_class);
  basis_.frames.enqueue(QueryTransportationMessage{1, interaction_class.value, federate.value});
}

bool FederateTransportation::handle_answer(Reader& reader) {
  TransportationMessage message;
  if (!exchange(reader, message)) return false;
  const auto transportation = static_cast<Transportation>(message.transportation);
  const bool is_confirmation = message.is_confirmation != 0;
  const auto handle = static_cast<std::uint32_t>(message.which);  // in an answer
  if (!is_confirmation && handle != message.which) return false;
  if (message.is_interaction != 0) {
    if (message.number >= basis_.fom.interaction_classes().size()) return false;
    const InteractionClassHandle interaction_class{message.number};
    if (is_confirmation)
      basis_.callbacks.confirm_interaction_transportation_type_change(interaction_class,
                                                                      transportation);
    else
      basis_.callbacks.report_interaction_transportation_type({handle}, interaction_class,
                                                              transportation);
    return true;
  }
  const ObjectHandle object{message.number};
  const KnownObject* known = uses_.objects.find(object);
  if (known == nullptr) return uses_.objects.is_gone(object);
  const AttributeSet all = basis_.fom.attributes(ObjectClassHandle{known->object_class});
  const AttributeSet confirmed(message.which);
  if (is_confirmation ? !all.includes(confirmed) : !all.contains({handle})) return false;
  if (is_confirmation && transportation == Transportation::best_effort)
    uses_.sender.make_best_effort(object, confirmed);
  if (is_confirmation)
    basis_.callbacks.confirm_attribute_transportation_type_change(object, confirmed,
                                                                  transportation);
  else basis_.callbacks.report_attribute_transportation_type(object, {handle}, transportation);
  return true;
}

}  // namespace rink::rti
