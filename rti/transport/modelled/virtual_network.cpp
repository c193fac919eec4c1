// The discrete-event queue and its endpoints.
#include "rti/transport/modelled/virtual_network.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::rti {

std::optional<std::int64_t> VirtualNetwork::next_arrival_ns() const {
  return arrivals_.empty() ? std::nullopt : std::optional(arrivals_.front().instant_ns);
}

void VirtualNetwork::advance_to(std::int64_t until_ns) {
  assert(until_ns >= now_ns_);
  while (!arrivals_.empty() && arrivals_.front().instant_ns <= until_ns) {
    now_ns_ = arrivals_.front().instant_ns;
    std::pop_heap(arrivals_.begin(), arrivals_.end());
    const std::uint32_t parcel = arrivals_.back().parcel;
    arrivals_.pop_back();
    arrive(parcel);
  }
  now_ns_ = until_ns;
}

std::uint32_t VirtualNetwork::take_parcel() {
  if (free_.empty()) {
    parcels_.emplace_back();
    return static_cast<std::uint32_t>(parcels_.size() - 1);
  }
  const std::uint32_t parcel = free_.back();
  free_.pop_back();
  return parcel;
}

void VirtualNetwork::check() const {
  assert(std::is_heap(arrivals_.begin(), arrivals_.end()));
  assert(arrivals_.empty() || arrivals_.front().instant_ns >= now_ns_);
  assert(sent_ >= arrived_ && arrivals_.size() == sent_ - arrived_);
  std::vector<bool> is_seen(parcels_.size());
  const auto see = [&is_seen](std::uint32_t parcel) {
    assert(parcel < is_seen.size() && !is_seen[parcel]);
    is_seen[parcel] = true;
  };
  for (const std::uint32_t parcel : free_) see(parcel);
  for (const Arrival& arrival : arrivals_) see(arrival.parcel);
}

void VirtualNetwork::return_parcel(std::uint32_t parcel) {
  assert(parcel < parcels_.size());
  parcels_[parcel].bytes.clear();
  parcels_[parcel].detail.clear();
  parcels_[parcel].reason = CloseReason::closed_by_peer;
  parcels_[parcel].receiver = nullptr;
  free_.push_back(parcel);
}

void VirtualNetwork::dispatch(std::uint32_t parcel, std::int64_t instant_ns) {
  assert(instant_ns >= now_ns_);  // nothing arrives before it was sent
  arrivals_.push_back({instant_ns, sent_++, parcel});
  std::push_heap(arrivals_.begin(), arrivals_.end());
}

void VirtualNetwork::arrive(std::uint32_t parcel) {
  ++arrived_;
  VirtualEndpoint* receiver = parcels_[parcel].receiver;
  if (receiver == nullptr) return return_parcel(parcel);
  const ConnectionId connection = parcels_[parcel].connection;
  receiver->inbox_.add(parcel);
  if (parcels_[parcel].kind == Kind::request)
    receiver->post(receiver->lines_[connection], take_parcel(), Kind::open);
}

/// Drops what is on its way to `endpoint`, and ends its lines.
void VirtualNetwork::forget(const VirtualEndpoint* endpoint) {
  for (Parcel& parcel : parcels_)
    if (parcel.receiver == endpoint) parcel.receiver = nullptr;
}

VirtualEndpoint::~VirtualEndpoint() {
  for (ConnectionId id = 0; id < lines_.size(); ++id) {
    close(id);
    if (lines_[id].peer != nullptr)
      lines_[id].peer->lines_[lines_[id].peer_connection].peer = nullptr;
  }
  network_.forget(this);
  inbox_.for_each([this](std::uint32_t parcel) { network_.return_parcel(parcel); });
  if (!name_.empty()) network_.listeners_.erase(name_);
}

void VirtualEndpoint::listen(const std::string& name) {
  if (!network_.listeners_.emplace(name, this).second)
    throw TransportError(TransportError::Kind::in_use, "virtual address '" + name + "' is in use");
  name_ = name;
}

ConnectionId VirtualEndpoint::add_line(VirtualEndpoint* peer, const LineIdentity& identity) {
  Line& line = lines_.emplace_back();
  line.peer = peer;
  line.number = network_.next_line_++;
  line.is_open = peer != nullptr;
  network_.model_.open_line(line.number, identity);
  return static_cast<ConnectionId>(lines_.size() - 1);
}

