// What a federate with another object model receives before it is refused.
#pragma once

#include "rti/wire/message.h"

namespace rink::rti {

/// The federation's model, element by element (rti/fom/fom_digest.h): `count` times the hash of a
/// name and of a content, u32 each. Goes before a refusal for a wrong model, unless that has more
/// elements.
struct FomDigestMessage {
  static constexpr MessageKind kind = MessageKind::fom_digest;
  static constexpr std::size_t entry_size = 2 * 4, count_max = 4096;
  std::uint16_t count = 0;
  Bytes entries;
};
template <class Stream>
bool exchange(Stream& stream, FomDigestMessage& message) {
  return stream.range(message.count, FomDigestMessage::count_max) &&
         stream.rest(message.entries, message.count * FomDigestMessage::entry_size);
}

}  // namespace rink::rti
