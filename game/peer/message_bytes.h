// Writes any message as bytes and reads it, by the stream of world snapshots and the message's one
// function `exchange`, with a checksum at the end.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/snapshot_stream.h"

namespace rink::peer {

template <class Message>
std::vector<std::uint8_t> bytes_from(Message& message, int checksum_bytes = 8) {
  physics::SnapshotWriter writer;
  exchange(writer, message);
  return writer.finish(checksum_bytes);
}

/// False, with the message in no particular state, unless the bytes are one whole message. Of a
/// message that says another version than this program's only the version is read.
template <class Message>
bool read_whole(std::span<const std::uint8_t> bytes, Message& message, int checksum_bytes = 8) {
  physics::SnapshotReader reader(bytes);
  if (!reader.is_intact(checksum_bytes) || !exchange(reader, message)) return false;
  if constexpr (requires { message.is_of_this_version(); })
    if (!message.is_of_this_version()) return true;
  return reader.is_at_end();
}

}  // namespace rink::peer
