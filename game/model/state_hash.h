// A hash of states, bit for bit, that is the same on every machine.
#pragma once

#include <bit>
#include <cstdint>

#include "game/physics/body.h"

namespace rink::game {

/// FNV-1a (Fowler, Noll and Vo) over the bytes of 64-bit words, lowest first.
class StateHash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) hash_ = (hash_ ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3u;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const physics::Vector2& vector) { add(vector.x()), add(vector.y()); }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace rink::game
