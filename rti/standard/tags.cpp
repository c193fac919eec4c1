// Packs and unpacks user-supplied tags.
#include "rti/standard/tags.h"

#include <array>
#include <cassert>
#include <cmath>
#include <string>

namespace rink::standard {

namespace {

constexpr std::size_t in_tag = 7, in_time = 6;

std::uint64_t word_of(const unsigned char* bytes, std::size_t size) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < size; ++i) word |= std::uint64_t{bytes[i]} << 8 * i;
  return word;
}

}  // namespace

std::uint64_t tag_word(rti::Bytes tag, unsigned flags) {
  assert(tag.size() <= in_tag);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(tag.data());
  return std::uint64_t{tag_mark | flags | static_cast<unsigned>(tag.size())} << 56 |
         word_of(bytes, tag.size());
}

rti::Stamp tag_stamp(rti1516e::VariableLengthData const& tag, std::optional<double> time) {
  const rti::Bytes bytes = bytes_of(tag);
  const unsigned flags = time ? tag_has_time : 0;
  if (bytes.empty() && !time) return {};
  if (bytes.size() <= in_tag) return {time.value_or(0.0), tag_word(bytes, flags)};
  if (time || bytes.size() > in_tag + in_time)
    throw rti1516e::RTIinternalError(L"the tag has " + std::to_wstring(bytes.size()) +
                                     L" bytes; an update carries at most 13, and 7 with a time");
  const auto* const rest = reinterpret_cast<const unsigned char*>(bytes.data()) + in_tag;
  const std::size_t left = bytes.size() - in_tag;
  // The count of the bytes goes with them: 3 bits above 48 are still a whole number as a double.
  const std::uint64_t word = std::uint64_t{left} << 8 * in_time | word_of(rest, left);
  return {static_cast<double>(word), tag_word(bytes.first(in_tag), tag_goes_on)};
}

ReceivedTag read_tag(const rti::Stamp& stamp) {
  if (stamp.tag == 0) return {};
  std::array<char, in_tag + in_time> bytes;
  const auto head = static_cast<unsigned>(stamp.tag >> 56);
  if ((head & tag_mark) == 0) {
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<char>(stamp.tag >> (56 - 8 * i));
    return {rti1516e::VariableLengthData(bytes.data(), 8), false};
  }
  std::size_t size = head & tag_size_bits;
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(stamp.tag >> 8 * i);
  constexpr double most = 7.0 * static_cast<double>(1ull << 8 * in_time);
  const bool goes_on = (head & tag_goes_on) != 0 && stamp.time >= 0.0 && stamp.time < most;
  if (goes_on && size == in_tag) {
    const auto word = static_cast<std::uint64_t>(stamp.time);
    const auto left = static_cast<std::size_t>(word >> 8 * in_time);
    for (std::size_t i = 0; i < left; ++i) bytes[size++] = static_cast<char>(word >> 8 * i);
  }
  return {rti1516e::VariableLengthData(bytes.data(), size), (head & tag_has_time) != 0};
}

bool tag_gives_time(const rti::Stamp& stamp) {
  constexpr std::uint64_t both = std::uint64_t{tag_mark | tag_has_time} << 56;
  return (stamp.tag & both) == both;
}

rti::Bytes bytes_of(rti1516e::VariableLengthData const& data) {
  return {static_cast<const std::byte*>(data.data()), data.size()};
}

rti1516e::VariableLengthData data_of(rti::Bytes bytes) {
  return rti1516e::VariableLengthData(bytes.data(), bytes.size());
}

}  // namespace rink::standard
