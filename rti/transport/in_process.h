// Endpoints in one process that reach each other by name: no sockets, one thread, the same order in
// every run.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "rti/transport/report_queue.h"
#include "rti/transport/transport.h"

namespace rink::rti {

class InProcessEndpoint;

/// The network between endpoints; must outlive them. Bytes sent arrive at the receiver's next poll.
/// All use one thread.
class InProcessNetwork {
 public:
  /// `queue_max` [bytes]: what a receiver may leave unread per connection before it is closed.
  explicit InProcessNetwork(std::size_t queue_max = 64u << 20) : queue_max_(queue_max) {}

 private:
  friend class InProcessEndpoint;
  std::map<std::string, InProcessEndpoint*> listeners_;
  std::size_t queue_max_;
};

/// One federate's or the RTI's end. `poll` never waits, since no event can come during a wait.
class InProcessEndpoint final : public Transport {
 public:
  explicit InProcessEndpoint(InProcessNetwork& network) : network_(network) {}
  ~InProcessEndpoint() override;
  InProcessEndpoint(const InProcessEndpoint&) = delete;
  InProcessEndpoint& operator=(const InProcessEndpoint&) = delete;

  /// Others may connect to `name` from now on. Throws TransportError in_use if the name is taken.
  void listen(const std::string& name);
  /// `on_open` follows in the next poll, or `on_close` with `refused` if nobody listens.
  ConnectionId connect(const std::string& name);

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  std::size_t queued_bytes(ConnectionId connection) const override;
  TransportCounters counters(ConnectionId connection) const override;

 private:
  enum class EventKind : std::uint8_t { open, bytes, close };
  struct Event {
    EventKind kind;
    ConnectionId connection;
    CloseReason reason = CloseReason::closed_by_peer;
    std::string detail;
  };
  struct Line {
    InProcessEndpoint* peer = nullptr;  ///< null once closed
    ConnectionId peer_connection = 0;
    std::vector<std::byte> incoming;  ///< sent by the peer, not yet polled
    TransportCounters counters;
  };
  ConnectionId add_line(InProcessEndpoint* peer);
  void report(const Event& event, TransportListener& listener);
  void part(ConnectionId connection, CloseReason ours, CloseReason theirs,
            const std::string& detail);

  InProcessNetwork& network_;
  std::string name_;
  std::vector<Line> lines_;  ///< by connection
  ReportQueue<Event> events_;
  std::vector<std::byte> delivering_;
};

}  // namespace rink::rti
