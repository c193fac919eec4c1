// Connects ambassadors to a transport.
#include "rti/transport/federate_link.h"

#include <cassert>
#include <string>

namespace rink::rti {

void send_waiting(Ambassador& ambassador, Transport& transport, ConnectionId connection) {
  const std::size_t datagram_max = transport.datagram_max(connection);
  ambassador.expect_datagrams(datagram_max);
  const std::span<const Datagram> datagrams = ambassador.outgoing_datagrams();
  if (const Bytes waiting = ambassador.outgoing(); !waiting.empty()) {
    transport.send(connection, std::span(&waiting, 1));
    ambassador.clear_outgoing();
  }
  if (datagrams.empty()) return;
  if (datagram_max > 0) transport.send_datagrams(connection, datagrams);
  transport.push();
  ambassador.clear_outgoing_datagrams();
}

void FederateLink::received(Bytes bytes) {
  if (!ambassador_.receive(bytes)) transport_.close(connection_);
}

void FederateLink::closed(CloseReason reason, const std::string& detail) {
  is_open_ = false;
  is_finished_ = true;
  close_reason_ = reason;
  ambassador_.disconnected(detail.empty() ? to_string(reason) : detail);
}

void FederateLink::flush(double now) {
  if (is_finished_) return;
  ambassador_.advance_clock(now, transport_.is_behind());
  if (!is_open_) return;
  send_waiting(ambassador_, transport_, connection_);
}

void FederateLink::close() {
  if (is_finished_) return;
  const Bytes waiting = ambassador_.outgoing();
  if (is_open_ && !waiting.empty()) transport_.send(connection_, std::span(&waiting, 1));
  ambassador_.clear_outgoing();
  transport_.close(connection_);
}

void FederateLinks::add(FederateLink& link) {
  if (link.connection() >= links_.size()) links_.resize(link.connection() + 1, nullptr);
  assert(find(link.connection()) == nullptr || find(link.connection()) == &link);
  links_[link.connection()] = &link;
}

void FederateLinks::remove(const FederateLink& link) {
  if (find(link.connection()) == &link) links_[link.connection()] = nullptr;
}

void FederateLinks::on_open(ConnectionId connection) {
  if (FederateLink* link = find(connection)) link->opened();
}

void FederateLinks::on_bytes(ConnectionId connection, Bytes bytes) {
  if (FederateLink* link = find(connection)) link->received(bytes);
}

void FederateLinks::on_close(ConnectionId connection, CloseReason reason,
                             const std::string& detail) {
  if (FederateLink* link = find(connection)) link->closed(reason, detail);
}

void FederateLinks::on_datagram(ConnectionId connection, Bytes datagram) {
  if (FederateLink* link = find(connection)) link->received_datagram(datagram);
}

void FederateLinks::flush(double now) {
  for (FederateLink* link : links_)
    if (link != nullptr) link->flush(now);
}

}  // namespace rink::rti
