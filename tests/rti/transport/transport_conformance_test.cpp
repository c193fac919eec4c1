// The contract of docs/transports.md, for every kind of transport: opening, order, limits,
// counting, closing and waiting.
#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "tests/places.h"
#include "tests/rti/transport/transport_kits.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

/// Writes down what a transport reports, connection by connection.
struct Log final : TransportListener {
  struct Line {
    int opened = 0, closed = 0;
    CloseReason reason = CloseReason::failed;
    std::vector<std::byte> bytes;
    bool is_out_of_turn = false;  ///< something was told before it opened or after it closed
  };
  std::map<ConnectionId, Line> lines;
  std::function<void(ConnectionId, Bytes)> answer;

  void on_open(ConnectionId connection) override {
    Line& line = lines[connection];
    line.is_out_of_turn |= line.opened + line.closed > 0;
    ++line.opened;
  }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    Line& line = lines[connection];
    line.is_out_of_turn |= line.opened == 0 || line.closed > 0 || bytes.empty();
    line.bytes.insert(line.bytes.end(), bytes.begin(), bytes.end());
    if (answer) answer(connection, bytes);
  }
  void on_close(ConnectionId connection, CloseReason reason, const std::string&) override {
    Line& line = lines[connection];
    line.is_out_of_turn |= line.closed > 0;
    ++line.closed;
    line.reason = reason;
  }
  std::size_t opened() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(lines, [](const auto& each) { return each.second.opened > 0; }));
  }
  std::size_t closed() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(lines, [](const auto& each) { return each.second.closed > 0; }));
  }
  bool is_in_turn() const {
    return std::ranges::none_of(lines, [](const auto& each) { return each.second.is_out_of_turn; });
  }
};

/// Bytes that tell where in a stream they belong.
std::vector<std::byte> stretch(std::size_t from, std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::byte>(((from + i) * 2654435761u) >> 13);
  return bytes;
}

class TransportContract : public ::testing::TestWithParam<KitChoice> {
 protected:
  std::unique_ptr<TransportKit> kit = GetParam().make();
  Log here, there;  ///< at the server, at the client

  void step() {
    kit->pass_time();
    kit->server().poll({}, here);
    kit->pass_time();
    kit->client().poll({}, there);
  }
  /// Polls both ends until `is_done`, for at most ten seconds.
  template <class Condition>
  bool settle(Condition is_done) {
    for (const auto start = std::chrono::steady_clock::now();
         std::chrono::steady_clock::now() - start < 10s;) {
      if (is_done()) return true;
      step();
    }
    return is_done();
  }
  /// A connection that is open at both ends: the client's number.
  ConnectionId open() {
    const std::size_t before = here.opened();
    const ConnectionId connection = kit->connect();
    EXPECT_TRUE(
        settle([&] { return here.opened() > before && there.lines[connection].opened == 1; }));
    return connection;
  }
  ConnectionId newest_here() const { return here.lines.rbegin()->first; }
  static void send(Transport& transport, ConnectionId connection, Bytes bytes) {
    transport.send(connection, std::span(&bytes, 1));
  }
  ~TransportContract() override {
    EXPECT_TRUE(here.is_in_turn());
    EXPECT_TRUE(there.is_in_turn());
  }
};

TEST_P(TransportContract, OpensOnceAtBothEnds) {
  const ConnectionId connection = open();
  for (int i = 0; i < 10; ++i) step();
  EXPECT_EQ(there.lines[connection].opened, 1);
  EXPECT_EQ(here.lines[newest_here()].opened, 1);
  EXPECT_EQ(here.closed() + there.closed(), 0u);
}

TEST_P(TransportContract, RefusesWhereNobodyListens) {
  const ConnectionId connection = kit->connect_to_nobody();
  ASSERT_TRUE(settle([&] { return there.lines[connection].closed == 1; }));
  EXPECT_EQ(there.lines[connection].reason, CloseReason::refused);
  EXPECT_EQ(there.lines[connection].opened, 0);
}

TEST_P(TransportContract, KeepsTheOrderBothWaysHoweverTheBytesAreCut) {
  const ConnectionId connection = open();
  const ConnectionId other_end = newest_here();
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::size_t up = 0, down = 0;
  for (int round = 0; round < 400; ++round) {
    const std::size_t first = random() % 3000, second = random() % 300;
    const bool is_up = random() % 2 == 0;
    std::size_t& at = is_up ? up : down;
    const auto head = stretch(at, first), tail = stretch(at + first, second);
    const std::array<Bytes, 2> parts{head, tail};
    is_up ? kit->client().send(connection, parts) : kit->server().send(other_end, parts);
    at += first + second;
    if (random() % 4 == 0) step();
  }
  ASSERT_TRUE(settle([&] {
    return here.lines[other_end].bytes.size() == up && there.lines[connection].bytes.size() == down;
  }));
  EXPECT_EQ(here.lines[other_end].bytes, stretch(0, up));
  EXPECT_EQ(there.lines[connection].bytes, stretch(0, down));
}

