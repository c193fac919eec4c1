// A listener that throws: what it was told is not repeated, and what it was not told follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "rti/transport/report_queue.h"
#include "tests/rti/transport/transport_kits.h"

namespace rink::rti::testing {
namespace {

/// Throws at whatever it is told while it is unwilling, once it has written it down.
struct ThrowingListener final : TransportListener {
  std::vector<std::string> told;
  bool is_unwilling = false;

  void on_open(ConnectionId connection) override { note("open " + std::to_string(connection)); }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    note(std::to_string(bytes.size()) + " bytes " + std::to_string(connection));
  }
  void on_close(ConnectionId connection, CloseReason, const std::string&) override {
    note("close " + std::to_string(connection));
  }
  void note(const std::string& what) {
    told.push_back(what);
    if (is_unwilling) throw std::runtime_error(what);
  }
};

TEST(AReportQueue, GoesOnBehindTheEventAtWhichAListenerThrew) {
  ReportQueue<int> queue;
  std::vector<int> told;
  const auto tell = [&](int event) {
    told.push_back(event);
    if (event == 2) throw std::runtime_error("unwilling");
  };
  for (const int event : {1, 2, 3}) queue.add(event);
  EXPECT_THROW(queue.report_all(tell), std::runtime_error);
  queue.add(4);
  EXPECT_FALSE(queue.is_empty());
  queue.report_all(tell);
  EXPECT_TRUE(queue.is_empty());
  EXPECT_EQ(told, (std::vector<int>{1, 2, 3, 4}));
}

TEST(AReportQueue, LeavesWhatComesMeanwhileForTheNextTime) {
  ReportQueue<int> queue;
  std::vector<int> told;
  const auto tell = [&](int event) {
    told.push_back(event);
    queue.add(event + 1);
  };
  queue.add(1);
  queue.report_all(tell);
  EXPECT_EQ(told, std::vector<int>{1});
  queue.report_all(tell);
  EXPECT_EQ(told, (std::vector<int>{1, 2}));
}

class AThrowingListener : public ::testing::TestWithParam<KitChoice> {
 protected:
  std::unique_ptr<TransportKit> kit = GetParam().make();
  ThrowingListener here, there;

  /// Until nothing comes any more, however often the server's listener throws.
  void settle() {
    for (int round = 0; round < 200; ++round) {
      kit->pass_time();
      kit->client().poll(std::chrono::milliseconds(kit->can_wait ? 1 : 0), there);
      kit->pass_time();
      try {
        kit->server().poll(std::chrono::milliseconds(kit->can_wait ? 1 : 0), here);
      } catch (const std::runtime_error&) {
      }
    }
  }
};

class AThrowingListenerOfAQueue : public AThrowingListener {};

TEST_P(AThrowingListener, IsToldOfEachEndOnce) {
  std::vector<ConnectionId> connections;
  for (int each = 0; each < 3; ++each) connections.push_back(kit->connect());
  settle();
  ASSERT_EQ(here.told.size(), 3u) << "opened";
  here.told.clear();
  here.is_unwilling = true;
  for (const ConnectionId connection : connections) kit->client().close(connection);
  settle();
  ASSERT_EQ(here.told.size(), 3u) << "closed";
  std::ranges::sort(here.told);
  EXPECT_EQ(std::ranges::adjacent_find(here.told), here.told.end());
}

TEST_P(AThrowingListenerOfAQueue, IsToldOfEachConnectionAndItsBytesOnce) {
  here.is_unwilling = true;
  const std::vector<std::byte> message(7);
  const Bytes bytes(message);
  for (int each = 0; each < 3; ++each) kit->client().send(kit->connect(), std::span(&bytes, 1));
  settle();
  ASSERT_EQ(here.told.size(), 6u) << "three opened, three sent something";
  std::ranges::sort(here.told);
  EXPECT_EQ(std::ranges::adjacent_find(here.told), here.told.end());
}

std::vector<KitChoice> kits_named(const std::set<std::string>& names) {
  std::vector<KitChoice> kits = transport_kits();
  std::erase_if(kits, [&](const KitChoice& kit) { return !names.contains(kit.name); });
  return kits;
}

INSTANTIATE_TEST_SUITE_P(Kinds, AThrowingListener,
                         ::testing::ValuesIn(kits_named({"in_process", "virtual_network", "tcp"})),
                         [](const auto& kit) { return kit.param.name; });
INSTANTIATE_TEST_SUITE_P(Kinds, AThrowingListenerOfAQueue,
                         ::testing::ValuesIn(kits_named({"in_process", "virtual_network"})),
                         [](const auto& kit) { return kit.param.name; });

}  // namespace
}  // namespace rink::rti::testing
