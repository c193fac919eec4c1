// Which service answers for which kind of message that the RTI may send.
#pragma once

#include "rti/federate/ambassador_parts.h"

namespace rink::rti {

/// Hands a message whose kind was read to its service. False if it makes no sense, or not now.
bool handle_message(AmbassadorParts& parts, MessageKind kind, Reader& reader, ReadContext& context);

}  // namespace rink::rti
