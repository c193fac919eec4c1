// How the tests of simulators that step advance them.
#pragma once

#include "game/physics/simulator.h"

namespace rink::physics::test {

/// Advances whatever goals fall.
inline void play(Simulator& simulator, double until) {
  while (simulator.advance(until)) {
  }
}

}  // namespace rink::physics::test
