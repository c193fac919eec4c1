// Whoever takes more than its part of what all share gets no more, or goes; nobody else pays for
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "rti/wire/declaration_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/management_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "rti/wire/region_messages.h"
#include "rti/wire/update_block.h"
#include "tests/rti/bare.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti::testing {
namespace {

constexpr std::uint32_t villains_first = 1 * object_block;  // the second federate's block

template <class Message>
std::size_t size_of(Message message) {
  return measure(message);
}

template <class Limit>
FederationSettings with(Limit FederationSettings::*limit, std::uint32_t value) {
  FederationSettings settings;
  settings.*limit = value;
  return settings;
}

TEST(GreedyPeer, WhatWasLostOfADividedObjectIsRepairedAllTheSame) {
  const ObjectClassHandle tide = *harbour().object_class("Tide");
  const AttributeSet level{*harbour().attribute(tide, "level")};
  Bare bare;
  bare.datagram_size = 1191;
  bare.enter(1, "gauge");
  bare.execution.receive(
      1, frame_of(SubscribeObjectClassMessage{static_cast<std::uint16_t>(tide.value), level.bits,
                                              RegionHandle::none}));
  bare.witness.publish_object_class_attributes(tide, level);
  bare.tick();
  const ObjectHandle object = bare.witness.register_object_instance(tide);
  bare.tick();
  bare.witness.update_attribute_values(object, level, values_of(1.5), {});
  bare.tick();
  bare.witness.unconditional_attribute_ownership_divestiture(
      object, AttributeSet{privilege_to_delete_object});
  for (double now = 0.1; now < 1.0; now += 0.1) bare.pass(now);
  EXPECT_GT(bare.execution.counters().datagrams_sent, 0u);
  EXPECT_GT(bare.execution.counters().updates_repaired, 0u);
}

TEST(GreedyPeer, HoweverOftenUpdatesAreRequestedTheirOwnerIsToldOncePerFlush) {
  constexpr std::uint32_t fleet = 50;
  const AttributeSet both{position, speed};
  Bare bare;
  for (std::uint32_t i = 0; i < fleet; ++i) bare.witness.register_object_instance(vessel);
  bare.enter(1, "nag");
  static const auto bounds = values_of(std::uint32_t{0}, 0.0, 0.0, 9.0, 9.0);
  bare.execution.receive(1, frame_of(CreateRegionMessage{0}, ModifyRegionsMessage{1, bounds}));
  bare.tick();
  std::vector<std::byte> pairs;
  for (std::size_t i = 0; i < regions_per_message_max; ++i) {
    const auto pair = values_of(static_cast<std::uint32_t>(both.bits), std::uint32_t{0});
    pairs.insert(pairs.end(), pair.begin(), pair.end());
  }
  const std::size_t before = bare.witness_bytes;
  RegionalClassMessage request{vessel_number,
                               static_cast<std::uint8_t>(RegionAction::request_update),
                               regions_per_message_max, pairs};
  for (int i = 0; i < 100; ++i) bare.execution.receive(1, frame_of(request));
  bare.tick();
  EXPECT_EQ(bare.witness_bytes - before,
            in_frame(std::vector<std::byte>(fleet * size_of(ProvideUpdateMessage{}))).size());
  bare.execution.receive(1, frame_of(request, CreateRegionMessage{1}, DeleteRegionMessage{0}));
  bare.tick();
  EXPECT_EQ(bare.witness_bytes - before,
            2 * in_frame(std::vector<std::byte>(fleet * size_of(ProvideUpdateMessage{}))).size())
      << "also of a region that is deleted at once";
  EXPECT_TRUE(bare.dropped.empty());
}

TEST(GreedyPeer, PointsOfOneFederateLeaveTheOthersTheirs) {
  Bare bare;
  bare.enter(1, "hoarder");
  std::vector<std::string> labels;
  for (int i = 0; i < 300; ++i) labels.push_back("point " + std::to_string(i));
  for (const std::string& label : labels)
    bare.execution.receive(1, frame_of(RegisterSynchronizationPointMessage{label, {}, {}}));
  bare.tick();
  bare.witness.register_synchronization_point("start", {});
  bare.tick();
  EXPECT_THAT(bare.witness_heard.log, ::testing::Contains("registered start"));
  EXPECT_THAT(bare.witness_heard.log, ::testing::Contains("announced point 0"));
  EXPECT_THAT(bare.witness_heard.log, ::testing::Not(::testing::Contains("announced point 299")));
  EXPECT_TRUE(bare.dropped.empty()) << "the others are refused by an answer";
}

TEST(GreedyPeer, PointsLeftBehindByThoseWhoComeAndGoDoNotGrowForEver) {
  Bare bare;
  for (int visit = 0; visit < 20; ++visit) {
    bare.enter(1, "visitor");
    for (int i = 0; i < 60; ++i) {
      const std::string label = std::to_string(visit) + ":" + std::to_string(i);
      bare.execution.receive(1, frame_of(RegisterSynchronizationPointMessage{label, {}, {}}));
    }
    bare.execution.receive(1, frame_of(ResignMessage{}));
    bare.tick();
  }
  Recorder heard;
  Ambassador newcomer(harbour(), heard);
  bare.sent.clear();
  bare.enter(1, "newcomer");
  newcomer.join("rink", "newcomer", "tester");
  EXPECT_TRUE(newcomer.receive(bare.sent[1]));
  EXPECT_EQ(std::ranges::count_if(
                heard.log, [](const std::string& each) { return each.starts_with("announced"); }),
            256);
}

TEST(GreedyPeer, AHoardOfObjectsLeavesTheOthersTheirShare) {
  Bare bare(with(&FederationSettings::object_max, 100));
  bare.enter(1, "hoarder");
  bare.execution.receive(
      1, frame_of(PublishObjectClassMessage{vessel_number, AttributeSet{position, speed}.bits}));
  const auto hoard = [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t i = from; i < to; ++i)
      bare.execution.receive(
          1, frame_of(RegisterObjectMessage{villains_first + i, vessel_number, ""}));
  };
  hoard(0, 100);
  for (int i = 0; i < 40; ++i) bare.witness.register_object_instance(vessel);
  bare.tick();
  EXPECT_EQ(bare.execution.object_count(), 140u);
  bare.sent.clear();
  hoard(100, 110);
  bare.execution.receive(1,
                         frame_of(DeleteObjectMessage{villains_first + 105}));  // it could not know
  bare.tick();
  EXPECT_EQ(bare.execution.object_count(), 140u);
  EXPECT_EQ(bare.sent[1].size(),
            frame_head_size(0) + 10 * size_of(RemoveObjectMessage{villains_first}))
      << "it is told so";
  EXPECT_TRUE(bare.dropped.empty());
}

