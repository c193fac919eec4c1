// Datagrams to all of a group on the local network, and answers to single ones of them.
#pragma once

#include <sys/socket.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "rti/wire/bytes.h"

namespace rink::rti {

/// One group of each family, at one UDP port.
struct MulticastGroup {
  std::string ipv4, ipv6;
  std::uint16_t port = 0;
};

/// Where a datagram came from.
struct DatagramSource {
  sockaddr_storage storage{};
  socklen_t size = 0;
  /// 192.168.1.4, or [fe80::1%eth0], without the port.
  std::string address() const;
  bool is_loopback() const;  ///< the sender is on this machine, by its loopback interface
};

/// The sockets of both families; one that this machine does not have is left out. Datagrams go to
/// the networks at hand alone (a hop limit of 1). Nothing blocks but wait(), nothing throws.
class MulticastSocket {
 public:
  enum class Role : std::uint8_t { asks, listens };

  /// Who listens has joined the group on every interface that is up, and shares its port with other
  /// programs that do.
  MulticastSocket(const MulticastGroup& group, Role role);
  ~MulticastSocket();
  MulticastSocket(const MulticastSocket&) = delete;
  MulticastSocket& operator=(const MulticastSocket&) = delete;

  /// False if neither family is to be had.
  bool is_open() const { return sockets_[0] >= 0 || sockets_[1] >= 0; }
  /// To the group, on every interface that is up. Returns on how many it was sent.
  int send_to_group(Bytes datagram);
  void send_to(const DatagramSource& to, Bytes datagram);

  struct Arrival {
    std::size_t size = 0;  ///< of the datagram, which may be larger than the room for it
    DatagramSource from;
  };
  /// The next datagram that waits, as far as there is `room` for it.
  std::optional<Arrival> receive(std::span<std::byte> room);
  /// Waits until one is there, or for so long.
  void wait(std::chrono::milliseconds longest) const;

 private:
  void join_everywhere() const;

  MulticastGroup group_;
  int sockets_[2] = {-1, -1};  ///< IPv4, IPv6
};

}  // namespace rink::rti
