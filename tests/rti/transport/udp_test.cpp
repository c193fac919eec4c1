// UDP beside TCP: how the way opens, who may not use it, and a federation whose best-effort updates
// take it.
#include "rti/transport/udp/udp.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "tests/rti/scenes/tides.h"
#include "tests/rti/transport/udp_by_hand.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

class Udp : public ::testing::TestWithParam<bool> {};

TEST_P(Udp, CarriesDatagramsWholeBothWays) {
  UdpTransport server({.tcp = {}, .use_offload = GetParam()}),
      client({.tcp = {}, .use_offload = GetParam()});
  DatagramEar here, there;
  const ConnectionId connection = client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  ASSERT_TRUE(pump(server, here, client, there, [&] {
    return !here.open.empty() && server.datagram_max(here.open[0]) > 0 &&
           client.datagram_max(connection) > 0;
  }));
  const std::size_t size_max = server.datagram_max(here.open[0]);
  EXPECT_EQ(size_max, 1200u - 9u);
  std::mt19937 random(1);
  std::vector<std::vector<std::byte>> sent;
  for (int burst = 0; burst < 40; ++burst) {
    // Runs of one size with a shorter one at their end, as blocks are cut, and others.
    std::vector<std::vector<std::byte>> wholes;
    for (int i = 0; i < 9; ++i) {
      std::vector<std::byte> whole(burst % 2 == 0 && i % 4 != 3 ? size_max
                                                                : 1 + random() % size_max);
      for (std::byte& byte : whole) byte = static_cast<std::byte>(random());
      wholes.push_back(std::move(whole));
    }
    std::vector<Datagram> datagrams;
    for (const auto& whole : wholes)
      datagrams.push_back(
          {Bytes(whole).first(whole.size() / 3), Bytes(whole).subspan(whole.size() / 3)});
    (burst % 3 == 0 ? client : server)
        .send_datagrams(burst % 3 == 0 ? connection : here.open[0], datagrams);
    (burst % 3 == 0 ? client : server).push();
    DatagramEar& ear = burst % 3 == 0 ? here : there;
    ASSERT_TRUE(
        pump(server, here, client, there, [&] { return ear.datagrams.size() >= wholes.size(); }));
    EXPECT_EQ(ear.datagrams, wholes);
    ear.datagrams.clear();
  }
  EXPECT_EQ(server.counters(here.open[0]).datagrams_sent,
            client.counters(connection).datagrams_received);
  EXPECT_EQ(server.counters(here.open[0]).datagram_bytes_sent,
            client.counters(connection).datagram_bytes_received);
  EXPECT_EQ(client.counters(connection).datagrams_sent,
            server.counters(here.open[0]).datagrams_received);
  EXPECT_EQ(server.udp_counters().ways_opened, 1u);
  EXPECT_EQ(server.udp_counters().rejected_datagrams + client.udp_counters().rejected_datagrams,
            0u);
}

INSTANTIATE_TEST_SUITE_P(Offload, Udp, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "by_kernel" : "none"; });

TEST(Udp, AClientOfPlainTcpHasTheStreamOnly) {
  UdpTransport server;
  TcpTransport client;
  DatagramEar here, there;
  const ConnectionId connection = client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  const auto words = bytes_of("RK is no greeting");  // but begins like one
  const Bytes part = words;
  for (const std::size_t cut : {1u, 2u, 5u}) client.send(connection, std::array{part.first(cut)});
  ASSERT_TRUE(pump(server, here, client, there, [&] { return here.stream.size() == 8; }));
  EXPECT_EQ(text_of(here.stream), "RRKRK is");
  EXPECT_EQ(server.datagram_max(here.open[0]), 0u);
  server.send(here.open[0], std::span(&part, 1));
  ASSERT_TRUE(
      pump(server, here, client, there, [&] { return there.stream.size() == words.size(); }));
}

