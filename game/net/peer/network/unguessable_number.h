// Numbers that nobody can guess, for tokens of newcomers and for sessions.
#pragma once

#include <cstdint>
#include <random>

namespace rink::game {

/// 64 bits from the system.
inline std::uint64_t unguessable_number() {
  std::random_device device;
  const std::uint64_t upper = device();
  return upper << 32 | device();
}

}  // namespace rink::game
