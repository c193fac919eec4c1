// A set of dimensions of one federation object model.
#pragma once

#include "rti/fom/handle_set.h"
#include "rti/handles.h"

namespace rink::rti {

using DimensionSet = HandleSet<DimensionHandle, std::uint64_t>;
/// Most dimensions that a model may have.
inline constexpr std::uint32_t dimension_max = DimensionSet::capacity;

}  // namespace rink::rti
