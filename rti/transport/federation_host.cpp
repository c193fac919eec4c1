// Transports on one side, a federation execution on the other.
#include "rti/transport/federation_host.h"

#include <cassert>

#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

namespace {
constexpr ConnectionId nobody = 0xffffffffu;
}

/// One transport, its connections numbered by the execution.
class FederationHost::Port final : public TransportListener {
 public:
  Port(FederationHost& host, Transport& transport) : host_(host), transport_(transport) {}
  Transport& transport() { return transport_; }
  bool has_received() const { return has_received_; }
  void poll(std::chrono::nanoseconds longest_wait) {
    has_received_ = false;
    transport_.poll(longest_wait, *this);
  }

  void on_open(ConnectionId connection) override {
    has_received_ = true;
    if (connection >= numbers_.size()) numbers_.resize(connection + 1, nobody);
    assert(numbers_[connection] == nobody);  // connections are never numbered twice
    numbers_[connection] = host_.admit(*this, connection);
  }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    has_received_ = true;
    assert(connection < numbers_.size() && numbers_[connection] != nobody);
    host_.core_.receive(numbers_[connection], bytes);
  }
  void on_datagram(ConnectionId connection, Bytes datagram) override {
    has_received_ = true;
    assert(connection < numbers_.size() && numbers_[connection] != nobody);
    host_.core_.receive_datagram(numbers_[connection], datagram);
  }
  bool on_shortage() override { return host_.make_room(*this); }
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override {
    has_received_ = true;
    if (connection >= numbers_.size() || numbers_[connection] == nobody) return;
    host_.core_.disconnect(numbers_[connection], detail.empty() ? to_string(reason) : detail);
    if (reason == CloseReason::queue_full) ++host_.closed_by_full_queue_;
    host_.routes_[numbers_[connection]] = {};
    host_.free_routes_.push_back(numbers_[connection]);
    numbers_[connection] = nobody;
  }

 private:
  FederationHost& host_;
  Transport& transport_;
  std::vector<ConnectionId> numbers_;  ///< the execution's, by the transport's
  bool has_received_ = false;
};

class FederationHost::HostOutlet final : public Outlet {
 public:
  explicit HostOutlet(FederationHost& host) : host_(host) {}
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    assert(connection < host_.routes_.size());
    const Route& route = host_.routes_[connection];
    if (route.port != nullptr) route.port->transport().send(route.connection, parts);
  }
  std::size_t waiting_bytes(ConnectionId connection) const override {
    const Route& route = host_.routes_[connection];
    return route.port != nullptr ? route.port->transport().queued_bytes(route.connection) : 0;
  }
  std::size_t datagram_max(ConnectionId connection) const override {
    const Route& route = host_.routes_[connection];
    return route.port != nullptr ? route.port->transport().datagram_max(route.connection) : 0;
  }
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override {
    const Route& route = host_.routes_[connection];
    if (route.port != nullptr) route.port->transport().send_datagrams(route.connection, datagrams);
  }
  void drop(ConnectionId connection, std::string_view) override {
    assert(connection < host_.routes_.size());
    const Route& route = host_.routes_[connection];
    if (route.port != nullptr) route.port->transport().close(route.connection);
  }

 private:
  FederationHost& host_;
};

FederationHost::FederationHost(CentralComponent& core) : core_(core) {}
FederationHost::~FederationHost() = default;

void FederationHost::add(Transport& transport) {
  ports_.push_back(std::make_unique<Port>(*this, transport));
}

ConnectionId FederationHost::admit(Port& port, ConnectionId connection) {
  ConnectionId number = static_cast<ConnectionId>(routes_.size());
  if (free_routes_.empty()) {
    routes_.emplace_back();
  } else {
    number = free_routes_.back();
    free_routes_.pop_back();
  }
  assert(routes_[number].port == nullptr);
  routes_[number] = {&port, connection};
  core_.connect(number);
  return number;
}

/// Only one of `port` gives back what that waits for.
bool FederationHost::make_room(const Port& port) {
  const std::optional<ConnectionId> stranger = core_.oldest_stranger(
      [&](ConnectionId connection) { return routes_[connection].port == &port; });
  if (!stranger) return false;
  const Route& route = routes_[*stranger];
  assert(route.port == &port);
  ++closed_for_room_;
  core_.disconnect(*stranger, "others wait");
  route.port->transport().close(route.connection);
  return true;
}

void FederationHost::poll(std::chrono::nanoseconds longest_wait) {
  bool has_received = false;
  for (const auto& port : ports_) {
    const bool may_wait = &port == &ports_.back() && !has_received;
    port->poll(may_wait ? longest_wait : std::chrono::nanoseconds(0));
    has_received |= port->has_received();
  }
}

void FederationHost::poll(Transport& transport) {
  for (const auto& port : ports_)
    if (&port->transport() == &transport) port->poll(std::chrono::nanoseconds(0));
}

void FederationHost::advance_clock(double now) {
  bool is_behind = false;
  for (const auto& port : ports_) is_behind |= port->transport().is_behind();
  core_.advance_clock(now, is_behind);
}

void FederationHost::flush() {
  HostOutlet outlet(*this);
  core_.flush(outlet);
  for (const auto& port : ports_) port->transport().push();
}

void FederationHost::close_all(std::string_view why) {
  const std::vector<std::byte> words = framed(ExpelledMessage{why});
  const Bytes frame(words);
  for (const Route& route : routes_) {
    if (route.port == nullptr) continue;
    Transport& transport = route.port->transport();
    transport.send(route.connection, std::span(&frame, 1));
    transport.push();
    transport.close(route.connection);
  }
}

}  // namespace rink::rti
