// What a peer may do with the channels of a bundle, and what it loses its trunk for.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "im/basics/varint.h"
#include "rti/transport/bundle.h"
#include "tests/rti/rig.h"
#include "tests/rti/transport/scripted_transport.h"

namespace rink::rti::testing {
namespace {

constexpr ConnectionId trunk = 3;

struct ChannelEar final : TransportListener {
  std::vector<ConnectionId> opened;
  std::map<ConnectionId, std::string> heard, closed;
  void on_open(ConnectionId id) override { opened.push_back(id); }
  void on_bytes(ConnectionId id, Bytes bytes) override { heard[id] += text_of(bytes); }
  void on_close(ConnectionId id, CloseReason, const std::string& detail) override {
    closed[id] = detail;
  }
};

struct BundleScene {
  ScriptedTransport carrier;
  BundledTransport bundle{carrier};
  ChannelEar ear;
  BundleScene() {
    carrier.opens(trunk);
    poll();
  }
  void poll() {
    bundle.poll({}, ear);
    bundle.check();
  }
  void records(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& heads) {
    std::vector<std::byte> bytes;
    for (const auto& [channel, size] : heads) {
      std::byte head[2 * varint_size_max];
      bytes.insert(bytes.end(), head, put_varint(put_varint(head, channel), size));
    }
    carrier.says(trunk, bytes);
    poll();
  }
  void say(ConnectionId connection) {
    const std::vector<std::byte> some(10);
    const Bytes part = some;
    bundle.send(connection, std::span(&part, 1));
  }
  bool has_lost_its_trunk() const { return carrier.closed == std::vector{trunk}; }
};

TEST(Bundle, APeerMayOpenSoManyChannelsAndLosesItsTrunkForOneMore) {
  BundleScene scene;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (std::uint32_t number = 0; number < BundledTransport::channel_max; ++number)
    all.emplace_back(number, BundledTransport::opens);
  scene.records(all);
  EXPECT_EQ(scene.ear.opened.size(), BundledTransport::channel_max);
  EXPECT_FALSE(scene.has_lost_its_trunk());
  scene.records({{BundledTransport::channel_max, BundledTransport::opens}});
  EXPECT_EQ(scene.ear.opened.size(), BundledTransport::channel_max);
  EXPECT_TRUE(scene.has_lost_its_trunk());
  EXPECT_EQ(scene.ear.closed.size(), BundledTransport::channel_max) << "and all channels with it";
}

TEST(Bundle, ClosedChannelsCountForTheyAreNeverUsedAgain) {
  BundleScene scene;
  for (std::uint32_t number = 0; number < BundledTransport::channel_max; number += 1024) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> some;
    for (std::uint32_t k = number; k < number + 1024; ++k)
      some.emplace_back(k, BundledTransport::opens), some.emplace_back(k, BundledTransport::closes);
    scene.records(some);
  }
  EXPECT_EQ(scene.ear.closed.size(), BundledTransport::channel_max);
  EXPECT_FALSE(scene.has_lost_its_trunk());
  scene.records({{BundledTransport::channel_max, BundledTransport::opens}});
  EXPECT_TRUE(scene.has_lost_its_trunk());
}

TEST(Bundle, ARecordThatIsNoneCostsTheTrunk) {
  using Heads = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  const auto costs_it = [](const Heads& heads) {
    BundleScene scene;
    scene.records(heads);
    return scene.has_lost_its_trunk();
  };
  constexpr std::uint32_t opens = BundledTransport::opens, closes = BundledTransport::closes;
  EXPECT_FALSE(costs_it({{0, opens}, {1, opens}, {0, closes}, {0, closes}}));
  EXPECT_TRUE(costs_it({{1, opens}})) << "a gap";
  EXPECT_TRUE(costs_it({{0, opens}, {0, opens}})) << "in use";
  EXPECT_TRUE(costs_it({{0, 5}})) << "bytes for a channel that was never opened";
  EXPECT_TRUE(costs_it({{0, opens}, {1, closes}}));
  BundleScene scene;
  scene.carrier.says(trunk, std::vector(10, std::byte{0x81}));
  scene.poll();
  EXPECT_TRUE(scene.has_lost_its_trunk()) << "a number without an end";
}

TEST(Bundle, ChannelsOfOurOwnTrunkAreOpenedByUsAlone) {
  BundleScene scene;
  const ConnectionId ours = scene.bundle.connect(trunk);
  scene.poll();
  EXPECT_EQ(scene.ear.opened, std::vector{ours});
  scene.records({{1, BundledTransport::opens}});
  EXPECT_TRUE(scene.has_lost_its_trunk());
}

TEST(Bundle, WhatIsGatheredGoesAtOnceWhenItIsTooMuch) {
  BundleScene scene;
  const ConnectionId ours = scene.bundle.connect(trunk);
  const std::vector<std::byte> half(BundledTransport::gathered_max / 2);
  const Bytes part = half;
  scene.bundle.send(ours, std::span(&part, 1));
  EXPECT_TRUE(scene.carrier.sent.empty());
  scene.bundle.send(ours, std::span(&part, 1));
  EXPECT_EQ(scene.carrier.sent[trunk].size(), 2 + 2 * (1 + 3 + half.size()))
      << "the opening, and two records with their heads";
}

TEST(Bundle, WhatWaitsOnATrunkIsThatOfChannelsInUseInEvenParts) {
  BundleScene scene;
  const ConnectionId first = scene.bundle.connect(trunk), second = scene.bundle.connect(trunk),
                     third = scene.bundle.connect(trunk);
  scene.bundle.connect(trunk);
  scene.poll();
  scene.say(first), scene.say(second), scene.say(third);
  scene.poll();
  scene.carrier.queued = 600;
  for (const ConnectionId each : {first, second, third})
    EXPECT_EQ(scene.bundle.queued_bytes(each), 200u);
  scene.bundle.close(third);
  scene.poll();
  EXPECT_EQ(scene.bundle.queued_bytes(first), 300u);
  EXPECT_EQ(scene.bundle.queued_bytes(third), 0u);
}

TEST(Bundle, ATrunkThatIsNotReadIsClosedForWhatWaitsForEachOfItsChannels) {
  BundleScene scene;
  const ConnectionId first = scene.bundle.connect(trunk), second = scene.bundle.connect(trunk);
  scene.poll();
  scene.bundle.connect(trunk);
  scene.say(first), scene.say(second);
  scene.carrier.queued = 2 * BundledTransport::queue_max;
  scene.poll();
  EXPECT_FALSE(scene.has_lost_its_trunk());
  scene.carrier.queued += 2;
  scene.say(second);
  scene.poll();
  EXPECT_TRUE(scene.has_lost_its_trunk());
  EXPECT_EQ(scene.ear.closed[first],
            "its bundle did not read: more than 1048576 bytes waited for each of 2");
  EXPECT_EQ(scene.ear.closed[first], scene.ear.closed[second]);
  EXPECT_FALSE(scene.bundle.takes_more(trunk));
}

TEST(Bundle, AClosedChannelKeepsItsCountersAndNothingElse) {
  BundleScene scene;
  const ConnectionId ours = scene.bundle.connect(trunk);
  scene.poll();
  scene.say(ours);
  scene.bundle.close(ours);
  scene.poll();
  EXPECT_EQ(scene.ear.closed.count(ours), 1u);
  EXPECT_EQ(scene.bundle.counters(ours).bytes_sent, 10u);
  EXPECT_EQ(scene.bundle.queued_bytes(ours), 0u);
  scene.bundle.close(ours);
  scene.say(ours);
  scene.poll();
  EXPECT_EQ(scene.bundle.counters(ours).bytes_sent, 10u);
}

TEST(Bundle, APeersTrunkWithoutChannelsIsClosedAfterAWhile) {
  BundleScene scene;
  scene.poll();
  EXPECT_FALSE(scene.has_lost_its_trunk());
  for (int i = 0; i < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    scene.poll();
  }
  EXPECT_TRUE(scene.has_lost_its_trunk());
}

TEST(Bundle, WhoStoodStillItselfGivesAPeersTrunkTimeAgain) {
  BundleScene scene;
  scene.poll();
  std::this_thread::sleep_for(BundledTransport::idle_max + std::chrono::milliseconds(1100));
  scene.poll();
  EXPECT_FALSE(scene.has_lost_its_trunk());
}

TEST(Bundle, ATrunkMayEndWithinARecord) {
  BundleScene scene;
  scene.records({{0, BundledTransport::opens}, {0, 101}});
  scene.bundle.close(scene.ear.opened.front());
  scene.carrier.close(trunk);
  scene.poll();
  scene.poll();
  EXPECT_EQ(scene.ear.closed.size(), 1u);
}

}  // namespace
}  // namespace rink::rti::testing
