// The messages by which a federate joins and leaves, and is notified of those that do.
#pragma once

#include <cstdint>
#include <string_view>

#include "rti/membership.h"
#include "rti/wire/message.h"

namespace rink::rti {

struct JoinMessage {
  static constexpr MessageKind kind = MessageKind::join;
  std::uint32_t magic = protocol_magic;
  std::uint16_t version = protocol_version;
  std::uint64_t fom_hash = 0;
  std::string_view federation, name, type;
};
/// What follows the version belongs to that version: a reader of another version stops there.
template <class Stream>
bool exchange(Stream& stream, JoinMessage& message) {
  if (!stream.number(message.magic) || !stream.number(message.version)) return false;
  if (message.magic != protocol_magic) return false;
  if (message.version != protocol_version) return true;
  return stream.number(message.fom_hash) && stream.text(message.federation, text_max) &&
         stream.text(message.name, text_max) && stream.text(message.type, text_max);
}

using ResignMessage = BareMessage<MessageKind::resign>;
using HeartbeatMessage = BareMessage<MessageKind::heartbeat>;
using WatchFederatesMessage = BareMessage<MessageKind::watch_federates>;

struct JoinedMessage {
  static constexpr MessageKind kind = MessageKind::joined;
  std::uint32_t federate = 0;
  std::uint32_t object_block = 0;
};
template <class Stream>
bool exchange(Stream& stream, JoinedMessage& message) {
  return stream.number(message.federate) &&
         stream.range(message.object_block, object_block_max - 1);
}

/// The block for the federate's objects once the present one is used up.
struct FurtherBlockMessage {
  static constexpr MessageKind kind = MessageKind::further_block;
  std::uint32_t object_block = 0;
};
template <class Stream>
bool exchange(Stream& stream, FurtherBlockMessage& message) {
  return stream.range(message.object_block, object_block_max - 1);
}

/// The same in every version of the protocol, so that a refused federate of another version can
/// read it.
struct RefusedMessage {
  static constexpr MessageKind kind = MessageKind::refused;
  std::uint8_t refusal = 0;
  std::string_view why;
};
template <class Stream>
bool exchange(Stream& stream, RefusedMessage& message) {
  return stream.number(message.refusal) && stream.text(message.why, text_max);
}

/// The last message to a federate that is dropped: the reason. Its connection closes.
struct ExpelledMessage {
  static constexpr MessageKind kind = MessageKind::expelled;
  std::string_view why;
};
template <class Stream>
bool exchange(Stream& stream, ExpelledMessage& message) {
  return stream.text(message.why, text_max);
}

struct FederateJoinedMessage {
  static constexpr MessageKind kind = MessageKind::federate_joined;
  std::uint32_t federate = 0;
  std::string_view name, type;
};
template <class Stream>
bool exchange(Stream& stream, FederateJoinedMessage& message) {
  return stream.number(message.federate) && stream.text(message.name, text_max) &&
         stream.text(message.type, text_max);
}

struct FederateResignedMessage {
  static constexpr MessageKind kind = MessageKind::federate_resigned;
  std::uint32_t federate = 0;
  std::uint8_t reason = 0;
  std::string_view name, type;
};
template <class Stream>
bool exchange(Stream& stream, FederateResignedMessage& message) {
  return stream.number(message.federate) &&
         stream.range(message.reason, static_cast<std::uint64_t>(ResignReason::misbehaved)) &&
         stream.text(message.name, text_max) && stream.text(message.type, text_max);
}

/// What the host of the federation execution sends to one federate; the RTI does not look into it.
struct HostMessage {
  static constexpr MessageKind kind = MessageKind::host_message;
  static constexpr std::size_t size_max = 16u << 20;  ///< bytes
  Bytes content;
};
template <class Stream>
bool exchange(Stream& stream, HostMessage& message) {
  auto size = static_cast<std::uint32_t>(message.content.size());
  return stream.varint(size) && stream.check(size <= HostMessage::size_max) &&
         stream.rest(message.content, size);
}
/// To the host, which knows what it means.
using NotifyHostMessage = BareMessage<MessageKind::notify_host>;

}  // namespace rink::rti
