// TCP as the federation sees it: errors by kind, slow readers, killed peers, and the kernel's own
// count.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

/// Counts what a transport reports.
struct Tally final : TransportListener {
  int opened = 0, closed = 0;
  std::uint64_t bytes = 0;
  ConnectionId last = 0;
  CloseReason reason = CloseReason::closed_by_us;
  std::string detail;
  void on_open(ConnectionId connection) override { ++opened, last = connection; }
  void on_bytes(ConnectionId, Bytes received) override { bytes += received.size(); }
  void on_close(ConnectionId, CloseReason why, const std::string& text) override {
    ++closed, reason = why, detail = text;
  }
};

TEST(Tcp, APortInUseAndAnUnknownAddressAreErrorsOfTheirOwn) {
  TcpTransport first, second;
  const std::uint16_t port = first.listen("127.0.0.1", 0);
  try {
    second.listen("127.0.0.1", port);
    FAIL();
  } catch (const TransportError& error) {
    EXPECT_EQ(error.kind(), TransportError::Kind::in_use);
    EXPECT_NE(std::string(error.what()).find("127.0.0.1:" + std::to_string(port)),
              std::string::npos)
        << error.what();
  }
  try {
    second.listen("203.0.113.7", 0);  // an address of documentation, nobody's
    FAIL();
  } catch (const TransportError& error) {
    EXPECT_EQ(error.kind(), TransportError::Kind::no_such_address);
  }
}

TEST(Tcp, NobodyThereIsARefusal) {
  std::uint16_t port = 0;
  {
    TcpTransport gone;
    port = gone.listen("127.0.0.1", 0);
  }
  TcpTransport transport;
  Tally tally;
  transport.connect("127.0.0.1", port);
  for (int i = 0; i < 100 && tally.closed == 0; ++i) transport.poll(10ms, tally);
  EXPECT_EQ(tally.reason, CloseReason::refused);
  EXPECT_NE(tally.detail.find(std::to_string(port)), std::string::npos);
}

TEST(Tcp, TheSamePortIsFreeAtOnceAfterARestart) {
  std::uint16_t port = 0;
  for (int life = 0; life < 3; ++life) {
    TcpTransport server, client;
    Tally here, there;
    port = server.listen("127.0.0.1", port);
    client.connect("127.0.0.1", port);
    for (int i = 0; i < 100 && here.opened == 0; ++i) {
      client.poll(0ms, there);
      server.poll(10ms, here);
    }
    EXPECT_EQ(here.opened, 1);
    server.close(here.last);  // the side that closes first keeps the port in TIME_WAIT
    server.poll(0ms, here);
  }
}

TEST(Tcp, CountsAgreeWithTheKernels) {
  TcpTransport server, client;
  Tally here, there;
  const ConnectionId connection = client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  while (here.opened == 0 || there.opened == 0) client.poll(1ms, there), server.poll(1ms, here);
  const std::vector<std::byte> small(700), large(3000);
  const std::array<Bytes, 2> parts{small, large};
  for (int i = 0; i < 50; ++i) {
    client.send(connection, parts);
    server.poll(1ms, here);
  }
  while (here.bytes < 50 * 3700) client.poll(0ms, there), server.poll(1ms, here);
  for (int i = 0; i < 100 && client.counters(connection).kernel_bytes_sent.value_or(0) < 50 * 3700;
       ++i)
    client.poll(1ms, there);
  const TransportCounters sent = client.counters(connection), received = server.counters(here.last);
  EXPECT_EQ(sent.bytes_sent, 50u * 3700u);
  EXPECT_EQ(sent.writes, 50u);
  EXPECT_EQ(sent.segments_sent, 50u * 3u);
  ASSERT_TRUE(sent.kernel_bytes_sent && received.kernel_bytes_received);
  EXPECT_LE(*sent.kernel_bytes_sent - sent.bytes_sent, 1u)
      << "the kernel counts the opening handshake as one byte";
  EXPECT_EQ(*received.kernel_bytes_received, received.bytes_received);
  EXPECT_EQ(received.bytes_received, sent.bytes_sent);
  client.close(connection);
  client.poll(1ms, there);
  EXPECT_EQ(client.counters(connection).bytes_sent, sent.bytes_sent) << "the last count is kept";
}

