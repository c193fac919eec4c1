// Walks over the submessages of a message.
#include "loadgen/dds/rtps_traffic.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <string>

namespace rink::loadgen {
namespace {

enum Submessage : std::uint8_t {
  padding = 0x01,
  acknack = 0x06,
  heartbeat = 0x07,
  gap = 0x08,
  info_time_stamp = 0x09,
  nack_fragment = 0x12,
  heartbeat_fragment = 0x13,
  data = 0x15,
  data_fragment = 0x16
};

/// Flag of `data`; without it a writer says that it no longer writes an instance.
constexpr std::uint8_t has_value = 0x04;

constexpr std::size_t message_header = 20, submessage_header = 4;

bool is_data(std::uint8_t kind) { return kind == data || kind == data_fragment; }

/// The place of the writer's entity id within a submessage's content; 0 if it has none.
std::size_t place_of_writer(std::uint8_t kind) {
  if (is_data(kind)) return 8;
  constexpr std::uint8_t others[] = {acknack, heartbeat, gap, nack_fragment, heartbeat_fragment};
  return std::ranges::find(others, kind) != std::end(others) ? 4 : 0;
}

/// Ethernet 14, IPv4 20, UDP 8; a message above 1,472 bytes is cut into packets of 1,480.
void add_headers(RtpsTraffic& traffic) {
  constexpr std::uint64_t udp = 8, of_packet = 34, packet = 1480;
  traffic.packets = (traffic.bytes + udp + packet - 1) / packet;
  traffic.headers = udp + of_packet * traffic.packets;
}

}  // namespace

RtpsTraffic traffic_of(std::span<const std::uint8_t> message) {
  RtpsTraffic traffic;
  if (message.size() < message_header || std::memcmp(message.data(), "RTPS", 4) != 0)
    return traffic;
  traffic.messages = 1;
  traffic.bytes = message.size();
  add_headers(traffic);
  std::uint64_t time_stamp = 0;  // before the submessage that it belongs to
  for (std::size_t at = message_header; at + submessage_header <= message.size();) {
    const std::uint8_t kind = message[at];
    const bool is_little = (message[at + 1] & 1) != 0;
    const std::size_t low = message[at + (is_little ? 2 : 3)],
                      high = message[at + (is_little ? 3 : 2)], length = 256 * high + low;
    // A length of 0 reaches to the message's end, but for these two.
    const std::size_t rest = message.size() - at;
    const std::size_t whole = length == 0 && kind != info_time_stamp && kind != padding
                                  ? rest
                                  : std::min(rest, submessage_header + length);
    const std::size_t writer = at + submessage_header + place_of_writer(kind);
    if (kind == info_time_stamp) time_stamp = whole;
    if (place_of_writer(kind) > 0 && writer + 4 <= message.size()) {
      const bool is_built_in = (message[writer + 3] & 0xc0) == 0xc0;
      if (is_built_in) traffic.discovery_bytes += whole + time_stamp;
      else if (is_data(kind)) {
        traffic.data_bytes += whole + time_stamp;
        if (kind != data || (message[at + 1] & has_value) != 0) ++traffic.samples;
      }
      time_stamp = 0;
    }
    at += whole;
  }
  return traffic;
}

std::uint64_t loopback_bytes() {
  std::ifstream table("/proc/self/net/dev");
  for (std::string line; std::getline(table, line);)
    if (const auto name = line.find("lo:"); name != std::string::npos)
      return std::strtoull(line.c_str() + name + 3, nullptr, 10);
  return 0;
}

}  // namespace rink::loadgen
