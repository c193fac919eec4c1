// Messages of every kind whose fields are guesses: whoever sends them harms nobody else, and
// whoever hears them survives.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "rti/baselines/residual_bits.h"
#include "rti/wire/admission_messages.h"
#include "rti/wire/baseline_messages.h"
#include "rti/wire/datagram.h"
#include "rti/wire/declaration_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/fom_messages.h"
#include "rti/wire/management_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/ownership_messages.h"
#include "rti/wire/region_messages.h"
#include "rti/wire/save_messages.h"
#include "rti/wire/stamp_steps.h"
#include "rti/wire/time_messages.h"
#include "tests/places.h"
#include "tests/rti/wire/guessed_message.h"

namespace rink::rti::testing {
namespace {

const std::vector<Guesser>& from_federates() {
  static const std::vector<Guesser> all = guessers_of<
      JoinMessage, ResignMessage, HeartbeatMessage, RegisterSynchronizationPointMessage,
      SynchronizationPointAchievedMessage, WatchFederatesMessage, PublishObjectClassMessage,
      SubscribeObjectClassMessage, PublishInteractionClassMessage, SubscribeInteractionClassMessage,
      RegisterObjectMessage, DeleteObjectMessage, UpdatesMessage, InteractionMessage,
      CreateRegionMessage, ModifyRegionsMessage, AssociateRegionMessage, DeleteRegionMessage,
      StampMessage, EnableTimeRegulationMessage, TimeSwitchMessage, ModifyLookaheadMessage,
      AdvanceRequestMessage, TimedSendMessage, RetractMessage, QueryTimeBoundsMessage,
      OwnershipRequestMessage, QueryOwnershipMessage, ResignDirectiveMessage,
      CreateRegionOverMessage, ModifyRangesMessage, RegionalClassMessage,
      RegionalInteractionMessage, AssociateRegionsMessage, InteractionWithinMessage,
      CreateFederationExecutionMessage, DestroyFederationExecutionMessage,
      ListFederationExecutionsMessage, QueryManagementMessage, RequestUpdateMessage,
      ChangeTransportationMessage, QueryTransportationMessage, InstanceNamesMessage,
      SpareUpdateMessage, LocalDeleteMessage, AdvisorySwitchMessage, AcknowledgeKeyframeMessage,
      RefuseKeyframeMessage, AcknowledgeDatagramsMessage, HelloMessage, ProofMessage,
      NotifyHostMessage, SaveRequestMessage, AmbassadorStateMessage>();
  return all;
}

const std::vector<Guesser>& from_the_rti() {
  static const std::vector<Guesser> all =
      guessers_of<JoinedMessage, RefusedMessage, AnnounceSynchronizationPointMessage,
                  FederationSynchronizedMessage, FederateJoinedMessage, FederateResignedMessage,
                  DiscoverObjectMessage, RemoveObjectMessage, InScopeMessage, OutOfScopeMessage,
                  TimeRegulationEnabledMessage, TimeConstrainedEnabledMessage,
                  TimeAdvanceGrantMessage, TimedDeliveryMessage, RequestRetractionMessage,
                  TimeBoundsMessage, FomDigestMessage, ProvideUpdateMessage,
                  SynchronizationPointRegisteredMessage, FederationExecutionCreatedMessage,
                  FederationExecutionDestroyedMessage, FederationExecutionMessage,
                  FederationReportMessage, FederateReportMessage, ReportEndMessage,
                  BeginKeyframeMessage, DeltasMessage, ResidualsMessage, OwnershipNoticeMessage,
                  InformOwnershipMessage, ChallengeMessage, AdmittedMessage, ExpelledMessage,
                  FurtherBlockMessage, InstanceNamesAnswerMessage, ClassRelevanceMessage,
                  ObjectRelevanceMessage, TransportationMessage, StampMessage, StampStepMessage,
                  UpdatesMessage, InteractionMessage, HostMessage, EntriesMessage,
                  EntriesAgainMessage, SaveNoticeMessage, RestoredMessage, SaveStatusMessage>();
  return all;
}

/// Names in the list of kinds, as the sources have it.
std::size_t kinds_in_the_sources() {
  std::ifstream file(test::source_folder() + "/rti/wire/message.h");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::size_t begin = text.find("enum class MessageKind"), end = text.find("};", begin);
  const std::string list =
      std::regex_replace(text.substr(text.find('{', begin) + 1, end - text.find('{', begin) - 1),
                         std::regex("//[^\n]*"), "");
  const std::regex name("[a-z_]+");
  return static_cast<std::size_t>(
      std::distance(std::sregex_iterator(list.begin(), list.end(), name), std::sregex_iterator()));
}

TEST(Noise, IsOfEveryKindThatThereIs) {
  std::set<MessageKind> kinds;
  for (const auto* list : {&from_federates(), &from_the_rti()})
    for (const Guesser& guesser : *list) kinds.insert(guesser.kind);
  EXPECT_EQ(kinds.size(), kinds_in_the_sources());
}

/// So far that messages about objects, regions, points and time find some.
std::vector<std::byte> beginning_of(const char* name, bool regulates) {
  static const auto bounds = values_of(std::uint32_t{0}, 1.0, 1.0, 2.0, 2.0);
  auto bytes = frame_of(join_of(name));
  const auto rest = frame_of(
      WatchFederatesMessage{}, PublishObjectClassMessage{vessel_number, 3}, CreateRegionMessage{0},
      ModifyRegionsMessage{1, bounds}, SubscribeObjectClassMessage{vessel_number, 3, 0},
      RegisterObjectMessage{object_block, vessel_number, "Aurora"},
      PublishInteractionClassMessage{1, 1}, SubscribeInteractionClassMessage{1, 1},
      RegisterSynchronizationPointMessage{"start", {}, {}}, StampMessage{});
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  if (!regulates) return bytes;
  const auto time = frame_of(EnableTimeRegulationMessage{0.5});
  bytes.insert(bytes.end(), time.begin(), time.end());
  return bytes;
}

/// In half of the plays more follow the first one. Answers of which kinds one was taken.
std::set<MessageKind> expect_no_harm_to_others(unsigned seed, int plays_per_kind) {
  std::mt19937 random(seed);
  std::set<MessageKind> taken;
  for (int play = 0; play < plays_per_kind; ++play)
    for (const Guesser& first : from_federates()) {
      Bare bare;
      bare.witness.register_object_instance(vessel);
      bare.tick();
      double now = 0.0;
      bare.execution.connect(1);
      if (play % 8 != 7)
        bare.execution.receive(1, beginning_of("guess", play % 3 == 0)), bare.tick();
      bare.execution.receive(1, first.frame(random));
      bare.tick();
      if (!bare.dropped.contains(1)) taken.insert(first.kind);
      for (int more = play % 2 == 0 ? 0 : 6; more > 0; --more) {
        bare.execution.receive(1,
                               from_federates()[random() % from_federates().size()].frame(random));
        if (more % 2 == 0) bare.pass(now += 0.01);
      }
      bare.tick();
      bare.execution.disconnect(1, "end");
      bare.pass(now += 0.01);
      if (bare.execution.federate_count() != 1 || !bare.witness_heard.lost.empty() ||
          bare.execution.object_count() < 1) {
        ADD_FAILURE() << "play " << play << " that began with kind " << static_cast<int>(first.kind)
                      << " left " << bare.execution.federate_count() << " federates and "
                      << bare.execution.object_count() << " objects; the witness "
                      << bare.witness_heard.lost;
        return taken;
      }
    }
  return taken;
}

TEST(Noise, BeginsWithWhatARtiTakes) {
  Bare bare;
  bare.execution.connect(1);
  bare.execution.receive(1, beginning_of("guess", true));
  bare.tick();
  EXPECT_EQ(bare.dropped[1], "");
  EXPECT_EQ(bare.execution.object_count(), 1u);
}

TEST(Noise, OfEveryKindHarmsNobodyButItsSender) {
  const std::set<MessageKind> taken = expect_no_harm_to_others(1, 150);
  // All but those that nobody who has joined may send, those after which nobody is there, and those
  // with records that a guess hardly gets right.
  for (const Guesser& guesser : from_federates()) {
    using enum MessageKind;
    const bool is_out_of_place =
        guesser.kind == create_federation_execution ||
        guesser.kind == destroy_federation_execution ||
        guesser.kind == list_federation_executions || guesser.kind == hello ||
        guesser.kind == proof || guesser.kind == join || guesser.kind == acknowledge_datagrams ||
        guesser.kind == resign || guesser.kind == updates || guesser.kind == timed_send;
    EXPECT_TRUE(taken.contains(guesser.kind) || is_out_of_place)
        << "no guess of kind " << static_cast<int>(guesser.kind) << " was taken";
  }
}

/// In half of the plays a federate that has joined hears them, after all that an RTI really said.
void expect_survival(unsigned seed, int plays_per_kind) {
  std::mt19937 random(seed);
  Bare bare;
  bare.enter(1, "guess");
  bare.execution.receive(
      1, frame_of(WatchFederatesMessage{},
                  SubscribeObjectClassMessage{vessel_number, 3, RegionHandle::none}));
  bare.tick();
  const ObjectHandle object = bare.witness.register_object_instance(vessel, "Aurora");
  bare.witness.update_attribute_values(object, AttributeSet{position, speed},
                                       values_of(1.0f, 2.0f, 3.0f), {});
  bare.tick();
  const auto session = bare.sent[1];
  std::uint64_t understood = 0, plays = 0;
  for (int play = 0; play < plays_per_kind; ++play)
    for (const Guesser& first : from_the_rti()) {
      FederateAmbassador silent;
      Ambassador ambassador(harbour(), silent);
      ambassador.join("rink", "guess", "tester");
      if (play % 4 != 3) {
        ASSERT_TRUE(ambassador.receive(session));
      }
      if (ambassador.is_joined()) {
        ambassador.publish_object_class_attributes(vessel, AttributeSet{position, speed});
        ambassador.register_object_instance(vessel, "own");
      }
      bool goes_on = ambassador.receive(first.frame(random));
      understood += goes_on, ++plays;
      for (int more = 6; more > 0 && goes_on; --more)
        goes_on =
            ambassador.receive(from_the_rti()[random() % from_the_rti().size()].frame(random));
      ambassador.advance_clock(1.0);
    }
  EXPECT_GT(understood, plays / 10) << "guesses that were taken";
}

TEST(Noise, OfEveryKindIsSurvivedByFederates) { expect_survival(2, 300); }

class NoiseLong : public ::testing::TestWithParam<unsigned> {};
TEST_P(NoiseLong, OfEveryKindHarmsNobody) {
  expect_no_harm_to_others(100 + GetParam(), 1'500);
  expect_survival(200 + GetParam(), 1'500);
}
INSTANTIATE_TEST_SUITE_P(Part, NoiseLong, ::testing::Range(0u, 4u));

}  // namespace
}  // namespace rink::rti::testing
