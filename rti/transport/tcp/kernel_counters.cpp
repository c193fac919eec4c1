// Reads the kernel's counters by TCP_INFO.
#include "rti/transport/tcp/kernel_counters.h"

#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstddef>

namespace rink::rti {

std::optional<KernelCounters> kernel_counters(int socket) {
  tcp_info info{};
  socklen_t size = sizeof info;
  if (getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return std::nullopt;
  if (size < offsetof(tcp_info, tcpi_data_segs_out) + sizeof info.tcpi_data_segs_out)
    return std::nullopt;
  // The kernel counts the SYN or FIN that was acknowledged as a byte; `bytes_acked` starts at 1 on
  // the side that connects or accepts.
  return KernelCounters{info.tcpi_bytes_acked, info.tcpi_bytes_received, info.tcpi_segs_out,
                        info.tcpi_segs_in,     info.tcpi_data_segs_out,  info.tcpi_data_segs_in};
}

}  // namespace rink::rti
