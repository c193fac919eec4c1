// Codes of numbers and lists in the messages of the policy "exact": one function writes and reads.
#pragma once

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "game/physics/body.h"
#include "rti/wire/bit_stream.h"

namespace rink::game {

/// Bodies are numbered below this.
inline constexpr std::uint32_t exact_number_max = 1u << 24;

namespace exact {

inline constexpr std::uint64_t list_max = 1u << 20;

/// What follows is of that field: for a stream that wants to know where the bits go.
template <class Stream>
void mark(Stream& stream, const char* field) {
  if constexpr (requires { stream.begin_field(field); }) stream.begin_field(field);
}

template <class Stream>
bool count(Stream& stream, std::uint64_t& value, std::uint64_t max, unsigned order) {
  if constexpr (!Stream::is_reading) assert(value <= max);
  return stream.golomb(value, order) && value <= max;
}

template <class Stream, class Number>
bool small(Stream& stream, Number& value, std::uint64_t max, unsigned order) {
  std::uint64_t wide = static_cast<std::uint64_t>(value);
  if (!count(stream, wide, max, order)) return false;
  if constexpr (Stream::is_reading) value = static_cast<Number>(wide);
  return true;
}

/// A number below `end`, all being as likely, in a truncated binary code: where `end` is no power
/// of two the first ones take a bit less.
template <class Stream>
bool below(Stream& stream, std::uint64_t& value, std::uint64_t end) {
  if (end == 0) return false;
  const auto size = static_cast<unsigned>(std::bit_width(end)) - 1;
  const std::uint64_t short_ones = (std::uint64_t{2} << size) - end;
  if constexpr (!Stream::is_reading) assert(value < end);
  // The long ones' first bits are those of `short_ones` and what follows.
  const std::uint64_t whole = value < short_ones ? value : value + short_ones;
  std::uint64_t head = value < short_ones ? value : whole >> 1, last = whole & 1;
  if (!stream.bits(head, size)) return false;
  if constexpr (Stream::is_reading) value = head;
  if (head < short_ones) return true;
  if (!stream.bits(last, 1)) return false;
  if constexpr (Stream::is_reading) value = 2 * head + last - short_ones;
  return value < end;
}

/// The length of a list; a reader resizes it, to no more elements than there are bits left.
template <class Stream, class List>
bool size(Stream& stream, List& list, unsigned order = 0) {
  std::uint64_t length = list.size();
  if (!count(stream, length, list_max, order)) return false;
  if constexpr (Stream::is_reading) {
    if (length > stream.left()) return false;
    list.resize(static_cast<std::size_t>(length));
  }
  return true;
}

inline std::uint64_t folded(std::int64_t value) {
  return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
}
inline std::int64_t unfolded(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

/// Every bit of a finite double whose exponent is near `exponent` (that of 2^exponent): 57 bits
/// mostly.
template <class Stream>
bool near(Stream& stream, double& value, int exponent) {
  constexpr std::uint64_t mantissa_mask = (std::uint64_t{1} << 52) - 1;
  std::uint64_t word = std::bit_cast<std::uint64_t>(value);
  bool is_negative = word >> 63 != 0;
  std::uint64_t mantissa = word & mantissa_mask,
                off = folded(1023 + exponent - static_cast<std::int64_t>(word >> 52 & 0x7ff));
  if (!stream.flag(is_negative) || !stream.golomb(off, 2) || !stream.bits(mantissa, 52))
    return false;
  if constexpr (Stream::is_reading) {
    if (off > 4096) return false;
    const std::int64_t biased = 1023 + exponent - unfolded(off);
    if (biased < 0 || biased > 2046) return false;
    word = static_cast<std::uint64_t>(is_negative) << 63 |
           static_cast<std::uint64_t>(biased) << 52 | mantissa;
    value = std::bit_cast<double>(word);
  }
  return true;
}

/// Every bit of a double that begins as `like` does.
template <class Stream>
bool like(Stream& stream, double& value, double like) {
  const std::uint64_t base = std::bit_cast<std::uint64_t>(like);
  std::uint64_t differing = std::bit_cast<std::uint64_t>(value) ^ base;
  auto width = static_cast<std::uint64_t>(std::bit_width(differing));
  if (!stream.bits(width, 7) || width > 64) return false;
  // The first differing bit is known to be one.
  std::uint64_t rest = width == 0 ? 0 : differing & ~(std::uint64_t{1} << (width - 1));
  if (width > 1 && !stream.bits(rest, static_cast<unsigned>(width) - 1)) return false;
  if constexpr (Stream::is_reading) {
    differing = width == 0 ? 0 : rest | std::uint64_t{1} << (width - 1);
    value = std::bit_cast<double>(base ^ differing);
  }
  return true;
}

/// A double that may be infinite but is a number.
template <class Stream>
bool any(Stream& stream, double& value) {
  return stream.full(value) && !std::isnan(value);
}
template <class Stream>
bool any(Stream& stream, physics::Vector2& value) {
  return any(stream, value.x()) && any(stream, value.y()) && value.allFinite();
}

/// Ranks or numbers in rising order, as gaps: of all bodies few enter, of the known ones some
/// change.
template <class Stream>
bool rising(Stream& stream, std::uint32_t& value, std::int64_t& last, std::uint64_t below) {
  std::uint64_t gap = static_cast<std::uint64_t>(value - last - 1);
  if (!count(stream, gap, below, below == exact_number_max ? 8 : 4)) return false;
  last += 1 + static_cast<std::int64_t>(gap);
  if (last >= static_cast<std::int64_t>(below)) return false;
  value = static_cast<std::uint32_t>(last);
  return true;
}

}  // namespace exact
}  // namespace rink::game
