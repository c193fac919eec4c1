// User-supplied tags in the 64 bits that Rink carries with each message.
#pragma once

#include <cstdint>
#include <optional>

#include "rti/standard/standard_headers.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::standard {

/// The topmost byte of a tag that this library writes.
inline constexpr unsigned tag_mark = 0x80;      ///< written by this library
inline constexpr unsigned tag_has_time = 0x40;  ///< the sender gave a time
inline constexpr unsigned tag_is_apart = 0x20;  ///< tag and parameters stand in the interaction
inline constexpr unsigned tag_goes_on = 0x10;   ///< up to 6 further bytes stand in the stamp's time
inline constexpr unsigned tag_size_bits = 0x07;

/// At most 7 bytes of a tag, the first one lowest.
std::uint64_t tag_word(rti::Bytes tag, unsigned flags);

/// The tag of an update or a deletion, in the stamp: 7 bytes, and 6 more in place of a time that
/// the message has not. Throws RTIinternalError for a longer one. An empty tag is 0.
rti::Stamp tag_stamp(rti1516e::VariableLengthData const& tag, std::optional<double> time);
struct ReceivedTag {
  rti1516e::VariableLengthData tag;
  bool has_time = false;
};
/// Tags of federates that use Rink's own API are their 8 bytes, the most significant first.
ReceivedTag read_tag(const rti::Stamp& stamp);

/// The sender gave a time. Of federates that use Rink's own API, false.
bool tag_gives_time(const rti::Stamp& stamp);

/// Tags that the core carries as they are.
rti::Bytes bytes_of(rti1516e::VariableLengthData const& data);
rti1516e::VariableLengthData data_of(rti::Bytes bytes);

}  // namespace rink::standard