TEST(Tcp, AReaderThatNeverReadsIsClosedAtItsQueuesLimit) {
  TcpSettings settings;
  settings.queue_max = 100'000;
  TcpTransport server(settings), client;
  Tally here, there;
  client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  while (here.opened == 0 || there.opened == 0) client.poll(1ms, there), server.poll(1ms, here);
  const std::vector<std::byte> chunk(10'000);
  const Bytes part = chunk;
  for (int i = 0; i < 10'000 && here.closed == 0; ++i) {
    server.send(here.last, std::span(&part, 1));
    EXPECT_LE(server.counters(here.last).queued_bytes, settings.queue_max);
    server.poll(0ms, here);
  }
  EXPECT_EQ(here.closed, 1);
  EXPECT_EQ(here.reason, CloseReason::queue_full);
  EXPECT_LE(server.counters(here.last).bytes_sent, 1'000'000u)
      << "the kernel's own queue for it is bounded too";
}

/// What waits unread at the one that closes makes the kernel reset the connection, which the other
/// notices at a write, before it has read the last words.
TEST(Tcp, LastWordsAreHeardHoweverTheEndIsNoticed) {
  TcpTransport server, client;
  Tally here, there;
  const ConnectionId connection = client.connect("127.0.0.1", server.listen("127.0.0.1", 0));
  while (here.opened == 0 || there.opened == 0) client.poll(1ms, there), server.poll(1ms, here);
  const std::vector<std::byte> words(100), chunk(10'000);
  const Bytes last = words, part = chunk;
  for (int i = 0; i < 20; ++i) server.send(here.last, std::span(&part, 1));
  client.send(connection, std::span(&last, 1));
  client.close(connection);
  for (int i = 0; i < 20; ++i) {
    server.send(here.last, std::span(&part, 1));
    std::this_thread::sleep_for(1ms);
  }
  for (int i = 0; i < 1'000 && here.closed == 0; ++i) server.poll(1ms, here);
  EXPECT_EQ(here.bytes, words.size());
  EXPECT_EQ(here.closed, 1);
  EXPECT_EQ(here.reason, CloseReason::closed_by_peer);
}

TEST(Tcp, APollThatEndsAtItsLimitSaysThatMoreMayWait) {
  TcpSettings settings;
  settings.bytes_per_poll = 10'000;
  TcpTransport server, client(settings);
  Tally here, there;
  constexpr int peers = 5;
  const std::uint16_t port = server.listen("127.0.0.1", 0);
  for (int k = 0; k < peers; ++k) client.connect("127.0.0.1", port);
  while (here.opened < peers || there.opened < peers)
    client.poll(1ms, there), server.poll(1ms, here);
  EXPECT_FALSE(client.is_behind());
  const std::vector<std::byte> chunk(8'000);
  const Bytes part = chunk;
  for (ConnectionId k = 0; k < peers; ++k) server.send(k, std::span(&part, 1));
  client.poll(1s, there);
  EXPECT_TRUE(client.is_behind());
  for (int k = 0; k < 100 && (there.bytes < peers * chunk.size() || client.is_behind()); ++k)
    client.poll(10ms, there);
  EXPECT_EQ(there.bytes, peers * chunk.size());
  EXPECT_FALSE(client.is_behind());
}

TEST(Tcp, ManyFilesAreRaisedOrNamed) {
  EXPECT_NO_THROW(ensure_file_limit(64));
  try {
    ensure_file_limit(std::size_t{1} << 40);
    FAIL();
  } catch (const TransportError& error) {
    EXPECT_EQ(error.kind(), TransportError::Kind::too_many_files);
    EXPECT_NE(std::string(error.what()).find("ulimit -n"), std::string::npos);
  }
}

TEST(Tcp, AFederationDropsTheSlowReaderAndServesTheOthers) {
  TcpSettings tcp;
  tcp.queue_max = 50'000;  // below what holds a federate back
  Rig rig(Carrier::tcp, {}, tcp);
  Station& pilot = rig.join("pilot");
  pilot.ambassador.publish_object_class_attributes(ferry, AttributeSet{destination});
  Station& coast = rig.join("coast");
  coast.ambassador.subscribe_object_class_attributes(ferry, AttributeSet{destination});
  coast.ambassador.watch_federates();
  // One that joins, subscribes, and never reads again.
  TcpTransport deaf_transport;
  Recorder deaf_heard;
  Ambassador deaf(harbour(), deaf_heard);
  FederateLink deaf_link(deaf, deaf_transport, deaf_transport.connect("127.0.0.1", rig.port()));
  FederateLinks deaf_links;
  deaf_links.add(deaf_link);
  deaf.join("rink", "deaf", "tester");
  deaf.subscribe_object_class_attributes(ferry, AttributeSet{destination});
  for (int i = 0; i < 100 && !deaf.is_joined(); ++i) {
    deaf_links.flush(0.0);
    deaf_transport.poll(1ms, deaf_links);
    rig.round();
  }
  ASSERT_TRUE(deaf.is_joined());
  const ObjectHandle object = pilot.ambassador.register_object_instance(ferry);
  const auto town = varying(std::string(30'000, 'x'));
  for (int i = 0; i < 2000 && rig.host().closed_by_full_queue() == 0; ++i) {
    pilot.ambassador.update_attribute_values(object, AttributeSet{destination}, town,
                                             {static_cast<double>(i), 0});
    rig.round();
  }
  rig.settle();
  EXPECT_EQ(rig.host().closed_by_full_queue(), 1u);
  EXPECT_THAT(coast.heard.log, ::testing::Contains("deaf lost"));
  EXPECT_EQ(static_cast<std::uint64_t>(coast.heard.objects[object.value].updates),
            pilot.ambassador.counters().updates_sent);
  EXPECT_EQ(rig.execution().federate_count(), 2u);
}

TEST(Tcp, AKilledProcessLeavesTheFederationWithinASecond) {
  Rig rig(Carrier::tcp);
  Station& coast = rig.join("coast");
  coast.ambassador.watch_federates();
  rig.settle();
  const pid_t child = fork();
  if (child == 0) {
    TcpTransport transport;
    Recorder heard;
    Ambassador doomed(harbour(), heard);
    FederateLink link(doomed, transport, transport.connect("127.0.0.1", rig.port()));
    FederateLinks links;
    links.add(link);
    doomed.join("rink", "doomed", "tester");
    for (;;) {
      links.flush(0.0);
      transport.poll(10ms, links);
    }
  }
  for (int i = 0; i < 5000 && rig.execution().federate_count() < 2; ++i) rig.round();
  ASSERT_EQ(rig.execution().federate_count(), 2u);
  kill(child, SIGKILL);
  const auto start = std::chrono::steady_clock::now();
  while (rig.execution().federate_count() == 2 && std::chrono::steady_clock::now() - start < 5s)
    rig.round();
  EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
  rig.settle();
  EXPECT_THAT(coast.heard.log, ::testing::Contains("doomed lost"));
  waitpid(child, nullptr, 0);
}

TEST(Tcp, APeerThatSendsWithoutPauseKeepsNeitherThePollNorTheOthersWaiting) {
  TcpSettings settings;
  settings.bytes_per_poll = 64 * 1024;
  settings.read_buffer = 16 * 1024;
  TcpTransport server(settings), flooder, modest;
  Tally here, there;
  const std::uint16_t port = server.listen("127.0.0.1", 0);
  const ConnectionId flood = flooder.connect("127.0.0.1", port);
  const ConnectionId other = modest.connect("127.0.0.1", port);
  while (here.opened < 2) flooder.poll(1ms, there), modest.poll(1ms, there), server.poll(1ms, here);
  const std::vector<std::byte> much(1'000'000), little(10);
  flooder.send(flood, std::array{Bytes(much)});
  modest.send(other, std::array{Bytes(little)});
  std::uint64_t most = 0;
  for (int i = 0; i < 1000 && here.bytes < much.size() + little.size(); ++i) {
    const std::uint64_t before = here.bytes;
    server.poll(1ms, here);
    most = std::max(most, here.bytes - before);
    if (i == 3) {
      EXPECT_EQ(std::min(server.counters(0).bytes_received, server.counters(1).bytes_received),
                little.size())
          << "its turn comes soon";
    }
    flooder.poll(0ms, there);
  }
  EXPECT_EQ(here.bytes, much.size() + little.size());
  EXPECT_LE(most, 64u * 1024u + 2 * 16u * 1024u);
}

TEST(Tcp, ATransportWhoseLastConnectionWentStillWaitsNoLongerThanAsked) {
  TcpTransport transport;
  Tally tally;
  for (int i = 0; i < 5; ++i) transport.poll(3ms, tally);
  EXPECT_EQ(tally.opened + tally.closed, 0);
}

TEST(Tcp, WaitsAtLeastAsLongAsAskedAndRecordsHowMuchLonger) {
  TcpTransport transport;
  Tally tally;
  transport.listen("127.0.0.1", 0);
  std::vector<double> late_ms;
  for (int i = 0; i < 100; ++i) {
    const double due_ms = i % 2 == 0 ? 0.5 : 3.3;
    const auto start = std::chrono::steady_clock::now();
    transport.poll(std::chrono::nanoseconds(static_cast<std::int64_t>(due_ms * 1e6)), tally);
    const double waited_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    EXPECT_GE(waited_ms, due_ms);
    late_ms.push_back(waited_ms - due_ms);
  }
  std::nth_element(late_ms.begin(), late_ms.begin() + 50, late_ms.end());
  RecordProperty("median_lateness_us", static_cast<int>(1000.0 * late_ms[50]));
}

TEST(InProcess, APollReportsWhatHappenedInTheOrderInWhichItDid) {
  InProcessNetwork network(1000);
  InProcessEndpoint server(network), client(network);
  Tally here, there;
  const ConnectionId lonely = client.connect("nobody");
  client.poll(0ms, there);
  EXPECT_EQ(there.reason, CloseReason::refused);
  EXPECT_EQ(client.counters(lonely).bytes_sent, 0u);
  server.listen("rti");
  EXPECT_THROW(client.listen("rti"), TransportError);
  const ConnectionId connection = client.connect("rti");
  const std::vector<std::byte> words(400);
  const Bytes part = words;
  client.send(connection, std::span(&part, 1));
  client.send(connection, std::span(&part, 1));
  client.close(connection);
  server.poll(0ms, here);
  EXPECT_EQ(here.opened, 1);
  EXPECT_EQ(here.bytes, 800u);
  EXPECT_EQ(here.reason, CloseReason::closed_by_peer);
  const ConnectionId second = client.connect("rti");
  for (int i = 0; i < 3; ++i) client.send(second, std::span(&part, 1));
  client.poll(0ms, there);
  EXPECT_EQ(there.reason, CloseReason::queue_full);
}

}  // namespace
}  // namespace rink::rti::testing
