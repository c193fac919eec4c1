// Datagrams in as few system calls as the platform allows: many messages in one call, and many
// datagrams of one size in one message.
#pragma once

#include <sys/socket.h>
#include <sys/uio.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rti/transport/readiness.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// An address of the internet, of either version.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
  /// Both compare what counts for their family; ports too, or not.
  bool is_same(const SocketAddress& other) const;
  bool is_same_host(const SocketAddress& other) const;
  std::uint16_t port() const;
  void set_port(std::uint16_t port);
};

/// Sets a large buffer for bursts, and `UDP_GRO` if it is available and wanted.
void prepare_datagram_socket(int socket, bool use_offload);

/// Gathers datagrams and sends them by `sendmmsg`; consecutive ones of one size (the last may be
/// shorter) to one address as one message that the kernel cuts (`UDP_SEGMENT`), unless the kernel
/// has refused that once. Bodies that stay are not copied. Datagrams that the kernel has no room
/// for are lost.
class DatagramSender {
 public:
  explicit DatagramSender(bool use_offload) : use_offload_(use_offload) {}

  /// Each datagram begins with `prefix`. `to` may be null for a connected socket. All that waits
  /// goes out first if it belongs to another socket.
  void add(int socket, const SocketAddress* to, Bytes prefix, std::span<const Datagram> datagrams);
  void push();

  bool uses_offload() const { return use_offload_; }
  std::uint64_t calls() const { return calls_; }  ///< of the operating system
  std::uint64_t lost() const { return lost_; }    ///< datagrams that the kernel did not take

 private:
  struct Message {
    std::size_t first_part = 0, part_count = 0;  ///< of `parts_`
    std::size_t size = 0, segment = 0;  ///< all datagrams but the last have `segment` bytes
    const SocketAddress* to = nullptr;
    std::uint32_t count = 0;   ///< of datagrams
    bool is_complete = false;  ///< the last is shorter than the others
  };
  static constexpr std::size_t message_max = 64, segment_max = 60, part_max = 1024,
                               message_bytes_max = 62'000, bytes_max = 256 * 1024;
  void append(Message& message, Bytes part, bool does_stay);
  std::size_t send_some(std::size_t from);
  void send_apart(const Message& message);

  int socket_ = -1;
  bool use_offload_;
  std::vector<std::byte> bytes_;  ///< bodies that do not stay; never grows beyond what was reserved
  std::vector<iovec> parts_;
  std::vector<Message> messages_;
  std::uint64_t calls_ = 0, lost_ = 0;
};

/// Receives datagrams, many messages in one call.
class DatagramReader {
 public:
  DatagramReader();
  /// Calls `take(source, datagram)` for each of at most sixteen messages; false if none is left.
  bool read(int socket, const std::function<void(const SocketAddress&, Bytes)>& take);
  std::uint64_t calls() const { return calls_; }

 private:
  static constexpr std::size_t message_max = 16, buffer_size = 65'536;
  std::vector<std::byte> buffer_;
  std::uint64_t calls_ = 0;
};

}  // namespace rink::rti
