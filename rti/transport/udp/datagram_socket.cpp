// Implements datagram sockets by sendmmsg, recvmmsg, UDP_SEGMENT and UDP_GRO.
#include "rti/transport/udp/datagram_socket.h"

#include <netinet/in.h>
#include <netinet/udp.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>

// Newer than some C libraries' headers; a kernel without them refuses, and they are not used.
#ifndef UDP_SEGMENT
#define UDP_SEGMENT 103
#endif
#ifndef UDP_GRO
#define UDP_GRO 104
#endif

namespace rink::rti {

namespace {

const sockaddr_in& v4(const SocketAddress& address) {
  return reinterpret_cast<const sockaddr_in&>(address.storage);
}
const sockaddr_in6& v6(const SocketAddress& address) {
  return reinterpret_cast<const sockaddr_in6&>(address.storage);
}

}  // namespace

std::uint16_t SocketAddress::port() const {
  return ntohs(storage.ss_family == AF_INET6 ? v6(*this).sin6_port : v4(*this).sin_port);
}

void SocketAddress::set_port(std::uint16_t port) {
  if (storage.ss_family == AF_INET6)
    reinterpret_cast<sockaddr_in6&>(storage).sin6_port = htons(port);
  else reinterpret_cast<sockaddr_in&>(storage).sin_port = htons(port);
}

bool SocketAddress::is_same_host(const SocketAddress& other) const {
  if (storage.ss_family != other.storage.ss_family) return false;
  if (storage.ss_family == AF_INET) return v4(*this).sin_addr.s_addr == v4(other).sin_addr.s_addr;
  return storage.ss_family == AF_INET6 &&
         std::memcmp(&v6(*this).sin6_addr, &v6(other).sin6_addr, sizeof(in6_addr)) == 0;
}

bool SocketAddress::is_same(const SocketAddress& other) const {
  return is_same_host(other) && port() == other.port();
}

void prepare_datagram_socket(int socket, bool use_offload) {
  // A tick to a thousand clients is 3 MB at once. Only a privileged process may go beyond the
  // system's limit; others get what it allows.
  const int size = 8 << 20, yes = 1;
  for (const auto& [forced, asked] :
       {std::pair{SO_RCVBUFFORCE, SO_RCVBUF}, std::pair{SO_SNDBUFFORCE, SO_SNDBUF}})
    if (::setsockopt(socket, SOL_SOCKET, forced, &size, sizeof size) != 0)
      ::setsockopt(socket, SOL_SOCKET, asked, &size, sizeof size);
  if (use_offload) ::setsockopt(socket, IPPROTO_UDP, UDP_GRO, &yes, sizeof yes);
}

void DatagramSender::add(int socket, const SocketAddress* to, Bytes prefix,
                         std::span<const Datagram> datagrams) {
  assert(socket >= 0);
  if (socket != socket_) push();
  socket_ = socket;
  if (bytes_.capacity() == 0) bytes_.reserve(bytes_max);
  bool is_first = true;
  for (const Datagram& each : datagrams) {
    const std::size_t size = prefix.size() + each.head.size() + each.body.size();
    assert(size <= bytes_max);
    if (bytes_.size() + size > bytes_max || parts_.size() + 3 > part_max) {
      push();
      is_first = true;
    }
    Message* message = messages_.empty() ? nullptr : &messages_.back();
    const bool continues = use_offload_ && !is_first && !message->is_complete &&
                           size <= message->segment && message->count < segment_max &&
                           message->size + size <= message_bytes_max;
    if (!continues) {
      if (messages_.size() == message_max) push();
      messages_.push_back({.first_part = parts_.size(),
                           .part_count = 0,
                           .size = 0,
                           .segment = size,
                           .to = to,
                           .count = 0,
                           .is_complete = false});
      message = &messages_.back();
    }
    is_first = false;
    append(*message, prefix, false);
    append(*message, each.head, false);
    append(*message, each.body, each.does_body_stay);
    message->size += size;
    ++message->count;
    message->is_complete = size < message->segment;
  }
}

/// Continues the last part if it follows that in memory.
void DatagramSender::append(Message& message, Bytes part, bool does_stay) {
  if (part.empty()) return;
  const std::byte* at = part.data();
  if (!does_stay) {
    assert(part.size() <= bytes_.capacity() - bytes_.size());  // what lies there must not move
    at = bytes_.data() + bytes_.size();
    bytes_.insert(bytes_.end(), part.begin(), part.end());
  }
  if (message.part_count > 0 &&
      static_cast<std::byte*>(parts_.back().iov_base) + parts_.back().iov_len == at) {
    parts_.back().iov_len += part.size();
    return;
  }
  parts_.push_back({const_cast<std::byte*>(at), part.size()});
  ++message.part_count;
}

void DatagramSender::push() {
  for (std::size_t sent = 0; sent < messages_.size();) sent += send_some(sent);
  messages_.clear();
  parts_.clear();
  bytes_.clear();
}

/// Returns how many messages are done with, at least one.
std::size_t DatagramSender::send_some(std::size_t from) {
  std::array<mmsghdr, message_max> headers{};
  union Control {
    cmsghdr alignment;
    char bytes[CMSG_SPACE(sizeof(std::uint16_t))];
  };
  std::array<Control, message_max> controls;
  const std::size_t count = messages_.size() - from;
  assert(0 < count && count <= message_max);
  for (std::size_t i = 0; i < count; ++i) {
    const Message& message = messages_[from + i];
    msghdr& header = headers[i].msg_hdr;
    header.msg_iov = &parts_[message.first_part];
    header.msg_iovlen = message.part_count;
    if (message.to != nullptr) {
      header.msg_name = const_cast<sockaddr*>(message.to->get());
      header.msg_namelen = message.to->size;
    }
    if (message.count < 2) continue;
    controls[i] = {};
    header.msg_control = controls[i].bytes;
    header.msg_controllen = sizeof controls[i].bytes;
    cmsghdr* control = CMSG_FIRSTHDR(&header);
    control->cmsg_level = IPPROTO_UDP;
    control->cmsg_type = UDP_SEGMENT;
    control->cmsg_len = CMSG_LEN(sizeof(std::uint16_t));
    const auto segment = static_cast<std::uint16_t>(message.segment);
    std::memcpy(CMSG_DATA(control), &segment, sizeof segment);
  }
  ++calls_;
  const int sent = ::sendmmsg(socket_, headers.data(), static_cast<unsigned>(count),
                              MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent > 0) return static_cast<std::size_t>(sent);
  const Message& refused = messages_[from];
  if (errno == EINTR || errno == ECONNREFUSED) {  // the second reports an earlier datagram, once
    if (::sendmmsg(socket_, headers.data(), 1, MSG_DONTWAIT | MSG_NOSIGNAL) <= 0)
      lost_ += refused.count;
    return 1;
  }
  if (refused.count > 1 && errno != EAGAIN && errno != ENOBUFS) {
    use_offload_ = false;
    send_apart(refused);
    return 1;
  }
  lost_ += refused.count;
  return 1;
}

void DatagramSender::send_apart(const Message& message) {
  std::vector<std::byte> whole;
  for (std::size_t i = 0; i < message.part_count; ++i) {
    const iovec& part = parts_[message.first_part + i];
    const auto* bytes = static_cast<const std::byte*>(part.iov_base);
    whole.insert(whole.end(), bytes, bytes + part.iov_len);
  }
  for (std::size_t at = 0; at < message.size; at += message.segment) {
    const std::size_t size = std::min(message.segment, message.size - at);
    ++calls_;
    const sockaddr* to = message.to == nullptr ? nullptr : message.to->get();
    if (::sendto(socket_, whole.data() + at, size, MSG_DONTWAIT | MSG_NOSIGNAL, to,
                 to == nullptr ? 0 : message.to->size) < 0)
      ++lost_;
  }
}

DatagramReader::DatagramReader() : buffer_(message_max * buffer_size) {}

bool DatagramReader::read(int socket,
                          const std::function<void(const SocketAddress&, Bytes)>& take) {
  std::array<mmsghdr, message_max> headers{};
  std::array<iovec, message_max> vectors;
  std::array<SocketAddress, message_max> sources;
  union Control {
    cmsghdr alignment;
    char bytes[CMSG_SPACE(sizeof(int))];
  };
  std::array<Control, message_max> controls;
  for (std::size_t i = 0; i < message_max; ++i) {
    vectors[i] = {buffer_.data() + i * buffer_size, buffer_size};
    headers[i].msg_hdr = {.msg_name = &sources[i].storage,
                          .msg_namelen = sizeof sources[i].storage,
                          .msg_iov = &vectors[i],
                          .msg_iovlen = 1,
                          .msg_control = controls[i].bytes,
                          .msg_controllen = sizeof controls[i].bytes,
                          .msg_flags = 0};
  }
  ++calls_;
  const int count = ::recvmmsg(socket, headers.data(), message_max, MSG_DONTWAIT, nullptr);
  for (int i = 0; i < count; ++i) {
    const msghdr& header = headers[static_cast<std::size_t>(i)].msg_hdr;
    if ((header.msg_flags & MSG_TRUNC) != 0) continue;
    sources[static_cast<std::size_t>(i)].size = header.msg_namelen;
    const Bytes bytes = Bytes(buffer_).subspan(static_cast<std::size_t>(i) * buffer_size,
                                               headers[static_cast<std::size_t>(i)].msg_len);
    std::size_t segment = bytes.size();
    for (cmsghdr* control = CMSG_FIRSTHDR(&header); control != nullptr;
         control = CMSG_NXTHDR(const_cast<msghdr*>(&header), control)) {
      if (control->cmsg_level != IPPROTO_UDP || control->cmsg_type != UDP_GRO) continue;
      int size = 0;
      std::memcpy(&size, CMSG_DATA(control), sizeof size);
      if (size > 0) segment = static_cast<std::size_t>(size);
    }
    for (std::size_t at = 0; at < bytes.size(); at += segment)
      take(sources[static_cast<std::size_t>(i)],
           bytes.subspan(at, std::min(segment, bytes.size() - at)));
  }
  return count == static_cast<int>(message_max);
}

}  // namespace rink::rti
