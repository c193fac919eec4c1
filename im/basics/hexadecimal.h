// Writes hashes in hexadecimal.
#pragma once

#include <cstdint>
#include <string>

namespace rink {

/// Sixteen digits, zeros in front included.
inline std::string hexadecimal(std::uint64_t number) {
  std::string digits(16, '0');
  for (std::size_t place = digits.size(); number != 0; number >>= 4)
    digits[--place] = "0123456789abcdef"[number & 0xf];
  return digits;
}

}  // namespace rink
