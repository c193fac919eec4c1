// What the two kinds of logical time have in common: sums that do not leave their range, and bytes.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "rti/standard/standard_headers.h"

namespace rink::standard {

/// Sums of numbers that are never negative; they throw IllegalTimeArithmetic.
template <class Number>
Number sum(Number value, Number addend) {
  if (addend > std::numeric_limits<Number>::max() - value)
    throw rti1516e::IllegalTimeArithmetic(L"the sum is later than the final time");
  return value + addend;
}
template <class Number>
Number difference(Number value, Number subtrahend) {
  if (subtrahend > value)
    throw rti1516e::IllegalTimeArithmetic(L"the difference is earlier than the initial time");
  return value - subtrahend;
}

/// The shortest text that reads as this number alone.
inline std::wstring shortest_text(double value) {
  std::array<char, 32> text;
  const std::to_chars_result end = std::to_chars(text.begin(), text.end(), value);
  return {text.begin(), end.ptr};
}

/// Times and intervals are encoded as HLAfloat64BE and HLAinteger64BE.
inline constexpr std::size_t encoded_time_size = 8;

template <class Number>
size_t encode_time(Number value, void* buffer, size_t room) {
  static_assert(sizeof(Number) == encoded_time_size);
  if (room < encoded_time_size)
    throw rti1516e::CouldNotEncode(L"a time needs 8 bytes, not " + std::to_wstring(room));
  auto word = std::bit_cast<std::uint64_t>(value);
  std::array<unsigned char, encoded_time_size> bytes;
  for (std::size_t i = encoded_time_size; i > 0; --i, word >>= 8)
    bytes[i - 1] = static_cast<unsigned char>(word & 0xff);
  std::memcpy(buffer, bytes.data(), encoded_time_size);
  return encoded_time_size;
}
template <class Number>
rti1516e::VariableLengthData encode_time(Number value) {
  std::array<char, encoded_time_size> bytes;
  encode_time(value, bytes.data(), bytes.size());
  return rti1516e::VariableLengthData(bytes.data(), bytes.size());
}

/// Throws CouldNotDecode for another size, and for a number that no time is.
template <class Number>
Number decode_time(const void* buffer, size_t size) {
  if (size != encoded_time_size)
    throw rti1516e::CouldNotDecode(L"a time has 8 bytes, not " + std::to_wstring(size));
  std::array<unsigned char, encoded_time_size> bytes;
  std::memcpy(bytes.data(), buffer, encoded_time_size);
  std::uint64_t word = 0;
  for (const unsigned char each : bytes) word = word << 8 | each;
  const auto value = std::bit_cast<Number>(word);
  if (!(value >= 0 && value <= std::numeric_limits<Number>::max()))
    throw rti1516e::CouldNotDecode(L"a time is neither negative nor infinite");
  return value;
}

/// The time or interval as one of the kind that is expected; throws `Error` if it is another.
template <class Kind, class Error, class Base>
const Kind& same_kind(const Base& value, const std::wstring& expected) {
  const auto* const found = dynamic_cast<const Kind*>(&value);
  if (found == nullptr)
    throw Error(value.implementationName() + L" where " + expected + L" is due");
  return *found;
}

}  // namespace rink::standard
