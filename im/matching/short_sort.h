// Sorts the few numbers that one subscriber's changes are.
#pragma once

#include <cstdint>
#include <span>

#include "im/matching/buffer.h"

namespace rink::im {

/// Ascending, all different. `spare` is memory to work with.
void sort_short(std::span<std::uint32_t> numbers, Buffer<std::uint32_t>& spare);

}  // namespace rink::im
