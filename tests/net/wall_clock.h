// The time of tests that run in real time.
#pragma once

#include <chrono>

namespace rink::game {

/// [s] since some instant.
inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace rink::game
