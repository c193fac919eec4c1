// The process's own sendmsg and recvmsg, which count RTPS messages on their way. Cyclone's library
// calls them instead of the C library's, since the linker finds the program's first.
#include <dlfcn.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>

#include "loadgen/dds/rtps_traffic.h"

namespace rink::loadgen {
namespace {

/// Threads of the library send and receive at once.
class SharedTraffic {
 public:
  void add(const RtpsTraffic& more) {
    if (more.messages == 0) return;
    messages_ += more.messages, bytes_ += more.bytes, headers_ += more.headers;
    packets_ += more.packets, data_bytes_ += more.data_bytes;
    discovery_bytes_ += more.discovery_bytes, samples_ += more.samples;
  }
  RtpsTraffic so_far() const {
    return {.messages = messages_,
            .bytes = bytes_,
            .headers = headers_,
            .packets = packets_,
            .data_bytes = data_bytes_,
            .discovery_bytes = discovery_bytes_,
            .samples = samples_};
  }

 private:
  std::atomic<std::uint64_t> messages_ = 0, bytes_ = 0, headers_ = 0, packets_ = 0, data_bytes_ = 0,
                             discovery_bytes_ = 0, samples_ = 0;
};

SharedTraffic sent, received;

/// The first `size` bytes of what `message` points to.
RtpsTraffic traffic_in(const msghdr& message, std::size_t size) {
  thread_local std::array<std::uint8_t, 65'536> bytes;
  std::size_t filled = 0;
  size = std::min(size, bytes.size());
  for (std::size_t part = 0; part < message.msg_iovlen && filled < size; ++part) {
    const std::size_t length = std::min(message.msg_iov[part].iov_len, size - filled);
    std::memcpy(bytes.data() + filled, message.msg_iov[part].iov_base, length);
    filled += length;
  }
  return traffic_of({bytes.data(), filled});
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

RtpsTraffic sent_so_far() { return sent.so_far(); }
RtpsTraffic received_so_far() { return received.so_far(); }

}  // namespace rink::loadgen

extern "C" ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  static auto* const of_library = rink::loadgen::next<decltype(sendmsg)>("sendmsg");
  const ssize_t size = of_library(socket, message, flags);
  if (size > 0)
    rink::loadgen::sent.add(rink::loadgen::traffic_in(*message, static_cast<std::size_t>(size)));
  return size;
}

extern "C" ssize_t recvmsg(int socket, msghdr* message, int flags) {
  static auto* const of_library = rink::loadgen::next<decltype(recvmsg)>("recvmsg");
  const ssize_t size = of_library(socket, message, flags);
  if (size > 0 && (flags & MSG_PEEK) == 0)
    rink::loadgen::received.add(
        rink::loadgen::traffic_in(*message, static_cast<std::size_t>(size)));
  return size;
}
