// The messages of ownership management.
#pragma once

#include "rti/ownership/holding.h"
#include "rti/wire/message.h"

namespace rink::rti {

inline constexpr std::size_t ownership_tag_max =
    1024;  ///< longest user-supplied tag of an ownership service [bytes]

/// A federate's request; the numbers are those on the wire.
enum class OwnershipRequest : std::uint8_t {
  divest,
  offer,
  confirm,
  deny_release,
  give_if_wanted,
  withdraw_offer,  // of own attributes
  acquire,
  acquire_if_available,
  cancel_acquisition,  // of others' attributes
};
inline constexpr std::uint8_t ownership_request_max = 8;

/// A notice to a federate; the numbers are those on the wire.
enum class OwnershipNotice : std::uint8_t {
  assumption_requested,
  confirmation_requested,
  acquired,
  unavailable,
  release_requested,
  acquisition_cancelled,
  divested,  ///< answers a divestiture if wanted: these have a new owner
  kept,
  kept_offered,  ///< answers a divestiture if wanted, or a confirmation that came too late: these
                 ///< stay with the receiver, and stay offered
};
inline constexpr std::uint8_t ownership_notice_max = 8;

/// Heads a block of objects (rti/wire/object_block.h).
template <MessageKind k, std::uint8_t word_max>
struct OwnershipMessage {
  static constexpr MessageKind kind = k;
  std::uint8_t word = 0;  ///< an OwnershipRequest upwards, an OwnershipNotice downwards
  AttributeBits attributes = 0;
  Bytes tag;
};
template <class Stream, MessageKind k, std::uint8_t word_max>
bool exchange(Stream& stream, OwnershipMessage<k, word_max>& message) {
  return stream.range(message.word, word_max) && attribute_bits(stream, message.attributes) &&
         message.attributes != 0 &&
         stream.template bytes<std::uint16_t>(message.tag, ownership_tag_max);
}
using OwnershipRequestMessage =
    OwnershipMessage<MessageKind::ownership_request, ownership_request_max>;
using OwnershipNoticeMessage =
    OwnershipMessage<MessageKind::ownership_notice, ownership_notice_max>;

struct QueryOwnershipMessage {
  static constexpr MessageKind kind = MessageKind::query_ownership;
  std::uint32_t object = 0;
  std::uint8_t attribute = 0;
};
template <class Stream>
bool exchange(Stream& stream, QueryOwnershipMessage& message) {
  return stream.varint(message.object) && stream.range(message.attribute, attribute_max - 1);
}

/// `federate` is all ones if the attribute has no owner.
struct InformOwnershipMessage {
  static constexpr MessageKind kind = MessageKind::inform_ownership;
  std::uint32_t object = 0;
  std::uint8_t attribute = 0;
  std::uint32_t federate = FederateHandle::none;
};
template <class Stream>
bool exchange(Stream& stream, InformOwnershipMessage& message) {
  return stream.varint(message.object) && stream.range(message.attribute, attribute_max - 1) &&
         stream.number(message.federate);
}

/// What happens to the sender's objects when it leaves, in whatever way.
struct ResignDirectiveMessage {
  static constexpr MessageKind kind = MessageKind::resign_directive;
  std::uint8_t action = 0;  ///< a ResignAction
};
template <class Stream>
bool exchange(Stream& stream, ResignDirectiveMessage& message) {
  return stream.range(message.action, static_cast<std::uint64_t>(ResignAction::no_action));
}

}  // namespace rink::rti
