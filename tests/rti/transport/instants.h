// Instants and waits on modelled networks.
#pragma once

#include <chrono>
#include <cstdint>

namespace rink::rti::testing {

inline constexpr std::int64_t ms = 1'000'000, second = 1000 * ms;  ///< [ns]
inline constexpr std::chrono::nanoseconds no_wait{0};

}  // namespace rink::rti::testing
