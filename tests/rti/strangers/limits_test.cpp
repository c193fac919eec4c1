// What one federate may have at once: just so much, and no more by one.
#include <gtest/gtest.h>

#include <string>

#include "rti/wire/declaration_messages.h"
#include "rti/wire/message.h"
#include "rti/wire/region_messages.h"
#include "tests/rti/bare.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti::testing {
namespace {

constexpr std::uint32_t owners_first = 1 * object_block;  // the second federate's block

TEST(Limits, SoManyObjectsOfOneFederate) {
  FederationSettings settings;
  settings.objects_per_federate_max = 10;
  Bare bare(settings);
  bare.enter(1, "owner");
  bare.execution.receive(
      1, frame_of(PublishObjectClassMessage{vessel_number, AttributeSet{position, speed}.bits}));
  for (std::uint32_t k = 0; k < 10; ++k)
    bare.execution.receive(1, frame_of(RegisterObjectMessage{owners_first + k, vessel_number, ""}));
  bare.tick();
  EXPECT_EQ(bare.execution.object_count(), 10u);
  EXPECT_TRUE(bare.dropped.empty());
  bare.execution.receive(1, frame_of(RegisterObjectMessage{owners_first + 10, vessel_number, ""}));
  bare.tick();
  EXPECT_LE(bare.execution.object_count(), 10u);
  EXPECT_EQ(bare.drops(Violation::over_limit), 1u);
}

TEST(Limits, SoManyRegionsAtAnAmbassadorAndAgainAsManyOnceSomeAreDeleted) {
  Recorder heard;
  Ambassador ambassador(harbour(), heard);
  FederationExecution execution(harbour(), {});
  struct Carried final : Outlet {
    Ambassador* to = nullptr;
    void send(ConnectionId, std::span<const Bytes> parts) override {
      for (const Bytes part : parts) EXPECT_TRUE(to->receive(part));
    }
    void drop(ConnectionId, std::string_view why) override { ADD_FAILURE() << why; }
  } outlet;
  outlet.to = &ambassador;
  const auto tick = [&] {
    execution.receive(0, ambassador.outgoing());
    ambassador.clear_outgoing();
    execution.match();
    execution.flush(outlet);
  };
  execution.connect(0);
  ambassador.join("rink", "surveyor", "test");
  tick();
  RegionHandle last;
  for (std::uint32_t k = 0; k < region_max; ++k) last = ambassador.create_region();
  EXPECT_TRUE(last);
  EXPECT_FALSE(ambassador.create_region()) << "all are in use";
  ambassador.delete_region(last);
  EXPECT_TRUE(ambassador.create_region());
  EXPECT_FALSE(ambassador.create_region());
  tick();
}

TEST(Limits, SoManyReservedNames) {
  FederationSettings settings;
  settings.object_max = 10;
  Bare bare(settings);
  for (int k = 0; k < 21; ++k)
    bare.witness.reserve_object_instance_name("name " + std::to_string(k));
  struct Names final : Recorder {
    int granted = 0, refused = 0;
    void object_instance_name_reservation_succeeded(std::string_view) override { ++granted; }
    void object_instance_name_reservation_failed(std::string_view) override { ++refused; }
  } heard;
  Ambassador other(harbour(), heard);
  bare.execution.connect(1);
  other.join("rink", "other", "test");
  bare.execution.receive(1, other.outgoing());
  other.clear_outgoing();
  bare.tick();
  EXPECT_TRUE(other.receive(bare.sent[1]));
  bare.sent.clear();
  other.reserve_object_instance_name("one more");
  bare.execution.receive(1, other.outgoing());
  bare.tick();
  EXPECT_TRUE(other.receive(bare.sent[1]));
  EXPECT_EQ(heard.granted, 0) << "two for each object that there may be";
  EXPECT_EQ(heard.refused, 1);
}

TEST(Limits, SoManyMessagesAheadOfTimeOfOneFederate) {
  FederationSettings settings;
  settings.timed_per_federate_max = 100;
  TimedFederation federation({}, settings);
  TimedFederate& shouter = federation.join_timed(0.0, false);
  TimedFederate& listener = federation.join_timed(-1.0);
  for (int k = 0; k < 100; ++k) TimedFederation::say(shouter, 1e6 + k);
  federation.carry();
  EXPECT_EQ(shouter.lost, "");
  TimedFederation::say(shouter, 1e7);
  federation.carry();
  EXPECT_NE(shouter.lost, "");
  EXPECT_EQ(listener.lost, "");
  EXPECT_EQ(federation.drops(Violation::over_limit), 1u);
}

TEST(Limits, SoManyBytesAheadOfTimeOfAllTogether) {
  FederationSettings settings;
  settings.timed_bytes_max = 100'000;
  TimedFederation federation({}, settings);
  TimedFederate& stopped = federation.join_timed(0.0, false);
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& listener = federation.join_timed(-1.0);
  for (int step = 1; step <= 20; ++step) {
    TimedFederation::say(sender, sender.clock().earliest(), std::string(10'000, 'x'));
    sender.ambassador.time_advance_request(LogicalTime(step));
    federation.carry();
    if (!listener.clock().is_advancing())
      listener.ambassador.time_advance_request(LogicalTime(step));
    federation.carry();
  }
  EXPECT_NE(stopped.lost, "") << "whose time stands still, so that all the others' messages wait";
  EXPECT_EQ(sender.lost, "");
  EXPECT_EQ(listener.lost, "");
}

/// A datagram that counts more frames than have come, and holds nothing.
std::vector<std::byte> datagram_ahead(std::uint32_t number, std::uint32_t frames) {
  return values_of(number, frames);
}

TEST(Limits, SoManyDatagramsWaitForTheirFramesAtEitherEnd) {
  constexpr std::uint32_t kept = 256, more = 44;  // docs/wire.md, "Datagrams"
  Bare bare;
  bare.enter(1, "hasty");
  for (std::uint32_t number = 1; number <= kept + more; ++number) {
    bare.execution.receive_datagram(1, datagram_ahead(number, 1000));
    bare.witness.receive_datagram(datagram_ahead(number, 1000));
  }
  EXPECT_EQ(bare.execution.counters().datagrams_ignored, more);
  EXPECT_EQ(bare.witness.counters().datagrams_ignored, more);
  EXPECT_TRUE(bare.dropped.empty());
}

/// Requests within regions that are deleted before anybody has looked whom they concern.
TEST(Limits, SoManyObjectsAreLookedAtForOneFederatesRequestsInOneFlush) {
  constexpr std::uint32_t fleet = 1100, looked_at_max = 1u << 19;
  const auto status = [](std::uint32_t regions) {
    Bare bare;
    for (std::uint32_t k = 0; k < fleet; ++k) bare.witness.register_object_instance(vessel);
    bare.enter(1, "nag");
    for (std::uint32_t region = 0; region < regions; ++region) {
      const auto pair = values_of(static_cast<std::uint32_t>(AttributeSet{position}.bits), region);
      bare.execution.receive(
          1, frame_of(CreateRegionMessage{region},
                      RegionalClassMessage{vessel_number,
                                           static_cast<std::uint8_t>(RegionAction::request_update),
                                           1, pair}));
    }
    for (std::uint32_t region = 0; region < regions; ++region)
      bare.execution.receive(1, frame_of(DeleteRegionMessage{region}));
    return bare.drops(Violation::over_limit);
  };
  EXPECT_EQ(status(looked_at_max / fleet), 0u);
  EXPECT_EQ(status(looked_at_max / fleet + 2), 1u);
}

TEST(Limits, ADigestOfTooManyElementsIsLeftOut) {
  const auto model_of = [](int classes) {
    std::string text = "<objectModel><objects><objectClass><name>HLAobjectRoot</name>";
    for (int i = 0; i < classes; ++i) {
      text += "<objectClass><name>C" + std::to_string(i) + "</name>";
      for (int k = 0; k < 31; ++k)
        text += "<attribute><name>a" + std::to_string(k) +
                "</name><dataType>HLAoctet</dataType></attribute>";
      text += "</objectClass>";
    }
    return Fom::parse(text + "</objectClass></objects></objectModel>", "large.xml");
  };
  for (const int classes :
       {127, 128}) {  // 1 + 32 n elements: 4,065 and 4,097, of 4,096 that a digest holds
    const Fom large = model_of(classes);
    FederationExecution execution(large, {});
    struct Kept final : Outlet {
      std::vector<std::byte> sent;
      void send(ConnectionId, std::span<const Bytes> parts) override {
        for (const Bytes part : parts) sent.insert(sent.end(), part.begin(), part.end());
      }
      void drop(ConnectionId, std::string_view) override {}
    } outlet;
    Recorder heard;
    Ambassador ambassador(harbour(), heard);
    execution.connect(0);
    ambassador.join("rink", "stranger", "test");
    execution.receive(0, ambassador.outgoing());
    execution.match();
    execution.flush(outlet);
    ambassador.receive(outlet.sent);
    EXPECT_EQ(heard.refusal, Refusal::wrong_fom);
    EXPECT_EQ(outlet.sent.size() > 4000u * 8, classes == 127);
  }
}

}  // namespace
}  // namespace rink::rti::testing
