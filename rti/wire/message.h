// The kinds of messages between a federate and the RTI, how each is written, and those that carry
// objects, their values and interactions; docs/wire.md specifies the same bytes in words.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "im/basics/checked.h"

#include "rti/federate_ambassador.h"
#include "rti/handles.h"
#include "rti/hla_error.h"
#include "rti/types.h"
#include "rti/wire/attribute_bits.h"
#include "rti/wire/frame.h"
#include "rti/wire/stream.h"

namespace rink::rti {

inline constexpr std::uint32_t protocol_magic = 0x4b4e4952;  ///< "RINK"
inline constexpr std::uint16_t protocol_version = 13;

/// The first byte of each message.
enum class MessageKind : std::uint8_t {
  // federate to RTI
  join = 1,
  resign,
  heartbeat,
  register_synchronization_point,
  synchronization_point_achieved,
  watch_federates,
  publish_object_class,
  subscribe_object_class,
  publish_interaction_class,
  subscribe_interaction_class,
  register_object,
  delete_object,
  updates,
  interaction,
  create_region,
  modify_regions,
  associate_region,
  delete_region,
  stamp,
  enable_time_regulation = 28,
  time_switch = 29,
  modify_lookahead = 30,
  advance_request = 31,
  timed_send = 32,
  retract = 33,
  query_time_bounds = 34,
  ownership_request = 36,
  query_ownership = 37,
  resign_directive = 38,
  create_region_over = 52,
  modify_ranges = 53,
  regional_class = 54,
  regional_interaction = 55,
  associate_regions = 56,
  interaction_within = 57,
  // federation management
  create_federation_execution = 20,
  destroy_federation_execution = 21,
  list_federation_executions = 22,
  query_management = 23,
  save_request = 24,
  ambassador_state = 25,
  // objects and declarations
  request_update = 39,
  change_transportation = 40,
  query_transportation = 41,
  instance_names = 46,
  spare_update = 47,
  local_delete = 48,
  advisory_switch = 49,
  // free: 26 and 27 federation management, 35 time, 42 to 45 ownership, 61 and 62 the connection
  // baselines
  acknowledge_keyframe = 50,
  refuse_keyframe = 51,
  notify_host = 60,
  acknowledge_datagrams = 63,  // in datagrams only, both ways (rti/wire/datagram.h)
  // admission, where a key is shared: before anything else
  hello = 58,
  proof = 59,
  // RTI to federate
  joined = 64,
  refused,
  announce_synchronization_point,
  federation_synchronized,
  federate_joined,
  federate_resigned,
  discover_object,
  remove_object,
  in_scope,
  out_of_scope,
  time_regulation_enabled = 82,
  time_constrained_enabled = 83,
  time_advance_grant = 84,
  timed_delivery = 85,
  request_retraction = 86,
  time_bounds = 87,
  fom_digest = 112,
  provide_update = 113,
  // federation management
  synchronization_point_registered = 74,
  federation_execution_created = 75,
  federation_execution_destroyed = 76,
  federation_execution = 77,
  federation_report = 78,
  federate_report = 79,
  report_end = 80,
  save_notice = 81,
  restored = 123,
  save_status = 124,
  // baselines
  begin_keyframe = 110,
  deltas = 111,
  residuals = 114,
  stamp_step = 115,
  entries = 116,
  entries_again = 117,
  ownership_notice = 92,
  inform_ownership = 93,
  // admission
  challenge = 118,
  admitted = 119,
  // the connection
  expelled = 120,
  further_block = 121,
  host_message = 122,
  // objects and declarations
  instance_names_answer = 104,
  class_relevance = 105,
  object_relevance = 106,
  transportation = 107,
  // free: 88 to 91 time, 94 to 103 ownership, 108 and 109 objects and declarations, 125 to 127 the
  // connection
};

/// Bytes of `message` with its kind.
template <class Message>
std::size_t measure(Message& message);
/// Appends `message` with its kind.
template <class Message>
void write(std::vector<std::byte>& bytes, Message& message);

/// A message that is its kind and nothing else.
template <MessageKind k>
struct BareMessage {
  static constexpr MessageKind kind = k;
};
template <class Stream, MessageKind k>
bool exchange(Stream&, BareMessage<k>&) {
  return true;
}

/// An object appears: registered by its owner, or discovered by others.
template <MessageKind k>
struct ObjectMessage {
  static constexpr MessageKind kind = k;
  std::uint32_t object = 0;
  std::uint16_t object_class = 0;
  std::string_view name;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, ObjectMessage<k>& message) {
  return stream.varint(message.object) && stream.varint(message.object_class) &&
         stream.text(message.name, text_max);
}
using RegisterObjectMessage = ObjectMessage<MessageKind::register_object>;
using DiscoverObjectMessage = ObjectMessage<MessageKind::discover_object>;

template <MessageKind k>
struct ObjectHandleMessage {
  static constexpr MessageKind kind = k;
  std::uint32_t object = 0;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, ObjectHandleMessage<k>& message) {
  return stream.varint(message.object);
}
using DeleteObjectMessage = ObjectHandleMessage<MessageKind::delete_object>;
using RemoveObjectMessage = ObjectHandleMessage<MessageKind::remove_object>;
/// Blocks of objects (rti/wire/object_block.h).
using InScopeMessage = BareMessage<MessageKind::in_scope>;
using OutOfScopeMessage = BareMessage<MessageKind::out_of_scope>;

/// First how many bytes of time and tag follow, four bits each, then these: the highest of the
/// time, since an instant on a binary grid ends in zeros, and the lowest of the tag. An instant of
/// a match on a grid of 1/1024 s takes 4 of 8 bytes, and an unused tag none.
template <class Stream>
bool exchange(Stream& stream, Stamp& stamp) {
  std::uint64_t time = std::bit_cast<std::uint64_t>(stamp.time);
  auto time_size = static_cast<std::size_t>(time == 0 ? 0 : 8 - std::countr_zero(time) / 8),
       tag_size = static_cast<std::size_t>((std::bit_width(stamp.tag) + 7) / 8);
  auto sizes = static_cast<std::uint8_t>(time_size | tag_size << 4);
  if (!stream.number(sizes)) return false;
  time_size = sizes & 15u, tag_size = sizes >> 4;
  const std::size_t shift = time_size == 0 || time_size > 8 ? 0 : 8 * (8 - time_size);
  time >>= shift;
  if (!stream.part(time, time_size) || !stream.part(stamp.tag, tag_size)) return false;
  if (Stream::is_reading) stamp.time = std::bit_cast<double>(time << shift);
  return std::isfinite(stamp.time);
}

/// The stamp of all blocks of updates that follow it in its frame, in both directions.
struct StampMessage {
  static constexpr MessageKind kind = MessageKind::stamp;
  static constexpr std::size_t size_max = 1 + 1 + 16;
  Stamp stamp;
};
template <class Stream>
bool exchange(Stream& stream, StampMessage& message) {
  return exchange(stream, message.stamp);
}

/// Begins a block of updates of one class and attribute set, in both directions; its records follow
/// until a zero (rti/wire/update_block.h).
struct UpdatesMessage {
  static constexpr MessageKind kind = MessageKind::updates;
  std::uint16_t object_class = 0;
  AttributeBits attributes = 0;
};
template <class Stream>
bool exchange(Stream& stream, UpdatesMessage& message) {
  return stream.varint(message.object_class) && attribute_bits(stream, message.attributes);
}
/// Begins a block of objects that come into scope with these attributes (rti/wire/entry_block.h).
/// Values of the repeated ones do not follow: they are those of the class's last entry. Of the
/// recalled ones a byte follows, which names a value that an entry of the class brought before.
struct EntriesMessage {
  static constexpr MessageKind kind = MessageKind::entries;
  std::uint16_t object_class = 0;
  AttributeBits attributes = 0, repeated = 0, recalled = 0;
  friend bool operator==(const EntriesMessage&, const EntriesMessage&) = default;
};
template <class Stream>
bool exchange(Stream& stream, EntriesMessage& message) {
  std::uint32_t head = message.object_class * 2u + (message.recalled != 0 ? 1u : 0u);
  if (!stream.varint(head) || !stream.check(head >> 17 == 0)) return false;
  message.object_class = static_cast<std::uint16_t>(head >> 1);
  return attribute_bits(stream, message.attributes) && attribute_bits(stream, message.repeated) &&
         ((head & 1u) == 0 ||
          (attribute_bits(stream, message.recalled) && stream.check(message.recalled != 0)));
}
using EntriesAgainMessage = BareMessage<MessageKind::entries_again>;

/// Upwards `federate` is the only receiver, or all ones for every subscriber; downwards it is the
/// sender.
struct InteractionMessage {
  static constexpr MessageKind kind = MessageKind::interaction;
  std::uint16_t interaction_class = 0;
  std::uint32_t federate = FederateHandle::none;
  Stamp stamp;
  Bytes parameters;
};
template <class Stream>
bool exchange(Stream& stream, InteractionMessage& message) {
  return stream.number(message.interaction_class) && stream.number(message.federate) &&
         exchange(stream, message.stamp) &&
         stream.template bytes<std::uint16_t>(message.parameters, parameters_max);
}

template <class Message>
std::size_t measure(Message& message) {
  Measurer measurer;
  exchange(measurer, message);
  return 1 + measurer.size();
}

template <class Message>
void write(std::vector<std::byte>& bytes, Message& message) {
  [[maybe_unused]] const std::size_t before = bytes.size();
  Writer writer(bytes);
  auto kind = static_cast<std::uint8_t>(Message::kind);
  writer.number(kind);
  [[maybe_unused]] const bool is_written = exchange(writer, message);
  assert(is_written);
  assert(!checks_whole_structures || bytes.size() - before == measure(message));
}

}  // namespace rink::rti