TEST_P(TransportContract, CarriesWhatIsSentBeforeItIsOpen) {
  const ConnectionId connection = kit->connect();
  send(kit->client(), connection, stretch(0, 5000));
  ASSERT_TRUE(
      settle([&] { return here.opened() == 1 && here.lines[newest_here()].bytes.size() == 5000; }));
  EXPECT_EQ(here.lines[newest_here()].bytes, stretch(0, 5000));
}

TEST_P(TransportContract, CarriesMessagesAsLargeAsItsQueue) {
  const ConnectionId connection = open();
  const ConnectionId other_end = newest_here();
  for (std::size_t round = 0, size = 900'000; round < 5; ++round) {
    send(kit->server(), other_end, stretch(round * size, size));
    send(kit->client(), connection, stretch(round * size, size));
    ASSERT_TRUE(settle([&] {
      return there.lines[connection].bytes.size() == (round + 1) * size &&
             here.lines[other_end].bytes.size() == (round + 1) * size;
    }));
  }
  EXPECT_EQ(there.lines[connection].bytes, stretch(0, 4'500'000));
  EXPECT_EQ(here.lines[other_end].bytes, stretch(0, 4'500'000));
}

TEST_P(TransportContract, TellsBothEndsOnceWhenEitherCloses) {
  for (const bool is_ours : {true, false}) {
    const ConnectionId connection = open();
    const ConnectionId other_end = newest_here();
    is_ours ? kit->client().close(connection) : kit->server().close(other_end);
    ASSERT_TRUE(settle(
        [&] { return there.lines[connection].closed == 1 && here.lines[other_end].closed == 1; }));
    EXPECT_EQ(there.lines[connection].reason,
              is_ours ? CloseReason::closed_by_us : CloseReason::closed_by_peer);
    EXPECT_EQ(here.lines[other_end].reason,
              is_ours ? CloseReason::closed_by_peer : CloseReason::closed_by_us);
    kit->client().close(connection);
    send(kit->client(), connection, stretch(0, 10));
    send(kit->server(), other_end, stretch(0, 10));
    for (int i = 0; i < 5; ++i) step();
    EXPECT_EQ(there.lines[connection].closed, 1);
    EXPECT_EQ(here.lines[other_end].closed, 1);
  }
}

