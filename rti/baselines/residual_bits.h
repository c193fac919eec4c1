// The bits of a block of residuals between its records: handles in ascending order, and which
// attributes a record has.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>

#include "im/basics/varint.h"
#include "rti/handles.h"
#include "rti/types.h"
#include "rti/wire/bit_stream.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// Begins a block of residuals to the values before; `size` bytes of bits follow.
struct ResidualsMessage {
  static constexpr MessageKind kind = MessageKind::residuals;
  std::uint16_t object_class = 0;
  std::uint32_t size = 0;
};
template <class Stream>
bool exchange(Stream& stream, ResidualsMessage& message) {
  return stream.varint(message.object_class) && stream.varint(message.size);
}

inline constexpr unsigned gap_order_bits = 4;
/// The golomb order for gaps between `count` handles over `span`: that of a geometric distribution
/// with their mean.
inline unsigned gap_order(std::uint64_t span, std::uint64_t count) {
  constexpr std::uint64_t most = (1u << gap_order_bits) - 1;
  const std::uint64_t mean = count > 1 ? span / (count - 1) : 0;
  return static_cast<unsigned>(
      std::min<std::uint64_t>(std::uint64_t(std::bit_width(mean * 11 / 16)), most));
}

/// The place in a block: the handle of the record before and the attributes of the last that had
/// others than the highest alone. The next record has another handle above it, and mostly one of
/// both sets.
struct ResidualCursor {
  AttributeSet residual;         ///< the attributes of the class that may travel so
  unsigned order = 0;            ///< of gaps
  unsigned companion_order = 0;  ///< of the ways from a record to its companion
  AttributeSet attributes{};
  bool has_begun = false;    ///< the first handle is known
  std::uint32_t handle = 0;  ///< of the record before

  /// The highest alone.
  static AttributeSet greatest(AttributeSet set) { return {set.back()}; }
};

/// Writes or reads the handle; a reader returns false if it is no handle.
template <class Stream>
bool exchange_handle(Stream& stream, ResidualCursor& cursor, std::uint32_t& handle) {
  constexpr unsigned number_order = 10, number_bits = 18;
  static_assert(object_block == 1u << number_bits);
  if (cursor.has_begun) {
    std::uint64_t gap = Stream::is_reading ? 0 : handle - cursor.handle - 1;
    if (!stream.golomb(gap, cursor.order) || gap >= 0xffffffffu - cursor.handle) return false;
    handle = cursor.handle + 1 + static_cast<std::uint32_t>(gap);
  } else {
    std::uint64_t block = Stream::is_reading ? 0 : handle >> number_bits,
                  number = Stream::is_reading ? 0 : handle & (object_block - 1);
    if (!stream.golomb(block, 0) || !stream.golomb(number, number_order) ||
        block >> (32 - number_bits) != 0 || number >= object_block)
      return false;
    handle = static_cast<std::uint32_t>(block << number_bits | number);
  }
  cursor.has_begun = true;
  cursor.handle = handle;
  return true;
}

/// The same for a companion of the record at hand, whose handle is in no order.
template <class Stream>
bool exchange_companion(Stream& stream, const ResidualCursor& cursor, std::uint32_t& handle) {
  assert(cursor.has_begun);
  std::uint64_t step = 0;
  if (!Stream::is_reading) step = zigzag(std::int64_t{handle} - std::int64_t{cursor.handle}) - 1;
  if (!stream.golomb(step, cursor.companion_order) || step >> 33 != 0) return false;
  const std::int64_t reached = std::int64_t{cursor.handle} + from_zigzag(step + 1);
  handle = static_cast<std::uint32_t>(reached);
  return reached >= 0 && reached <= 0xffffffffll;
}

/// Writes or reads which attributes follow; a reader returns false if there are none.
template <class Stream>
bool exchange_attributes(Stream& stream, ResidualCursor& cursor, AttributeSet& attributes) {
  const AttributeSet highest = ResidualCursor::greatest(cursor.residual);
  bool is_highest = !Stream::is_reading && attributes == highest,
       is_as_before = !Stream::is_reading && attributes == cursor.attributes;
  if (!stream.flag(is_highest)) return false;
  if (is_highest) return attributes = highest, true;
  if (!stream.flag(is_as_before)) return false;
  if (is_as_before) return attributes = cursor.attributes, !attributes.is_empty();
  AttributeSet named;
  for (const AttributeHandle each : cursor.residual) {
    bool is_there = !Stream::is_reading && attributes.contains(each);
    if (!stream.flag(is_there)) return false;
    if (is_there) named.insert(each);
  }
  attributes = cursor.attributes = named;
  return !named.is_empty();
}

/// True if only what fills the last byte up is left: no record is all zeros.
inline bool is_block_end(BitReader bits) { return bits.left() < 8 && bits.finish(); }

}  // namespace rink::rti
