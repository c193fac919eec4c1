// UDP beside TCP: how the way opens, who may not use it, and a federation whose best-effort updates take it.
#include "rti/transport/udp.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <random>

#include "rti/transport/readiness.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

struct DatagramEar final : TransportListener {
  std::vector<ConnectionId> open;
  std::vector<std::vector<std::byte>> datagrams;
  std::vector<std::byte> stream;
  int closed = 0;
  void on_open(ConnectionId connection) override { open.push_back(connection); }
  void on_bytes(ConnectionId, Bytes bytes) override { stream.insert(stream.end(), bytes.begin(), bytes.end()); }
  void on_close(ConnectionId, CloseReason, const std::string&) override { ++closed; }
  void on_datagram(ConnectionId, Bytes datagram) override { datagrams.emplace_back(datagram.begin(), datagram.end()); }
};

template <class Condition>
bool pump(UdpTransport& server, DatagramEar& here, Transport& client, DatagramEar& there, Condition is_done) {
  for (const auto start = std::chrono::steady_clock::now(); !is_done();) {
    if (std::chrono::steady_clock::now() - start > 10s) return false;
    server.poll(200us, here);
    client.poll(200us, there);
  }
  return true;
}

class Udp : public ::testing::TestWithParam<bool> {};

TEST_P(Udp, CarriesDatagramsWholeBothWays) {
  UdpTransport server({.tcp = {}, .use_offload = GetParam()}), client({.tcp = {}, .use_offload = GetParam()});
  DatagramEar here, there;
  const ConnectionId connection = client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  ASSERT_TRUE(pump(server, here, client, there, [&] { return !here.open.empty() && server.datagram_max(here.open[0]) > 0 && client.datagram_max(connection) > 0; }));
  const std::size_t size_max = server.datagram_max(here.open[0]);
  EXPECT_EQ(size_max, 1200u - 9u);
  std::mt19937 random(1);
  std::vector<std::vector<std::byte>> sent;
  for (int burst = 0; burst < 40; ++burst) {
    // Runs of one size with a shorter one at their end, as blocks are cut, and others.
    std::vector<std::vector<std::byte>> wholes;
    for (int i = 0; i < 9; ++i) {
      std::vector<std::byte> whole(burst % 2 == 0 && i % 4 != 3 ? size_max : 1 + random() % size_max);
      for (std::byte& byte : whole) byte = static_cast<std::byte>(random());
      wholes.push_back(std::move(whole));
    }
    std::vector<Datagram> datagrams;
    for (const auto& whole : wholes) datagrams.push_back({Bytes(whole).first(whole.size() / 3), Bytes(whole).subspan(whole.size() / 3)});
    (burst % 3 == 0 ? client : server).send_datagrams(burst % 3 == 0 ? connection : here.open[0], datagrams);
    (burst % 3 == 0 ? client : server).push();
    DatagramEar& ear = burst % 3 == 0 ? here : there;
    ASSERT_TRUE(pump(server, here, client, there, [&] { return ear.datagrams.size() >= wholes.size(); }));
    EXPECT_EQ(ear.datagrams, wholes);
    ear.datagrams.clear();
  }
  EXPECT_EQ(server.counters(here.open[0]).datagrams_sent, client.counters(connection).datagrams_received);
  EXPECT_EQ(server.counters(here.open[0]).datagram_bytes_sent, client.counters(connection).datagram_bytes_received);
  EXPECT_EQ(client.counters(connection).datagrams_sent, server.counters(here.open[0]).datagrams_received);
  EXPECT_EQ(server.udp_counters().ways_opened, 1u);
  EXPECT_EQ(server.udp_counters().stranger_datagrams + client.udp_counters().stranger_datagrams, 0u);
}

INSTANTIATE_TEST_SUITE_P(Offload, Udp, ::testing::Bool(), [](const auto& info) { return info.param ? "by_kernel" : "none"; });

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
  ASSERT_TRUE(pump(server, here, client, there, [&] { return there.stream.size() == words.size(); }));
}

