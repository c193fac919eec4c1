// Stages on a transport: who hears of what, and in which order.
#include "rti/transport/staged/staged_transport.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/rti/transport/scripted_transport.h"

namespace rink::rti::testing {
namespace {

/// Writes its name and what passes it into a diary that all of a scene share; keeps what it is told
/// to keep.
class Watch final : public TransportStage {
 public:
  Watch(std::string name, std::vector<std::string>& diary)
      : name_(std::move(name)), diary_(diary) {}

  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    if (passes("send")) TransportStage::send(connection, parts);
  }
  void close(ConnectionId connection) override {
    if (passes("close")) TransportStage::close(connection);
  }
  void push() override {
    if (passes("push")) TransportStage::push();
  }
  std::size_t queued_bytes(ConnectionId connection) const override {
    return TransportStage::queued_bytes(connection) + 10;
  }

  void keep(std::string what) { kept_ = std::move(what); }
  void say_below(ConnectionId connection, Bytes bytes) {
    TransportStage::send(connection, std::span(&bytes, 1));
  }
  void close_below(ConnectionId connection) { TransportStage::close(connection); }

 private:
  void on_open(ConnectionId connection) override {
    if (passes("opened")) TransportStage::on_open(connection);
  }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    if (passes("bytes")) TransportStage::on_bytes(connection, bytes);
  }
  void on_datagram(ConnectionId connection, Bytes datagram) override {
    if (passes("datagram")) TransportStage::on_datagram(connection, datagram);
  }
  void on_close(ConnectionId connection, CloseReason, const std::string& detail) override {
    if (passes("closed"))
      TransportStage::on_close(connection, CloseReason::failed, detail + " past " + name_);
  }
  bool passes(const std::string& what) {
    diary_.push_back(name_ + ": " + what);
    return what != kept_;
  }
  std::string name_, kept_;
  std::vector<std::string>& diary_;
};

/// Overrides nothing.
class Idle final : public TransportStage {};

/// Two stages about one that does nothing, and a user who writes into the same diary.
class Staged : public ::testing::Test, protected TransportListener {
 protected:
  using Diary = std::vector<std::string>;
  Staged() { inner_.opens(7); }
  /// What has happened since the last time.
  Diary news() { return std::exchange(diary_, {}); }
  Diary poll() {
    transport_.poll({}, *this);
    return news();
  }
  void on_open(ConnectionId) override { diary_.push_back("user: opened"); }
  void on_bytes(ConnectionId, Bytes bytes) override {
    diary_.push_back("user: " + std::to_string(bytes.size()) + " bytes");
  }
  void on_datagram(ConnectionId, Bytes) override { diary_.push_back("user: datagram"); }
  void on_close(ConnectionId, CloseReason reason, const std::string& detail) override {
    diary_.push_back("user: " + detail + ", " + to_string(reason));
  }
  Diary diary_;
  ScriptedTransport inner_;
  StagedTransport transport_{inner_};
  Watch& low_ = transport_.add<Watch>("low", diary_);
  Idle& idle_ = transport_.add<Idle>();
  Watch& high_ = transport_.add<Watch>("high", diary_);
  const std::vector<std::byte> four_ = std::vector<std::byte>(4);
};

TEST_F(Staged, WhatArrivesPassesTheLowestFirst) {
  inner_.says(7, four_);
  inner_.says_by_datagram(7, four_);
  EXPECT_EQ(poll(),
            (Diary{"low: opened", "high: opened", "user: opened", "low: bytes", "high: bytes",
                   "user: 4 bytes", "low: datagram", "high: datagram", "user: datagram"}));
}

TEST_F(Staged, WhatLeavesPassesTheHighestFirst) {
  const Bytes bytes = four_;
  transport_.send(7, std::span(&bytes, 1));
  transport_.push();
  transport_.close(7);
  EXPECT_EQ(news(), (Diary{"high: send", "low: send", "high: push", "low: push", "high: close",
                           "low: close"}));
  EXPECT_EQ(inner_.sent[7].size(), 4u);
  EXPECT_EQ(inner_.closed, std::vector<ConnectionId>{7});
  EXPECT_EQ(transport_.queued_bytes(7), 20u);
}

TEST_F(Staged, WhatOneKeepsNobodyBeyondItHearsOf) {
  poll();
  inner_.says(7, four_);
  low_.keep("bytes");
  EXPECT_EQ(poll(), Diary{"low: bytes"});
  high_.keep("send");
  const Bytes bytes = four_;
  transport_.send(7, std::span(&bytes, 1));
  EXPECT_EQ(news(), Diary{"high: send"});
  EXPECT_TRUE(inner_.sent.empty());
}

TEST_F(Staged, WhatAStageSaysOrClosesItselfPassesThoseBelowItAlone) {
  high_.say_below(7, four_);
  EXPECT_EQ(news(), Diary{"low: send"});
  low_.say_below(7, four_);
  EXPECT_EQ(news(), Diary{});
  EXPECT_EQ(inner_.sent[7].size(), 8u);
  high_.close_below(7);
  EXPECT_EQ(news(), Diary{"low: close"});
}

TEST_F(Staged, EachMayGiveAnotherReasonForAnEnd) {
  poll();
  transport_.close(7);
  news();
  EXPECT_EQ(poll(), (Diary{"low: closed", "high: closed",
                           "user: closed by us past low past high, failed"}));
}

}  // namespace
}  // namespace rink::rti::testing
