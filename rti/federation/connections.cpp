// Reads frames and messages from bytes, and drops connections.
#include "rti/federation/connections.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "rti/federation/oldest_stranger.h"
#include "rti/fom/fom_digest.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/fom_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

void Connections::connect(ConnectionId id) {
  if (id >= connections_.size()) connections_.resize(id + 1);
  connections_[id] = {};
  connections_[id].phase = Phase::connected;
  connections_[id].since = basis_.now;
}

std::optional<ConnectionId> Connections::oldest_stranger(
    const CentralComponent::ConnectionTest& test) const {
  return oldest_stranger_of(connections_, basis_.now, [&](ConnectionId id) {
    return connections_[id].phase == Phase::connected && test(id);
  });
}

void Connections::disconnect(ConnectionId id) {
  if (id >= connections_.size()) return;
  if (is_joined(id)) handler_.remove(connections_[id].federate, ResignReason::lost);
  connections_[id] = {};
  forget_words(id);
}

void Connections::forget_words(ConnectionId id) {
  for (std::vector<PendingClose>* words : {&answers_, &pending_closes_})
    std::erase_if(*words, [id](const PendingClose& each) { return each.connection == id; });
}

void Connections::advance_clock(bool is_behind) {
  const double lost_after_s = basis_.settings.timeouts.lost_after_s;
  const double passed_s = basis_.now - advanced_s_.value_or(basis_.now);
  advanced_s_ = basis_.now;
  for (ConnectionId id = 0; id < connections_.size(); ++id) {
    FederationConnection& connection = connections_[id];
    if (connection.phase == Phase::unknown) continue;
    connection.silence.advance(passed_s, is_behind, lost_after_s);
    if (connection.silence.lasted_s() > lost_after_s)
      expel(id, Violation::silent, ResignReason::lost, explain(Violation::silent));
  }
}

void Connections::expel(ConnectionId id, Violation violation, ResignReason reason,
                        std::string_view why) {
  assert(id < connections_.size());
  ++basis_.counters.drops[static_cast<std::size_t>(violation)];
  // An unjoined connection that breaks a rule gets no answer: it may be another program altogether.
  const bool was_joined = is_joined(id);
  if (was_joined) handler_.remove(connections_[id].federate, reason);
  connections_[id] = {};
  pending_closes_.push_back(
      {id, std::string(why), was_joined ? framed(ExpelledMessage{why}) : std::vector<std::byte>()});
}

void Connections::take_over(Connections& former, const std::vector<std::uint32_t>& slots) {
  advanced_s_ = former.advanced_s_;
  connections_ = std::move(former.connections_);
  report_queries_ = std::move(former.report_queries_);
  pending_closes_ = std::move(former.pending_closes_);
  answers_ = std::move(former.answers_);
  for (FederationConnection& each : connections_)
    if (each.phase == Phase::joined) each.federate = slots[each.federate];
}

Status Connections::resign(ConnectionId id) {
  assert(is_joined(id));
  handler_.remove(connections_[id].federate, ResignReason::resigned);
  connections_[id] = {};
  pending_closes_.push_back({id, "resigned", {}});
  return std::nullopt;
}

void Connections::receive(ConnectionId id, Bytes bytes) {
  if (is_unknown(id)) return;
  basis_.counters.bytes_received += bytes.size();
  // Of an unjoined connection only whole frames count as signs of life: one byte now and then does
  // not.
  if (is_joined(id)) connections_[id].silence.broken();
  if (is_joined(id)) basis_.federates[connections_[id].federate].counts.bytes_sent += bytes.size();
  // The reader is moved out meanwhile, so that dropping the connection does not destroy it while it
  // reads.
  FrameReader reader = std::move(connections_[id].reader);
  Status status;
  const auto limit = [&] { return is_joined(id) ? frame_max_to_rti : frame_max_to_join; };
  const auto take = [&](Bytes frame) {
    if (is_joined(id) && reader.form() == FrameForm::older) status = Violation::malformed;
    else status = handle_frame(id, frame);
    return !status && !is_unknown(id);
  };
  const Framing framing = reader.receive(bytes, limit, take);
  if (framing == Framing::sound) connections_[id].reader = std::move(reader);
  else punish(id, framing, status);
}

void Connections::punish(ConnectionId id, Framing framing, const Status& status) {
  if (framing == Framing::empty)
    expel(id, Violation::malformed, ResignReason::misbehaved, "it sent a frame without a message");
  if (framing == Framing::oversized)
    expel(id, Violation::oversized, ResignReason::misbehaved, explain(Violation::oversized));
  if (framing == Framing::stopped && status)
    expel(id, *status, ResignReason::misbehaved, explain(*status));
  assert(is_unknown(id));
}

void Connections::receive_datagram(ConnectionId id, Bytes datagram) {
  if (is_unknown(id) || !is_joined(id)) return;
  basis_.counters.bytes_received += datagram.size();
  connections_[id].silence.broken();
  const std::uint32_t slot = connections_[id].federate;
  basis_.federates[slot].counts.bytes_sent += datagram.size();
  handler_.handle_datagram(slot, datagram);
}

Status Connections::handle_frame(ConnectionId id, Bytes frame) {
  ++basis_.counters.frames_received;
  connections_[id].silence.broken();
  if (is_joined(id)) handler_.begin_frame(connections_[id].federate);
  Reader reader(frame);
  while (!reader.is_at_end() && !is_unknown(id))
    if (const Status status = handle_message(id, reader)) return status;
  if (is_joined(id)) handler_.end_frame(connections_[id].federate);
  return std::nullopt;
}

Status Connections::handle_message(ConnectionId id, Reader& reader) {
  if (is_joined(id)) return handler_.handle_message(connections_[id].federate, reader);
  std::uint8_t kind = 0;
  reader.number(kind);
  return static_cast<MessageKind>(kind) == MessageKind::join
             ? join(id, reader)
             : answer_unjoined(id, static_cast<MessageKind>(kind), reader);
}

Status Connections::join(ConnectionId id, Reader& reader) {
  JoinMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (const auto objection = membership_.objection(message))
    return refuse(id, *objection), std::nullopt;
  const std::uint32_t slot = handler_.admit(id, message);
  connections_[id].phase = Phase::joined;
  connections_[id].federate = slot;
  return std::nullopt;
}

void Connections::refuse(ConnectionId id, const Membership::Objection& objection) {
  expel(id, Violation::refused, ResignReason::misbehaved, objection.why);
  std::vector<std::byte>& bytes = pending_closes_.back().bytes;
  if (objection.refusal == Refusal::wrong_fom) bytes = framed_digest();
  const std::vector<std::byte> refused =
      framed(RefusedMessage{static_cast<std::uint8_t>(objection.refusal), objection.why});
  bytes.insert(bytes.end(), refused.begin(), refused.end());
}

/// The federate finds out from the digest where its own model differs. Empty for a model that is
/// too large for one.
std::vector<std::byte> Connections::framed_digest() const {
  const std::vector<FomDigestEntry> entries = digest(basis_.fom);
  if (entries.size() > FomDigestMessage::count_max) return {};
  return framed(FomDigestMessage{static_cast<std::uint16_t>(entries.size()),
                                 std::as_bytes(std::span(entries))});
}

void Connections::close_pending(Outlet& outlet) {
  for (const PendingClose& each : pending_closes_) {
    const Bytes bytes = each.bytes;
    if (!bytes.empty()) outlet.send(each.connection, std::span(&bytes, 1));
    outlet.drop(each.connection, each.why);
  }
  pending_closes_.clear();
}

}  // namespace rink::rti
