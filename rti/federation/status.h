// The result of handling a federate's message.
#pragma once

#include <optional>

#include "rti/violation.h"

namespace rink::rti {

/// The rule that the sender broke, which costs it the connection; nothing if the message is valid.
using Status = std::optional<Violation>;

}  // namespace rink::rti