std::uint32_t VirtualEndpoint::closing(ConnectionId connection, CloseReason reason) {
  const std::uint32_t parcel = network_.take_parcel();
  VirtualNetwork::Parcel& notice = network_.parcels_[parcel];
  notice.kind = VirtualNetwork::Kind::close;
  notice.reason = reason;
  notice.connection = connection;
  notice.receiver = this;
  return parcel;
}

ConnectionId VirtualEndpoint::connect(const std::string& name) {
  const std::uint32_t link = network_.link_counts_[name]++;
  const LineIdentity there{name, link, LinkDirection::to_listener},
      back{name, link, LinkDirection::from_listener};
  const auto found = network_.listeners_.find(name);
  if (found == network_.listeners_.end()) {
    const ConnectionId refused = add_line(nullptr, there);
    const std::uint32_t parcel = closing(refused, CloseReason::refused);
    network_.parcels_[parcel].detail = "nobody listens at virtual address '" + name + "'";
    const std::int64_t there_ns =
        network_.model_.arrival_ns(lines_[refused].number, network_.now_ns(), 0);
    network_.dispatch(parcel, network_.model_.arrival_ns(lines_[refused].number, there_ns, 0));
    return refused;
  }
  VirtualEndpoint& peer = *found->second;
  const ConnectionId ours = add_line(&peer, there), theirs = peer.add_line(this, back);
  lines_[ours].peer_connection = theirs;
  peer.lines_[theirs].peer_connection = ours;
  post(lines_[ours], network_.take_parcel(), VirtualNetwork::Kind::request);
  return ours;
}

void VirtualEndpoint::post(Line& line, std::uint32_t parcel, VirtualNetwork::Kind kind) {
  if (line.peer == nullptr || line.is_given_up) return network_.return_parcel(parcel);
  VirtualNetwork::Parcel& posted = network_.parcels_[parcel];
  const Delivery delivery =
      network_.model_.deliver(line.number, network_.now_ns(), posted.bytes.size());
  if (delivery.is_given_up) {
    network_.return_parcel(parcel);
    return give_up(line, delivery.instant_ns);
  }
  posted.kind = kind;
  posted.connection = line.peer_connection;
  posted.receiver = line.peer;
  line.last_ns = std::max(line.last_ns, delivery.instant_ns);
  network_.dispatch(parcel, line.last_ns);
}

/// The peer is not notified, as with a cut cable.
void VirtualEndpoint::give_up(Line& line, std::int64_t instant_ns) {
  line.is_given_up = true;
  const std::uint32_t parcel =
      closing(static_cast<ConnectionId>(&line - lines_.data()), CloseReason::failed);
  network_.parcels_[parcel].detail = "nothing got through: connection timed out";
  network_.dispatch(parcel, instant_ns);
}

void VirtualEndpoint::poll(std::chrono::nanoseconds, TransportListener& listener) {
  struct Opened {
    VirtualNetwork& network;
    std::uint32_t parcel;
    ~Opened() { network.return_parcel(parcel); }  // though the listener throws
  };
  inbox_.report_all([&](std::uint32_t parcel) {
    const Opened opened{network_, parcel};
    report(parcel, listener);
  });
}

void VirtualEndpoint::report(std::uint32_t number, TransportListener& listener) {
  using Kind = VirtualNetwork::Kind;
  VirtualNetwork::Parcel& parcel = network_.parcels_[number];
  const ConnectionId connection = parcel.connection;
  assert(parcel.receiver == this && connection < lines_.size());
  Line& line = lines_[connection];
  const bool is_end = parcel.kind == Kind::close;
  if (!line.is_open && !is_end) return;  // an end that closes does not read what came before
  if (parcel.kind == Kind::request || parcel.kind == Kind::open) {
    line.is_reported = true;
    return listener.on_open(connection);
  }
  if (is_end) {
    if (!line.is_open &&
        (parcel.reason == CloseReason::closed_by_peer || parcel.reason == CloseReason::failed))
      return;  // this end closed first and has been notified
    line.is_open = false;
    const std::string detail = parcel.detail;
    return listener.on_close(connection, parcel.reason, detail);
  }
  const bool is_datagram = parcel.kind == Kind::datagram;
  delivering_.swap(parcel.bytes);  // callbacks may send, which may move the parcels
  if (is_datagram) {
    report_datagram(line, connection, listener);
    return delivering_.swap(network_.parcels_[number].bytes);
  }
  line.counters.bytes_received += delivering_.size();
  totals_.bytes_received += delivering_.size();
  line.acknowledgements.received(delivering_.size(), network_.now_ns());
  listener.on_bytes(connection, delivering_);
  delivering_.swap(network_.parcels_[number].bytes);
}