TEST(Udp, WhereItDoesNotGetThroughTheStreamCarriesOnAndItIsCounted) {
  TcpTransport server;  // promises a port where nobody listens
  UdpTransport client;
  DatagramEar here, there;
  const ConnectionId connection = client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  std::uint16_t dead_port = 0;
  {
    UdpTransport gone;
    dead_port = gone.listen("127.0.0.1", 0);
  }
  std::vector<std::byte> greeting =
      values_of(std::uint32_t{0x47444b52}, dead_port, std::uint64_t{1}, std::uint64_t{2});
  const auto start = std::chrono::steady_clock::now();
  bool is_greeted = false;
  while (client.udp_counters().ways_failed == 0 && std::chrono::steady_clock::now() - start < 10s) {
    server.poll(1ms, here);
    if (!is_greeted && !here.open.empty()) {
      is_greeted = true;
      const Bytes part = greeting;
      server.send(here.open[0], std::span(&part, 1));
    }
    client.poll(5ms, there);
  }
  EXPECT_EQ(client.udp_counters().ways_failed, 1u);
  EXPECT_EQ(client.datagram_max(connection), 0u);
  const auto words = bytes_of("still here");
  const Bytes part = words;
  server.send(here.open[0], std::span(&part, 1));
  for (int i = 0; i < 100 && there.stream.size() < words.size(); ++i) client.poll(5ms, there);
  EXPECT_EQ(text_of(there.stream), "still here");
}

TEST(Udp, AFederationsBestEffortUpdatesTakeItAndAllElseTheStream) {
  Tides tides;
  const auto rounds = [&](int count) {
    for (int i = 0; i < count; ++i) tides.round(0.001);
  };
  for (int i = 0; i < 5; ++i) tides.join(tides.port);
  ASSERT_NO_FATAL_FAILURE(tides.open_ways([&] { rounds(1); }));
  rounds(20);
  std::vector<ObjectHandle> gauges;
  for (int i = 0; i < 300; ++i)
    gauges.push_back(tides.stations[0].ambassador.register_object_instance(tides.tide));
  for (int tick = 0; tick < 50; ++tick) {
    for (const ObjectHandle gauge : gauges) tides.set(gauge, tick, tides.now);
    rounds(1);
  }
  rounds(300);
  const FederationCounters& counters = tides.execution.counters();
  EXPECT_GE(counters.datagrams_received, 50u) << "the owner's own go by datagram too";
  std::uint64_t received =
      tides.stations[0].ambassador.counters().datagrams_received;  // acknowledgements of its own
  for (std::size_t i = 1; i < 5; ++i) {
    received += tides.stations[i].ambassador.counters().datagrams_received;
    EXPECT_EQ(tides.stations[i].heard.objects.size(), 300u);
    for (const auto& [handle, object] : tides.stations[i].heard.objects)
      EXPECT_EQ(object.values.at(0), values_of(49.0));
  }
  EXPECT_GE(counters.datagrams_sent, 4u * 40u * 2u);
  EXPECT_EQ(received, counters.datagrams_sent) << "loopback loses nothing";
  EXPECT_EQ(counters.updates_repaired, 0u);
  EXPECT_EQ(counters.datagram_fallbacks, 0u);
}

/// An owner and a listener over real datagrams in either direction.
TEST(Udp, AnAttributesTransportationMayChangeWhileItIsUpdated) {
  Tides tides;
  const auto rounds = [&](int count) {
    for (int i = 0; i < count; ++i) tides.round(0.005);
  };
  for (int i = 0; i < 2; ++i) tides.join(tides.port);
  ASSERT_NO_FATAL_FAILURE(tides.open_ways([&] { rounds(1); }));
  rounds(20);
  Ambassador &owner = tides.stations[0].ambassador, &listener = tides.stations[1].ambassador;
  const ObjectHandle gauge = owner.register_object_instance(tides.tide);
  double value = 0.0;
  const auto update = [&](int times) {
    for (int i = 0; i < times; ++i) {
      tides.set(gauge, value += 1.0, tides.now);
      rounds(4);
    }
    rounds(40);  // all acknowledged
    EXPECT_EQ(tides.stations[1].heard.objects.at(gauge.value).values.at(0), values_of(value));
  };
  const auto up = [&] { return tides.execution.counters().datagrams_received; };
  const auto down = [&] { return listener.counters().datagrams_received; };
  update(20);
  const std::uint64_t up_first = up(), down_first = down();
  EXPECT_GE(up_first, 15u);
  EXPECT_GE(down_first, 15u);
  owner.request_attribute_transportation_type_change(gauge, tides.level, Transportation::reliable);
  update(20);
  EXPECT_EQ(up(), up_first) << "by the stream from the request on";
  EXPECT_LE(down(), down_first + 1);
  const std::uint64_t down_second = down();
  owner.request_attribute_transportation_type_change(gauge, tides.level,
                                                     Transportation::best_effort);
  rounds(40);
  update(20);
  EXPECT_GE(up(), up_first + 15);
  EXPECT_GE(down(), down_second + 15);
  EXPECT_EQ(tides.execution.counters().updates_outdated + listener.counters().updates_outdated, 0u);
}

}  // namespace
}  // namespace rink::rti::testing
