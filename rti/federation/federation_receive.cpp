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

Outcome FederationParts::register_object(std::uint32_t slot, Reader& reader) {
  RegisterObjectMessage message;
  Federate& federate = federates_[slot];
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= fom_.object_classes().size()) return Violation::unknown_name;
  if (publications_.of_class(slot, message.object_class).is_empty()) return Violation::undeclared;
  const std::size_t alive = registered_alive(federate);
  if (alive >= settings_.objects_per_federate_max) return Violation::over_limit;
  if (federate.objects_registered == object_block) extend_block(federate);
  // Handles come in order, so that a stranger can't make the table grow by naming a great one.
  if (message.object != federate.block * object_block + federate.objects_registered)
    return Violation::unknown_name;
  if (++federate.objects_registered == object_block / 2 && federates_.has_block()) {
    federate.further_block = federates_.take_block();
    federate.outbox.before_updates(FurtherBlockMessage{*federate.further_block});
  }
  federate.name_bytes += message.name.size();
  // Those who have more than their share are refused first, so nobody's hoard keeps others from
  // theirs.
  const bool is_full = objects_.size() >= settings_.object_max &&
                       alive >= settings_.object_max / federates_.joined_count();
  if (is_full || federate.name_bytes > settings_.name_bytes_per_federate_max)
    return refuse_object(slot, {message.object}), std::nullopt;
  const bool has_name = message.name.empty() || names_.take(slot, message.name);
  interest_.object_registered(objects_.insert({message.object}, slot, message.object_class,
                                              has_name ? message.name : std::string_view()));
  return std::nullopt;
}

std::size_t FederationParts::registered_alive(const Federate& federate) const {
  std::size_t count = objects_.alive_in(federate.block);
  for (const std::uint32_t block : federate.former_blocks) count += objects_.alive_in(block);
  return count;
}

/// Goes on in the block that it was given. Without one it stays where it is, and its next handle is
/// none of its own.
void FederationParts::extend_block(Federate& federate) {
  if (!federate.further_block) return;
  objects_.close_block(federate.block);
  federate.former_blocks.push_back(federate.block);
  federate.block = *std::exchange(federate.further_block, std::nullopt);
  federate.objects_registered = 0;
}

/// Its registrar hears that it is removed; what it says of it meanwhile is late and no crime.
void FederationParts::refuse_object(std::uint32_t slot, ObjectHandle object) {
  objects_.pass_over(object);
  federates_[slot].outbox.after_updates(RemoveObjectMessage{object.value});
}

Outcome FederationParts::delete_object(std::uint32_t slot, Reader& reader) {
  DeleteObjectMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  ObjectSlot object = no_object;
  if (const Outcome outcome = known_.find({message.object}, object); outcome || object == no_object)
    return outcome;
  if (objects_[object].owner != slot &&
      ownership_.owner_of(object, privilege_to_delete_object) != slot)
    return Violation::not_owned;
  ++federates_[slot].objects_deleted;
  delete_object(object);
  return std::nullopt;
}

void FederationParts::delete_object(ObjectSlot object) {
  interest_.object_deleted(object);
  ownership_.forget(object);
  newest_.forget(object);
  arrivals_.forget(objects_[object].handle);
  for (std::uint32_t i = 0; i < federates_.size(); ++i) {
    if (federates_[i].is_joined) interest_.of(i).unannounced.erase(object);
    if (!federates_[i].is_joined || !interest_.of(i).known.contains(object)) continue;
    interest_.of(i).known.erase(object);
    ++federates_[i].objects_removed;
    RemoveObjectMessage removal{objects_[object].handle.value};
    federates_[i].outbox.after_updates(removal);
    counters_.scope_bytes_sent += measure(removal);
  }
  if (!objects_[object].name.empty()) names_.give_back(objects_[object].name);
  transportation_.forget(objects_[object].handle);
  objects_.erase(object);
}

}  // namespace rink::rti
