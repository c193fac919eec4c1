// Refused joins, broken rules, garbage: the one who does it is dropped and counted, nobody else is
// harmed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "rti/wire/declaration_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "rti/wire/region_messages.h"
#include "rti/wire/update_block.h"
#include "tests/rti/bare.h"

namespace rink::rti::testing {
namespace {

std::uint64_t drops(Rig& rig, Violation violation) {
  return rig.execution().counters().drops[static_cast<std::size_t>(violation)];
}

class Refused : public ::testing::TestWithParam<Carrier> {};

TEST_P(Refused, EachReasonHasItsOwnText) {
  FederationSettings settings;
  settings.federate_max = 2;
  Rig rig(GetParam(), settings);
  rig.join("first");
  const auto refusal_of = [&](const Fom& fom, std::string_view federation, std::string_view name) {
    Station& station = rig.connect(fom);
    station.ambassador.join(federation, name, "tester");
    rig.settle();
    EXPECT_FALSE(station.ambassador.is_joined());
    EXPECT_TRUE(station.link->is_finished()) << "the connection of one who is refused is closed";
    EXPECT_EQ(station.heard.lost, "") << "a refusal is told once";
    EXPECT_EQ(station.heard.log.size(), 1u);
    return std::pair(station.heard.refusal,
                     station.heard.log.empty() ? std::string() : station.heard.log.front());
  };
  std::string other_xml = harbour_xml;
  other_xml.replace(other_xml.find("HLAfloat64LE"), 12, "HLAfloat32LE");
  const Fom other = Fom::parse(other_xml, "other.xml");
  std::set<std::string> texts;
  const auto expect = [&](const auto& refused, Refusal reason) {
    EXPECT_EQ(refused.first, reason);
    EXPECT_TRUE(texts.insert(refused.second).second) << refused.second;
  };
  expect(refusal_of(other, "rink", "second"), Refusal::wrong_fom);
  expect(refusal_of(harbour(), "rank", "second"), Refusal::wrong_federation);
  expect(refusal_of(harbour(), "rink", "first"), Refusal::name_taken);
  expect(refusal_of(harbour(), "rink", ""), Refusal::bad_name);
  rig.join("second");
  expect(refusal_of(harbour(), "rink", "third"), Refusal::federation_full);
  EXPECT_EQ(drops(rig, Violation::refused), 5u);
  EXPECT_EQ(rig.execution().federate_count(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Over, Refused,
                         ::testing::Values(Carrier::in_process, Carrier::tcp,
                                           Carrier::virtual_network),
                         [](const auto& carrier) { return name_of(carrier.param); });

TEST(BadPeer, IsRefusedForAnotherVersionWhateverFollowsIt) {
  Bare bare;
  bare.execution.connect(1);
  JoinMessage message = join_of("old");
  message.version = protocol_version + 1;
  std::vector<std::byte> payload;
  write(payload, message);
  payload.push_back(std::byte{77});  // what that version has more
  bare.execution.receive(1, in_frame(payload));
  bare.tick();
  Recorder heard;
  Ambassador old(harbour(), heard);
  old.join("rink", "old", "tester");
  EXPECT_TRUE(old.receive(bare.sent[1]));
  EXPECT_EQ(heard.refusal, Refusal::wrong_version);
  const std::string both = "the federate speaks version " + std::to_string(protocol_version + 1) +
                           ", the RTI version " + std::to_string(protocol_version);
  EXPECT_NE(heard.log.back().find(both), std::string::npos) << heard.log.back();
  EXPECT_NE(bare.dropped.at(1).find(both), std::string::npos) << bare.dropped.at(1);
}

TEST(BadPeer, WithAnotherObjectModelIsToldTheHashesOfBoth) {
  std::string other_xml = harbour_xml;
  other_xml.replace(other_xml.find("HLAfloat64LE"), 12, "HLAfloat32LE");
  const Fom other = Fom::parse(other_xml, "other.xml");
  Rig rig(Carrier::in_process);
  Station& station = rig.connect(other);
  station.ambassador.join("rink", "stranger", "tester");
  rig.settle();
  ASSERT_EQ(station.heard.refusal, Refusal::wrong_fom);
  char both[96];
  std::snprintf(both, sizeof both, "the federate's is %016llx, of the RTI's %016llx",
                static_cast<unsigned long long>(other.hash()),
                static_cast<unsigned long long>(harbour().hash()));
  EXPECT_NE(station.heard.log.back().find(both), std::string::npos) << station.heard.log.back();
}

struct Crime {
  const char* name;
  Violation violation;
  std::vector<std::byte> frame;
};

/// A block of updates as it travels, with one record.
struct Block {
  static constexpr MessageKind kind = MessageKind::updates;
  UpdatesMessage header;
  std::vector<std::byte> records;
};
template <class Stream>
bool exchange(Stream& stream, Block& block) {
  Bytes records = block.records;
  return exchange(stream, block.header) && stream.rest(records, records.size());
}
Block block_of(std::uint32_t object, const std::vector<std::byte>& values) {
  Block block{{vessel_number, AttributeSet{position, speed}.bits}, {}};
  RecordWriter(block.records).add(object, values);
  return block;
}

/// A stamp whose time is infinite.
struct HalfStamp {
  static constexpr MessageKind kind = MessageKind::stamp;
  double time = HUGE_VAL;
  std::uint64_t tag = 0;
};
template <class Stream>
bool exchange(Stream& stream, HalfStamp& message) {
  return stream.number(message.time) && stream.number(message.tag);
}

std::vector<Crime> crimes() {
  const std::uint32_t own = 1 * object_block;  // the second federate's block
  const AttributeSet both{position, speed};
  const Block foreign = block_of(0, values_of(1.0f, 2.0f, 3.0f)),
              owned = block_of(own, values_of(1.0f, 2.0f, 3.0f)),
              short_record = block_of(own, values_of(1.0f, 2.0f));
  static const auto inverted = values_of(std::uint32_t{0}, 2.0, 2.0, 1.0, 1.0),
                    infinite = values_of(std::uint32_t{0}, 0.0, 0.0, HUGE_VAL, 1.0);
  const PublishObjectClassMessage publish{vessel_number, both.bits};
  const RegisterObjectMessage here{own, vessel_number, ""};
  std::vector<std::byte> too_long(frame_head_max);
  write_frame_head(too_long.data(), frame_max_to_rti + 1);
  return {
      {"SecondJoin", Violation::wrong_phase, frame_of(join_of("again"))},
      {"UnknownKind",
       Violation::malformed,
       {std::byte{1}, std::byte{0}, std::byte{0}, std::byte{0}, std::byte{250}}},
      {"OversizedFrame", Violation::oversized, too_long},
      {"UnknownClass", Violation::unknown_name, frame_of(PublishObjectClassMessage{99, 1})},
      {"UnknownAttribute", Violation::unknown_name,
       frame_of(PublishObjectClassMessage{vessel_number, 1u << 20})},
      {"UnknownInteraction", Violation::unknown_name,
       frame_of(PublishInteractionClassMessage{99, 1})},
      {"SubscriptionToUnknownRegion", Violation::unknown_name,
       frame_of(SubscribeObjectClassMessage{vessel_number, 1, 7})},
      {"UnpublishedClass", Violation::undeclared, frame_of(here)},
      {"HandleOutOfOrder", Violation::unknown_name,
       frame_of(publish, RegisterObjectMessage{own + 5, vessel_number, ""})},
      {"HandleOfSomebodyElse", Violation::unknown_name,
       frame_of(publish, RegisterObjectMessage{0, vessel_number, ""})},
      {"UpdateOfForeignObject", Violation::not_owned, frame_of(publish, StampMessage{}, foreign)},
      {"UpdateOfUnpublishedAttribute", Violation::undeclared,
       frame_of(PublishObjectClassMessage{vessel_number, AttributeSet{position}.bits}, here,
                StampMessage{}, owned)},
      {"UpdateOfWrongSize", Violation::malformed,
       frame_of(publish, here, StampMessage{}, short_record)},
      {"UpdateWithoutStamp", Violation::malformed, frame_of(publish, here, owned)},
      {"StampThatIsNoNumber", Violation::malformed, frame_of(publish, here, HalfStamp{})},
      {"DeletionOfForeignObject", Violation::not_owned, frame_of(DeleteObjectMessage{0})},
      {"DeletionOfUnknownObject", Violation::unknown_name, frame_of(DeleteObjectMessage{own + 9})},
      {"UnpublishedInteraction", Violation::undeclared,
       frame_of(InteractionMessage{1, FederateHandle::none, {}, {}})},
      {"RegionGap", Violation::unknown_name, frame_of(CreateRegionMessage{5})},
      {"RegionTwice", Violation::unknown_name,
       frame_of(CreateRegionMessage{0}, CreateRegionMessage{0})},
      {"UnknownRegion", Violation::unknown_name, frame_of(DeleteRegionMessage{3})},
      {"InvertedRegion", Violation::malformed,
       frame_of(CreateRegionMessage{0}, ModifyRegionsMessage{1, inverted})},
      {"InfiniteRegion", Violation::malformed,
       frame_of(CreateRegionMessage{0}, ModifyRegionsMessage{1, infinite})},
      {"UnknownLabel", Violation::unknown_name,
       frame_of(SynchronizationPointAchievedMessage{"nothing", 1})},
  };
}

class BadPeerCrime : public ::testing::TestWithParam<Crime> {};

TEST_P(BadPeerCrime, IsNamedCountedAndDropped) {
  Bare bare;
  const ObjectHandle object = bare.witness.register_object_instance(vessel);
  ASSERT_EQ(object.value, 0u);
  bare.tick();
  bare.enter(1, "villain");
  ASSERT_EQ(bare.execution.federate_count(), 2u);
  bare.execution.receive(1, GetParam().frame);
  bare.execution.receive(1, frame_of(HeartbeatMessage{}));  // what follows is ignored
  bare.tick();
  EXPECT_EQ(bare.drops(GetParam().violation), 1u);
  EXPECT_EQ(bare.dropped.count(1), 1u);
  EXPECT_EQ(bare.execution.federate_count(), 1u);
  EXPECT_EQ(bare.execution.object_count(), 1u) << "the witness's own";
  EXPECT_THAT(bare.witness_heard.log, ::testing::Contains("villain misbehaved"));
  EXPECT_EQ(bare.witness_heard.lost, "");
}

INSTANTIATE_TEST_SUITE_P(Of, BadPeerCrime, ::testing::ValuesIn(crimes()),
                         [](const auto& crime) { return std::string(crime.param.name); });

TEST(BadPeer, MayOnlyJoinBeforeItHasJoinedAndShortly) {
  Bare bare;
  bare.execution.connect(1);
  bare.execution.receive(1, frame_of(HeartbeatMessage{}));
  EXPECT_EQ(bare.drops(Violation::wrong_phase), 1u);
  bare.execution.connect(2);
  bare.execution.receive(2, values_of(std::uint32_t{frame_max_to_join + 1}));
  EXPECT_EQ(bare.drops(Violation::oversized), 1u);
  bare.tick();
  EXPECT_EQ(bare.dropped.size(), 2u);
}

TEST(BadPeer, IsLostWhenSilentButNotWhenItPausesForTwoSeconds) {
  Bare bare;
  bare.enter(1, "sleeper");
  bare.execution.advance_clock(2.0);
  bare.tick();
  EXPECT_EQ(bare.execution.federate_count(), 2u);
  bare.witness.advance_clock(2.0);
  bare.execution.receive(1, frame_of(HeartbeatMessage{}));
  bare.execution.advance_clock(3.0);
  for (double now = 4.0; now < 9.5; now += 1.0) {
    bare.witness.advance_clock(now);
    bare.execution.receive(0, bare.witness.outgoing());
    bare.witness.clear_outgoing();
    bare.execution.advance_clock(now);
    bare.tick();
  }
  EXPECT_EQ(bare.execution.federate_count(), 1u);
  EXPECT_THAT(bare.witness_heard.log, ::testing::Contains("sleeper lost"));
  EXPECT_EQ(bare.drops(Violation::silent), 1u);
  EXPECT_EQ(bare.witness_heard.lost, "");
}

TEST(BadPeer, AnAmbassadorNoticesASilentRti) {
  Recorder heard;
  Ambassador lonely(harbour(), heard);
  lonely.join("rink", "lonely", "tester");
  lonely.advance_clock(100.0);
  lonely.advance_clock(104.9);
  EXPECT_EQ(heard.lost, "");
  lonely.advance_clock(105.1);
  EXPECT_NE(heard.lost, "");
}

/// What a busy federate says, as one stream.
std::vector<std::byte> recorded_session() {
  const AttributeSet both{position, speed};
  const Block updates = block_of(object_block, values_of(1.0f, 2.0f, 3.0f));
  static const auto bounds = values_of(std::uint32_t{0}, 1.0, 1.0, 2.0, 2.0);
  static const auto words = bytes_of("ahoy");
  std::vector<std::byte> session = frame_of(join_of("recorded"));
  const auto rest =
      frame_of(WatchFederatesMessage{}, PublishObjectClassMessage{vessel_number, both.bits},
               CreateRegionMessage{0}, ModifyRegionsMessage{1, bounds},
               SubscribeObjectClassMessage{vessel_number, both.bits, 0},
               RegisterObjectMessage{object_block, vessel_number, "Aurora"},
               AssociateRegionMessage{object_block, 0}, StampMessage{}, updates,
               PublishInteractionClassMessage{1, 1}, SubscribeInteractionClassMessage{1, 1},
               InteractionMessage{1, FederateHandle::none, {}, words},
               RegisterSynchronizationPointMessage{"start", {}, {}},
               SynchronizationPointAchievedMessage{"start", 1});
  const auto end = frame_of(HeartbeatMessage{}, DeleteRegionMessage{0},
                            DeleteObjectMessage{object_block}, ResignMessage{});
  session.insert(session.end(), rest.begin(), rest.end());
  session.insert(session.end(), end.begin(), end.end());
  return session;
}

TEST(Fuzz, ARecordedSessionMeansTheSameHoweverItIsCut) {
  const auto session = recorded_session();
  for (std::size_t step = 1; step < session.size(); ++step) {
    Bare bare;
    bare.execution.connect(1);
    for (std::size_t at = 0; at < session.size(); at += step)
      bare.execution.receive(1, Bytes(session).subspan(at, std::min(step, session.size() - at)));
    bare.tick();
    ASSERT_EQ(bare.dropped[1], "resigned") << "cut every " << step << " bytes";
    ASSERT_EQ(bare.execution.counters().updates_received, 1u);
    ASSERT_EQ(bare.execution.object_count(), 0u);
  }
}

TEST(Fuzz, TruncationsAtEveryByteHarmNobody) {
  const auto session = recorded_session();
  Bare bare;
  for (std::size_t size = 0; size < session.size(); ++size) {
    bare.execution.connect(1);
    bare.execution.receive(1, Bytes(session).first(size));
    bare.tick();
    bare.execution.disconnect(1, "cut");
    bare.tick();
    ASSERT_EQ(bare.execution.federate_count(), 1u);
    ASSERT_EQ(bare.execution.object_count(), 0u);
  }
  EXPECT_EQ(bare.witness_heard.lost, "");
}

TEST(Fuzz, FlippedBitsHarmNobodyButTheirSender) {
  const unsigned seed = 7;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto session = recorded_session();
  Bare bare;
  for (int i = 0; i < 4000; ++i) {
    auto flipped = session;
    for (int k = 0; k < 1 + i % 3; ++k)
      flipped[random() % flipped.size()] ^= static_cast<std::byte>(1u << random() % 8);
    bare.execution.connect(1);
    bare.execution.receive(1, flipped);
    bare.tick();
    bare.execution.disconnect(1, "end");
    bare.tick();
    ASSERT_EQ(bare.execution.federate_count(), 1u);
    ASSERT_EQ(bare.execution.object_count(), 0u);
    ASSERT_EQ(bare.witness_heard.lost, "");
  }
}

TEST(Fuzz, RandomBytesHarmNobodyBeforeAndAfterJoining) {
  const unsigned seed = 8;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  Bare bare;
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::byte> noise(1 + random() % 200);
    for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
    noise[0] = static_cast<std::byte>(random() % 20);  // of a kind that exists
    if (i % 2 == 0) noise = in_frame(noise);
    bare.execution.connect(1);
    if (i % 3 != 0) bare.execution.receive(1, frame_of(join_of("noisy")));
    bare.execution.receive(1, noise);
    bare.tick();
    bare.execution.disconnect(1, "end");
    bare.tick();
    ASSERT_EQ(bare.execution.federate_count(), 1u);
    ASSERT_EQ(bare.witness_heard.lost, "");
  }
}

TEST(Fuzz, AnAmbassadorSurvivesWhateverAnRtiSends) {
  const unsigned seed = 9;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  Bare bare;
  bare.enter(1, "listener");
  bare.execution.receive(
      1, frame_of(WatchFederatesMessage{},
                  SubscribeObjectClassMessage{vessel_number, 3, RegionHandle::none}));
  bare.tick();  // the witness hears that somebody listens
  const ObjectHandle object = bare.witness.register_object_instance(vessel, "Aurora");
  bare.witness.update_attribute_values(object, AttributeSet{position, speed},
                                       values_of(1.0f, 2.0f, 3.0f), {});
  bare.tick();
  const auto session = bare.sent[1];
  for (int i = 0; i < 4000; ++i) {
    auto flipped = session;
    if (i != 0) flipped[random() % flipped.size()] ^= static_cast<std::byte>(1u << random() % 8);
    if (i % 4 == 3) flipped.resize(random() % flipped.size());
    FederateAmbassador silent;
    Ambassador ambassador(harbour(), silent);
    ambassador.join("rink", "listener", "tester");
    const bool is_understood = ambassador.receive(flipped);
    ASSERT_TRUE(i != 0 || (is_understood && ambassador.counters().updates_reflected == 1));
  }
}

}  // namespace
}  // namespace rink::rti::testing
