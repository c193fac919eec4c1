// The messages of federation management: synchronisation points, and requests to a host before a
// federate has joined.
#pragma once

#include "rti/wire/message.h"

namespace rink::rti {

inline constexpr std::size_t synchronization_tag_max =
    1024;  ///< longest user-supplied tag of a synchronisation point [bytes]

/// Federate handles as they travel: how many, then each as a u32.
struct HandleList {
  static constexpr std::size_t count_max = 16'000;
  std::uint16_t count = 0;
  Bytes records;
};
template <class Stream>
bool exchange(Stream& stream, HandleList& list) {
  return stream.range(list.count, HandleList::count_max) &&
         stream.rest(list.records, list.count * sizeof(std::uint32_t));
}
/// The list of `handles`, whose bytes stay where they are.
inline HandleList list_of(std::span<const FederateHandle> handles) {
  static_assert(sizeof(FederateHandle) == sizeof(std::uint32_t));
  assert(handles.size() <= HandleList::count_max);
  return {static_cast<std::uint16_t>(handles.size()), std::as_bytes(handles)};
}
inline std::vector<FederateHandle> handles_of(const HandleList& list) {
  assert(list.records.size() == list.count * sizeof(FederateHandle));
  std::vector<FederateHandle> handles(list.count);
  if (list.count > 0)
    std::memcpy(static_cast<void*>(handles.data()), list.records.data(), list.records.size());
  return handles;
}

/// `message` in a frame of its own, of a form that every version reads: for a connection that has
/// not joined, or may not have.
template <class Message>
std::vector<std::byte> framed(Message message) {
  FrameWriter frame(older_frame_max, FrameForm::older);
  write(frame.begin_message(measure(message)), message);
  frame.appended();
  return {frame.bytes().begin(), frame.bytes().end()};
}

/// Without members the point is for all, those included that join before it is reached.
struct RegisterSynchronizationPointMessage {
  static constexpr MessageKind kind = MessageKind::register_synchronization_point;
  std::string_view label;
  Bytes tag;
  HandleList members;
};
template <class Stream>
bool exchange(Stream& stream, RegisterSynchronizationPointMessage& message) {
  return stream.text(message.label, text_max) &&
         stream.template bytes<std::uint16_t>(message.tag, synchronization_tag_max) &&
         exchange(stream, message.members);
}

struct SynchronizationPointAchievedMessage {
  static constexpr MessageKind kind = MessageKind::synchronization_point_achieved;
  std::string_view label;
  std::uint8_t is_success = 1;
};
template <class Stream>
bool exchange(Stream& stream, SynchronizationPointAchievedMessage& message) {
  return stream.text(message.label, text_max) && stream.range(message.is_success, 1);
}

struct SynchronizationPointRegisteredMessage {
  static constexpr MessageKind kind = MessageKind::synchronization_point_registered;
  std::string_view label;
  std::uint8_t failure = 0;  ///< 0: it is registered; else a `SynchronizationFailure`
};
template <class Stream>
bool exchange(Stream& stream, SynchronizationPointRegisteredMessage& message) {
  return stream.text(message.label, text_max) &&
         stream.range(message.failure,
                      static_cast<std::uint64_t>(SynchronizationFailure::over_limit));
}

struct AnnounceSynchronizationPointMessage {
  static constexpr MessageKind kind = MessageKind::announce_synchronization_point;
  std::string_view label;
  Bytes tag;
};
template <class Stream>
bool exchange(Stream& stream, AnnounceSynchronizationPointMessage& message) {
  return stream.text(message.label, text_max) &&
         stream.template bytes<std::uint16_t>(message.tag, synchronization_tag_max);
}

struct FederationSynchronizedMessage {
  static constexpr MessageKind kind = MessageKind::federation_synchronized;
  std::string_view label;
  HandleList failed;
};
template <class Stream>
bool exchange(Stream& stream, FederationSynchronizedMessage& message) {
  return stream.text(message.label, text_max) && exchange(stream, message.failed);
}

/// Asks a host to make or to remove a federation execution. The model is named by its hash: the
/// host must have it.
struct CreateFederationExecutionMessage {
  static constexpr MessageKind kind = MessageKind::create_federation_execution;
  std::string_view federation;
  std::uint64_t fom_hash = 0;
};
template <class Stream>
bool exchange(Stream& stream, CreateFederationExecutionMessage& message) {
  return stream.text(message.federation, text_max) && stream.number(message.fom_hash);
}

struct DestroyFederationExecutionMessage {
  static constexpr MessageKind kind = MessageKind::destroy_federation_execution;
  std::string_view federation;
};
template <class Stream>
bool exchange(Stream& stream, DestroyFederationExecutionMessage& message) {
  return stream.text(message.federation, text_max);
}

using ListFederationExecutionsMessage = BareMessage<MessageKind::list_federation_executions>;

/// The result of a request to create or destroy: `error` is an `HlaError`, 0 for success.
template <MessageKind k>
struct FederationOutcomeMessage {
  static constexpr MessageKind kind = k;
  std::string_view federation;
  std::uint8_t error = 0;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, FederationOutcomeMessage<k>& message) {
  return stream.text(message.federation, text_max) &&
         stream.range(message.error, static_cast<std::uint64_t>(HlaError::rti_internal_error));
}
using FederationExecutionCreatedMessage =
    FederationOutcomeMessage<MessageKind::federation_execution_created>;
using FederationExecutionDestroyedMessage =
    FederationOutcomeMessage<MessageKind::federation_execution_destroyed>;

/// One federation execution in the list that answers; a last message marks the end, which is all
/// that an empty host sends.
struct FederationExecutionMessage {
  static constexpr MessageKind kind = MessageKind::federation_execution;
  std::uint8_t is_end = 0;  ///< 1: the list is complete, and only this byte is sent
  std::string_view federation, model;
  std::uint32_t federates = 0;
};
template <class Stream>
bool exchange(Stream& stream, FederationExecutionMessage& message) {
  if (!stream.range(message.is_end, 1)) return false;
  return message.is_end == 1 ||
         (stream.text(message.federation, text_max) && stream.text(message.model, text_max) &&
          stream.number(message.federates));
}

}  // namespace rink::rti