TEST(GreedyPeer, NamesOfOneFederatesObjectsAreBounded) {
  Bare bare(with(&FederationSettings::name_bytes_per_federate_max, 1000));
  bare.enter(1, "verbose");
  bare.execution.receive(
      1, frame_of(PublishObjectClassMessage{vessel_number, AttributeSet{position, speed}.bits}));
  const std::string name(100, 'x');
  for (std::uint32_t i = 0; i < 20; ++i)
    bare.execution.receive(
        1, frame_of(RegisterObjectMessage{villains_first + i, vessel_number, name}));
  bare.tick();
  EXPECT_EQ(bare.execution.object_count(), 10u);
  EXPECT_TRUE(bare.dropped.empty());
}

TEST(GreedyPeer, AShouterGoesBeforeThoseWhoListen) {
  Bare bare;
  bare.witness.subscribe_interaction_class(hail);
  bare.enter(1, "shouter");
  bare.execution.receive(
      1, frame_of(PublishInteractionClassMessage{static_cast<std::uint16_t>(hail.value), 1}));
  bare.tick();
  const std::vector<std::byte> words(32'000);
  const std::size_t before = bare.witness_bytes;
  for (int i = 0; i < 1000; ++i)
    bare.execution.receive(
        1, frame_of(InteractionMessage{
               static_cast<std::uint16_t>(hail.value), FederateHandle::none, {}, words}));
  bare.tick();
  EXPECT_EQ(bare.drops(Violation::over_limit), 1u);
  EXPECT_EQ(bare.dropped.count(1), 1u);
  EXPECT_LT(bare.witness_bytes - before, 600'000u);
  EXPECT_EQ(bare.witness_heard.lost, "");
}

TEST(GreedyPeer, AStrangersQuestionsAreAnsweredOnceAFlushAndItGoesIfItAsksTooMuch) {
  Bare bare;
  bare.execution.connect(1);
  const auto ask = frame_of(ListFederationExecutionsMessage{}, QueryManagementMessage{},
                            CreateFederationExecutionMessage{"mine", 0});
  bare.execution.receive(1, ask);
  bare.tick();
  const std::size_t answer = bare.sent[1].size();
  EXPECT_GT(answer, 0u);
  bare.sent.clear();
  bare.sends.clear();
  for (int i = 0; i < 20; ++i)
    bare.execution.receive(1,
                           frame_of(ListFederationExecutionsMessage{}, QueryManagementMessage{}));
  bare.tick();
  EXPECT_LE(bare.sends[1], 2) << "one for the list, one for the report";
  EXPECT_LT(bare.sent[1].size(), answer) << "the same, without the creation's";
  EXPECT_TRUE(bare.dropped.empty());
  for (int i = 0; i < 1000; ++i)
    bare.execution.receive(1, frame_of(ListFederationExecutionsMessage{}));
  bare.tick();
  EXPECT_EQ(bare.drops(Violation::over_limit), 1u);
  EXPECT_EQ(bare.dropped.count(1), 1u);
}

TEST(GreedyPeer, AStrangerWhoSaysOneByteNowAndThenIsSilent) {
  Bare bare;
  bare.execution.connect(1);
  auto slow = frame_of(join_of("slow"));
  for (int second = 0; second < 8; ++second) {
    bare.execution.receive(1, Bytes(slow).subspan(static_cast<std::size_t>(second), 1));
    bare.pass(second);
  }
  EXPECT_EQ(bare.drops(Violation::silent), 1u);
  EXPECT_EQ(bare.dropped.count(1), 1u);
}

TEST(GreedyPeer, WhoSaysMoreAheadOfTimeThanIsKeptForOneGoes) {
  TimedFederation federation({}, with(&FederationSettings::timed_bytes_per_federate_max, 2u << 20));
  TimedFederate& shouter = federation.join_timed(0.0, false);
  TimedFederate& listener = federation.join_timed(-1.0);
  listener.ambassador.time_advance_request(LogicalTime(10.0));
  for (int i = 0; i < 100 && shouter.lost.empty(); ++i) {
    TimedFederation::say(shouter, 1e6 + i, std::string(30'000, 'x'));
    federation.carry();
  }
  EXPECT_NE(shouter.lost, "");
  EXPECT_EQ(listener.lost, "");
  EXPECT_EQ(federation.drops(Violation::over_limit), 1u);
}

TEST(GreedyPeer, WhoHoldsTheOthersTimeUpGoesBeforeThoseWhoWaitForIt) {
  TimedFederation federation({}, with(&FederationSettings::timed_max, 100));
  TimedFederate& stopped = federation.join_timed(0.0, false);
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& listener = federation.join_timed(-1.0);
  for (int step = 1; step <= 300; ++step) {
    TimedFederation::say(sender, sender.clock().earliest(), "step " + std::to_string(step));
    sender.ambassador.time_advance_request(LogicalTime(step));
    federation.carry();
    if (!listener.clock().is_advancing())
      listener.ambassador.time_advance_request(LogicalTime(step));
    federation.carry();
  }
  EXPECT_NE(stopped.lost, "");
  EXPECT_EQ(sender.lost, "");
  EXPECT_EQ(listener.lost, "");
  EXPECT_EQ(listener.times(TimedFederate::Heard::What::message).size(), 300u);
}

}  // namespace
}  // namespace rink::rti::testing
