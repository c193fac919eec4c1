// The classes of the management object model (IEEE 1516.1-2010, clause 11), which every federation
// object model has after its own.
#pragma once

#include <vector>

#include "rti/fom/fom.h"

namespace rink::rti {

/// What the RTI truly knows, by the standard's names; docs/rti.md, "Management", says what each
/// value is. Hangs them on the roots, which are added where a model lacks them. They stand behind
/// all others, so that a model's own numbers stay what they are.
void append_management_classes(std::vector<ObjectClass>& object_classes,
                               std::vector<InteractionClass>& interaction_classes);

}  // namespace rink::rti
