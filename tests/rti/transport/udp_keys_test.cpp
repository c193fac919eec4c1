// Who may open the way for datagrams, and by which keys each end takes what comes over it.
#include "tests/rti/transport/udp_by_hand.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

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
  EXPECT_EQ(server.udp_counters().rejected_datagrams, 4u);
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
  bool receives(std::uint8_t kind) {
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
    return client.udp_counters().rejected_datagrams + there.datagrams.size() +
           client.udp_counters().ways_opened;
  }
};

TEST(Udp, AClientTakesNothingWithoutTheKeyThatTheServerNamedForItsDatagrams) {
  HandmadeServer server;
  ASSERT_TRUE(server.receives(1));
  int strangers = 0;
  for (const std::uint64_t wrong :
       {HandmadeServer::down_key ^ 1u, HandmadeServer::up_key, std::uint64_t{0}}) {
    for (const std::uint8_t kind :
         {std::uint8_t{2}, std::uint8_t{4}, std::uint8_t{0}}) {  // welcome, open, data
      server.say(control(wrong, kind, HandmadeServer::nonce,
                         kind == 2   ? 1200
                         : kind == 4 ? 9
                                     : 60));
      EXPECT_EQ(server.client.udp_counters().rejected_datagrams,
                static_cast<std::uint64_t>(++strangers));
      EXPECT_EQ(server.client.datagram_max(server.connection), 0u) << "the way stays shut";
    }
  }
  server.say({std::byte{1}, std::byte{2}});  // shorter than a key
  EXPECT_EQ(server.client.udp_counters().rejected_datagrams,
            static_cast<std::uint64_t>(++strangers));
  EXPECT_TRUE(server.there.datagrams.empty());

  server.say(control(HandmadeServer::down_key, 2, HandmadeServer::nonce, 1199));
  EXPECT_EQ(server.client.udp_counters().rejected_datagrams,
            static_cast<std::uint64_t>(++strangers))
      << "a welcome that does not show how long datagrams may be";

  server.say(control(HandmadeServer::down_key, 2, HandmadeServer::nonce, 1200));
  ASSERT_TRUE(server.receives(3)) << "it confirms what the right key welcomed";
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
    return server.client.udp_counters().rejected_datagrams >=
               static_cast<std::uint64_t>(strangers) + 2 &&
           !server.there.datagrams.empty();
  }));
  EXPECT_EQ(server.there.datagrams, (std::vector<std::vector<std::byte>>{bytes_of("good")}));
}

}  // namespace
}  // namespace rink::rti::testing
