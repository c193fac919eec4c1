// Who answers for which kind of message that a federate may send.
#pragma once

#include <cstdint>

#include "rti/federation/outcome.h"
#include "rti/wire/message.h"

namespace rink::rti {

class FederationParts;

/// Takes the next message of a federate that has joined.
Outcome take_message(FederationParts& parts, std::uint32_t slot, Reader& reader);

}  // namespace rink::rti
