// The three bit streams that one `exchange` function serves: writing, reading and measuring fields
// that end between bytes.
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <vector>

#include "rti/wire/bytes.h"
#include "rti/wire/quantisation.h"

namespace rink::rti {

/// Exponential Golomb codes (Teuhola 1978): what is below 2^order takes order + 1 bits; each
/// doubling of (value + 2^order) takes two bits more.
inline constexpr std::uint64_t golomb_max = (std::uint64_t{1} << 56) - 1;
inline constexpr unsigned golomb_order_max = 31;
inline unsigned golomb_size(std::uint64_t value, unsigned order) {
  assert(order <= golomb_order_max);
  return 2 * static_cast<unsigned>(std::bit_width((value >> order) + 1)) - 1 + order;
}

/// Appends bits to a buffer, least significant first, from its end on. Asserts the ranges. The last
/// byte is filled up with zeros by `finish`, which the destructor calls; the buffer must not be
/// touched before.
class BitWriter {
 public:
  static constexpr bool is_reading = false;
  explicit BitWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  BitWriter(const BitWriter&) = delete;
  BitWriter& operator=(const BitWriter&) = delete;
  ~BitWriter() { finish(); }

  /// The `size` lowest bits, at most 64; the others are 0.
  template <class Number>
  bool bits(const Number& number, unsigned size) {
    const auto value = static_cast<std::uint64_t>(number);
    assert(size <= 64 && (size == 64 || value >> size == 0));
    if (size == 0) return true;
    pending_ |= value << used_;
    if (used_ + size < 64) {
      used_ += size;
      return true;
    }
    append(8);
    written_ += 64;
    pending_ = used_ == 0 ? 0 : value >> (64 - used_);
    used_ = used_ + size - 64;
    return true;
  }
  bool flag(const bool& is_set) { return bits(is_set ? 1u : 0u, 1); }
  /// A whole number from `low` to `high`, in as few bits as tell them apart.
  bool ranged(const std::int64_t& value, std::int64_t low, std::int64_t high) {
    assert(low <= value && value <= high);
    const std::uint64_t span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
    return bits(static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(low),
                static_cast<unsigned>(std::bit_width(span)));
  }
  bool quantised(const double& value, const Quantisation& grid) {
    assert(grid.contains(value));
    return bits(grid.count(value), grid.bits);
  }
  /// A number from `low` to `high` that may be rounded by `error`; the grid must exist.
  bool quantised(const double& value, double low, double high, double error) {
    const std::optional<Quantisation> grid = Quantisation::of(low, high, error);
    assert(grid);
    return quantised(value, *grid);
  }
  /// Every bit of a double.
  bool full(const double& value) { return bits(std::bit_cast<std::uint64_t>(value), 64); }
  /// A number of at most `golomb_max`, the shorter the smaller.
  bool golomb(const std::uint64_t& value, unsigned order) {
    assert(value <= golomb_max && order <= golomb_order_max);
    const std::uint64_t head = (value >> order) + 1;
    const auto length = static_cast<unsigned>(std::bit_width(head)) - 1;
    bits(std::uint64_t{1} << length, length + 1);  // as many zeros as bits follow the head's first
    bits(head - (std::uint64_t{1} << length), length);
    return bits(value & ((std::uint64_t{1} << order) - 1), order);
  }

  /// Bits written so far.
  std::size_t at() const { return written_ + used_; }

  void finish() {
    append((used_ + 7) / 8);
    written_ += (used_ + 7) / 8 * 8;
    pending_ = 0;
    used_ = 0;
  }

 private:
  void append(std::size_t size) {
    assert(size <= sizeof pending_);
    const auto* first = reinterpret_cast<const std::byte*>(&pending_);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::vector<std::byte>& bytes_;
  std::size_t written_ = 0;  ///< bits that left `pending_`
  std::uint64_t pending_ = 0;
  unsigned used_ = 0;  ///< bits of `pending_`, below 64
};

/// Takes bits from a view and checks: false as soon as anything is missing or out of range.
class BitReader {
 public:
  static constexpr bool is_reading = true;
  explicit BitReader(Bytes bytes, std::size_t at = 0) : bytes_(bytes), at_(at) {
    assert(at <= 8 * bytes.size());
  }
  /// Bits read so far.
  std::size_t at() const { return at_; }
  std::size_t left() const { return 8 * bytes_.size() - at_; }
  /// Bytes that were begun.
  std::size_t bytes_read() const { return (at_ + 7) / 8; }

