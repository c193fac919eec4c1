// UDP beside TCP: the stream by TCP, datagrams by UDP, bound to each other so that nobody can
// inject or be flooded (docs/wire.md, "UDP beside TCP").
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "rti/transport/tcp/tcp.h"

namespace rink::rti {

struct UdpSettings {
  TcpSettings tcp;
  bool use_offload = true;  ///< segmentation and its reverse by the kernel, if it can
};

struct UdpCounters {
  std::uint64_t ways_opened = 0;  ///< connections whose datagrams get through
  std::uint64_t ways_failed =
      0;  ///< connections whose datagrams never did, which have the stream only
  std::uint64_t stranger_datagrams =
      0;  ///< from nobody known, from a wrong address, or nonsense: ignored, never answered
  std::uint64_t lost_datagrams = 0;  ///< that the operating system did not take
  std::uint64_t send_calls = 0;      ///< of the operating system, for datagrams
  bool uses_offload = false;         ///< the kernel cuts; false once it has refused
};

/// A TcpTransport whose connections have, after a round trip or two, a way for datagrams. Where UDP
/// does not get through, the stream carries on alone. Clients of a plain TcpTransport may connect
/// to it; a client of this one needs a server of this one.
class UdpTransport final : public Transport {
 public:
  explicit UdpTransport(const UdpSettings& settings = {});
  ~UdpTransport() override;
  UdpTransport(const UdpTransport&) = delete;
  UdpTransport& operator=(const UdpTransport&) = delete;

  /// As TcpTransport's; the UDP socket takes the same port if it is free, else any.
  std::uint16_t listen(const std::string& address, std::uint16_t port);
  ConnectionId connect(const std::string& address, std::uint16_t port);

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void close(ConnectionId connection) override;
  std::size_t queued_bytes(ConnectionId connection) const override;
  TransportCounters counters(ConnectionId connection) const override;
  std::size_t datagram_max(ConnectionId connection) const override;
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override;
  void push() override;

  /// Sum over all connections that ever were.
  TransportCounters totals() const;
  UdpCounters udp_counters() const;

 private:
  class Core;
  std::unique_ptr<Core> core_;
};

}  // namespace rink::rti
