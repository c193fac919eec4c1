// The transports that a command's user chooses by name: the sockets that a bundle shares.
#include "rti/transport/socket_transport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

struct SocketEar final : TransportListener {
  std::set<ConnectionId> open;
  std::map<ConnectionId, std::string> heard, closed;
  void on_open(ConnectionId id) override { open.insert(id); }
  void on_bytes(ConnectionId id, Bytes bytes) override { heard[id] += text_of(bytes); }
  void on_close(ConnectionId id, CloseReason, const std::string& detail) override {
    closed[id] = detail;
  }
};

struct Ends {
  explicit Ends(std::uint32_t bundles) : port(listen_anew(0)), client("bundle", bundles) {}
  std::uint16_t listen_anew(std::uint16_t at) {
    server.reset();
    return server.emplace("bundle").listen("127.0.0.1", at);
  }
  ConnectionId connect() { return client.connect("127.0.0.1", port); }
  template <class Condition>
  bool poll_until(Condition is_so) {
    for (int i = 0; i < 2000 && !is_so(); ++i)
      server->get().poll(1ms, at_server), client.get().poll(1ms, at_client);
    return is_so();
  }
  void say(SocketTransport& from, ConnectionId connection, const std::string& text) {
    const Bytes part = std::as_bytes(std::span(text));
    from.get().send(connection, std::span(&part, 1));
  }

  std::optional<SocketTransport> server;
  std::uint16_t port;
  SocketTransport client;
  SocketEar at_server, at_client;
};

TEST(SocketTransport, ConnectionsOfABundleShareItsSocketsByTurns) {
  Ends ends(2);
  std::vector<ConnectionId> connections;
  for (int i = 0; i < 5; ++i) connections.push_back(ends.connect());
  ASSERT_TRUE(ends.poll_until(
      [&] { return ends.at_client.open.size() == 5 && ends.at_server.open.size() == 5; }));
  for (std::size_t i = 0; i < connections.size(); ++i)
    ends.say(ends.client, connections[i], std::string(1, static_cast<char>('a' + i)));
  ASSERT_TRUE(ends.poll_until([&] { return ends.at_server.heard.size() == 5; }));
  std::set<std::string> heard;
  for (const auto& [connection, text] : ends.at_server.heard) heard.insert(text);
  EXPECT_EQ(heard, (std::set<std::string>{"a", "b", "c", "d", "e"}));
  // A record has a head of 2 bytes, and so has an opening.
  EXPECT_EQ(ends.client.totals().bytes_sent, 5u * (2 + 2 + 1));
  EXPECT_EQ(ends.server->totals().bytes_received, 5u * (2 + 2 + 1));
  EXPECT_LE(ends.client.totals().writes, 4u) << "two for each socket";
}

TEST(SocketTransport, WhoComesBackAfterTheSocketHasEndedGetsANewOne) {
  Ends ends(1);
  const ConnectionId first = ends.connect();
  ASSERT_TRUE(ends.poll_until([&] { return ends.at_client.open.contains(first); }));
  ends.server.reset();
  for (int i = 0; i < 2000 && !ends.at_client.closed.contains(first); ++i)
    ends.client.get().poll(1ms, ends.at_client);
  ASSERT_TRUE(ends.at_client.closed.contains(first));
  ends.listen_anew(ends.port);
  const ConnectionId again = ends.connect();
  ASSERT_TRUE(ends.poll_until([&] { return ends.at_client.open.contains(again); }));
  ends.say(ends.client, again, "here");
  EXPECT_TRUE(ends.poll_until([&] {
    return std::ranges::any_of(ends.at_server.heard,
                               [](const auto& each) { return each.second == "here"; });
  }));
}

}  // namespace
}  // namespace rink::rti::testing
