// Closes connections that do not prove themselves, and seals what the others carry.
#include "rti/transport/staged/guard.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "rti/central_component.h"

namespace rink::rti {

Guard::Guard(const SharedKey& key, GuardSettings settings, Clock now_s)
    : key_(key), settings_(std::move(settings)), now_s_(std::move(now_s)) {}

Guard::Admission* Guard::find(ConnectionId connection) {
  if (is_known(connection)) return nullptr;
  for (const auto& each : admissions_)
    if (each->connection == connection) return each.get();
  return nullptr;
}

Guard::Admission& Guard::admission_of(ConnectionId connection) {
  if (Admission* admission = find(connection)) return *admission;
  admissions_.push_back(std::make_unique<Admission>(
      Admission{connection,
                now_s_(),
                Handshake(key_, settings_.role, settings_.federation, draw_nonce()),
                {}}));
  return *admissions_.back();
}

void Guard::forget(ConnectionId connection) {
  std::erase_if(admissions_,
                [connection](const auto& each) { return each->connection == connection; });
}

void Guard::send_handshake(Admission& admission) {
  assert(!is_known(admission.connection));
  const Bytes greeting = admission.handshake.outgoing();
  if (!greeting.empty()) TransportStage::send(admission.connection, std::span(&greeting, 1));
  admission.handshake.clear_outgoing();
}

void Guard::refuse(Admission& admission) {
  if (admission.is_refused) return;
  admission.is_refused = true;
  ++refused_;
  close(admission.connection);
}

void Guard::admit(ConnectionId connection) {
  assert(find(connection) != nullptr && !find(connection)->is_refused);
  const std::vector<std::byte> pending = std::move(find(connection)->pending);
  const Handshake& handshake = find(connection)->handshake;
  const Role own = settings_.role, other = own == Role::rti ? Role::federate : Role::rti;
  sessions_.emplace(connection, Session{Seal(handshake.session_key(own)),
                                        SealReader(handshake.session_key(other))});
  forget(connection);
  if (connection >= is_known_.size()) is_known_.resize(connection + 1);
  is_known_[connection] = true;
  if (const Bytes waiting = pending; !waiting.empty()) send(connection, std::span(&waiting, 1));
  TransportStage::on_open(connection);
}

void Guard::on_open(ConnectionId connection) {
  Admission& admission = admission_of(connection);
  admission.is_open = true;
  send_handshake(admission);
}

void Guard::on_bytes(ConnectionId connection, Bytes bytes) {
  Admission* admission = find(connection);
  if (admission == nullptr) return open(connection, bytes);
  if (admission->is_refused) return;
  const Handshake::State state = admission->handshake.receive(bytes);
  send_handshake(*admission);
  if (state == Handshake::State::failed) refuse(*admission);
  if (state != Handshake::State::proven) return;
  admit(connection);
  open(connection, bytes);
}

Guard::Session* Guard::session_of(ConnectionId connection) {
  const auto found = sessions_.find(connection);
  return found == sessions_.end() ? nullptr : &found->second;
}

void Guard::open(ConnectionId connection, Bytes bytes) {
  Session* const session = session_of(connection);
  if (session == nullptr || session->is_closing) return;
  const Framing framing = session->records.receive(
      bytes, [] { return seal_record_max; },
      [&](Bytes record) {
        if (!session->incoming.open(record, opened_) || opened_.empty()) return false;
        TransportStage::on_bytes(connection, opened_);
        return !session->is_closing;
      });
  if (framing == Framing::sound || session->is_closing) return;
  session->is_broken = true;
  close(connection);
}

/// Nothing is opened for a listener that has closed the connection.
void Guard::close(ConnectionId connection) {
  if (Session* const session = session_of(connection)) session->is_closing = true;
  TransportStage::close(connection);
}

void Guard::on_datagram(ConnectionId connection, Bytes datagram) {
  Session* const session = session_of(connection);
  if (session != nullptr && session->is_closing) return;
  if (session != nullptr && session->incoming.open_datagram(datagram, opened_))
    TransportStage::on_datagram(connection, opened_);
  else ++rejected_datagrams_;
}

/// Who has been unproven for longest goes first; all of them before any that is proven.
bool Guard::on_shortage() {
  for (const auto& each : admissions_)
    if (each->is_open && !each->is_refused && now_s_() - each->since >= stranger_due_s)
      return refuse(*each), true;
  return TransportStage::on_shortage();
}

std::size_t Guard::datagram_max(ConnectionId connection) const {
  const std::size_t most = is_known(connection) ? TransportStage::datagram_max(connection) : 0;
  return most > datagram_seal_size ? most - datagram_seal_size : 0;
}

void Guard::send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) {
  Session* const session = session_of(connection);
  if (session == nullptr) return;
  if (sealed_datagrams_.size() < datagrams.size()) sealed_datagrams_.resize(datagrams.size());
  to_send_.clear();
  for (std::size_t i = 0; i < datagrams.size(); ++i) {
    sealed_datagrams_[i].clear();
    session->outgoing.seal_datagram(datagrams[i], sealed_datagrams_[i]);
    to_send_.push_back({.head = sealed_datagrams_[i], .body = {}});
  }
  TransportStage::send_datagrams(connection, to_send_);
}

void Guard::on_close(ConnectionId connection, CloseReason reason, const std::string& detail) {
  const Admission* admission = find(connection);
  if (admission == nullptr) {
    const Session* const session = session_of(connection);
    const bool was_broken = session != nullptr && session->is_broken;
    sessions_.erase(connection);
    if (!was_broken) return TransportStage::on_close(connection, reason, detail);
    return TransportStage::on_close(connection, CloseReason::failed,
                                    "what came was altered on its way, or not sealed by our key");
  }
  const std::string why = admission->handshake.why();
  const bool was_open = admission->is_open, was_refused = admission->is_refused;
  forget(connection);
  if (settings_.role == Role::rti) return;
  if (!was_open) return TransportStage::on_close(connection, reason, detail);
  if (was_refused) return TransportStage::on_close(connection, CloseReason::failed, why);
  TransportStage::on_close(
      connection, reason,
      reason == CloseReason::closed_by_us
          ? detail
          : "closed before it proved that it has our key: does it ask for one?");
}

void Guard::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  if (!admissions_.empty()) {
    const double now = now_s_();
    for (const auto& each : admissions_)
      if (each->is_open && now - each->since > settings_.patience_s) refuse(*each);
    longest_wait = std::min<std::chrono::nanoseconds>(
        longest_wait,
        std::chrono::milliseconds(100));  // or a silent connection would last as long as a long
                                          // wait
  }
  TransportStage::poll(longest_wait, listener);
}

void Guard::send(ConnectionId connection, std::span<const Bytes> parts) {
  if (Session* const session = session_of(connection)) {
    sealed_.clear();
    session->outgoing.seal(parts, sealed_);
    const Bytes sealed = sealed_.bytes();
    return TransportStage::send(connection, std::span(&sealed, 1));
  }
  if (is_known(connection)) return;         // it has closed
  if (settings_.role == Role::rti) return;  // its user does not know it
  Admission& admission = admission_of(connection);
  for (const Bytes part : parts)
    admission.pending.insert(admission.pending.end(), part.begin(), part.end());
}

}  // namespace rink::rti
