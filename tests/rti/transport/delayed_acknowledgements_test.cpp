// The model of TCP's acknowledgements by hand, in virtual time, and what a kernel counts of a real
// connection.
#include "rti/transport/modelled/delayed_acknowledgements.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <vector>

#include "rti/transport/modelled/virtual_network.h"
#include "rti/transport/tcp/kernel_counters.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/rti/transport/instants.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;
constexpr std::size_t full = DelayedAcknowledgements::full_segment;

TEST(DelayedAcknowledgements, EverySecondFullSegmentIsAcknowledgedAtOnceAndTheRestAfterTheDelay) {
  DelayedAcknowledgements end;
  end.received(4 * full, 0);
  EXPECT_EQ(end.count(0), 2u);
  EXPECT_EQ(end.count(1'000 * ms), 2u) << "nothing is left";
  end.received(3 * full + 1, 1'000 * ms);
  EXPECT_EQ(end.count(1'000 * ms), 3u);
  EXPECT_EQ(end.count(1'040 * ms - 1), 3u);
  EXPECT_EQ(end.count(1'040 * ms), 4u) << "the third and what is beyond it, together";
}

TEST(DelayedAcknowledgements, WhatComesWithinTheDelayIsAcknowledgedWithWhatWaits) {
  DelayedAcknowledgements end;
  end.received(100, 0), end.received(100, 33 * ms);
  EXPECT_EQ(end.count(40 * ms), 1u) << "both";
  EXPECT_EQ(end.count(1'000 * ms), 1u);
  end.received(full, 2'000 * ms), end.received(full, 2'010 * ms);
  EXPECT_EQ(end.count(2'010 * ms), 2u) << "the second full one";
  EXPECT_EQ(end.count(3'000 * ms), 2u);
}

TEST(DelayedAcknowledgements, DataTheOtherWayCarriesThem) {
  DelayedAcknowledgements end;
  for (int i = 0; i < 100; ++i) end.received(full, 50 * i * ms), end.sent((50 * i + 39) * ms);
  EXPECT_EQ(end.count(10'000 * ms), 0u);
  end.received(full, 20'000 * ms), end.sent(20'041 * ms);
  EXPECT_EQ(end.count(20'041 * ms), 1u) << "too late";
}

/// 30 writes a second of three segments down, 100 ms under way, none up. The rest of a write waits
/// 40 ms, and 33 ms after it the next pair takes it along.
TEST(DelayedAcknowledgements, AreCountedByAConnectionInVirtualTime) {
  struct Ears final : TransportListener {
    ConnectionId last = 0;
    void on_open(ConnectionId connection) override { last = connection; }
    void on_bytes(ConnectionId, Bytes) override {}
    void on_close(ConnectionId, CloseReason, const std::string&) override {}
  } here, there;
  ConstantDelay air(100 * ms);
  VirtualNetwork network(air);
  VirtualEndpoint server(network), client(network);
  server.listen("server");
  const ConnectionId connection = client.connect("server");
  const std::vector<std::byte> update(2 * full + 500);
  const Bytes part = update;
  for (std::int64_t now = 0; now <= 2'000 * ms; now += ms) {
    network.advance_to(now);
    server.poll(0ns, here), client.poll(0ns, there);
    if (now >= 500 * ms && now < 1'500 * ms && (now / ms - 500) % 33 == 0)
      server.send(here.last, std::span(&part, 1));
  }
  EXPECT_EQ(server.totals().segments_sent, 31u * 3u);
  EXPECT_EQ(server.totals().acknowledgements_sent, 0u);
  EXPECT_EQ(client.totals().acknowledgements_sent, 31u + 1u) << "a pair each, and the last rest";
  EXPECT_EQ(client.counters(connection).acknowledgements_sent,
            client.totals().acknowledgements_sent);
}

/// What a capture of both directions would count is what both kernels say that they sent; the wire
/// formula must come to the same.
TEST(Acknowledgements, OfARealConnectionAreThoseOfBothKernels) {
  struct Ears final : TransportListener {
    ConnectionId last = 0;
    int opened = 0;
    std::uint64_t bytes = 0;
    void on_open(ConnectionId connection) override { last = connection, ++opened; }
    void on_bytes(ConnectionId, Bytes received) override { bytes += received.size(); }
    void on_close(ConnectionId, CloseReason, const std::string&) override {}
  } here, there;
  TcpTransport server, client;
  const ConnectionId ours = client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  while (here.opened == 0 || there.opened == 0) client.poll(1ms, there), server.poll(1ms, here);
  const auto kernels = [&] {
    return std::pair(kernel_counters(client.file(ours)).value(),
                     kernel_counters(server.file(here.last)).value());
  };
  const auto begin = kernels();
  const TransportCounters client_begin = client.counters(ours),
                          server_begin = server.counters(here.last);
  const std::vector<std::byte> small(700);
  const Bytes part = small;
  for (std::uint64_t i = 1; i <= 40; ++i) {
    server.send(here.last, std::span(&part, 1));
    while (there.bytes < i * small.size()) client.poll(1ms, there), server.poll(0ms, here);
    if (i % 8 == 0) client.send(ours, std::span(&part, 1));  // carries what it acknowledges
    client.poll(5ms, there), server.poll(0ms, here);
  }
  for (const auto until = std::chrono::steady_clock::now() + 300ms;
       std::chrono::steady_clock::now() < until;)
    client.poll(10ms, there), server.poll(10ms, here);
  const auto end = kernels();
  const TransportCounters client_end = client.counters(ours),
                          server_end = server.counters(here.last);
  const std::uint64_t captured = end.first.segments_sent - begin.first.segments_sent +
                                 end.second.segments_sent - begin.second.segments_sent;
  const std::uint64_t by_client =
                          client_end.acknowledgements_sent - client_begin.acknowledgements_sent,
                      by_server =
                          server_end.acknowledgements_sent - server_begin.acknowledgements_sent;
  const std::uint64_t segments = client_end.segments_sent - client_begin.segments_sent +
                                 server_end.segments_sent - server_begin.segments_sent;
  EXPECT_EQ(segments, 45u);
  EXPECT_EQ(segments + by_client + by_server, captured)
      << "66 B for each, and the payload: the wire bytes of both directions";
  EXPECT_GT(by_client, 5u) << "that were not counted";
  // Each end hears what the other says that it sent.
  EXPECT_EQ(end.second.segments_received - begin.second.segments_received -
                (end.second.data_segments_received - begin.second.data_segments_received),
            by_client);
  EXPECT_EQ(end.first.segments_received - begin.first.segments_received -
                (end.first.data_segments_received - begin.first.data_segments_received),
            by_server);
  EXPECT_EQ(end.second.data_segments_sent - begin.second.data_segments_sent,
            *server_end.kernel_segments_sent - *server_begin.kernel_segments_sent);
}

}  // namespace
}  // namespace rink::rti::testing
