// The seam between the RTI's core, which does no I/O, and the transport that carries its bytes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "rti/wire/bytes.h"

namespace rink::rti {

enum class CloseReason : std::uint8_t {
  closed_by_peer,  ///< orderly or not, the peer is gone
  closed_by_us,
  queue_full,  ///< the peer did not read and its queue reached the limit
  refused,     ///< nobody listens there
  failed,      ///< any other error of the operating system
  too_fast,    ///< the peer sent more than its rate limit allows
  too_many,    ///< the peer's address has too many connections
};
const char* to_string(CloseReason reason);

/// An error in setting up a transport; `what` explains it to a user, with address and port.
class TransportError : public std::runtime_error {
 public:
  enum class Kind : std::uint8_t { in_use, no_such_address, no_permission, too_many_files, failed };
  TransportError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// Receives a transport's events while it is polled. Callbacks may send and close, but not poll.
class TransportListener {
 public:
  virtual ~TransportListener() = default;
  virtual void on_open(ConnectionId connection) = 0;
  /// Bytes as the peer sent them, in order, cut anywhere. Valid during the call.
  virtual void on_bytes(ConnectionId connection, Bytes bytes) = 0;
  virtual void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) = 0;
  /// One whole datagram of the connection's peer, in any order with other messages, and perhaps
  /// twice. Valid during the call.
  virtual void on_datagram(ConnectionId /*connection*/, Bytes /*datagram*/) {}
  /// No file is left for a connection that waits to be accepted. True if the listener has closed
  /// one to make room.
  virtual bool on_shortage() { return false; }
};

/// Payload as counted here, and the kernel's counts of the same connection where it has them
/// (`TCP_INFO`).
struct TransportCounters {
  std::uint64_t bytes_sent = 0,
                bytes_received = 0;  ///< handed to / taken from the operating system
  std::uint64_t writes = 0;          ///< calls of `send` that had bytes
  std::uint64_t segments_sent =
      0;  ///< sum over writes of ceil(bytes / 1448): what Ethernet would carry
  std::size_t queued_bytes = 0;  ///< accepted by `send`, not yet taken by the operating system
  std::optional<std::uint64_t> kernel_bytes_sent;  ///< acknowledged by the peer's kernel
  std::optional<std::uint64_t> kernel_bytes_received;
  std::optional<std::uint64_t>
      kernel_segments_sent;  ///< with data: on loopback fewer and larger ones than `segments_sent`
  /// Segments without data that this end sent: the kernel's count with those of the handshake, or
  /// that of `DelayedAcknowledgements` where no kernel carries the bytes; 0 in transports without a
  /// clock.
  std::uint64_t acknowledgements_sent = 0;
  /// Apart from the bytes above: datagrams given to and taken from the operating system, and their
  /// payload.
  std::uint64_t datagrams_sent = 0, datagrams_received = 0, datagram_bytes_sent = 0,
                datagram_bytes_received = 0;
};

/// Carries bytes, reliably and in order, between this endpoint and its peers. Not thread safe: one
/// thread owns it. Transports with unreliable datagrams override the last three members; all others
/// leave them alone.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Reports all that happened to `listener`; if nothing has, waits for the first event up to
  /// `longest_wait`.
  virtual void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) = 0;

  /// True if the last poll ended at its limits: bytes of connections that it has not read may wait.
  virtual bool is_behind() const { return false; }

  /// Sends the parts, one after the other, as one write. What the operating system does not take
  /// now is queued (a copy), up to the transport's limit; beyond it the connection is closed with
  /// `queue_full`, reported by the next `poll`. Unknown connections are ignored.
  virtual void send(ConnectionId connection, std::span<const Bytes> parts) = 0;

  /// Sends what is queued if the peer takes it at once, then closes; `on_close` follows in the next
  /// `poll`.
  virtual void close(ConnectionId connection) = 0;

  /// `queued_bytes` of `counters` without a call to the kernel, for use before each send. 0 from a
  /// transport that does not know, whose readers then get all updates however late.
  virtual std::size_t queued_bytes(ConnectionId) const { return 0; }

  /// Counters of an open connection, or the last ones of a closed one; all zero for one that never
  /// was.
  virtual TransportCounters counters(ConnectionId connection) const = 0;

  /// Whose an open connection is: its peer's IPv4 address, or the first 64 bits of an IPv6 one, of
  /// which one host may have all; empty if there is none.
  virtual std::string peer_network(ConnectionId) const { return {}; }

  /// The most bytes that a datagram over this connection may have now [bytes]; 0 while there is no
  /// channel for datagrams, when none may be sent.
  virtual std::size_t datagram_max(ConnectionId /*connection*/) const { return 0; }
  /// Sends each as one datagram, or loses it; never queues it for long, never closes the
  /// connection. The bytes are valid during the call, bodies marked as staying until the next
  /// `push`.
  virtual void send_datagrams(ConnectionId /*connection*/,
                              std::span<const Datagram> /*datagrams*/) {}
  /// Passes gathered datagrams to the operating system, many in one system call.
  virtual void push() {}
};

}  // namespace rink::rti
