// RTPS messages made by hand, byte by byte as the standard has them, are counted by their kinds.
#include "loadgen/dds/rtps_traffic.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace rink::loadgen {
namespace {

using Message = std::vector<std::uint8_t>;

Message header() {
  Message message{'R', 'T', 'P', 'S', 2, 1, 1, 16};
  message.resize(20);
  return message;
}

// Flags of submessages: the order of bytes, and what data holds.
constexpr std::uint8_t little = 1, value = little | 4, key = little | 8;

/// A submessage of `length` bytes with the last byte of its writer's entity id.
void add(Message& message, std::uint8_t kind, std::uint16_t length, std::size_t writer,
         std::uint8_t entity_kind, std::uint8_t flags = little) {
  const std::size_t begin = message.size();
  message.insert(message.end(), {kind, flags, static_cast<std::uint8_t>(length & 0xff),
                                 static_cast<std::uint8_t>(length >> 8)});
  message.resize(begin + 4 + length);
  if (length >= writer + 4) message[begin + 4 + writer + 3] = entity_kind;
}

TEST(RtpsTraffic, TellsSamplesOfUsersFromDiscovery) {
  Message message = header();
  add(message, 0x09, 8, 0, 0);             // the time of the sample
  add(message, 0x15, 44, 8, 0x02, value);  // data of a writer with a key
  add(message, 0x15, 20, 8, 0x02, key);    // it no longer writes an instance
  add(message, 0x07, 28, 4, 0x02);         // its heartbeat
  add(message, 0x15, 100, 8, 0xc2);        // data of a built-in writer
  add(message, 0x06, 24, 4, 0xc7);         // acknowledged by a built-in reader
  const RtpsTraffic counted = traffic_of(message);
  EXPECT_EQ(counted.messages, 1u);
  EXPECT_EQ(counted.bytes, 20u + 12u + 48u + 24u + 32u + 104u + 28u);
  EXPECT_EQ(counted.samples, 1u);
  EXPECT_EQ(counted.data_bytes, 12u + 48u + 24u);
  EXPECT_EQ(counted.discovery_bytes, 104u + 28u);
  EXPECT_EQ(counted.packets, 1u);
  EXPECT_EQ(counted.headers, 14u + 20u + 8u);
}

TEST(RtpsTraffic, TakesALengthOfZeroAsTheMessagesRest) {
  Message message = header();
  add(message, 0x15, 200, 8, 0x02);
  message[22] = message[23] = 0;
  EXPECT_EQ(traffic_of(message).data_bytes, 204u);
}

/// RFC 791: 1,480 bytes of UDP, its own 8 among them, fit one packet of Ethernet.
TEST(RtpsTraffic, CutsLongMessagesIntoPackets) {
  const auto packets = [](std::size_t size) {
    Message message = header();
    message.resize(size);
    return traffic_of(message).packets;
  };
  EXPECT_EQ(packets(1472), 1u);
  EXPECT_EQ(packets(1473), 2u);
  EXPECT_EQ(packets(14'720), 10u);
}

TEST(RtpsTraffic, CountsNothingElseAndReadsNoFurtherThanThereIs) {
  EXPECT_EQ(traffic_of({}), RtpsTraffic{});
  const std::string_view other = "POST / HTTP/1.1 and what follows";
  EXPECT_EQ(traffic_of({reinterpret_cast<const std::uint8_t*>(other.data()), other.size()}),
            RtpsTraffic{});
  Message whole = header();
  add(whole, 0x09, 8, 0, 0);
  add(whole, 0x15, 44, 8, 0x02);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const Message torn(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_LE(traffic_of(torn).data_bytes, size);
  }
}

}  // namespace
}  // namespace rink::loadgen
