// Checks, encodes and sends updates and interactions.
#include "rti/federate/services/federate_updates.h"

#include <cmath>
#include <string>

#include "rti/federate/books/require.h"
#include "rti/federate/services/require_declared.h"
#include "rti/fom/coded_values.h"

namespace rink::rti {

namespace {

void require_stamp(const Stamp& stamp) {
  if (!std::isfinite(stamp.time))
    throw RtiException(HlaError::invalid_logical_time,
                       "a time stamp is a finite number of seconds");
}

}  // namespace

void FederateUpdates::require_parameters(Bytes parameters) {
  if (parameters.size() > parameters_max)
    throw RtiException(HlaError::rti_internal_error, "the parameters of an interaction have " +
                                                         std::to_string(parameters.size()) +
                                                         " bytes; allowed are at most " +
                                                         std::to_string(parameters_max));
}

void FederateUpdates::require_values(ObjectClassHandle object_class, AttributeSet attributes,
                                     Bytes values) const {
  const Fom& fom = basis_.fom;
  if (!fom.attributes(object_class).includes(attributes))
    throw RtiException(HlaError::attribute_not_defined,
                       "class " + fom.at(object_class).name + " lacks an attribute of the update");
  if (values.size() > values_max)
    throw RtiException(HlaError::rti_internal_error,
                       "the values of an update have " + std::to_string(values.size()) +
                           " bytes; allowed are at most " + std::to_string(values_max));
  if (fom.values_fit(object_class, attributes, values)) return;
  std::string names;
  attributes.for_each([&](AttributeHandle each) {
    names += (names.empty() ? "" : ", ") + fom.at(object_class).attributes[each.value].name;
  });
  throw RtiException(HlaError::rti_internal_error, std::to_string(values.size()) +
                                                       " bytes are not the values of " +
                                                       fom.at(object_class).name + "'s " + names);
}

/// An object that is owned whole, as most are, needs no look at the holdings.
const KnownObject& FederateUpdates::require_updatable(ObjectHandle object,
                                                      AttributeSet attributes) const {
  const KnownObject* known = uses_.objects.find(object);
  if (known != nullptr && known->is_own && basis_.phase.is_joined()) return *known;
  const KnownObject& partly = uses_.ownership.require_known(object, attributes);
  require(uses_.ownership.owned_of(object, partly).includes(attributes),
          HlaError::attribute_not_owned, object, "an attribute that is updated must be owned");
  return partly;
}

void FederateUpdates::update(ObjectHandle object, AttributeSet attributes, Bytes values,
                             const Stamp& stamp) {
  const KnownObject& known = require_updatable(object, attributes);
  const ObjectClassHandle object_class{known.object_class};
  require_values(object_class, attributes, values);
  require_stamp(stamp);
  if (known.is_own && !uses_.classes.published(object_class).includes(attributes))
    throw RtiException(HlaError::attribute_not_owned,
                       name_of(object) + ": an attribute of the update is not published");
  if (attributes.is_empty()) return;
  const UpdateHeader header{object_class, attributes, stamp};
  if (uses_.sparing.concerns(object_class, attributes) &&
      uses_.sparing.spares(header, object, known.is_own, values))
    return;
  if (is_coded(basis_.fom.at(object_class), attributes)) {
    coded_.clear();
    encode(basis_.fom.at(object_class), attributes, values, stamp.time, coded_);
    values = coded_;
  }
  uses_.sender.send(header, object, values);
}

bool FederateUpdates::may_send(InteractionClassHandle interaction_class, Bytes parameters,
                               const Stamp& stamp) {
  require_published(basis_, uses_.classes, interaction_class);
  require_parameters(parameters);
  require_stamp(stamp);
  return !uses_.sparing.spares(interaction_class);
}

void FederateUpdates::send(InteractionClassHandle interaction_class, FederateHandle receiver,
                           Bytes parameters, const Stamp& stamp) {
  if (!may_send(interaction_class, parameters, stamp)) return;
  basis_.frames.enqueue(InteractionMessage{static_cast<std::uint16_t>(interaction_class.value),
                                           receiver.value, stamp, parameters});
  ++basis_.counters.interactions_sent;
}

}  // namespace rink::rti
