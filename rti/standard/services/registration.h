// What registering objects and sending interactions have in common with and without regions.
#pragma once

#include <optional>
#include <string>

#include "rti/standard/errors.h"
#include "rti/standard/federate/federate_state.h"
#include "rti/standard/handles.h"
#include "rti/standard/values.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

/// Throws ObjectInstanceNameNotReserved unless this federate has been told that it has the name.
inline std::string reserved_name(const FederateState& state, const std::wstring& wide) {
  std::string name = to_utf8(wide);
  if (!state.reserved_names.contains(name))
    throw rti1516e::ObjectInstanceNameNotReserved(L"reserve '" + wide + L"' first");
  return name;
}

/// Notes an object that was registered. Throws RTIinternalError if there was no handle for it.
inline rti1516e::ObjectInstanceHandle registered(const rti::Ambassador& core, FederateState& state,
                                                 rti::ObjectClassHandle object_class,
                                                 rti::ObjectHandle object) {
  if (!object)
    throw rti1516e::RTIinternalError(
        L"the RTI has not given further object handles yet; register the object later");
  state.objects[object] = {object_class, core.get_object_instance_name(object), object_class};
  return to_standard(object);
}

/// Throws InteractionClassNotDefined too.
inline Message message_of(const rti::Ambassador& core,
                          rti::InteractionClassHandle interaction_class,
                          const rti1516e::ParameterHandleValueMap& values,
                          rti1516e::VariableLengthData const& tag, std::optional<double> time) {
  core.get_interaction_class_name(interaction_class);
  return encode_message(core.fom(), interaction_class, values, tag, time);
}

}  // namespace rink::standard
