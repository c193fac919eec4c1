// How a service ends the membership of a federate.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "rti/federate_ambassador.h"
#include "rti/violation.h"

namespace rink::rti {

/// Takes effect at once, also in the middle of another action: an expelled federate receives
/// nothing more.
using Expulsion = std::function<void(std::uint32_t slot, Violation violation, ResignReason reason,
                                     std::string_view why)>;

}  // namespace rink::rti
