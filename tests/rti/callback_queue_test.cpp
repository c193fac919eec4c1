// Callbacks evoked, immediate and disabled: what a federate is told is the same, only when differs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>

#include "rti/callbacks/callback_queue.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"
#include "tests/places.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::map<std::string, int> callbacks_in(const std::string& path, const std::string& pattern) {
  std::ifstream file(test::source_folder() + path);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::regex expression(pattern);
  std::map<std::string, int> counts;
  for (std::sregex_iterator each(text.begin(), text.end(), expression), end; each != end; ++each)
    ++counts[(*each)[1]];
  return counts;
}

TEST(CallbackQueue, KnowsEveryCallbackThatAFederateHas) {
  const auto declared = callbacks_in("/rti/federate_ambassador.h", "virtual [a-z]+ ([a-z_]+)\\(");
  EXPECT_GT(declared.size(), 15u);
  EXPECT_EQ(
      callbacks_in("/rti/callbacks/callback_queue.h", "\n  [a-z]+ ([a-z_]+)\\([^;{}]*\\) override"),
      declared)
      << "a callback that is not in the queue would be lost to federates that evoke: add it to "
         "rti/callbacks/callback_queue.h";
}

/// Two ambassadors that hear the same bytes, one in each model.
struct TwoModels {
  Recorder heard_now, heard_late;
  Ambassador now{harbour(), heard_now}, late{harbour(), heard_late, {}, CallbackModel::evoked};
  TwoModels() {
    for (Ambassador* each : {&now, &late}) each->join("rink", "pair", "tester");
  }
  template <class... Messages>
  void tell(Messages... messages) {
    for (const auto& frame : {framed(messages)...})
      for (Ambassador* each : {&now, &late}) EXPECT_TRUE(each->receive(frame));
  }
};

TEST(CallbackQueue, EvokedOneByOneTheyAreThoseOfTheImmediateModelInTheirOrder) {
  TwoModels pair;
  const auto tag = bytes_of("tag"), words = bytes_of("ahoy");
  const std::vector<FederateHandle> failed{{3}, {5}};
  pair.tell(JoinedMessage{4, 1});
  pair.tell(FederateJoinedMessage{4, "pair", "tester"},
            AnnounceSynchronizationPointMessage{"start", tag},
            DiscoverObjectMessage{5, 1, "Aurora"}, OneObject<MessageKind::in_scope>{5});
  pair.tell(InteractionMessage{1, 2, {1.5, 9}, words},
            FederationSynchronizedMessage{"start", list_of(failed)},
            FederateResignedMessage{4, 1, "pair", "tester"});
  EXPECT_TRUE(pair.late.is_joined()) << "the ambassador knows at once";
  EXPECT_THAT(pair.heard_late.log, IsEmpty());
  int evoked = 1;
  for (; pair.late.evoke_callback(); ++evoked)
    EXPECT_LE(pair.heard_late.log.size(), static_cast<std::size_t>(evoked));
  EXPECT_EQ(evoked, 8);
  EXPECT_EQ(pair.heard_late.log, pair.heard_now.log);
  EXPECT_THAT(pair.heard_late.log,
              ElementsAre("joined", "announced start with tag",
                          "synchronized start without 3 without 5", "pair lost"));
  EXPECT_EQ(pair.heard_late.interactions, pair.heard_now.interactions);
  EXPECT_EQ(pair.heard_late.objects.at(5).name, "Aurora");
  EXPECT_TRUE(pair.heard_late.objects.at(5).is_in_scope);
  EXPECT_FALSE(pair.late.evoke_callback());
}

/// Hands what goes to connection 0 and 1 to two ambassadors.
struct Both final : Outlet {
  Both(Ambassador& first, Ambassador& second) : ends{&first, &second} {}
  Ambassador* ends[2];
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) EXPECT_TRUE(ends[connection]->receive(part));
  }
  void drop(ConnectionId, std::string_view) override {}
};

