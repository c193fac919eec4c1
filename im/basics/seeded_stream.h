// Random numbers whose bits are the same on every machine: distributions of the standard library
// differ between libraries.
#pragma once

#include <cassert>
#include <cstdint>

namespace rink {

/// SplitMix64 (Steele, Lea and Flood 2014): passes BigCrush, and any state is a good one.
class SeededStream {
 public:
  explicit SeededStream(std::uint64_t state = 0) : state_(state) {}
  /// The state from which another stream continues with the same numbers.
  std::uint64_t state() const { return state_; }

  std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15u); }
  /// Within [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Within [0, count), for count far below 2^32, where the bias of the multiplication is below
  /// 1e-9.
  std::uint32_t below(std::uint32_t count) {
    assert(count > 0);
    return static_cast<std::uint32_t>((next() >> 32) * count >> 32);
  }
  /// True with `probability`.
  bool coin(double probability) { return uniform() < probability; }

 protected:
  /// The generator's output function, a bijection that stirs all bits: makes states of seeds.
  static constexpr std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
  }

 private:
  std::uint64_t state_;
};

}  // namespace rink
