// Random numbers for one property of one direction of one link: the same bits on every machine,
// independent of other streams.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "im/basics/seeded_stream.h"

namespace rink::rti {

/// Streams with different keys are independent.
class LinkStream : public SeededStream {
 public:
  using SeededStream::SeededStream;

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
};

}  // namespace rink::rti
