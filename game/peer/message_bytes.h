// Writes any message as bytes and reads it, by the message's one function `exchange`, with the
// checksum of snapshots at the end.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/snapshot_stream.h"

namespace rink::peer {

template <class Message>
std::vector<std::uint8_t> bytes_from(Message& message, std::size_t checksum_size = 8) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(64);  // most messages are short: their bytes are allocated once
  physics::SnapshotWriter writer(bytes);
  exchange(writer, message);
  physics::add_checksum(bytes, checksum_size);
  return bytes;
}

/// False, with the message in no particular state, unless the bytes are one whole message. Of a
/// message that says another version than this program's only the version is read.
template <class Message>
bool read_whole(std::span<const std::uint8_t> bytes, Message& message,
                std::size_t checksum_size = 8) {
  const auto content = physics::without_checksum(bytes, checksum_size);
  if (!content) return false;
  ByteReader reader(*content);
  if (!exchange(reader, message)) return false;
  if constexpr (requires { message.is_of_this_version(); })
    if (!message.is_of_this_version()) return true;
  return reader.is_at_end();
}

}  // namespace rink::peer