void VirtualEndpoint::report_datagram(Line& line, ConnectionId connection,
                                      TransportListener& listener) {
  if (!line.is_reported) return;
  for (TransportCounters* counters : {&line.counters, &totals_}) {
    ++counters->datagrams_received;
    counters->datagram_bytes_received += delivering_.size();
  }
  listener.on_datagram(connection, delivering_);
}

void VirtualEndpoint::send(ConnectionId connection, std::span<const Bytes> parts) {
  if (connection >= lines_.size() || !lines_[connection].is_open) return;
  Line& line = lines_[connection];
  std::size_t size = 0;
  for (const Bytes part : parts) size += part.size();
  if (size == 0) return;
  if (network_.model_.queued_bytes(line.number, network_.now_ns()) + size > network_.queue_max_)
    return overflow(connection);
  const std::uint32_t parcel = packed(parts, size);
  line.acknowledgements.sent(network_.now_ns());
  for (TransportCounters* counters : {&line.counters, &totals_}) {
    counters->bytes_sent += size;
    counters->segments_sent += (size + 1447) / 1448;
    ++counters->writes;
  }
  post(line, parcel, VirtualNetwork::Kind::bytes);
}

std::uint32_t VirtualEndpoint::packed(std::span<const Bytes> parts, std::size_t size) {
  const std::uint32_t parcel = network_.take_parcel();
  std::vector<std::byte>& bytes = network_.parcels_[parcel].bytes;
  bytes.reserve(size);
  for (const Bytes part : parts) bytes.insert(bytes.end(), part.begin(), part.end());
  return parcel;
}

std::size_t VirtualEndpoint::datagram_max(ConnectionId connection) const {
  return network_.carries_datagrams_ && connection < lines_.size() && lines_[connection].is_open &&
                 lines_[connection].is_reported
             ? virtual_datagram_max
             : 0;
}

void VirtualEndpoint::send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) {
  if (datagram_max(connection) == 0 || lines_[connection].peer == nullptr) return;
  Line& line = lines_[connection];
  for (const auto& [head, body, does_body_stay] : datagrams) {
    const std::size_t size = head.size() + body.size();
    assert(size <= virtual_datagram_max);
    for (TransportCounters* counters : {&line.counters, &totals_}) {
      ++counters->datagrams_sent;
      counters->datagram_bytes_sent += size;
    }
    for (const std::int64_t instant_ns :
         network_.model_.datagram(line.number, network_.now_ns(), size)) {
      const std::uint32_t number = packed(std::array{head, body}, size);
      VirtualNetwork::Parcel& parcel = network_.parcels_[number];
      parcel.kind = VirtualNetwork::Kind::datagram;
      parcel.connection = line.peer_connection;
      parcel.receiver = line.peer;
      network_.dispatch(number, instant_ns);
    }
  }
}

void VirtualEndpoint::overflow(ConnectionId connection) {
  Line& line = lines_[connection];
  line.is_open = false;
  post(line, network_.take_parcel(), VirtualNetwork::Kind::close);
  const std::uint32_t parcel = closing(connection, CloseReason::queue_full);
  network_.parcels_[parcel].detail = "the line is too slow for what is sent";
  inbox_.add(parcel);
}

void VirtualEndpoint::close(ConnectionId connection) {
  if (connection >= lines_.size() || !lines_[connection].is_open) return;
  Line& line = lines_[connection];
  line.is_open = false;
  post(line, network_.take_parcel(), VirtualNetwork::Kind::close);
  inbox_.add(closing(connection, CloseReason::closed_by_us));
}

TransportCounters VirtualEndpoint::counters(ConnectionId connection) const {
  if (connection >= lines_.size()) return {};
  TransportCounters counters = lines_[connection].counters;
  counters.queued_bytes =
      network_.model_.queued_bytes(lines_[connection].number, network_.now_ns());
  counters.acknowledgements_sent = lines_[connection].acknowledgements.count(network_.now_ns());
  return counters;
}

TransportCounters VirtualEndpoint::totals() const {
  TransportCounters sum = totals_;
  for (const Line& line : lines_)
    sum.acknowledgements_sent += line.acknowledgements.count(network_.now_ns());
  return sum;
}

}  // namespace rink::rti
