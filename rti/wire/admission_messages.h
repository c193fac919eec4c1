// The messages by which both ends prove that they have the same key, before anything else is sent
// (docs/wire.md).
#pragma once

#include <array>

#include "rti/wire/message.h"

namespace rink::rti {

/// 32 bytes: a nonce or a proof.
template <class Stream>
bool exchange_block(Stream& stream, std::array<std::byte, 32>& block) {
  Bytes view = block;
  if (!stream.rest(view, block.size())) return false;
  if constexpr (Stream::is_reading) std::copy(view.begin(), view.end(), block.begin());
  return true;
}

struct HelloMessage {
  static constexpr MessageKind kind = MessageKind::hello;
  std::uint16_t version = protocol_version;
  std::array<std::byte, 32> nonce{};
  std::string_view federation;
};
/// What follows the version belongs to that version.
template <class Stream>
bool exchange(Stream& stream, HelloMessage& message) {
  if (!stream.number(message.version)) return false;
  if (message.version != protocol_version) return true;
  return exchange_block(stream, message.nonce) && stream.text(message.federation, text_max);
}

/// A message of one block.
template <MessageKind k>
struct BlockMessage {
  static constexpr MessageKind kind = k;
  std::array<std::byte, 32> block{};
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, BlockMessage<k>& message) {
  return exchange_block(stream, message.block);
}
using ProofMessage = BlockMessage<MessageKind::proof>;          ///< the federate's
using ChallengeMessage = BlockMessage<MessageKind::challenge>;  ///< the RTI's nonce
using AdmittedMessage = BlockMessage<MessageKind::admitted>;    ///< the RTI's proof

}  // namespace rink::rti
