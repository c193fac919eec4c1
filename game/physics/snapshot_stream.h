// Numbers to bytes and back, the same bytes on every machine: little endian, floating point by its
// bits, a checksum at the end.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "im/basics/fnv_hash.h"

namespace rink::physics {

/// What writer and reader share: how a value is made of 64-bit words. Derived has `bool
/// word(std::uint64_t&, int byte_count)`.
template <class Derived>
class SnapshotStream {
 public:
  template <class Number>
  bool number(Number& value) {
    if constexpr (std::is_floating_point_v<Number>) return real(value);
    else {
      auto word = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<Number>>(value));
      if (!self().word(word, sizeof(Number))) return false;
      value = static_cast<Number>(word);
      return true;
    }
  }
  template <class... Numbers>
  bool numbers(Numbers&... values) {
    return (number(values) && ...);
  }
  bool truth(bool& value) {
    std::uint64_t word = value;
    if (!self().word(word, 1) || word > 1) return false;
    value = word == 1;
    return true;
  }
  /// An enumeration counted from 0, none beyond `last`.
  template <class Choice>
  bool choice(Choice& value, Choice last) {
    auto word = static_cast<std::uint64_t>(value);
    if (!self().word(word, 1) || word > static_cast<std::uint64_t>(last)) return false;
    value = static_cast<Choice>(word);
    return true;
  }
  /// The length of `list`, which a reader resizes.
  template <class List>
  bool size(List& list) {
    std::uint64_t count = list.size();
    if (!self().word(count, 4) || count > self().count_max()) return false;
    list.resize(count);
    return true;
  }

 private:
  Derived& self() { return static_cast<Derived&>(*this); }

  /// A wider number is the sum of as many doubles as its digits need, largest first.
  template <class Real>
  bool real(Real& value) {
    constexpr int parts = (std::numeric_limits<Real>::digits + 52) / 53;
    Real rest = value, sum = 0.0;
    for (int part = 0; part < parts; ++part) {
      const auto leading = static_cast<double>(rest);
      auto word = std::bit_cast<std::uint64_t>(leading);
      if (!self().word(word, 8)) return false;
      rest = std::isfinite(leading) ? rest - static_cast<Real>(leading) : Real(0.0);
      if (part == 0) sum = std::bit_cast<double>(word);
      else if (const auto further = std::bit_cast<double>(word); further != 0.0) sum += further;
    }
    value = sum;
    return true;
  }
};

/// FNV-1a of 64 bits; of 4 bytes: its halves folded onto each other.
inline std::uint64_t checksum(std::span<const std::uint8_t> bytes, int byte_count = 8) {
  Fnv64 hash;
  for (const std::uint8_t byte : bytes) hash.add(byte);
  const std::uint64_t sum = hash.value();
  return byte_count == 8 ? sum : (sum ^ sum >> 32) & 0xffffffffULL;
}

class SnapshotWriter : public SnapshotStream<SnapshotWriter> {
 public:
  /// Most messages are short: their bytes are allocated once.
  SnapshotWriter() { bytes_.reserve(64); }
  bool word(std::uint64_t& value, int byte_count) {
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + static_cast<std::size_t>(byte_count));
    for (int byte = 0; byte < byte_count; ++byte)
      bytes_[begin + static_cast<std::size_t>(byte)] =
          static_cast<std::uint8_t>(value >> (8 * byte));
    return true;
  }
  static std::uint64_t count_max() { return 0xffffffff; }
  /// All that was written, with its checksum of 8 or 4 bytes.
  std::vector<std::uint8_t> finish(int checksum_bytes = 8) {
    std::uint64_t sum = checksum(bytes_, checksum_bytes);
    word(sum, checksum_bytes);
    return std::move(bytes_);
  }

 private:
  std::vector<std::uint8_t> bytes_;
};

class SnapshotReader : public SnapshotStream<SnapshotReader> {
 public:
  explicit SnapshotReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// Whether the last 8, or 4, bytes are the checksum of the others; they are not read again.
  bool is_intact(int checksum_bytes = 8) {
    const auto size = static_cast<std::size_t>(checksum_bytes);
    if (bytes_.size() < size) return false;
    SnapshotReader tail(bytes_.last(size));
    std::uint64_t sum = 0;
    tail.word(sum, checksum_bytes);
    bytes_ = bytes_.first(bytes_.size() - size);
    return sum == checksum(bytes_, checksum_bytes);
  }
  bool word(std::uint64_t& value, int byte_count) {
    if (bytes_.size() < static_cast<std::size_t>(byte_count)) return false;
    value = 0;
    for (int byte = 0; byte < byte_count; ++byte)
      value |= static_cast<std::uint64_t>(bytes_[static_cast<std::size_t>(byte)]) << (8 * byte);
    bytes_ = bytes_.subspan(static_cast<std::size_t>(byte_count));
    return true;
  }
  /// No list is longer than what is left of the bytes, so that a damaged length claims no memory.
  std::uint64_t count_max() const { return bytes_.size(); }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace rink::physics