TEST_P(TransportContract, DeliversWhatWasSentBeforeAClose) {
  open();
  const ConnectionId connection = there.lines.begin()->first, other_end = newest_here();
  send(kit->server(), other_end, stretch(0, 20'000));
  kit->server().close(other_end);
  ASSERT_TRUE(settle([&] { return there.lines[connection].closed == 1; }));
  EXPECT_EQ(there.lines[connection].bytes, stretch(0, 20'000));
}

TEST_P(TransportContract, ClosesAReaderThatDoesNotReadWhenItsQueueIsFull) {
  if (!kit->limit_queue(100'000)) GTEST_SKIP() << "knows no limit";
  kit->restart_server();
  open();
  const ConnectionId other_end = newest_here();
  const auto chunk = stretch(0, 10'000);
  for (int i = 0; i < 20'000 && here.closed() == 0; ++i) {
    send(kit->server(), other_end, chunk);
    kit->server().poll({}, here);
  }
  ASSERT_EQ(here.lines[other_end].closed, 1);
  EXPECT_EQ(here.lines[other_end].reason, CloseReason::queue_full);
  EXPECT_EQ(kit->server().counters(other_end).queued_bytes, 0u);
}

TEST_P(TransportContract, CountsAtBothEndsWhatArrived) {
  const ConnectionId connection = open();
  const ConnectionId other_end = newest_here();
  for (int i = 0; i < 20; ++i) {
    send(kit->client(), connection, stretch(0, 1449));
    send(kit->server(), other_end, stretch(0, 100));
    send(kit->server(), other_end, {});
  }
  ASSERT_TRUE(settle([&] {
    return here.lines[other_end].bytes.size() == 28'980 &&
           there.lines[connection].bytes.size() == 2000;
  }));
  const TransportCounters ours = kit->client().counters(connection),
                          theirs = kit->server().counters(other_end);
  EXPECT_EQ(ours.bytes_sent, 28'980u);
  EXPECT_EQ(theirs.bytes_received, 28'980u);
  EXPECT_EQ(theirs.bytes_sent, 2000u);
  EXPECT_EQ(ours.bytes_received, 2000u);
  EXPECT_EQ(ours.writes, 20u);
  EXPECT_EQ(theirs.writes, 20u) << "a send of nothing is none";
  EXPECT_EQ(ours.segments_sent, 40u);
  kit->client().close(connection);
  ASSERT_TRUE(settle([&] { return there.closed() == 1; }));
  EXPECT_EQ(kit->client().counters(connection).bytes_sent, 28'980u) << "the last counts are kept";
}

TEST_P(TransportContract, KnowsNothingOfConnectionsThatNeverWere) {
  send(kit->client(), 12'345, stretch(0, 10));
  kit->client().close(12'345);
  EXPECT_EQ(kit->client().counters(12'345).bytes_sent, 0u);
  EXPECT_EQ(kit->client().datagram_max(12'345), 0u);
  step();
  EXPECT_TRUE(there.lines.empty());
}

TEST_P(TransportContract, AnAddressIsFreeAtOnceAfterItsOwnerHasGone) {
  for (int life = 0; life < 3; ++life) {
    const ConnectionId connection = open();
    send(kit->client(), connection, stretch(0, 100));
    ASSERT_TRUE(settle([&] { return here.lines[newest_here()].bytes.size() == 100; }));
    here.lines.clear();
    kit->restart_server();
    ASSERT_TRUE(settle([&] { return there.lines[connection].closed == 1; }))
        << "who was connected to the former owner is told";
    EXPECT_EQ(there.lines[connection].reason, CloseReason::closed_by_peer);
  }
}

TEST_P(TransportContract, CallbacksMaySendAndClose) {
  here.answer = [&](ConnectionId connection, Bytes bytes) {
    const std::vector<std::byte> copy(bytes.begin(), bytes.end());
    send(kit->server(), connection, copy);
    if (here.lines[connection].bytes.size() >= 1000) kit->server().close(connection);
  };
  const ConnectionId connection = open();
  for (std::size_t sent = 0; sent < 1000; sent += 100) {
    send(kit->client(), connection, stretch(sent, 100));
    ASSERT_TRUE(settle([&] { return there.lines[connection].bytes.size() == sent + 100; }));
  }
  ASSERT_TRUE(settle([&] { return there.lines[connection].closed == 1; }));
  EXPECT_EQ(there.lines[connection].bytes, stretch(0, 1000));
}

TEST_P(TransportContract, CarriesACrowd) {
  std::vector<ConnectionId> crowd;
  for (std::size_t i = 0; i < kit->connections; ++i) {
    crowd.push_back(kit->connect());
    if (i % 64 == 0) step();
  }
  ASSERT_TRUE(settle([&] {
    return here.opened() == crowd.size() && there.opened() == crowd.size();
  })) << here.opened()
      << " of " << crowd.size();
  for (const ConnectionId connection : crowd)
    send(kit->client(), connection, stretch(connection, 64));
  ASSERT_TRUE(settle([&] {
    return std::ranges::all_of(here.lines,
                               [](const auto& each) { return each.second.bytes.size() == 64; });
  }));
  for (const auto& [connection, line] : here.lines) send(kit->server(), connection, line.bytes);
  ASSERT_TRUE(settle([&] {
    return std::ranges::all_of(there.lines,
                               [](const auto& each) { return each.second.bytes.size() == 64; });
  }));
  for (const ConnectionId connection : crowd)
    EXPECT_EQ(there.lines[connection].bytes, stretch(connection, 64)) << "everybody gets his own";
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST_P(TransportContract, APollWaitsWithoutWorkingUntilSomethingHappens) {
  if (!kit->can_wait) GTEST_SKIP() << "what can happen has happened: its poll never waits";
  open();
  for (int i = 0; i < 20; ++i) step();
  const auto start = std::chrono::steady_clock::now();
  const double worked = processor_seconds();
  kit->server().poll(100ms, here);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 90ms);
  EXPECT_LT(processor_seconds() - worked, 0.03);
}

TEST_P(TransportContract, APollIsWokenByWhatIsSent) {
  if (!kit->can_wait) GTEST_SKIP() << "what can happen has happened: its poll never waits";
  const ConnectionId connection = open();
  std::thread sender([&] {
    std::this_thread::sleep_for(50ms);
    send(kit->client(), connection, stretch(0, 24));
    kit->client().push();
  });
  const auto start = std::chrono::steady_clock::now();
  while (here.lines[newest_here()].bytes.empty() && std::chrono::steady_clock::now() - start < 5s)
    kit->server().poll(5s, here);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 2s);
  EXPECT_EQ(here.lines[newest_here()].bytes.size(), 24u);
  sender.join();
}

INSTANTIATE_TEST_SUITE_P(Kinds, TransportContract, ::testing::ValuesIn(transport_kits()),
                         [](const auto& info) { return info.param.name; });

std::string text_of_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(test::source_folder() + "/" + path).rdbuf();
  return text.str();
}

TEST(TransportPage, NamesTheSampleThatThisSuiteRuns) {
  const std::string path = "tests/rti/transport/sample_transport.h", sample = text_of_file(path);
  ASSERT_FALSE(sample.empty());
  EXPECT_LT(std::ranges::count(sample, '\n'), 150);
  EXPECT_NE(text_of_file("docs/transports.md").find("`" + path + "`"), std::string::npos);
}

}  // namespace
}  // namespace rink::rti::testing
