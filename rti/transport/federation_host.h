// Runs a federation execution, or a directory of them, on any number of transports at once: the
// server's own federate in process, its clients by TCP.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rti/central_component.h"
#include "rti/transport/transport.h"

namespace rink::rti {

/// A tick is `poll` (as often as wanted), `match`, `flush`.
class FederationHost {
 public:
  explicit FederationHost(CentralComponent& core);
  ~FederationHost();

  /// The transport must outlive the host. Its owner makes it listen and connect.
  void add(Transport& transport);

  /// Polls each transport in the order added; only the last one waits, up to `longest_wait`, if
  /// nothing came before.
  void poll(std::chrono::nanoseconds longest_wait);
  /// Polls one transport alone, without waiting: the answer of a federate in the same process needs
  /// no system call.
  void poll(Transport& transport);
  void advance_clock(double now);
  void match() { core_.match(); }
  /// Sends one write per destination, and closes the connections that the execution drops.
  void flush();
  /// Tells every federate why the RTI ends, in at most 255 bytes, and closes all connections once
  /// that is on its way.
  void close_all(std::string_view why);

  /// Sum over the transports' connections, closed ones included.
  std::uint64_t closed_by_full_queue() const { return closed_by_full_queue_; }
  /// Strangers' connections closed where files ran short.
  std::uint64_t closed_for_room() const { return closed_for_room_; }

 private:
  class Port;
  class HostOutlet;
  struct Route {
    Port* port = nullptr;
    ConnectionId connection = 0;  ///< the transport's number
  };
  ConnectionId admit(Port& port, ConnectionId connection);
  /// Closes the connection of the oldest stranger at `port`, if there is one.
  bool make_room(const Port& port);

  CentralComponent& core_;
  std::vector<std::unique_ptr<Port>> ports_;
  std::vector<Route> routes_;  ///< by the core's connection number
  std::vector<ConnectionId> free_routes_;
  std::uint64_t closed_by_full_queue_ = 0, closed_for_room_ = 0;
};

}  // namespace rink::rti
