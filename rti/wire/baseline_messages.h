// The messages by which federate and RTI agree on baselines of periodic state (docs/wire.md,
// "Baselines").
#pragma once

#include "rti/wire/message.h"

namespace rink::rti {

/// A message about one keyframe; numbers wrap around.
template <MessageKind k>
struct KeyframeMessage {
  static constexpr MessageKind kind = k;
  std::uint16_t number = 0;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, KeyframeMessage<k>& message) {
  return stream.number(message.number);
}
/// From the RTI: the deltas that follow in this frame are to be kept as this keyframe.
using BeginKeyframeMessage = KeyframeMessage<MessageKind::begin_keyframe>;
/// From a federate: it keeps all that it was sent of this keyframe.
using AcknowledgeKeyframeMessage = KeyframeMessage<MessageKind::acknowledge_keyframe>;
/// From a federate: it received differences to this keyframe, which it lacks.
using RefuseKeyframeMessage = KeyframeMessage<MessageKind::refuse_keyframe>;

/// Begins a block of periodic state; its bits follow (rti/baselines/delta_bits.h).
struct DeltasMessage {
  static constexpr MessageKind kind = MessageKind::deltas;
  std::uint16_t object_class = 0;
};
template <class Stream>
bool exchange(Stream& stream, DeltasMessage& message) {
  return stream.varint(message.object_class);
}

}  // namespace rink::rti
