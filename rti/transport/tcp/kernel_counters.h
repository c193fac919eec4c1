// What the kernel has counted of a TCP connection; apart from Asio, whose headers clash with
// <linux/tcp.h>.
#pragma once

#include <cstdint>
#include <optional>

namespace rink::rti {

struct KernelCounters {
  std::uint64_t bytes_acknowledged = 0;  ///< payload that the peer's kernel has taken
  std::uint64_t bytes_received = 0;      ///< payload that our kernel has taken
  std::uint64_t segments_sent = 0,
                segments_received = 0;  ///< of any kind, as a capture on the interface would count
  std::uint64_t
      data_segments_sent = 0,
      data_segments_received =
          0;  ///< those with payload; all others are acknowledgements, but for the handshakes
};

/// `TCP_INFO` of an open TCP socket; nothing if the kernel does not support it.
std::optional<KernelCounters> kernel_counters(int socket);

}  // namespace rink::rti