  template <class Number>
  bool bits(Number& value, unsigned size) {
    if (size > left()) return false;
    value = static_cast<Number>(peek(size));
    at_ += size;
    return true;
  }
  bool flag(bool& is_set) {
    std::uint64_t bit = 0;
    if (!bits(bit, 1)) return false;
    is_set = bit != 0;
    return true;
  }
  bool ranged(std::int64_t& value, std::int64_t low, std::int64_t high) {
    const std::uint64_t span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
    std::uint64_t count = 0;
    if (!bits(count, static_cast<unsigned>(std::bit_width(span))) || count > span) return false;
    value = static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + count);
    return true;
  }
  bool quantised(double& value, const Quantisation& grid) {
    std::uint64_t count = 0;
    if (!bits(count, grid.bits) || count > grid.last) return false;
    value = grid.value(count);
    return true;
  }
  bool quantised(double& value, double low, double high, double error) {
    return quantised(value, *Quantisation::of(low, high, error));
  }
  bool full(double& value) {
    std::uint64_t word = 0;
    if (!bits(word, 64)) return false;
    value = std::bit_cast<double>(word);
    return true;
  }
  bool golomb(std::uint64_t& value, unsigned order) {
    const auto there = static_cast<unsigned>(std::min<std::size_t>(64, left()));
    const std::uint64_t ahead = peek(there);
    if (ahead == 0) return false;
    const auto length = static_cast<unsigned>(std::countr_zero(ahead));
    std::uint64_t head = 0, tail = 0;
    if (const unsigned size = 2 * length + 1 + order;
        size <= there && order < 64) {  // nearly always: the whole code has been read
      head = ahead >> length >> 1 & low_bits(length);
      tail = ahead >> (size - order) & low_bits(order);
      at_ += size;
    } else {
      at_ += length + 1;
      if (length > 56 || !bits(head, length) || !bits(tail, order)) return false;
    }
    head += (std::uint64_t{1} << length) - 1;
    if (head > golomb_max >> order) return false;
    value = head << order | tail;
    return true;
  }
  bool skip(std::size_t size) {
    if (size > left()) return false;
    at_ += size;
    return true;
  }
  /// Steps over what fills the last byte up; false if that is anything but zeros.
  bool finish() {
    std::uint64_t rest = 0;
    return bits(rest, static_cast<unsigned>(-at_ & 7u)) && rest == 0;
  }

 private:
  static std::uint64_t low_bits(unsigned size) { return (std::uint64_t{1} << size) - 1; }
  /// `size` bits from here on, all of which are there.
  std::uint64_t peek(unsigned size) const {
    if (size == 0) return 0;
    const std::size_t from = at_ / 8, shift = at_ % 8, there = bytes_.size() - from;
    std::uint64_t word = 0;
    if (there >= 8)
      std::memcpy(&word, bytes_.data() + from, 8);  // of a size that is known it is a single load
    else std::memcpy(&word, bytes_.data() + from, there);
    word >>= shift;
    if (shift + size > 64) word |= static_cast<std::uint64_t>(bytes_[from + 8]) << (64 - shift);
    return size == 64 ? word : word & ((std::uint64_t{1} << size) - 1);
  }
  Bytes bytes_;
  std::size_t at_ = 0;
};

/// Appends `size` bits of `from`, the first of them the bit `at`; all must be there.
inline void append_bits(BitWriter& writer, Bytes from, std::size_t at, std::size_t size) {
  BitReader reader(from, at);
  assert(size <= reader.left());
  for (std::uint64_t part = 0; size > 0;) {
    const auto taken = static_cast<unsigned>(std::min<std::size_t>(size, 64));
    reader.bits(part, taken);
    writer.bits(part, taken);
    size -= taken;
  }
}

/// Counts the bits that a writer would append.
class BitMeasurer {
 public:
  static constexpr bool is_reading = false;
  std::size_t bits() const { return size_; }
  /// With what fills the last byte up.
  std::size_t bytes() const { return (size_ + 7) / 8; }

  template <class Number>
  bool bits(const Number&, unsigned size) {
    size_ += size;
    return true;
  }
  bool flag(const bool&) { return bits(0, 1); }
  bool ranged(const std::int64_t& value, std::int64_t low, std::int64_t high) {
    return bits(value, static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(high) -
                                                            static_cast<std::uint64_t>(low))));
  }
  bool quantised(const double& value, const Quantisation& grid) { return bits(value, grid.bits); }
  bool quantised(const double& value, double low, double high, double error) {
    return quantised(value, *Quantisation::of(low, high, error));
  }
  bool full(const double& value) { return bits(value, 64); }
  bool golomb(const std::uint64_t& value, unsigned order) {
    return bits(value, golomb_size(value, order));
  }

 private:
  std::size_t size_ = 0;
};

}  // namespace rink::rti
