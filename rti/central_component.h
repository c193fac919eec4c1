// The interface through which a host of transports drives the RTI's central component, whether that
// holds one federation execution or many.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "rti/wire/bytes.h"

namespace rink::rti {

/// The sink into which `flush` puts what must be sent.
class Outlet {
 public:
  virtual ~Outlet() = default;
  /// Everything for one destination, at most once per flush. The parts are valid during the call.
  virtual void send(ConnectionId connection, std::span<const Bytes> parts) = 0;
  /// Bytes sent to this destination that wait because it does not take them.
  virtual std::size_t waiting_bytes(ConnectionId) const { return 0; }
  /// The most bytes that a datagram to this destination may have now; 0 where it has no channel for
  /// datagrams.
  virtual std::size_t datagram_max(ConnectionId) const { return 0; }
  /// At most once per flush and destination, before its `send`; one more datagram may probe whether
  /// a channel is open again. The bytes are valid during the call.
  virtual void send_datagrams(ConnectionId, std::span<const Datagram>) {}
  /// Closes the connection once the bytes sent before are on their way; the central component has
  /// forgotten it already.
  virtual void drop(ConnectionId connection, std::string_view why) = 0;
};

/// For so long a stranger may take a file that others wait for [s].
inline constexpr double stranger_due_s = 1.0;

/// Bytes and time in, bytes out; no I/O, no clock, no thread. A tick is any number of `receive`,
/// then `match`, then `flush`.
class CentralComponent {
 public:
  virtual ~CentralComponent() = default;
  /// Connection ids may be any numbers that are not connected now; small ones are dense.
  virtual void connect(ConnectionId connection) = 0;
  virtual void receive(ConnectionId connection, Bytes bytes) = 0;
  /// A whole datagram of a federate; datagrams may arrive in any order, twice or never.
  virtual void receive_datagram(ConnectionId /*connection*/, Bytes /*datagram*/) {}
  virtual void disconnect(ConnectionId connection, std::string_view why) = 0;
  using ConnectionTest = std::function<bool(ConnectionId)>;
  /// Of the connections that have been there for `stranger_due_s` without joining, and pass the
  /// test, the oldest: it goes first where files run short.
  virtual std::optional<ConnectionId> oldest_stranger(const ConnectionTest& /*test*/) const {
    return std::nullopt;
  }
  /// `now` [s] never decreases. `is_behind`: some of what connections have sent may wait unread, so
  /// that nobody counts as silent since the last call.
  virtual void advance_clock(double now, bool is_behind) = 0;
  void advance_clock(double now) { advance_clock(now, false); }
  virtual void match() = 0;
  virtual void flush(Outlet& outlet) = 0;
};

}  // namespace rink::rti
