// Counts what RTPS messages carry (OMG formal/2022-04-01, 8.3 and 9.4): data of users, discovery,
// and the rest.
#pragma once

#include <cstdint>
#include <span>

namespace rink::loadgen {

/// Messages in one direction, each a UDP datagram. Bytes are those of UDP's payload.
struct RtpsTraffic {
  std::uint64_t messages = 0, bytes = 0;
  std::uint64_t headers = 0;     ///< bytes of Ethernet, IPv4 and UDP around them
  std::uint64_t packets = 0;     ///< of at most 1,500 bytes, as Ethernet would carry the messages
  std::uint64_t data_bytes = 0;  ///< of submessages with users' samples, their time stamps too
  std::uint64_t discovery_bytes = 0;  ///< of submessages from and to built-in endpoints
  std::uint64_t samples = 0;          ///< of users, values of instances

  friend RtpsTraffic operator-(RtpsTraffic a, const RtpsTraffic& b) {
    a.messages -= b.messages, a.bytes -= b.bytes, a.headers -= b.headers, a.packets -= b.packets;
    a.data_bytes -= b.data_bytes, a.discovery_bytes -= b.discovery_bytes, a.samples -= b.samples;
    return a;
  }
  friend bool operator==(const RtpsTraffic&, const RtpsTraffic&) = default;
};

/// What `message` adds; nothing if it is no RTPS message. What is malformed counts as far as it can
/// be read.
RtpsTraffic traffic_of(std::span<const std::uint8_t> message);

/// What this process has handed to the kernel and taken from it. Counted in the process's own
/// sendmsg and recvmsg, which stand before those of the C library and call them.
RtpsTraffic sent_so_far();
RtpsTraffic received_so_far();

/// Bytes that the loopback interface has carried in this process's network namespace, as the kernel
/// counts them, with 28 bytes of IPv4 and UDP for each message; 0 if that is unknown.
std::uint64_t loopback_bytes();

}  // namespace rink::loadgen
