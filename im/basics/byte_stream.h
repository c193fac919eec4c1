// The three streams of bytes that one `exchange` function per message serves: writing, reading and
// measuring. Bytes are the same on every machine: little endian, floating point by its bits.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "im/basics/varint.h"

namespace rink {

static_assert(std::endian::native == std::endian::little,
              "the bytes are little-endian and values are copied as they lie in memory");

/// What all streams make of their parts. `Stream` has `is_reading`; `part(word, size)`, the `size`
/// lowest bytes of a word whose others are 0, at most 8; `rest(view, size)`, bytes without a length
/// of their own; `varint(number)`; `count_max()`, the longest list; and `check(is_sound)`, which
/// tells a reader's caller what does not hold, and is asserted by a writer.
template <class Stream>
class ByteStream {
 public:
  template <class Number>
  bool number(Number& value) {
    static_assert(std::is_trivially_copyable_v<Number> && !std::is_same_v<Number, bool> &&
                  sizeof(Number) <= sizeof(std::uint64_t));
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof value);
    if (!self().part(word, sizeof value)) return false;
    if constexpr (Stream::is_reading) std::memcpy(&value, &word, sizeof value);
    return true;
  }
  template <class... Numbers>
  bool numbers(Numbers&... values) {
    return (number(values) && ...);
  }
  template <class Number>
  bool range(Number& value, std::uint64_t max) {
    return number(value) && self().check(value <= max);
  }
  bool finite(double& value) { return number(value) && self().check(std::isfinite(value)); }
  bool truth(bool& value) {
    auto byte = static_cast<std::uint8_t>(value);
    if (!range(byte, 1)) return false;
    if constexpr (Stream::is_reading) value = byte == 1;
    return true;
  }
  /// An enumeration counted from 0, none beyond `last`.
  template <class Choice>
  bool choice(Choice& value, Choice last) {
    auto byte = static_cast<std::uint8_t>(value);
    if (!range(byte, static_cast<std::uint8_t>(last))) return false;
    if constexpr (Stream::is_reading) value = static_cast<Choice>(byte);
    return true;
  }

  /// The length of `list` in four bytes; a reader resizes it.
  template <class List>
  bool size(List& list) {
    assert(list.size() <= std::numeric_limits<std::uint32_t>::max());
    auto count = static_cast<std::uint32_t>(list.size());
    return number(count) && resize(list, count);
  }
  /// As `size`, in as few bytes as it needs.
  template <class List>
  bool short_size(List& list) {
    std::uint64_t count = list.size();
    return self().varint(count) && resize(list, count);
  }
  template <class List>
  bool number_list(List& list) {
    return size(list) &&
           std::all_of(list.begin(), list.end(), [&](auto& value) { return number(value); });
  }

  /// A length of `Length`'s size, then that many bytes, which a reader does not copy.
  template <class Length>
  bool bytes(std::span<const std::byte>& value, std::size_t max) {
    assert(max <= std::numeric_limits<Length>::max());
    auto length = static_cast<Length>(value.size());
    return range(length, max) && self().rest(value, length);
  }
  bool text(std::string_view& value, std::size_t max) {
    std::span<const std::byte> view = std::as_bytes(std::span(value));
    if (!bytes<std::uint8_t>(view, max)) return false;
    if constexpr (Stream::is_reading)
      value = {reinterpret_cast<const char*>(view.data()), view.size()};
    return true;
  }

 private:
  Stream& self() { return static_cast<Stream&>(*this); }

  template <class List>
  bool resize(List& list, std::uint64_t count) {
    if (!self().check(count <= self().count_max())) return false;
    if constexpr (Stream::is_reading) list.resize(static_cast<std::size_t>(count));
    return true;
  }
};

/// Appends to a buffer; asserts the ranges, since only this program's values are written.
template <class Buffer>
class ByteWriter : public ByteStream<ByteWriter<Buffer>> {
 public:
  static constexpr bool is_reading = false;
  explicit ByteWriter(Buffer& bytes) : bytes_(bytes) {}

  bool part(std::uint64_t& value, std::size_t size) {
    assert(size <= sizeof value && (size == sizeof value || value >> (8 * size) == 0));
    const std::size_t end = bytes_.size();
    bytes_.resize(end + size);
    std::memcpy(bytes_.data() + end, &value, size);
    return true;
  }
  template <class Number>
  bool varint(Number& value) {
    std::byte bytes[varint_size_max];
    append(bytes, put_varint(bytes, value));
    return true;
  }
  bool rest(std::span<const std::byte>& value, [[maybe_unused]] std::size_t size) {
    assert(value.size() == size);
    append(value.data(), value.data() + value.size());
    return true;
  }
  static std::uint64_t count_max() { return std::numeric_limits<std::uint64_t>::max(); }
  static bool check([[maybe_unused]] bool is_sound) {
    assert(is_sound);
    return true;
  }

 private:
  void append(const std::byte* begin, const std::byte* end) {
    using Byte = typename Buffer::value_type;
    bytes_.insert(bytes_.end(), reinterpret_cast<const Byte*>(begin),
                  reinterpret_cast<const Byte*>(end));
  }
  Buffer& bytes_;
};

/// Takes from a view and checks: false as soon as anything is missing or out of range. Texts and
/// bytes are views into what is read.
class ByteReader : public ByteStream<ByteReader> {
 public:
  static constexpr bool is_reading = true;
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  bool is_at_end() const { return bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }
  std::span<const std::byte> rest() const { return bytes_; }

  bool part(std::uint64_t& value, std::size_t size) {
    if (size > sizeof value || bytes_.size() < size) return false;
    value = 0;
    std::memcpy(&value, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
    return true;
  }
  /// False if the number does not fit `Number`, or is not in its shortest form.
  template <class Number>
  bool varint(Number& value) {
    std::uint64_t whole = 0;
    const std::size_t size = get_varint(bytes_, whole);
    if (size == 0) return false;
    bytes_ = bytes_.subspan(size);
    value = static_cast<Number>(whole);
    return value == whole;
  }
  bool rest(std::span<const std::byte>& value, std::size_t size) {
    if (bytes_.size() < size) return false;
    value = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return true;
  }
  /// No list is longer than what is left of the bytes, so that a damaged length claims no memory.
  std::uint64_t count_max() const { return bytes_.size(); }
  static bool check(bool is_sound) { return is_sound; }

 private:
  std::span<const std::byte> bytes_;
};

/// Counts the bytes that a writer would append.
class ByteMeasurer : public ByteStream<ByteMeasurer> {
 public:
  static constexpr bool is_reading = false;
  std::size_t size() const { return size_; }

  using ByteStream::size;
  bool part(std::uint64_t&, std::size_t size) {
    size_ += size;
    return true;
  }
  template <class Number>
  bool varint(Number& value) {
    size_ += varint_size(value);
    return true;
  }
  bool rest(std::span<const std::byte>&, std::size_t size) {
    size_ += size;
    return true;
  }
  static std::uint64_t count_max() { return std::numeric_limits<std::uint64_t>::max(); }
  static bool check(bool) { return true; }

 private:
  std::size_t size_ = 0;
};

}  // namespace rink
