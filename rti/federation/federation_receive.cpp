// What federates say: checked once, here; then it is state.
#include <algorithm>
#include <cassert>
#include <utility>

#include "rti/federation/federation_parts.h"
#include "rti/federation/message_table.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

void FederationParts::receive(ConnectionId id, Bytes bytes) {
  if (id >= connections_.size() || connections_[id].phase == Phase::unknown) return;
  counters_.bytes_received += bytes.size();
  // A stranger's frame counts when it is whole: one byte now and then says nothing.
  connections_[id].has_spoken |= connections_[id].phase == Phase::joined;
  if (connections_[id].phase == Phase::joined)
    federates_[connections_[id].federate].counts.bytes_sent += bytes.size();
  // The reader leaves its connection meanwhile: dropping the connection must not pull it from under
  // our feet.
  FrameReader reader = std::move(connections_[id].reader);
  Outcome outcome;
  const auto limit = [&] {
    return connections_[id].phase == Phase::joined ? frame_max_to_rti : frame_max_to_join;
  };
  const auto take = [&](Bytes frame) {
    outcome = take_frame(id, frame);
    return !outcome && connections_[id].phase != Phase::unknown;
  };
  switch (reader.receive(bytes, limit, take)) {
    case Framing::sound:
      connections_[id].reader = std::move(reader);
      break;
    case Framing::empty:
      expel(id, Violation::malformed, ResignReason::misbehaved,
            "it sent a frame without a message");
      break;
    case Framing::oversized:
      expel(id, Violation::oversized, ResignReason::misbehaved, explain(Violation::oversized));
      break;
    case Framing::stopped:
      if (outcome) expel(id, *outcome, ResignReason::misbehaved, explain(*outcome));
      assert(connections_[id].phase == Phase::unknown);
  }
}

void FederationParts::receive_datagram(ConnectionId id, Bytes datagram) {
  if (id >= connections_.size() || connections_[id].phase != Phase::joined) return;
  counters_.bytes_received += datagram.size();
  connections_[id].has_spoken = true;
  const std::uint32_t slot = connections_[id].federate;
  federates_[slot].counts.bytes_sent += datagram.size();
  best_effort_receiver_.receive(slot, datagram);
}

Outcome FederationParts::take_frame(ConnectionId id, Bytes frame) {
  ++counters_.frames_received;
  connections_[id].has_spoken = true;
  if (connections_[id].phase == Phase::joined) {
    updates_.begin_frame(connections_[id].federate);
    arrivals_.hear_frame(connections_[id].federate);
  }
  Reader reader(frame);
  while (!reader.is_at_end() && connections_[id].phase != Phase::unknown) {
    if (connections_[id].phase == Phase::joined) {
      if (const Outcome outcome = take_message(*this, connections_[id].federate, reader))
        return outcome;
      continue;
    }
    std::uint8_t kind = 0;
    reader.number(kind);
    const bool is_join = static_cast<MessageKind>(kind) == MessageKind::join;
    if (const Outcome outcome = is_join
                                    ? join(id, reader)
                                    : answer_stranger(id, static_cast<MessageKind>(kind), reader))
      return outcome;
  }
  if (connections_[id].phase != Phase::joined) return std::nullopt;
  best_effort_receiver_.take_held(connections_[id].federate);
  return std::nullopt;
}

}  // namespace rink::rti
