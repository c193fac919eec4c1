// What snapshots have beyond the streams of bytes (im/basics/byte_stream.h): reals of any width,
// and a checksum at the end.
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "im/basics/byte_stream.h"
#include "im/basics/fnv_hash.h"

namespace rink::physics {

using SnapshotWriter = ByteWriter<std::vector<std::uint8_t>>;

/// A real wider than double is the sum of as many doubles as its digits need, largest first.
template <class Stream, class Real>
bool exchange_real(Stream& stream, Real& value) {
  constexpr int parts = (std::numeric_limits<Real>::digits + 52) / 53;
  Real rest = value, sum = 0.0;
  for (int part = 0; part < parts; ++part) {
    auto leading = static_cast<double>(rest);
    if (!stream.number(leading)) return false;
    rest = std::isfinite(leading) ? rest - static_cast<Real>(leading) : Real(0.0);
    if (part == 0) sum = leading;
    else if (leading != 0.0) sum += leading;
  }
  if constexpr (Stream::is_reading) value = sum;
  return true;
}

/// As the stream's `numbers`, of reals of any width too.
template <class Stream, class... Numbers>
bool exchange_all(Stream& stream, Numbers&... values) {
  const auto exchange_one = [&]<class Number>(Number& value) {
    if constexpr (sizeof(Number) > sizeof(double)) return exchange_real(stream, value);
    else return stream.number(value);
  };
  return (exchange_one(values) && ...);
}

/// FNV-1a of 64 bits; of 4 bytes: its halves folded onto each other.
inline std::uint64_t checksum(std::span<const std::byte> bytes, std::size_t size = 8) {
  assert(size == 4 || size == 8);
  Fnv64 hash;
  for (const std::byte byte : bytes) hash.add(static_cast<std::uint8_t>(byte));
  const std::uint64_t sum = hash.value();
  return size == 8 ? sum : (sum ^ sum >> 32) & 0xffffffffULL;
}

/// Appends the checksum of all bytes, of 8 or 4 bytes.
inline void add_checksum(std::vector<std::uint8_t>& bytes, std::size_t size = 8) {
  std::uint64_t sum = checksum(std::as_bytes(std::span(bytes)), size);
  SnapshotWriter(bytes).part(sum, size);
}

/// What stands before the checksum that the bytes end with; nothing unless it is theirs.
inline std::optional<std::span<const std::byte>> without_checksum(
    std::span<const std::uint8_t> bytes, std::size_t size = 8) {
  if (bytes.size() < size) return std::nullopt;
  const std::span<const std::byte> whole = std::as_bytes(bytes),
                                   content = whole.first(whole.size() - size);
  std::uint64_t sum = 0;
  ByteReader(whole.last(size)).part(sum, size);
  return sum == checksum(content, size) ? std::optional(content) : std::nullopt;
}

}  // namespace rink::physics
