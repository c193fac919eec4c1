// A tick's writes spread over its window: who goes when, in which order, and how dense.
#include "rti/transport/staged/stagger.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "rti/transport/in_process.h"

namespace rink::rti {
namespace {

struct Hearer final : TransportListener {
  void on_open(ConnectionId) override { ++opened; }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    heard.emplace_back(connection, bytes.size());
  }
  void on_close(ConnectionId, CloseReason, const std::string&) override {}
  std::vector<std::pair<ConnectionId, std::size_t>> heard;
  int opened = 0;
};

/// 32 clients, all sent 100 bytes at time 0; the clock is the test's.
class Staggered : public ::testing::Test {
 protected:
  static constexpr std::size_t client_count = 32, size = 100;
  void send_all(double window_s) {
    transport.emplace(server);
    stagger = &transport->add<Stagger>(window_s, [this] { return now_s; });
    server.listen("here");
    for (std::size_t i = 0; i < client_count; ++i) clients.connect("here");
    transport->poll({}, at_server);
    const std::vector<std::byte> bytes(size);
    const Bytes whole = bytes;
    for (ConnectionId connection = 0; connection < client_count; ++connection)
      transport->send(connection, std::span(&whole, 1));
    transport->push();
  }
  std::size_t arrived() {
    clients.poll({}, at_clients);
    return at_clients.heard.size();
  }
  double now_s = 0.0;
  InProcessNetwork network;
  InProcessEndpoint server{network}, clients{network};
  std::optional<StagedTransport> transport;
  Stagger* stagger = nullptr;
  Hearer at_server, at_clients;
};

TEST_F(Staggered, LeavesInEqualGroupsOverTheWindow) {
  send_all(0.032);
  ASSERT_EQ(at_server.opened, static_cast<int>(client_count));
  for (std::size_t slot = 0; slot < Stagger::slot_count; ++slot) {
    now_s = 0.032 * static_cast<double>(slot) / Stagger::slot_count + 1e-6;
    transport->poll({}, at_server);
    EXPECT_EQ(arrived(), 2 * (slot + 1));
  }
  EXPECT_EQ(stagger->burst_bytes_max(), 2 * size);
}

TEST_F(Staggered, WithoutAWindowAllGoesAtOnce) {
  send_all(0.0);
  EXPECT_EQ(arrived(), client_count);
  EXPECT_EQ(stagger->burst_bytes_max(), client_count * size);
}

TEST_F(Staggered, WhatWaitsIsCountedKeepsItsOrderAndGoesBeforeAClose) {
  send_all(0.016);
  const std::vector<std::byte> more(7);
  const Bytes whole = more;
  transport->send(15, std::span(&whole, 1));
  EXPECT_EQ(transport->queued_bytes(15), size + 7);
  EXPECT_EQ(transport->queued_bytes(0), server.queued_bytes(0)) << "it has gone";
  transport->close(15);
  arrived();
  std::size_t bytes = 0;
  for (const auto& [connection, count] : at_clients.heard) bytes += connection == 15 ? count : 0;
  EXPECT_EQ(bytes, size + 7);
  now_s = 1.0;
  transport->poll({}, at_server);
  arrived();
  EXPECT_EQ(transport->queued_bytes(14), 0u);
}

}  // namespace
}  // namespace rink::rti
