// The three streams that one `exchange` function per message serves: writing, reading and
// measuring.
#pragma once

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "im/basics/varint.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

static_assert(std::endian::native == std::endian::little,
              "the wire is little-endian and values are copied as they lie in memory");

/// Appends to a buffer; asserts the ranges, since only this program's values are written.
class Writer {
 public:
  static constexpr bool is_reading = false;
  explicit Writer(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <class Number>
  bool number(Number& value) {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + sizeof value);
    std::memcpy(bytes_.data() + end, &value, sizeof value);
    return true;
  }
  template <class Number>
  bool varint(Number& value) {
    std::byte bytes[varint_size_max];
    bytes_.insert(bytes_.end(), bytes, put_varint(bytes, value));
    return true;
  }
  /// The `size` lowest bytes of `value`, at most 8; the others are 0.
  bool part(std::uint64_t& value, std::size_t size) {
    assert(size <= sizeof value && (size == sizeof value || value >> (8 * size) == 0));
    const auto* at = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), at, at + size);
    return true;
  }
  template <class Number>
  bool range(Number& value, [[maybe_unused]] std::uint64_t max) {
    assert(value <= max);
    return number(value);
  }
  bool finite(double& value) {
    assert(std::isfinite(value));
    return number(value);
  }
  /// A length of `Length`'s size, then that many bytes.
  template <class Length>
  bool bytes(Bytes& value, [[maybe_unused]] std::size_t max) {
    assert(value.size() <= max);
    Length length = static_cast<Length>(value.size());
    number(length);
    return rest(value, value.size());
  }
  bool text(std::string_view& value, std::size_t max) {
    Bytes view = std::as_bytes(std::span(value));
    return bytes<std::uint8_t>(view, max);
  }
  /// `size` bytes without a length of their own.
  bool rest(Bytes& value, std::size_t size) {
    assert(value.size() == size);
    bytes_.insert(bytes_.end(), value.begin(), value.begin() + static_cast<std::ptrdiff_t>(size));
    return true;
  }

 private:
  std::vector<std::byte>& bytes_;
};

/// Takes from a view and checks: false as soon as anything is missing or out of range. Texts and
/// bytes are views into what is read.
class Reader {
 public:
  static constexpr bool is_reading = true;
  explicit Reader(Bytes bytes) : bytes_(bytes) {}
  bool is_at_end() const { return bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }
  Bytes rest() const { return bytes_; }

  template <class Number>
  bool number(Number& value) {
    if (bytes_.size() < sizeof value) return false;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return true;
  }
  /// False if the number does not fit `Number`.
  template <class Number>
  bool varint(Number& value) {
    std::uint64_t whole = 0;
    const std::size_t size = get_varint(bytes_, whole);
    if (size == 0) return false;
    bytes_ = bytes_.subspan(size);
    value = static_cast<Number>(whole);
    return value == whole;
  }
  bool part(std::uint64_t& value, std::size_t size) {
    if (size > sizeof value || bytes_.size() < size) return false;
    value = 0;
    for (std::size_t byte = 0; byte < size; ++byte)
      value |= static_cast<std::uint64_t>(bytes_[byte]) << (8 * byte);
    bytes_ = bytes_.subspan(size);
    return true;
  }
  template <class Number>
  bool range(Number& value, std::uint64_t max) {
    return number(value) && value <= max;
  }
  bool finite(double& value) { return number(value) && std::isfinite(value); }
  template <class Length>
  bool bytes(Bytes& value, std::size_t max) {
    Length length = 0;
    return number(length) && length <= max && rest(value, length);
  }
  bool text(std::string_view& value, std::size_t max) {
    Bytes view;
    if (!bytes<std::uint8_t>(view, max)) return false;
    value = {reinterpret_cast<const char*>(view.data()), view.size()};
    return true;
  }
  bool rest(Bytes& value, std::size_t size) {
    if (bytes_.size() < size) return false;
    value = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return true;
  }

 private:
  Bytes bytes_;
};

/// Counts the bytes that a writer would append.
class Measurer {
 public:
  static constexpr bool is_reading = false;
  std::size_t size() const { return size_; }

  template <class Number>
  bool number(Number& value) {
    size_ += sizeof value;
    return true;
  }
  template <class Number>
  bool varint(Number& value) {
    size_ += varint_size(value);
    return true;
  }
  bool part(std::uint64_t&, std::size_t size) {
    size_ += size;
    return true;
  }
  template <class Number>
  bool range(Number& value, std::uint64_t) {
    return number(value);
  }
  bool finite(double& value) { return number(value); }
  template <class Length>
  bool bytes(Bytes& value, std::size_t) {
    size_ += sizeof(Length) + value.size();
    return true;
  }
  bool text(std::string_view& value, std::size_t) {
    size_ += 1 + value.size();
    return true;
  }
  bool rest(Bytes&, std::size_t size) {
    size_ += size;
    return true;
  }

 private:
  std::size_t size_ = 0;
};

}  // namespace rink::rti
