// Numbers whose small values are short: seven bits a byte, least significant first, the top bit set
// in all but the last; and numbers of any sign as such.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rink {

inline constexpr std::size_t varint_size_max = 10;

inline std::size_t varint_size(std::uint64_t value) {
  return (static_cast<std::size_t>(std::bit_width(value | 1)) + 6) / 7;
}

/// Writes to where `varint_size(value)` bytes are free; returns their end.
inline std::byte* put_varint(std::byte* at, std::uint64_t value) {
  assert(at != nullptr);
  for (; value >= 0x80; value >>= 7) *at++ = static_cast<std::byte>(value | 0x80);
  *at++ = static_cast<std::byte>(value);
  return at;
}

/// The size of the number that `bytes` begin with, which it sets; 0 where its last byte is missing,
/// not among the first ten, or not as `put_varint` writes it: a number has one form of bytes.
inline std::size_t get_varint(std::span<const std::byte> bytes, std::uint64_t& value) {
  value = 0;
  for (std::size_t k = 0; k < varint_size_max && k < bytes.size(); ++k) {
    const auto byte = static_cast<std::uint64_t>(bytes[k]);
    value |= (byte & 0x7f) << 7 * k;
    if (byte >= 0x80) continue;
    const bool is_shortest = byte != 0 || k == 0, has_64_bits = k < 9 || byte <= 1;
    return is_shortest && has_64_bits ? k + 1 : 0;
  }
  return 0;
}

/// Numbers of any sign as numbers that are small near zero: 0, -1, 1, -2, 2 become 0, 1, 2, 3, 4.
inline std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
inline std::int64_t from_zigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

}  // namespace rink
