// What becomes of a message that a federate has sent.
#pragma once

#include <optional>

#include "rti/violation.h"

namespace rink::rti {

/// The rule that its sender broke, which costs it the connection; nothing: all is well.
using Status = std::optional<Violation>;

}  // namespace rink::rti
