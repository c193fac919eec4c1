// Arrivals under a virtual clock: when, in which order, and what closing does to them.
#include "rti/transport/modelled/virtual_network.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/rti/transport/instants.h"

namespace rink::rti {
namespace {

using namespace testing;

Bytes bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

/// Writes down all that an endpoint reports, with the instant.
struct Diary : TransportListener {
  explicit Diary(const VirtualNetwork& network) : network(network) {}
  void on_open(ConnectionId connection) override { note(connection, "open"); }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    note(connection, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }
  void on_close(ConnectionId connection, CloseReason reason, const std::string&) override {
    note(connection, to_string(reason));
  }
  void note(ConnectionId connection, const std::string& what) {
    text += std::to_string(network.now_ns()) + " " + std::to_string(connection) + " " + what + "\n";
  }
  const VirtualNetwork& network;
  std::string text;
};

/// A server and a crowd of clients on one network.
struct Pair {
  explicit Pair(LinkModel& model) : network(model) { server.listen("here"); }
  /// Lets everything happen that happens up to `until_ns`.
  void run(std::int64_t until_ns) {
    while (true) {
      const std::optional<std::int64_t> next_ns = network.next_arrival_ns();
      network.advance_to(next_ns && *next_ns <= until_ns ? *next_ns : until_ns);
      network.check();
      server.poll(no_wait, heard);
      clients.poll(no_wait, told);
      if (!next_ns || *next_ns > until_ns) return;
    }
  }
  VirtualNetwork network;
  VirtualEndpoint server{network}, clients{network};
  Diary heard{network}, told{network};
};

void send(VirtualEndpoint& from, ConnectionId connection, const std::string& text) {
  from.send(connection, std::array{bytes_of(text)});
}

TEST(VirtualNetwork, BytesArriveExactlyOneDelayAfterTheyWereSent) {
  ConstantDelay link(7);
  Pair pair(link);
  const ConnectionId line = pair.clients.connect("here");
  send(pair.clients, line, "early");
  pair.run(100);
  EXPECT_EQ(pair.heard.text, "7 0 open\n7 0 early\n");
  EXPECT_EQ(pair.told.text, "14 0 open\n");
  send(pair.server, 0, "answer");
  EXPECT_EQ(pair.network.next_arrival_ns(), 107);
  pair.run(106);
  EXPECT_EQ(pair.told.text, "14 0 open\n");
  pair.run(107);
  EXPECT_EQ(pair.told.text, "14 0 open\n107 0 answer\n");
}

TEST(VirtualNetwork, WhatIsSentAtOneInstantArrivesInTheOrderOfSending) {
  ConstantDelay link(5);
  Pair pair(link);
  for (int i = 0; i < 3; ++i) pair.clients.connect("here");
  pair.run(20);
  pair.heard.text.clear();
  for (const ConnectionId line : {2u, 0u, 1u, 2u}) send(pair.clients, line, std::to_string(line));
  pair.run(25);
  EXPECT_EQ(pair.heard.text, "25 2 2\n25 0 0\n25 1 1\n25 2 2\n");
}

/// Alternately slow and fast.
struct Overtaking final : LinkModel {
  std::int64_t arrival_ns(std::uint32_t, std::int64_t now_ns, std::size_t size) override {
    return now_ns + (size > 3 ? 100 : 10);
  }
};

TEST(VirtualNetwork, NothingOvertakesOnOneLineWhateverTheModelSays) {
  Overtaking link;
  Pair pair(link);
  pair.clients.connect("here");
  pair.clients.connect("here");
  pair.run(1000);
  pair.heard.text.clear();
  send(pair.clients, 0, "slow");
  send(pair.clients, 0, "a");
  send(pair.clients, 1, "b");
  pair.run(2000);
  EXPECT_EQ(pair.heard.text, "1010 1 b\n1100 0 slow\n1100 0 a\n");
}

TEST(VirtualNetwork, BytesSentBeforeAClosingStillArriveAndNoneAfter) {
  ConstantDelay link(10);
  Pair pair(link);
  const ConnectionId line = pair.clients.connect("here");
  pair.run(50);
  pair.heard.text.clear();
  pair.told.text.clear();
  send(pair.server, 0, "lost on one who has gone");
  send(pair.clients, line, "last words");
  pair.clients.close(line);
  send(pair.clients, line, "too late");
  pair.run(100);
  EXPECT_EQ(pair.heard.text,
            "60 0 last words\n60 0 " + std::string(to_string(CloseReason::closed_by_peer)) + "\n");
  EXPECT_EQ(pair.told.text, "60 0 " + std::string(to_string(CloseReason::closed_by_us)) + "\n");
  EXPECT_EQ(pair.server.totals().bytes_received, 10u);
}

TEST(VirtualNetwork, ConnectingWhereNobodyListensIsRefusedAfterARoundTrip) {
  ConstantDelay link(10);
  Pair pair(link);
  pair.clients.connect("elsewhere");
  pair.run(100);
  EXPECT_EQ(pair.told.text, "20 0 " + std::string(to_string(CloseReason::refused)) + "\n");
  EXPECT_THROW(pair.clients.listen("here"), TransportError);
}

TEST(VirtualNetwork, WhatOneEndSentTheOtherReceived) {
  ConstantDelay link(3);
  Pair pair(link);
  for (int i = 0; i < 4; ++i) pair.clients.connect("here");
  std::uint64_t sent = 0, segments = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const std::string text(1 + 37 * i, 'x');
    send(i % 2 == 0 ? pair.clients : pair.server, static_cast<ConnectionId>(i / 2 % 4), text);
    if (i % 2 != 0) continue;
    sent += text.size();
    segments += (text.size() + 1447) / 1448;
    pair.run(pair.network.now_ns() + static_cast<std::int64_t>(i % 5));
  }
  pair.run(pair.network.now_ns() + 3);
  EXPECT_EQ(pair.clients.totals().bytes_sent, sent);
  EXPECT_EQ(pair.clients.totals().segments_sent, segments);
  EXPECT_EQ(pair.server.totals().bytes_received, sent);
  std::uint64_t by_line = 0;
  for (ConnectionId line = 0; line < 4; ++line)
    by_line += pair.server.counters(line).bytes_received;
  EXPECT_EQ(by_line, sent);
  EXPECT_EQ(pair.clients.totals().bytes_received, pair.server.totals().bytes_sent);
}

TEST(VirtualNetwork, AnEndpointThatGoesAwayLeavesNothingToArrive) {
  ConstantDelay link(10);
  VirtualNetwork network(link);
  VirtualEndpoint server(network);
  server.listen("here");
  Diary heard(network);
  {
    VirtualEndpoint brief(network);
    send(brief, brief.connect("here"), "hello");
    network.advance_to(10);
    server.poll(no_wait, heard);
    send(server, 0, "to nobody");
  }
  network.advance_to(100);
  server.poll(no_wait, heard);
  send(server, 0, "nor this");
  network.advance_to(200);
  EXPECT_EQ(heard.text, "10 0 open\n10 0 hello\n100 0 " +
                            std::string(to_string(CloseReason::closed_by_peer)) + "\n");
}

}  // namespace
}  // namespace rink::rti
