// A hash of states, bit for bit, that is the same on every machine.
#pragma once

#include <cstdint>

#include "game/physics/body.h"
#include "im/basics/fnv_hash.h"

namespace rink::game {

/// Over the bytes of 64-bit words, lowest first.
class StateHash {
 public:
  void add(std::uint64_t word) { hash_.add_word(word); }
  void add(double number) { hash_.add_number(number); }
  void add(const physics::Vector2& vector) { add(vector.x()), add(vector.y()); }
  std::uint64_t value() const { return hash_.value(); }

 private:
  Fnv64 hash_;
};

}  // namespace rink::game
