// Who has too many connections gets no more, told why; nobody else notices.
#include "rti/transport/staged/address_limit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rti/transport/bundle.h"
#include "rti/transport/tcp/tcp.h"
#include "rti/transport/udp/udp.h"
#include "tests/rti/transport/scripted_transport.h"

namespace rink::rti::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Notes what comes through.
struct Events final : TransportListener {
  std::vector<std::string> all;
  void on_open(ConnectionId id) override { all.push_back("open " + std::to_string(id)); }
  void on_bytes(ConnectionId id, Bytes) override { all.push_back("bytes " + std::to_string(id)); }
  void on_datagram(ConnectionId id, Bytes) override {
    all.push_back("datagram " + std::to_string(id));
  }
  void on_close(ConnectionId id, CloseReason, const std::string&) override {
    all.push_back("close " + std::to_string(id));
  }
};

struct LimitedAddresses {
  explicit LimitedAddresses(bool spares_loopback = true)
      : limit(limited.add<AddressLimit>(AddressLimitSettings{
            .most = 2, .spares_loopback = spares_loopback, .last_words = {std::byte{7}}})) {}
  void opens(ConnectionId id, const std::string& network) {
    inner.networks[id] = network;
    inner.opens(id);
  }
  std::vector<std::string> poll() {
    Events events;
    limited.poll({}, events);
    return events.all;
  }
  ScriptedTransport inner;
  StagedTransport limited{inner};
  AddressLimit& limit;
};

TEST(AddressLimit, TurnsAwayWhoHasTooManyAndNobodyElse) {
  LimitedAddresses line;
  line.opens(0, "203.0.113.7");
  line.opens(1, "203.0.113.7");
  line.opens(2, "203.0.113.7");
  line.inner.says(2, {std::byte{1}});
  line.inner.says_by_datagram(2, {std::byte{1}});
  line.inner.says(1, {std::byte{1}});
  line.opens(3, "203.0.113.8");
  EXPECT_THAT(line.poll(), ElementsAre("open 0", "open 1", "bytes 1", "open 3"))
      << "nobody above hears of who was turned away, not even the end";
  EXPECT_THAT(line.inner.closed, ElementsAre(2u));
  EXPECT_THAT(line.inner.sent[2], ElementsAre(std::byte{7}));
  EXPECT_EQ(line.limit.turned_away(), 1u);
}

TEST(AddressLimit, TakesTheNextWhenOneHasGone) {
  LimitedAddresses line;
  for (const ConnectionId id : {0u, 1u}) line.opens(id, "2001:db8:1:2::/64");
  line.poll();
  line.limited.close(0);
  EXPECT_THAT(line.poll(), ElementsAre("close 0"));
  line.opens(2, "2001:db8:1:2::/64");
  line.opens(3, "2001:db8:1:2::/64");
  EXPECT_THAT(line.poll(), ElementsAre("open 2"));
}

TEST(AddressLimit, SparesThisMachineUnlessItIsAskedFor) {
  for (const char* own : {"127.0.0.1", "127.8.9.1", "::/64", ""}) {
    LimitedAddresses spared;
    for (ConnectionId id = 0; id < 5; ++id) spared.opens(id, own);
    EXPECT_EQ(spared.poll().size(), 5u) << own;
  }
  LimitedAddresses held(false);
  for (ConnectionId id = 0; id < 5; ++id) held.opens(id, "127.0.0.1");
  EXPECT_EQ(held.poll().size(), 2u);
}

/// Polls both until `count` have come or a second is over.
template <class Server, class Client>
void await(Server& server, Client& client, Events& here, std::size_t count) {
  Events there;
  for (int i = 0; i < 200 && here.all.size() < count; ++i) {
    server.poll(std::chrono::milliseconds(5), here);
    client.poll({}, there);
  }
}

TEST(PeerNetwork, IsTheAddressThatTheOperatingSystemHas) {
  for (const auto& [address, network] :
       {std::pair{"127.0.0.1", "127.0.0.1"}, std::pair{"::1", "::/64"}}) {
    TcpTransport server, client;
    client.connect(address, server.listen(address, 0));
    Events here;
    await(server, client, here, 1);
    ASSERT_THAT(here.all, ElementsAre("open 0")) << address;
    EXPECT_EQ(server.peer_network(0), network);
    EXPECT_EQ(server.peer_network(5), "") << "nobody";
  }
  UdpTransport server, client;
  client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  Events here;
  await(server, client, here, 1);
  EXPECT_EQ(server.peer_network(0), "127.0.0.1");
}

TEST(PeerNetwork, OfConnectionsThatShareASocketIsThatOfTheSocket) {
  TcpTransport server_carrier, client_carrier;
  BundledTransport server(server_carrier), client(client_carrier);
  const ConnectionId trunk =
      client_carrier.connect("127.0.0.1", server_carrier.listen("127.0.0.1", 0));
  client.connect(trunk), client.connect(trunk);
  Events here;
  await(server, client, here, 2);
  ASSERT_EQ(here.all.size(), 2u);
  for (const ConnectionId id : {0u, 1u}) EXPECT_EQ(server.peer_network(id), "127.0.0.1");
}

}  // namespace
}  // namespace rink::rti::testing
