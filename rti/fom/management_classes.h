// The classes of the management object model (IEEE 1516.1-2010, clause 11), which every federation
// object model has after its own.
#pragma once

#include <vector>

#include "rti/fom/fom.h"

namespace rink::rti {

/// Only attributes that the RTI has values for, by the standard's names; docs/rti.md, "Management",
/// describes each value. Adds them below the roots, which are added where a model lacks them. They
/// follow all other classes, so that the numbers of a model's own classes stay.
void append_management_classes(std::vector<ObjectClass>& object_classes,
                               std::vector<InteractionClass>& interaction_classes);

}  // namespace rink::rti
