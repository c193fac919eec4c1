// Random numbers of one property of one direction of one link: the same bits on every machine,
// whatever else draws.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

namespace rink::rti {

/// SplitMix64 (Steele, Lea and Flood 2014). Streams with different keys are independent.
class LinkStream {
 public:
  LinkStream() = default;
  explicit LinkStream(std::uint64_t key) : state_(key) {}

  /// `key` with `part` mixed in: seed, listener, link, direction and property one after the other
  /// make the key of a stream.
  static std::uint64_t key_of(std::uint64_t key, std::uint64_t part) {
    return mixed(mixed(key) ^ mixed(~part));
  }
  static std::uint64_t key_of(std::uint64_t key, std::string_view name) {
    for (const char letter : name)
      key = key_of(key, static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
    return key;
  }

  /// Within [0, 1), a multiple of 2^-53.
  double uniform() {
    return static_cast<double>(mixed(state_ += 0x9e3779b97f4a7c15u) >> 11) * 0x1p-53;
  }
  /// True with `probability`.
  bool coin(double probability) { return uniform() < probability; }
  /// Of mean 1, at most 36.8. The logarithm is summed here, for the library's differs between
  /// libraries.
  double exponential() {
    int exponent = 0;
    const double fraction = std::frexp(1.0 - uniform(), &exponent),
                 z = (fraction - 1.0) / (fraction + 1.0), square = z * z;
    double sum = 0.0;
    for (int k = 33; k >= 1; k -= 2)
      sum = sum * square + 1.0 / k;  // atanh z = z (1 + z^2/3 + z^4/5 ...), |z| <= 1/3
    constexpr double logarithm_of_2 = 0.693147180559945309417;
    return -(2.0 * z * sum + exponent * logarithm_of_2);
  }

 private:
  static std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
  }
  std::uint64_t state_ = 0;
};

}  // namespace rink::rti
