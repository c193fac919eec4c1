// The greatest values that flags and experiments may have.
#pragma once

#include <cstdint>

namespace rink::game {

inline constexpr double seconds_max =
    86'400.0;  ///< longest run, warm-up or patience [s]: plans and key logs are held in memory
inline constexpr std::uint32_t bats_max = 100'000, pucks_max = 1'000'000;
inline constexpr std::uint32_t sweep_ticks_max = 1'000;
inline constexpr double cell_size_min =
    1e-3;  ///< of a filter's grid [m]; smaller ones do not fit into memory
inline constexpr double view_area_max = 1e12, view_margin_max = 1e6;  ///< m^2, m

}  // namespace rink::game
