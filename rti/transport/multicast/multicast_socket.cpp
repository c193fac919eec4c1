// Plain sockets, since a datagram must leave by each interface by itself.
#include "rti/transport/multicast/multicast_socket.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace rink::rti {
namespace {

constexpr int families[2] = {AF_INET, AF_INET6};

struct Interface {
  unsigned number;
  bool is_loopback;
};

/// Those that are up.
std::vector<Interface> interfaces_up() {
  std::vector<Interface> found;
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return found;
  for (const ifaddrs* each = first; each != nullptr; each = each->ifa_next) {
    if ((each->ifa_flags & IFF_UP) == 0) continue;
    if ((each->ifa_flags & (IFF_MULTICAST | IFF_LOOPBACK)) == 0) continue;
    const unsigned number = ::if_nametoindex(each->ifa_name);
    if (number != 0 && std::ranges::find(found, number, &Interface::number) == found.end())
      found.push_back({number, (each->ifa_flags & IFF_LOOPBACK) != 0});
  }
  ::freeifaddrs(first);
  return found;
}

template <class Value>
bool set(int socket, int level, int option, const Value& value) {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

DatagramSource place_of(const MulticastGroup& group, int family, bool is_any) {
  DatagramSource place;
  if (family == AF_INET) {
    auto& address = reinterpret_cast<sockaddr_in&>(place.storage);
    address.sin_family = AF_INET;
    address.sin_port = htons(group.port);
    if (!is_any) ::inet_pton(AF_INET, group.ipv4.c_str(), &address.sin_addr);
    place.size = sizeof address;
  } else {
    auto& address = reinterpret_cast<sockaddr_in6&>(place.storage);
    address.sin6_family = AF_INET6;
    address.sin6_port = htons(group.port);
    if (!is_any) ::inet_pton(AF_INET6, group.ipv6.c_str(), &address.sin6_addr);
    place.size = sizeof address;
  }
  return place;
}

int opened(const MulticastGroup& group, int family, MulticastSocket::Role role) {
  const int socket = ::socket(family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return -1;
  const int yes = 1, hops = 1;
  bool is_ready = true;
  if (family == AF_INET6) {
    is_ready = set(socket, IPPROTO_IPV6, IPV6_V6ONLY, yes) &&
               set(socket, IPPROTO_IPV6, IPV6_MULTICAST_HOPS, hops);
  } else {
    is_ready = set(socket, IPPROTO_IP, IP_MULTICAST_TTL, hops);
  }
  if (role == MulticastSocket::Role::listens) {
    const DatagramSource any = place_of(group, family, true);
    is_ready = is_ready && set(socket, SOL_SOCKET, SO_REUSEADDR, yes) &&
               ::bind(socket, reinterpret_cast<const sockaddr*>(&any.storage), any.size) == 0;
  }
  if (is_ready) return socket;
  ::close(socket);
  return -1;
}

}  // namespace

std::string DatagramSource::address() const {
  char host[NI_MAXHOST] = {};
  if (::getnameinfo(reinterpret_cast<const sockaddr*>(&storage), size, host, sizeof host, nullptr,
                    0, NI_NUMERICHOST) != 0)
    return {};
  return storage.ss_family == AF_INET6 ? '[' + std::string(host) + ']' : std::string(host);
}

bool DatagramSource::is_loopback() const {
  if (storage.ss_family == AF_INET)
    return (ntohl(reinterpret_cast<const sockaddr_in&>(storage).sin_addr.s_addr) >> 24) == 127;
  return storage.ss_family == AF_INET6 &&
         IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6&>(storage).sin6_addr);
}

MulticastSocket::MulticastSocket(const MulticastGroup& group, Role role) : group_(group) {
  for (std::size_t k = 0; k < 2; ++k) sockets_[k] = opened(group, families[k], role);
  if (role == Role::listens) join_everywhere();
}

MulticastSocket::~MulticastSocket() {
  for (const int socket : sockets_)
    if (socket >= 0) ::close(socket);
}

/// An interface that refuses is left out: others may do.
void MulticastSocket::join_everywhere() const {
  for (const Interface& each : interfaces_up())
    for (std::size_t k = 0; k < 2; ++k) {
      if (sockets_[k] < 0) continue;
      group_req wish{};
      wish.gr_interface = each.number;
      const DatagramSource group = place_of(group_, families[k], false);
      std::memcpy(&wish.gr_group, &group.storage, group.size);
      set(sockets_[k], k == 0 ? IPPROTO_IP : IPPROTO_IPV6, MCAST_JOIN_GROUP, wish);
    }
}

int MulticastSocket::send_to_group(Bytes datagram) {
  int count = 0;
  for (const auto& [number, is_loopback] : interfaces_up())
    for (std::size_t k = 0; k < 2; ++k) {
      if (sockets_[k] < 0) continue;
      // Else it would leave by the loopback interface with another one's address.
      const in_addr from{htonl(is_loopback ? INADDR_LOOPBACK : INADDR_ANY)};
      const ip_mreqn by{
          .imr_multiaddr = {}, .imr_address = from, .imr_ifindex = static_cast<int>(number)};
      const bool is_set = k == 0 ? set(sockets_[k], IPPROTO_IP, IP_MULTICAST_IF, by)
                                 : set(sockets_[k], IPPROTO_IPV6, IPV6_MULTICAST_IF, number);
      const DatagramSource group = place_of(group_, families[k], false);
      count += is_set && ::sendto(sockets_[k], datagram.data(), datagram.size(), 0,
                                  reinterpret_cast<const sockaddr*>(&group.storage),
                                  group.size) == static_cast<ssize_t>(datagram.size());
    }
  return count;
}

void MulticastSocket::send_to(const DatagramSource& to, Bytes datagram) {
  const int socket = sockets_[to.storage.ss_family == AF_INET ? 0 : 1];
  if (socket < 0) return;
  // What the system does not take is lost, as datagrams are.
  [[maybe_unused]] const ssize_t sent =
      ::sendto(socket, datagram.data(), datagram.size(), 0,
               reinterpret_cast<const sockaddr*>(&to.storage), to.size);
}

std::optional<MulticastSocket::Arrival> MulticastSocket::receive(std::span<std::byte> room) {
  for (const int socket : sockets_) {
    if (socket < 0) continue;
    Arrival arrival;
    arrival.from.size = sizeof arrival.from.storage;
    const ssize_t size =
        ::recvfrom(socket, room.data(), room.size(), MSG_TRUNC,
                   reinterpret_cast<sockaddr*>(&arrival.from.storage), &arrival.from.size);
    if (size < 0) continue;
    arrival.size = static_cast<std::size_t>(size);
    return arrival;
  }
  return std::nullopt;
}

void MulticastSocket::wait(std::chrono::milliseconds longest) const {
  std::array<pollfd, 2> waiting{};
  for (std::size_t k = 0; k < 2; ++k) waiting[k] = {sockets_[k], POLLIN, 0};
  ::poll(waiting.data(), waiting.size(), static_cast<int>(longest.count()));
}

}  // namespace rink::rti
