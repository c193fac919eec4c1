// A hash of states, bit for bit, that is the same on every machine.
#pragma once

#include <bit>
#include <cstdint>

#include "game/model/byte_hash.h"
#include "game/physics/body.h"

namespace rink::game {

/// Over the bytes of 64-bit words, lowest first.
class StateHash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) hash_.add(static_cast<unsigned char>(word >> (8 * byte)));
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const physics::Vector2& vector) { add(vector.x()), add(vector.y()); }
  std::uint64_t value() const { return hash_.value(); }

 private:
  ByteHash hash_;
};

}  // namespace rink::game
