// How a service ends the membership of a federate.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "rti/federate_ambassador.h"
#include "rti/violation.h"

namespace rink::rti {

/// At once, in the midst of whatever is going on: who is expelled is asked and told nothing more.
using Expulsion = std::function<void(std::uint32_t slot, Violation violation, ResignReason reason,
                                     std::string_view why)>;

}  // namespace rink::rti
