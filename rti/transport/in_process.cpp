// Carries bytes between endpoints of one process.
#include "rti/transport/in_process.h"

#include <cassert>

namespace rink::rti {

InProcessEndpoint::~InProcessEndpoint() {
  for (ConnectionId id = 0; id < lines_.size(); ++id) close(id);
  if (!name_.empty()) network_.listeners_.erase(name_);
}

void InProcessEndpoint::listen(const std::string& name) {
  if (!network_.listeners_.emplace(name, this).second)
    throw TransportError(TransportError::Kind::in_use,
                         "in-process address '" + name + "' is in use");
  name_ = name;
}

ConnectionId InProcessEndpoint::add_line(InProcessEndpoint* peer) {
  lines_.emplace_back().peer = peer;
  return static_cast<ConnectionId>(lines_.size() - 1);
}

ConnectionId InProcessEndpoint::connect(const std::string& name) {
  const auto found = network_.listeners_.find(name);
  if (found == network_.listeners_.end()) {
    const ConnectionId refused = add_line(nullptr);
    events_.add({EventKind::close, refused, CloseReason::refused,
                 "nobody listens at in-process address '" + name + "'"});
    return refused;
  }
  InProcessEndpoint& peer = *found->second;
  const ConnectionId ours = add_line(&peer), theirs = peer.add_line(this);
  lines_[ours].peer_connection = theirs;
  peer.lines_[theirs].peer_connection = ours;
  peer.events_.add({EventKind::open, theirs, {}, {}});
  events_.add({EventKind::open, ours, {}, {}});
  return ours;
}

void InProcessEndpoint::poll(std::chrono::nanoseconds, TransportListener& listener) {
  events_.report_all([&](const Event& event) { report(event, listener); });
}

void InProcessEndpoint::report(const Event& event, TransportListener& listener) {
  assert(event.connection < lines_.size());
  if (event.kind == EventKind::open) return listener.on_open(event.connection);
  if (event.kind == EventKind::close)
    return listener.on_close(event.connection, event.reason, event.detail);
  delivering_.clear();  // a listener that threw may have left some bytes
  delivering_.swap(lines_[event.connection].incoming);
  lines_[event.connection].counters.bytes_received += delivering_.size();
  if (!delivering_.empty()) listener.on_bytes(event.connection, delivering_);
}

void InProcessEndpoint::send(ConnectionId connection, std::span<const Bytes> parts) {
  if (connection >= lines_.size() || lines_[connection].peer == nullptr) return;
  Line& line = lines_[connection];
  Line& there = line.peer->lines_[line.peer_connection];
  const bool was_empty = there.incoming.empty();
  std::size_t size = 0;
  for (const Bytes part : parts) size += part.size();
  if (size == 0) return;
  if (there.incoming.size() + size > network_.queue_max_)
    return part(connection, CloseReason::queue_full, CloseReason::closed_by_peer,
                "the peer did not read");
  for (const Bytes part : parts)
    there.incoming.insert(there.incoming.end(), part.begin(), part.end());
  if (was_empty) line.peer->events_.add({EventKind::bytes, line.peer_connection, {}, {}});
  line.counters.bytes_sent += size;
  line.counters.segments_sent += (size + 1447) / 1448;
  ++line.counters.writes;
}

void InProcessEndpoint::close(ConnectionId connection) {
  if (connection < lines_.size() && lines_[connection].peer != nullptr)
    part(connection, CloseReason::closed_by_us, CloseReason::closed_by_peer, "");
}

void InProcessEndpoint::part(ConnectionId connection, CloseReason ours, CloseReason theirs,
                             const std::string& detail) {
  Line& line = lines_[connection];
  assert(line.peer != nullptr);
  Line& there = line.peer->lines_[line.peer_connection];
  assert(there.peer == this && there.peer_connection == connection);
  line.peer->events_.add({EventKind::close, line.peer_connection, theirs, detail});
  events_.add({EventKind::close, connection, ours, detail});
  there.peer = line.peer = nullptr;
  line.incoming.clear();  // an end that closes does not read what came before
}

std::size_t InProcessEndpoint::queued_bytes(ConnectionId connection) const {
  if (connection >= lines_.size() || lines_[connection].peer == nullptr) return 0;
  return lines_[connection].peer->lines_[lines_[connection].peer_connection].incoming.size();
}

TransportCounters InProcessEndpoint::counters(ConnectionId connection) const {
  if (connection >= lines_.size()) return {};
  TransportCounters counters = lines_[connection].counters;
  counters.queued_bytes = queued_bytes(connection);
  return counters;
}

}  // namespace rink::rti
