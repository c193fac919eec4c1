// The messages of time management, in both directions; docs/wire.md specifies the same bytes in
// words.
#pragma once

#include "rti/time/logical_time.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// True of messages that carry values in receive order, for which a constrained federate may have
/// to wait.
inline bool is_receive_ordered(MessageKind kind) {
  return kind == MessageKind::updates || kind == MessageKind::interaction ||
         kind == MessageKind::remove_object || kind == MessageKind::residuals;
}

/// The longest message inside a `TimedMessage`: the longest values or parameters and what precedes
/// them.
inline constexpr std::size_t content_max = values_max + 64;

template <MessageKind k>
struct SecondsMessage {
  static constexpr MessageKind kind = k;
  double seconds = 0.0;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, SecondsMessage<k>& message) {
  return stream.finite(message.seconds) && message.seconds >= 0.0;
}
using EnableTimeRegulationMessage =
    SecondsMessage<MessageKind::enable_time_regulation>;  ///< the lookahead
using ModifyLookaheadMessage = SecondsMessage<MessageKind::modify_lookahead>;
using TimeConstrainedEnabledMessage = SecondsMessage<MessageKind::time_constrained_enabled>;
using TimeAdvanceGrantMessage = SecondsMessage<MessageKind::time_advance_grant>;

/// Switches of time management that need no number.
enum class TimeSwitch : std::uint8_t {
  enable_constrained,
  disable_constrained,
  disable_regulation
};
inline constexpr std::uint8_t time_switch_max =
    static_cast<std::uint8_t>(TimeSwitch::disable_regulation);
struct TimeSwitchMessage {
  static constexpr MessageKind kind = MessageKind::time_switch;
  std::uint8_t which = 0;  ///< a `TimeSwitch`
};
template <class Stream>
bool exchange(Stream& stream, TimeSwitchMessage& message) {
  return stream.range(message.which, time_switch_max);
}

struct AdvanceRequestMessage {
  static constexpr MessageKind kind = MessageKind::advance_request;
  std::uint8_t advance = 0;  ///< an `AdvanceKind`
  double time = 0.0;
};
template <class Stream>
bool exchange(Stream& stream, AdvanceRequestMessage& message) {
  return stream.range(message.advance, advance_kind_max) && stream.finite(message.time);
}

/// A message in time-stamp order. `content` is one whole message: an update block of one record, an
/// interaction (whose own stamp is all zero, since this one holds) or a deletion. Upwards `sender`
/// is left out, since the connection tells it.
template <MessageKind k>
struct TimedMessage {
  static constexpr MessageKind kind = k;
  std::uint32_t sender = FederateHandle::none;
  std::uint8_t is_in_order =
      0;  ///< downwards: 1 if the receiver is constrained; else the message came without order
  std::uint64_t number = 0;  ///< the sender's count
  Stamp stamp;
  Bytes content;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, TimedMessage<k>& message) {
  if (k == MessageKind::timed_delivery &&
      (!stream.varint(message.sender) || !stream.range(message.is_in_order, 1)))
    return false;
  return stream.varint(message.number) && exchange(stream, message.stamp) &&
         stream.template bytes<std::uint16_t>(message.content, content_max);
}
using TimedSendMessage = TimedMessage<MessageKind::timed_send>;
using TimedDeliveryMessage = TimedMessage<MessageKind::timed_delivery>;

/// The sender retracts a message; receivers that have it are asked to retract it too.
struct RetractMessage {
  static constexpr MessageKind kind = MessageKind::retract;
  std::uint64_t number = 0;
};
template <class Stream>
bool exchange(Stream& stream, RetractMessage& message) {
  return stream.varint(message.number);
}
struct RequestRetractionMessage {
  static constexpr MessageKind kind = MessageKind::request_retraction;
  std::uint32_t sender = 0;
  std::uint64_t number = 0;
  double time = 0.0;
};
template <class Stream>
bool exchange(Stream& stream, RequestRetractionMessage& message) {
  return stream.varint(message.sender) && stream.varint(message.number) &&
         stream.finite(message.time);
}

struct TimeRegulationEnabledMessage {
  static constexpr MessageKind kind = MessageKind::time_regulation_enabled;
  double time = 0.0;
  double earliest = 0.0;  ///< the least time stamp that it may use
};
template <class Stream>
bool exchange(Stream& stream, TimeRegulationEnabledMessage& message) {
  return stream.finite(message.time) && stream.finite(message.earliest);
}

using QueryTimeBoundsMessage = BareMessage<MessageKind::query_time_bounds>;
/// Infinity stands for a bound that no federate sets.
struct TimeBoundsMessage {
  static constexpr MessageKind kind = MessageKind::time_bounds;
  double galt = 0.0, lits = 0.0;
};
template <class Stream>
bool exchange(Stream& stream, TimeBoundsMessage& message) {
  return stream.number(message.galt) && stream.number(message.lits) && message.galt >= 0.0 &&
         message.lits >= 0.0;
}

}  // namespace rink::rti