/// A UDP socket of somebody's own.
struct RawSocket {
  explicit RawSocket(const char* address) : file(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in from = place(address, 0);
    EXPECT_EQ(::bind(file.number(), reinterpret_cast<sockaddr*>(&from), sizeof from), 0);
  }
  static sockaddr_in place(const char* address, std::uint16_t port) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    inet_pton(AF_INET, address, &to.sin_addr);
    return to;
  }
  void send(std::uint16_t port, Bytes bytes) {
    const sockaddr_in to = place("127.0.0.1", port);
    ::sendto(file.number(), bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
  std::vector<std::byte> receive() {
    std::vector<std::byte> bytes(2000);
    const ssize_t size = ::recv(file.number(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    bytes.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return bytes;
  }
  File file;
};

std::vector<std::byte> control(std::uint64_t key, std::uint8_t kind, std::uint64_t nonce, std::size_t size) {
  std::vector<std::byte> bytes = values_of(key, kind, nonce);
  bytes.resize(size);
  return bytes;
}

TEST(Udp, OnlyTheHostOfTheStreamMayOpenTheWayAndOnlyByProvingItsAddress) {
  UdpTransport server;
  TcpTransport client;  // speaks the protocol by hand
  DatagramEar here, there;
  const ConnectionId connection = client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  const auto magic = bytes_of("RKDG");
  const Bytes part = magic;
  client.send(connection, std::span(&part, 1));
  ASSERT_TRUE(pump(server, here, client, there, [&] { return there.stream.size() == 22; }));
  std::uint16_t port = 0;
  std::uint64_t up_key = 0, down_key = 0, nonce = 0;
  std::memcpy(&port, there.stream.data() + 4, 2);
  std::memcpy(&up_key, there.stream.data() + 6, 8);
  std::memcpy(&down_key, there.stream.data() + 14, 8);

  RawSocket stranger("127.0.0.2"), honest("127.0.0.1");
  const auto settle = [&] {
    for (int i = 0; i < 20; ++i) server.poll(1ms, here);
  };
  stranger.send(port, control(up_key, 1, 0, 1200));
  honest.send(port, control(up_key + 1, 1, 0, 1200));
  honest.send(port, control(up_key, 1, 0, 100));
  honest.send(port, control(up_key, 0, 0, 60));
  settle();
  EXPECT_TRUE(stranger.receive().empty()) << "who knows the key but not the host";
  EXPECT_TRUE(honest.receive().empty()) << "no key, or a question shorter than its answer";
  EXPECT_EQ(server.udp_counters().stranger_datagrams, 4u);
  EXPECT_TRUE(here.datagrams.empty());

  honest.send(port, control(up_key, 1, 0, 1200));
  settle();
  const auto welcome = honest.receive();
  ASSERT_EQ(welcome.size(), 1200u) << "no longer than the question";
  EXPECT_EQ(server.datagram_max(here.open[0]), 0u) << "nothing flows before the address is proven";
  std::memcpy(&nonce, welcome.data() + 9, 8);
  honest.send(port, control(up_key, 3, nonce + 1, 17));
  stranger.send(port, control(up_key, 3, nonce, 17));
  settle();
  EXPECT_EQ(server.datagram_max(here.open[0]), 0u);
  honest.send(port, control(up_key, 3, nonce, 17));
  settle();
  EXPECT_GT(server.datagram_max(here.open[0]), 0u);
  EXPECT_EQ(honest.receive(), control(down_key, 4, 0, 9));
  RawSocket other_port("127.0.0.1");
  other_port.send(port, control(up_key, 0, 0, 60));
  settle();
  for (const std::uint64_t wrong : {up_key + 1, down_key})
    honest.send(port, control(wrong, 0, 0, 60));
  settle();
  EXPECT_TRUE(here.datagrams.empty())
      << "from another port than the proven one, and by other keys than its own";
  honest.send(port, control(up_key, 0, 0, 60));
  settle();
  EXPECT_EQ(here.datagrams.size(), 1u);
}

/// A server made by hand, whose stream promises a way and whose datagrams the test writes.
struct HandmadeServer {
  static constexpr std::uint64_t up_key = 0x1122334455667788, down_key = 0x99aabbccddeeff00,
                                 nonce = 77;
  TcpTransport stream;
  UdpTransport client;
  DatagramEar here, there;
  RawSocket datagrams{"127.0.0.1"};
  sockaddr_in client_place{};
  ConnectionId connection = 0;

  HandmadeServer() {
    connection = client.connect("127.0.0.1", stream.listen("127.0.0.1", 0));
    sockaddr_in own{};
    socklen_t size = sizeof own;
    EXPECT_EQ(::getsockname(datagrams.file.number(), reinterpret_cast<sockaddr*>(&own), &size), 0);
    const std::vector<std::byte> greeting =
        values_of(std::uint32_t{0x47444b52}, ntohs(own.sin_port), up_key, down_key);
    EXPECT_TRUE(pump_until([&] { return !here.open.empty(); }));
    const Bytes part = greeting;
    stream.send(here.open[0], std::span(&part, 1));
  }
  template <class Condition>
  bool pump_until(Condition is_done) {
    for (const auto start = std::chrono::steady_clock::now(); !is_done();) {
      if (std::chrono::steady_clock::now() - start > 10s) return false;
      stream.poll(200us, here);
      client.poll(200us, there);
    }
    return true;
  }
  /// The client's next datagram; an empty one if none has come.
  std::vector<std::byte> hear() {
    std::vector<std::byte> bytes(2000);
    socklen_t size = sizeof client_place;
    const ssize_t got = ::recvfrom(datagrams.file.number(), bytes.data(), bytes.size(),
                                   MSG_DONTWAIT, reinterpret_cast<sockaddr*>(&client_place), &size);
    bytes.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    return bytes;
  }
  /// Waits for one of that kind.
  bool hears(std::uint8_t kind) {
    return pump_until([&] {
      const std::vector<std::byte> datagram = hear();
      return datagram.size() > 8 && std::to_integer<std::uint8_t>(datagram[8]) == kind;
    });
  }
  /// Sends it, and waits until the client has taken or refused it.
  void say(const std::vector<std::byte>& datagram) {
    const std::uint64_t before = seen();
    ::sendto(datagrams.file.number(), datagram.data(), datagram.size(), 0,
             reinterpret_cast<const sockaddr*>(&client_place), sizeof client_place);
    EXPECT_TRUE(
        pump_until([&] { return seen() != before || client.datagram_max(connection) > 0; }));
    for (int i = 0; i < 3; ++i) client.poll(1ms, there);
  }
  std::uint64_t seen() {
    return client.udp_counters().stranger_datagrams + there.datagrams.size() +
           client.udp_counters().ways_opened;
  }
};

TEST(Udp, AClientTakesNothingWithoutTheKeyThatTheServerNamedForItsDatagrams) {
  HandmadeServer server;
  ASSERT_TRUE(server.hears(1));
  int strangers = 0;
  for (const std::uint64_t wrong :
       {HandmadeServer::down_key ^ 1u, HandmadeServer::up_key, std::uint64_t{0}}) {
    for (const std::uint8_t kind :
         {std::uint8_t{2}, std::uint8_t{4}, std::uint8_t{0}}) {  // welcome, open, data
      server.say(control(wrong, kind, HandmadeServer::nonce,
                         kind == 2   ? 1200
                         : kind == 4 ? 9
                                     : 60));
      EXPECT_EQ(server.client.udp_counters().stranger_datagrams,
                static_cast<std::uint64_t>(++strangers));
      EXPECT_EQ(server.client.datagram_max(server.connection), 0u) << "the way stays shut";
    }
  }
  server.say({std::byte{1}, std::byte{2}});  // shorter than a key
  EXPECT_EQ(server.client.udp_counters().stranger_datagrams,
            static_cast<std::uint64_t>(++strangers));
  EXPECT_TRUE(server.there.datagrams.empty());

  server.say(control(HandmadeServer::down_key, 2, HandmadeServer::nonce, 1199));
  EXPECT_EQ(server.client.udp_counters().stranger_datagrams,
            static_cast<std::uint64_t>(++strangers))
      << "a welcome that does not show how long datagrams may be";

  server.say(control(HandmadeServer::down_key, 2, HandmadeServer::nonce, 1200));
  ASSERT_TRUE(server.hears(3)) << "it confirms what the right key welcomed";
  const auto data = [](std::uint64_t key, std::string_view words) {
    std::vector<std::byte> bytes = values_of(key, std::uint8_t{0});
    const auto content = bytes_of(words);
    bytes.insert(bytes.end(), content.begin(), content.end());
    return bytes;
  };
  for (const std::uint64_t key :
       {HandmadeServer::down_key ^ 1u, HandmadeServer::down_key, HandmadeServer::up_key})
    server.say(data(key, key == HandmadeServer::down_key ? "good" : "bad"));
  ASSERT_TRUE(server.pump_until([&] {
    return server.client.udp_counters().stranger_datagrams >=
               static_cast<std::uint64_t>(strangers) + 2 &&
           !server.there.datagrams.empty();
  }));
  EXPECT_EQ(server.there.datagrams, (std::vector<std::vector<std::byte>>{bytes_of("good")}));
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
  std::vector<std::byte> greeting = values_of(std::uint32_t{0x47444b52}, dead_port, std::uint64_t{1}, std::uint64_t{2});
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
  const ObjectClassHandle tide = *harbour().object_class("Tide");
  const AttributeSet level = harbour().attributes(tide);
  UdpTransport server, clients;
  FederationExecution execution(harbour(), {});
  FederationHost host(execution);
  host.add(server);
  const std::uint16_t port = server.listen("127.0.0.1", 0);
  std::deque<Station> stations;
  FederateLinks links;
  double now = 0.0;
  const auto round = [&] {
    now += 0.001;
    links.flush(now);
    host.poll(200us);
    host.advance_clock(now);
    host.match();
    host.flush();
    clients.poll(200us, links);
  };
  for (int i = 0; i < 5; ++i) {
    Station& station = stations.emplace_back(harbour());
    station.link = std::make_unique<FederateLink>(station.ambassador, clients, clients.connect("127.0.0.1", port));
    links.add(*station.link);
    station.ambassador.join("rink", "station " + std::to_string(i), "");
    if (i == 0) station.ambassador.publish_object_class_attributes(tide, level);
    else station.ambassador.subscribe_object_class_attributes(tide, level);
  }
  for (int i = 0; i < 2000 && (execution.federate_count() < 5 || server.udp_counters().ways_opened < 5); ++i) round();
  ASSERT_EQ(server.udp_counters().ways_opened, 5u);
  for (int i = 0; i < 20; ++i) round();
  std::vector<ObjectHandle> gauges;
  for (int i = 0; i < 300; ++i) gauges.push_back(stations[0].ambassador.register_object_instance(tide));
  for (int tick = 0; tick < 50; ++tick) {
    for (const ObjectHandle gauge : gauges) stations[0].ambassador.update_attribute_values(gauge, level, values_of(static_cast<double>(tick)), {now, 0});
    round();
  }
  for (int i = 0; i < 300; ++i) round();
  EXPECT_GE(execution.counters().datagrams_received, 50u) << "the owner's own go by datagram too";
  std::uint64_t received = stations[0].ambassador.counters().datagrams_received;  // acknowledgements of its own
  for (std::size_t i = 1; i < 5; ++i) {
    received += stations[i].ambassador.counters().datagrams_received;
    EXPECT_EQ(stations[i].heard.objects.size(), 300u);
    for (const auto& [handle, object] : stations[i].heard.objects) EXPECT_EQ(object.values.at(0), values_of(49.0));
  }
  EXPECT_GE(execution.counters().datagrams_sent, 4u * 40u * 2u);
  EXPECT_EQ(received, execution.counters().datagrams_sent) << "loopback loses nothing";
  EXPECT_EQ(execution.counters().updates_repaired, 0u);
  EXPECT_EQ(execution.counters().datagram_fallbacks, 0u);
}

/// An owner and a listener over real datagrams in either direction.
TEST(Udp, AnAttributesTransportationMayChangeWhileItIsUpdated) {
  const ObjectClassHandle tide = *harbour().object_class("Tide");
  const AttributeSet level = harbour().attributes(tide);
  UdpTransport server, clients;
  FederationExecution execution(harbour(), {});
  FederationHost host(execution);
  host.add(server);
  const std::uint16_t port = server.listen("127.0.0.1", 0);
  std::deque<Station> stations;
  FederateLinks links;
  double now = 0.0, value = 0.0;
  const auto round = [&] {
    now += 0.005;
    links.flush(now);
    host.poll(200us);
    host.advance_clock(now);
    host.match();
    host.flush();
    clients.poll(200us, links);
  };
  for (int i = 0; i < 2; ++i) {
    Station& station = stations.emplace_back(harbour());
    station.link = std::make_unique<FederateLink>(station.ambassador, clients, clients.connect("127.0.0.1", port));
    links.add(*station.link);
    station.ambassador.join("rink", "station " + std::to_string(i), "");
    if (i == 0) station.ambassador.publish_object_class_attributes(tide, level);
    else station.ambassador.subscribe_object_class_attributes(tide, level);
  }
  for (int i = 0; i < 2000 && (execution.federate_count() < 2 || server.udp_counters().ways_opened < 2); ++i) round();
  ASSERT_EQ(server.udp_counters().ways_opened, 2u);
  for (int i = 0; i < 20; ++i) round();
  const ObjectHandle gauge = stations[0].ambassador.register_object_instance(tide);
  const auto update = [&](int times) {
    for (int i = 0; i < times; ++i) {
      stations[0].ambassador.update_attribute_values(gauge, level, values_of(value += 1.0), {now, 0});
      for (int k = 0; k < 4; ++k) round();
    }
    for (int k = 0; k < 40; ++k) round();  // all acknowledged
    EXPECT_EQ(stations[1].heard.objects.at(gauge.value).values.at(0), values_of(value));
  };
  const auto up = [&] { return execution.counters().datagrams_received; };
  const auto down = [&] { return stations[1].ambassador.counters().datagrams_received; };
  update(20);
  const std::uint64_t up_first = up(), down_first = down();
  EXPECT_GE(up_first, 15u);
  EXPECT_GE(down_first, 15u);
  stations[0].ambassador.request_attribute_transportation_type_change(gauge, level, Transportation::reliable);
  update(20);
  EXPECT_EQ(up(), up_first) << "by the stream from the request on";
  EXPECT_LE(down(), down_first + 1);
  const std::uint64_t down_second = down();
  stations[0].ambassador.request_attribute_transportation_type_change(gauge, level, Transportation::best_effort);
  for (int k = 0; k < 40; ++k) round();
  update(20);
  EXPECT_GE(up(), up_first + 15);
  EXPECT_GE(down(), down_second + 15);
  EXPECT_EQ(execution.counters().updates_outdated + stations[1].ambassador.counters().updates_outdated, 0u);
}

}  // namespace
}  // namespace rink::rti::testing
