// A transport that carries nothing: it reports what the test scripts, and keeps what it was asked
// to do.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rti/transport/transport.h"

namespace rink::rti::testing {

/// Each `poll` reports the script so far, once; a connection that is closed is reported closed.
class ScriptedTransport final : public Transport {
 public:
  using Event = std::function<void(TransportListener&)>;
  void opens(ConnectionId id) {
    script_.push_back([id](TransportListener& to) { to.on_open(id); });
  }
  void says(ConnectionId id, std::vector<std::byte> bytes) {
    script_.push_back(
        [id, bytes = std::move(bytes)](TransportListener& to) { to.on_bytes(id, bytes); });
  }
  void says_by_datagram(ConnectionId id, std::vector<std::byte> bytes) {
    script_.push_back(
        [id, bytes = std::move(bytes)](TransportListener& to) { to.on_datagram(id, bytes); });
  }

  void poll(std::chrono::nanoseconds, TransportListener& listener) override {
    const std::vector<Event> script = std::exchange(script_, {});
    for (const Event& each : script) each(listener);
    for (const ConnectionId id : std::exchange(closing_, {}))
      listener.on_close(id, CloseReason::closed_by_us, "closed by us");
  }
  void send(ConnectionId id, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) sent[id].insert(sent[id].end(), part.begin(), part.end());
  }
  void close(ConnectionId id) override {
    closed.push_back(id);
    closing_.push_back(id);
  }
  TransportCounters counters(ConnectionId) const override { return {}; }
  std::size_t queued_bytes(ConnectionId) const override { return queued; }
  std::string peer_network(ConnectionId id) const override {
    const auto found = networks.find(id);
    return found == networks.end() ? "" : found->second;
  }

  std::size_t queued = 0;  ///< of every connection
  std::map<ConnectionId, std::vector<std::byte>> sent;
  std::vector<ConnectionId> closed;
  std::map<ConnectionId, std::string> networks;

 private:
  std::vector<Event> script_;
  std::vector<ConnectionId> closing_;
};

}  // namespace rink::rti::testing
