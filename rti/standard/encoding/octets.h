// Reading and writing of octets, as the encoding helpers do it.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "rti/standard/standard_headers.h"

namespace rink::standard {

using Octets = std::vector<rti1516e::Octet>;

template <std::size_t size>
using WordOf = std::conditional_t<
    size == 1, std::uint8_t,
    std::conditional_t<size == 2, std::uint16_t,
                       std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

/// Throws EncoderException unless `count` octets follow `index`.
inline void check_room(const Octets& buffer, std::size_t index, std::size_t count) {
  if (index > buffer.size() || count > buffer.size() - index)
    throw rti1516e::EncoderException(L"the value at octet " + std::to_wstring(index) + L" needs " +
                                     std::to_wstring(count) + L" octets of " +
                                     std::to_wstring(buffer.size()));
}

template <std::endian order, class Number>
void put_number(Octets& buffer, Number value) {
  const auto word = std::bit_cast<WordOf<sizeof(Number)>>(value);
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    const std::size_t place = order == std::endian::little ? i : sizeof(Number) - 1 - i;
    buffer.push_back(static_cast<char>(static_cast<std::uint64_t>(word) >> 8 * place & 0xff));
  }
}
template <std::endian order, class Number>
Number get_number(const Octets& buffer, std::size_t index) {
  check_room(buffer, index, sizeof(Number));
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    const std::size_t place = order == std::endian::little ? sizeof(Number) - 1 - i : i;
    word = word << 8 | static_cast<unsigned char>(buffer[index + place]);
  }
  return std::bit_cast<Number>(static_cast<WordOf<sizeof(Number)>>(word));
}

/// The count that an array begins with.
inline void put_count(Octets& buffer, std::size_t count) {
  if (count > 0x7fffffff) throw rti1516e::EncoderException(L"an array has too many elements");
  put_number<std::endian::big>(buffer, static_cast<std::int32_t>(count));
}
inline std::size_t get_count(const Octets& buffer, std::size_t index) {
  const auto count = get_number<std::endian::big, std::int32_t>(buffer, index);
  if (count < 0) throw rti1516e::EncoderException(L"an array has less than no elements");
  return static_cast<std::size_t>(count);
}

/// Octets from `place` to the next multiple of `boundary`.
inline std::size_t padding(std::size_t place, unsigned boundary) {
  return (boundary - place % boundary) % boundary;
}

inline Octets octets_of(rti1516e::VariableLengthData const& data) {
  const auto* const begin = static_cast<const rti1516e::Octet*>(data.data());
  return begin == nullptr ? Octets() : Octets(begin, begin + data.size());
}

/// What every helper does with values as a whole, by what it does with a buffer.
inline void encode_whole(const rti1516e::DataElement& element, rti1516e::VariableLengthData& data) {
  Octets buffer;
  element.encodeInto(buffer);
  data.setData(buffer.data(), buffer.size());
}
inline rti1516e::VariableLengthData encode_whole(const rti1516e::DataElement& element) {
  rti1516e::VariableLengthData data;
  encode_whole(element, data);
  return data;
}
inline std::size_t encoded_length(const rti1516e::DataElement& element) {
  Octets buffer;
  element.encodeInto(buffer);
  return buffer.size();
}

}  // namespace rink::standard

// The members of a helper that follow from `encodeInto` and `decodeFrom`.
#define RINK_DEFINE_WHOLE_VALUES(Kind)                                                    \
  std::auto_ptr<DataElement> Kind::clone() const {                                        \
    return std::auto_ptr<DataElement>(new Kind(*this));                                   \
  }                                                                                       \
  VariableLengthData Kind::encode() const { return rink::standard::encode_whole(*this); } \
  void Kind::encode(VariableLengthData& inData) const {                                   \
    rink::standard::encode_whole(*this, inData);                                          \
  }                                                                                       \
  void Kind::decode(VariableLengthData const& inData) {                                   \
    decodeFrom(rink::standard::octets_of(inData), 0);                                     \
  }                                                                                       \
  size_t Kind::getEncodedLength() const { return rink::standard::encoded_length(*this); }
