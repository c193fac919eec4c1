// Reliable lines over a bad network: everything arrives, in order, and as late as RFC 6298 says;
// cuts halt it and healing lets it go on.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "rti/transport/modelled/network_model.h"
#include "tests/rti/transport/instants.h"

namespace rink::rti {
namespace {

using namespace testing;

NetworkConditions both_ways(const LinkConditions& conditions,
                            std::vector<Partition> partitions = {}) {
  return {.seed = 3,
          .to_listener = conditions,
          .from_listener = conditions,
          .exceptions = {},
          .partitions = std::move(partitions)};
}

/// Remembers text and instants.
struct Ear : TransportListener {
  explicit Ear(const VirtualNetwork& network) : network(network) {}
  void on_open(ConnectionId) override { opened_ns = network.now_ns(); }
  void on_bytes(ConnectionId, Bytes bytes) override {
    text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    last_ns = network.now_ns();
  }
  void on_datagram(ConnectionId, Bytes bytes) override {
    datagrams.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  void on_close(ConnectionId, CloseReason reason, const std::string&) override {
    closed = to_string(reason);
    closed_ns = network.now_ns();
  }
  const VirtualNetwork& network;
  std::string text, datagrams, closed;
  std::int64_t opened_ns = -1, last_ns = -1, closed_ns = -1;
};

struct Talk {
  explicit Talk(NetworkConditions conditions, std::size_t queue_max = 64u << 20)
      : model(std::move(conditions)), network(model, 0, queue_max) {
    network.carry_datagrams();
    server.listen("here");
    line = client.connect("here");
  }
  void run(std::int64_t until_ns) {
    while (true) {
      const std::optional<std::int64_t> next_ns = network.next_arrival_ns();
      network.advance_to(next_ns && *next_ns <= until_ns ? *next_ns : until_ns);
      server.poll(no_wait, server_ear);
      client.poll(no_wait, client_ear);
      if (!next_ns || *next_ns > until_ns) return;
    }
  }
  void say(const std::string& text) {
    client.send(line, std::array{Bytes(std::as_bytes(std::span(text)))});
  }
  void toss(const std::string& text) { toss(client, line, text); }
  void toss_back(const std::string& text) { toss(server, 0, text); }
  static void toss(VirtualEndpoint& from, ConnectionId line, const std::string& text) {
    const Bytes bytes = std::as_bytes(std::span(text));
    from.send_datagrams(
        line, std::array{Datagram{bytes.first(bytes.size() / 2), bytes.subspan(bytes.size() / 2)}});
  }
  NetworkModel model;
  VirtualNetwork network;
  VirtualEndpoint server{network}, client{network};
  Ear server_ear{network}, client_ear{network};
  ConnectionId line = 0;
};

TEST(ModelledTcp, AllArrivesInOrderOverABadNetwork) {
  Talk talk(both_ways({.latency_ns = 20 * ms,
                       .jitter_ns = 10 * ms,
                       .loss = PacketLoss::in_bursts(0.2, 3.0),
                       .reorder = 0.2,
                       .held_ns = 30 * ms,
                       .duplicate = 0.2,
                       .rate_bits_per_s = 1'000'000}));
  std::string said;
  for (int i = 0; i < 1000; ++i) {
    const std::string words = std::to_string(i) + " ";
    said += words;
    talk.say(words);
    talk.run(talk.network.now_ns() + 10 * ms);
  }
  talk.run(talk.network.now_ns() + 1000 * second);
  EXPECT_EQ(talk.server_ear.text, said);
  EXPECT_GT(talk.model.counters().retransmitted, 200u);
  EXPECT_EQ(talk.client_ear.closed, "");
}

TEST(ModelledTcp, TheFirstTimeOutIsASecondAndDoublesUntilTheCutHeals) {
  Talk talk(both_ways({.latency_ns = 50 * ms}, {{.from_ns = 0, .until_ns = 5 * second}}));
  talk.run(100 * second);
  EXPECT_EQ(talk.server_ear.opened_ns, 7 * second + 50 * ms) << "tried at 0, 1, 3 and 7 s";
  EXPECT_EQ(talk.model.counters().cut, 3u);
}

TEST(ModelledTcp, OnceTheRoundTripIsKnownTheTimeOutFollowsIt) {
  for (const std::int64_t latency_ns : {50 * ms, 400 * ms}) {
    Talk talk(both_ways({.latency_ns = latency_ns},
                        {{.from_ns = 200 * second, .until_ns = 200 * second + 1}}));
    for (int i = 0; i < 100; ++i) {
      talk.say("x");
      talk.run(talk.network.now_ns() + second);
    }
    talk.run(200 * second);
    talk.say("lost once");
    talk.run(300 * second);
    // A round trip that never changes lets the variation die out in whole nanoseconds.
    EXPECT_NEAR(static_cast<double>(talk.server_ear.last_ns - 200 * second),
                static_cast<double>(std::max(200 * ms, 2 * latency_ns) + latency_ns), 1e3);
  }
}

/// RFC 6298: after a first round trip r the time-out is r + 4 r/2, and a round trip goes there and
/// back.
TEST(ModelledTcp, ARoundTripTakesTheLatencyOfEachWay) {
  for (const auto& [up, down] : {std::pair(10 * ms, 200 * ms), std::pair(200 * ms, 10 * ms)}) {
    NetworkConditions conditions =
        both_ways({.latency_ns = up}, {{.from_ns = 2 * second, .until_ns = 2 * second + 300 * ms}});
    conditions.from_listener.latency_ns = down;
    Talk talk(std::move(conditions));
    talk.run(2 * second);
    talk.say("lost once");
    talk.run(10 * second);
    EXPECT_EQ(talk.server_ear.text, "lost once");
    EXPECT_EQ(talk.server_ear.last_ns, 2 * second + 3 * (up + down) + up) << up << " up";
  }
}

TEST(ModelledTcp, ASegmentWithThreeBehindItIsSentAgainAfterOneRoundTrip) {
  // 1500 bytes take 12 ms at 1 Mbit/s: the cut takes the first of five segments, or the last.
  const auto arrival_ns = [](std::int64_t cut_ns) {
    const Partition cut{.from_ns = 10 * second + cut_ns - ms,
                        .until_ns = 10 * second + cut_ns + ms,
                        .direction = LinkDirection::to_listener};
    Talk talk(both_ways({.latency_ns = 30 * ms, .rate_bits_per_s = 1'000'000}, {cut}));
    talk.run(10 * second);
    talk.say(std::string(5 * segment_max, 'x'));
    talk.run(30 * second);
    EXPECT_EQ(talk.model.counters().retransmitted, 1u);
    return talk.server_ear.last_ns - 10 * second;
  };
  const std::int64_t whole_ns = 5 * 12 * ms + 30 * ms;
  EXPECT_LT(arrival_ns(12 * ms), whole_ns + 60 * ms)
      << "hidden behind the rest, or a round trip later";
  EXPECT_GE(arrival_ns(60 * ms), whole_ns + 200 * ms)
      << "nothing follows the last one: the time-out";
}

TEST(ModelledTcp, ASenderBehindACutThatNeverHealsGivesUp) {
  Talk talk(both_ways({.latency_ns = ms}, {{.from_ns = second, .until_ns = INT64_MAX}}));
  talk.run(second);
  talk.say("into the void");
  talk.say("and again");
  talk.run(5000 * second);
  EXPECT_EQ(talk.client_ear.closed, to_string(CloseReason::failed));
  // RTT known: 0.2 0.4 ... 51.2 s, then 60 s: nine doublings, seven at the limit.
  EXPECT_NEAR(1e-9 * static_cast<double>(talk.client_ear.closed_ns), 1.0 + 0.2 * 511.0 + 7 * 60.0,
              1e-6);
  EXPECT_EQ(talk.server_ear.closed, "") << "who is cut off hears nothing of it";
  EXPECT_EQ(talk.server_ear.text, "");
}

TEST(ModelledTcp, ACutOfOneDirectionLetsTheOtherThrough) {
  Talk talk(both_ways({.latency_ns = ms}, {{.from_ns = second,
                                            .until_ns = 2 * second,
                                            .first = 0,
                                            .last = 0,
                                            .direction = LinkDirection::from_listener}}));
  talk.run(1500 * ms);
  talk.say("heard");
  talk.toss("seen");
  talk.toss_back("lost");
  talk.run(1900 * ms);
  EXPECT_EQ(talk.server_ear.text, "heard");
  EXPECT_EQ(talk.server_ear.datagrams, "seen");
  EXPECT_EQ(talk.client_ear.datagrams, "");
  talk.run(2 * second);
  talk.toss_back("healed");
  talk.run(3 * second);
  EXPECT_EQ(talk.client_ear.datagrams, "healed");
}

TEST(ModelledTcp, DatagramsPassAReliableLineThatWaits) {
  Talk talk(both_ways({.latency_ns = ms}, {{.from_ns = second, .until_ns = second + ms}}));
  talk.run(second);
  talk.say("late");
  talk.run(second + 2 * ms);
  talk.say(" too");
  talk.toss("now");
  talk.run(second + 10 * ms);
  EXPECT_EQ(talk.server_ear.datagrams, "now");
  EXPECT_EQ(talk.server_ear.text, "") << "what was said after waits for what was lost";
  talk.run(2 * second);
  EXPECT_EQ(talk.server_ear.text, "late too");
}

TEST(ModelledTcp, DatagramsWaitForTheConnectionAndForANetworkThatCarriesThem) {
  Talk talk(both_ways({.latency_ns = 5 * ms}));
  EXPECT_EQ(talk.client.datagram_max(talk.line), 0u);
  talk.toss("too early");
  talk.run(20 * ms);
  EXPECT_EQ(talk.client.datagram_max(talk.line), virtual_datagram_max);
  talk.toss("in time");
  talk.client.close(talk.line);
  EXPECT_EQ(talk.client.datagram_max(talk.line), 0u);
  talk.run(30 * ms);
  EXPECT_EQ(talk.server_ear.datagrams, "in time");
  EXPECT_EQ(talk.server.counters(0).datagram_bytes_received, 7u);
  VirtualNetwork reliable(talk.model);
  VirtualEndpoint server(reliable), client(reliable);
  server.listen("here");
  EXPECT_EQ(client.datagram_max(client.connect("here")), 0u);
}

TEST(ModelledTcp, WhoSendsMoreThanTheLineCarriesIsClosed) {
  Talk talk(both_ways({.latency_ns = ms, .rate_bits_per_s = 8'000'000}), 1'000'000);
  talk.run(10 * ms);
  std::size_t accepted = 0;
  for (; talk.client_ear.closed.empty() && accepted < 200; ++accepted) {
    talk.say(std::string(10'000, 'x'));
    talk.run(talk.network.now_ns());
  }
  EXPECT_EQ(talk.client_ear.closed, to_string(CloseReason::queue_full));
  EXPECT_EQ(accepted, 97u) << "10,000 bytes travel as 10,364";
  talk.run(2 * second);
  EXPECT_EQ(talk.server_ear.text.size(), 96u * 10'000u);
  EXPECT_EQ(talk.server_ear.closed, to_string(CloseReason::closed_by_peer));
}

TEST(ModelledTcp, ALineShowsWhatHasNotLeftYet) {
  Talk talk(both_ways({.rate_bits_per_s = 8'000'000}));
  talk.run(10 * ms);
  talk.say(std::string(948, 'x'));
  EXPECT_EQ(talk.client.counters(talk.line).queued_bytes, 1000u);
  talk.run(10 * ms + ms / 2);
  EXPECT_EQ(talk.client.counters(talk.line).queued_bytes, 500u);
  talk.run(11 * ms);
  EXPECT_EQ(talk.client.counters(talk.line).queued_bytes, 0u);
}

}  // namespace
}  // namespace rink::rti
