// Sets of attributes on the wire: as short for narrow classes as if there were no wide ones.
#pragma once

#include <cassert>
#include <cstdint>

#include "rti/types.h"
#include "rti/wire/stream.h"

namespace rink::rti {

/// A varint of attributes 0 to 62. Bit 63 of it says that a varint of those from 63 on follows.
template <class Stream>
bool attribute_bits(Stream& stream, AttributeBits& bits) {
  constexpr unsigned low_bits = 63;
  constexpr std::uint64_t is_wide = std::uint64_t{1} << low_bits;
  assert(Stream::is_reading || bits >> attribute_max == 0);
  auto higher = static_cast<std::uint64_t>(bits >> low_bits);
  std::uint64_t low = (static_cast<std::uint64_t>(bits) & ~is_wide) | (higher != 0 ? is_wide : 0u);
  if (!stream.varint(low)) return false;
  const bool has_higher = (low & is_wide) != 0;
  if (has_higher && (!stream.varint(higher) || !stream.check(higher != 0))) return false;
  if constexpr (Stream::is_reading)
    bits = has_higher ? AttributeBits{higher} << low_bits | (low & ~is_wide) : low;
  return true;
}

/// Four bytes for attributes 0 to 30. The bit of the privilege to delete, which declarations never
/// name, says that a varint of the attributes from 32 on follows.
template <class Stream>
bool attribute_word(Stream& stream, AttributeBits& bits) {
  constexpr std::uint32_t is_wide = 1u << privilege_to_delete_object.value;
  assert(Stream::is_reading || (bits & is_wide) == 0);
  auto word = static_cast<std::uint32_t>(bits) | (bits >> 32 != 0 ? is_wide : 0u);
  AttributeBits higher = bits >> 32;
  if (!stream.number(word)) return false;
  if ((word & is_wide) != 0 && (!attribute_bits(stream, higher) || !stream.check(higher != 0)))
    return false;
  if constexpr (Stream::is_reading)
    bits = (word & is_wide) != 0 ? higher << 32 | (word & ~is_wide) : word;
  return true;
}

}  // namespace rink::rti