TEST(CallbackQueue, ABlockOfUpdatesIsAsManyCallbacksAndNothingIsAllocatedOnceItHasGrown) {
  Recorder heard;
  Ambassador evoking(harbour(), heard, {}, CallbackModel::evoked);
  evoking.join("rink", "evoking", "tester");
  FederationExecution execution(harbour(), {});
  execution.connect(0);
  execution.connect(1);
  Recorder said;
  Ambassador speaker(harbour(), said);
  speaker.join("rink", "speaker", "tester");
  const auto tick = [&] {
    for (auto [id, each] : {std::pair(0u, &speaker), std::pair(1u, &evoking)}) {
      execution.receive(id, each->outgoing());
      each->clear_outgoing();
    }
    execution.match();
    Both both(speaker, evoking);
    execution.flush(both);
  };
  tick();
  speaker.publish_object_class_attributes(vessel, AttributeSet{speed});
  evoking.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  std::vector<ObjectHandle> objects;
  for (int i = 0; i < 10; ++i) objects.push_back(speaker.register_object_instance(vessel));
  tick();
  evoking.evoke_multiple_callbacks();
  EXPECT_EQ(heard.objects.size(), 10u);
  std::size_t memory = 0;
  for (int round = 0; round < 20; ++round) {
    for (const ObjectHandle object : objects)
      speaker.update_attribute_values(object, AttributeSet{speed},
                                      values_of(static_cast<float>(round)),
                                      {static_cast<double>(round), 0});
    tick();
    EXPECT_TRUE(evoking.evoke_multiple_callbacks(4)) << "6 of 10 wait";
    EXPECT_FALSE(evoking.evoke_multiple_callbacks());
    if (round == 5) memory = evoking.memory_bytes();
  }
  EXPECT_EQ(evoking.memory_bytes(), memory);
  for (const auto& [handle, known] : heard.objects) EXPECT_EQ(known.updates, 20) << handle;
}

TEST(CallbackQueue, EvokingWithinACallbackIsRefusedByName) {
  struct Greedy : FederateAmbassador {
    Ambassador* ambassador = nullptr;
    HlaError error = HlaError::none;
    void joined(FederateHandle) override {
      try {
        ambassador->evoke_callback();
      } catch (const RtiException& exception) {
        error = exception.error();
      }
    }
  } greedy;
  Ambassador ambassador(harbour(), greedy, {}, CallbackModel::evoked);
  greedy.ambassador = &ambassador;
  ambassador.join("rink", "greedy", "tester");
  ambassador.receive(framed(JoinedMessage{0, 0}));
  ambassador.evoke_callback();
  EXPECT_EQ(greedy.error, HlaError::call_not_allowed_from_within_callback);
}

TEST(CallbackQueue, WhoNeverEvokesLosesItsConnectionBeforeItsMemory) {
  Recorder heard;
  Ambassador ambassador(harbour(), heard, {}, CallbackModel::evoked);
  ambassador.join("rink", "sleeper", "tester");
  ambassador.receive(framed(JoinedMessage{0, 0}));
  const std::vector<std::byte> words(parameters_max);
  const std::vector<std::byte> frame = framed(InteractionMessage{1, 2, {}, words});
  std::size_t received = 0;
  while (ambassador.receive(frame) && received < 2 * Ambassador::waiting_callbacks_max)
    received += frame.size();
  EXPECT_NEAR(static_cast<double>(received), static_cast<double>(Ambassador::waiting_callbacks_max),
              0.01 * Ambassador::waiting_callbacks_max);
  ambassador.evoke_multiple_callbacks();
  EXPECT_EQ(heard.lost, "too many callbacks wait to be evoked");
}

class DisabledCallbacks : public ::testing::TestWithParam<CallbackModel> {};

// IEEE 1516.1-2010, 10.43 and 10.44.
TEST_P(DisabledCallbacks, AreToldInTheirOrderWhenTheyAreEnabledAgain) {
  Recorder heard;
  Ambassador ambassador(harbour(), heard, {}, GetParam());
  ambassador.join("rink", "quiet", "tester");
  ambassador.disable_callbacks();
  ambassador.receive(framed(JoinedMessage{0, 0}));
  ambassador.receive(framed(AnnounceSynchronizationPointMessage{"start", {}}));
  ambassador.disconnected("gone");
  ambassador.evoke_multiple_callbacks();
  EXPECT_THAT(heard.log, IsEmpty());
  EXPECT_EQ(heard.lost, "");
  ambassador.enable_callbacks();
  ambassador.evoke_multiple_callbacks();
  EXPECT_THAT(heard.log, ElementsAre("joined", "announced start"));
  EXPECT_EQ(heard.lost, "gone");
}

INSTANTIATE_TEST_SUITE_P(In, DisabledCallbacks,
                         ::testing::Values(CallbackModel::immediate, CallbackModel::evoked),
                         [](const auto& model) {
                           return model.param == CallbackModel::evoked ? "evoked" : "immediate";
                         });

}  // namespace
}  // namespace rink::rti::testing
