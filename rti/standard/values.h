// Attribute and parameter values, between the standard's maps and the bytes
// that Rink carries.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "rti/fom/fom.h"
#include "rti/standard/standard_headers.h"
#include "rti/standard/tags.h"
#include "rti/types.h"

namespace rink::standard {

/// Attributes of one object and their values one after the other, as the core takes them.
struct Update {
  rti::AttributeSet attributes;
  std::vector<std::byte> values;
};
/// Into `update`, whose memory it uses again. Throws AttributeNotDefined, and RTIinternalError for
/// a value that is not of the size that the model gives its data type.
void encode_update(const rti::Fom& fom, rti::ObjectClassHandle object_class,
                   const rti1516e::AttributeHandleValueMap& values, Update& update);
/// The values of `wanted` among those of `attributes`.
rti1516e::AttributeHandleValueMap decode_update(const rti::Fom& fom,
                                                rti::ObjectClassHandle object_class,
                                                rti::AttributeSet attributes, rti::Bytes values,
                                                rti::AttributeSet wanted);

/// Parameters and tag as an interaction carries them.
struct Message {
  std::vector<std::byte> parameters;
  rti::Stamp stamp;
};
/// If all parameters are there and the tag has at most 7 bytes, the parameters follow each other
/// like the attributes of an update, so that federates that use Rink's own API read them. Else
/// tag and parameters go with their handles and sizes. `time` is that of a message sent with one.
/// Throws InteractionParameterNotDefined, and RTIinternalError as `encode_update` does.
Message encode_message(const rti::Fom& fom, rti::InteractionClassHandle interaction_class,
                       const rti1516e::ParameterHandleValueMap& values,
                       rti1516e::VariableLengthData const& tag, std::optional<double> time);

/// What arrives of either.
struct ReceivedMessage {
  rti1516e::ParameterHandleValueMap values;
  rti1516e::VariableLengthData tag;
  bool has_time = false;  ///< the sender gave a time
};
/// Bytes that are in neither form, of a federate that uses Rink's own API otherwise, give no
/// values. Parameters that `known` does not have are left out.
ReceivedMessage decode_message(const rti::Fom& fom, rti::InteractionClassHandle sent,
                               rti::InteractionClassHandle known, rti::Bytes parameters,
                               const rti::Stamp& stamp);

}  // namespace rink::standard
