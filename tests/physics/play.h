// How the tests of simulators that step advance them, and by which integrators.
#pragma once

#include <array>

#include "game/physics/simulator_choice.h"

namespace rink::physics::test {

/// Of the engines that step.
inline constexpr std::array<const char*, 4> integrators{"euler", "semi_implicit", "verlet", "rk4"};

/// Advances whatever goals fall.
inline void play(Simulator& simulator, double until) {
  while (simulator.advance(until)) {
  }
}

}  // namespace rink::physics::test
