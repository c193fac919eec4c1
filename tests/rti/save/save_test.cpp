// Saving a federation: who is asked, what is refused meanwhile, and how it ends (IEEE 1516.1-2010,
// 4.16 to 4.23).
#include "rti/wire/region_messages.h"
#include "tests/rti/save/saved_fleet.h"

namespace rink::rti::testing {
namespace {

TEST(Save, AsksAllFederatesAndTellsThemThatAllAreSaved) {
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
  pilot.ambassador->request_federation_save("noon");
  EXPECT_EQ(fleet.told(pilot), (ToldWords{"save noon", "saved"}));
  EXPECT_EQ(fleet.told(coast), (ToldWords{"save noon", "saved"}));
  EXPECT_EQ(fleet.store->saves.count("noon"), 1u);
}

TEST(Save, RefusesOtherServicesUntilItEnds) {
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
  coast.heard.save_answer = Keeper::Answer::nothing;
  pilot.ambassador->publish_object_class_attributes(vessel, motion);
  pilot.ambassador->request_federation_save("noon");
  fleet.tick();
  const auto refuses = [](HlaError error, const auto& service) {
    EXPECT_EQ(error_thrown_by(service), error);
  };
  Ambassador& rti = *pilot.ambassador;
  refuses(HlaError::save_in_progress, [&] { rti.register_object_instance(vessel); });
  refuses(HlaError::save_in_progress, [&] { rti.create_region(); });
  refuses(HlaError::save_in_progress, [&] { rti.enable_time_constrained(); });
  refuses(HlaError::save_in_progress, [&] { rti.request_federation_save("again"); });
  refuses(HlaError::save_in_progress, [&] { rti.request_federation_restore("noon"); });
  refuses(HlaError::save_in_progress, [&] { rti.federate_restore_complete(); });
  refuses(HlaError::save_in_progress, [&] { rti.abort_federation_restore(); });
  refuses(HlaError::save_in_progress, [&] { rti.query_federation_restore_status(); });
  refuses(HlaError::save_not_initiated, [&] { rti.federate_save_begun(); });
  refuses(HlaError::federate_has_not_begun_save, [&] { rti.federate_save_complete(); });
  refuses(HlaError::federate_has_not_begun_save,
          [&] { coast.ambassador->federate_save_complete(); });
  coast.ambassador->federate_save_begun();
  coast.ambassador->federate_save_complete();
  EXPECT_EQ(fleet.told(pilot), (ToldWords{"save noon", "saved"}));
  EXPECT_TRUE(rti.register_object_instance(vessel));
  refuses(HlaError::save_not_initiated, [&] { rti.federate_save_begun(); });
  refuses(HlaError::save_not_in_progress, [&] { rti.abort_federation_save(); });
  refuses(HlaError::restore_not_requested, [&] { rti.federate_restore_complete(); });
  refuses(HlaError::restore_not_in_progress, [&] { rti.abort_federation_restore(); });
}

TEST(Save, TellsHowFarEachFederateIs) {
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast"), &tug = fleet.join("tug");
  coast.heard.save_answer = Keeper::Answer::nothing;
  tug.heard.save_answer = Keeper::Answer::begun_only;
  const auto status = [&] {
    pilot.ambassador->query_federation_save_status();
    fleet.tick();
    std::vector<SaveStatus> all;
    for (const FederateSaveStatus& each : pilot.heard.save_status) all.push_back(each.status);
    return all;
  };
  using enum SaveStatus;
  EXPECT_EQ(status(), (std::vector{none, none, none}));
  coast.ambassador->request_federation_save("noon");
  fleet.tick();
  EXPECT_EQ(status(), (std::vector{waiting, instructed, saving}));
  EXPECT_EQ(pilot.heard.save_status[2].federate, tug.ambassador->federate());
  coast.ambassador->federate_save_begun();
  coast.ambassador->federate_save_complete();
  tug.ambassador->federate_save_complete();
  fleet.tick();
  EXPECT_EQ(status(), (std::vector{none, none, none}));
}

TEST(Save, FailsWhenAFederateCannotSaveLeavesOrAborts) {
  using Answer = Keeper::Answer;
  for (const Answer of_coast : {Answer::nothing, Answer::begun_only}) {
    const auto expect_failure = [&](const std::string& expected, const auto& end) {
      SavedFleet fleet;
      auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
      coast.heard.save_answer = of_coast;
      pilot.ambassador->request_federation_save("noon");
      fleet.tick();
      end(fleet, *coast.ambassador);
      EXPECT_EQ(fleet.told(pilot), (ToldWords{"save noon", "not saved: " + expected}));
      EXPECT_TRUE(fleet.store->saves.empty());
      // The federation goes on, and can be saved.
      coast.heard.save_answer = Answer::complete;
      pilot.ambassador->request_federation_save("later");
      EXPECT_EQ(fleet.told(pilot), (ToldWords{"save later", "saved"}));
    };
    expect_failure("save aborted; save aborted",
                   [](SavedFleet&, Ambassador& rti) { rti.abort_federation_save(); });
    expect_failure("federate resigned during save; federate 'coast' left",
                   [](SavedFleet& fleet, Ambassador&) { fleet.lose(1); });
    expect_failure("federate resigned during save; federate 'coast' left",
                   [](SavedFleet& fleet, Ambassador& rti) {
                     rti.resign();
                     fleet.tick();
                   });
    expect_failure("federate reported failure during save; federate 'coast' could not save itself",
                   [&](SavedFleet&, Ambassador& rti) {
                     if (of_coast == Answer::nothing) rti.federate_save_begun();
                     rti.federate_save_not_complete();
                   });
  }
}

TEST(Save, LeavesAnOlderSaveAloneWhereTheNewOneCannotBeWritten) {
  SavedFleet fleet;
  auto& pilot = fleet.join("pilot");
  pilot.ambassador->request_federation_save("noon");
  fleet.told(pilot);
  const auto before = fleet.store->saves;
  fleet.store->fault = "noon.save: No space left on device";
  pilot.ambassador->request_federation_save("noon");
  EXPECT_EQ(fleet.told(pilot),
            (ToldWords{"save noon",
                       "not saved: RTI detected failure during save; noon.save: No space "
                       "left on device"}));
  EXPECT_EQ(fleet.store->saves, before);
}

TEST(Save, IsRefusedByAnRtiWithoutADirectory) {
  SavedFleet fleet;
  fleet.begin(false);
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
  pilot.ambassador->request_federation_save("noon");
  EXPECT_EQ(fleet.told(pilot),
            (ToldWords{"not saved: RTI unable to save; this RTI has no directory to save to"}));
  pilot.ambassador->request_federation_restore("noon");
  EXPECT_EQ(fleet.told(pilot),
            (ToldWords{"refused noon: this RTI has no directory to restore from"}));
  EXPECT_EQ(fleet.told(coast), ToldWords{});
}

TEST(Save, LetsNobodyJoin) {
  SavedFleet fleet;
  auto& pilot = fleet.join("pilot");
  pilot.heard.save_answer = Keeper::Answer::nothing;
  pilot.ambassador->request_federation_save("noon");
  fleet.tick();
  auto& late = fleet.join("late");
  EXPECT_EQ(late.heard.refusal, Refusal::save_in_progress);
  EXPECT_EQ(error_of(Refusal::save_in_progress), HlaError::save_in_progress);
}

TEST(Save, DropsAFederateThatSendsOtherThingsAfterItHasBegun) {
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
  coast.heard.save_answer = Keeper::Answer::begun_only;
  pilot.ambassador->request_federation_save("noon");
  fleet.tick();
  std::vector<std::byte> message;
  CreateRegionMessage create{0};
  write(message, create);
  fleet.execution().receive(1, in_frame(message));
  EXPECT_EQ(
      fleet.told(pilot),
      (ToldWords{"save noon", "not saved: federate resigned during save; federate 'coast' left"}));
  EXPECT_FALSE(coast.dropped.empty());
}

TEST(Save, FailsByNameOfWhoNeverAnswers) {
  SavedFleet fleet;
  fleet.settings.save_s_max = 3.0;
  fleet.begin();
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
  pilot.ambassador->request_federation_save("noon");
  fleet.tick();
  pilot.heard.told.clear();
  coast.heard.save_answer = coast.heard.restore_answer = Keeper::Answer::nothing;
  pilot.ambassador->request_federation_save("later");
  fleet.tick();
  fleet.execution().advance_clock(2.9);
  EXPECT_EQ(fleet.told(pilot), ToldWords{"save later"});
  fleet.execution().advance_clock(3.1);
  EXPECT_EQ(fleet.told(pilot), ToldWords{"not saved: RTI detected failure during save; federate "
                                         "'coast' took too long"});
  pilot.ambassador->request_federation_restore("noon");
  fleet.tick();
  fleet.execution().advance_clock(6.0);
  pilot.heard.told.clear();
  EXPECT_EQ(fleet.told(pilot), ToldWords{});
  fleet.execution().advance_clock(6.2);
  EXPECT_EQ(fleet.told(pilot), ToldWords{"not restored: RTI detected failure during restore; "
                                         "federate 'coast' took too long"});
  EXPECT_EQ(fleet.told(coast).back(),
            "not restored: RTI detected failure during restore; "
            "federate 'coast' took too long");
}

TEST(Save, FailsBeyondTheBytesThatAllAmbassadorsMayHave) {
  SavedFleet fleet;
  fleet.settings.save_bytes_max = 20;
  fleet.begin();
  auto& pilot = fleet.join("pilot");
  pilot.ambassador->request_federation_save("noon");
  EXPECT_EQ(fleet.told(pilot),
            (ToldWords{"save noon",
                       "not saved: RTI unable to save; more than 20 bytes for all "
                       "ambassadors"}));
  EXPECT_TRUE(fleet.store->saves.empty());
  EXPECT_TRUE(pilot.dropped.empty());
}

TEST(Save, LimitsWhatAFederateSendsBeforeItHearsOfItByFlushAndNotInAll) {
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
  pilot.ambassador->publish_interaction_class(hail);
  coast.ambassador->subscribe_interaction_class(hail);
  pilot.heard.save_answer = coast.heard.save_answer = Keeper::Answer::nothing;
  fleet.tick();
  pilot.ambassador->request_federation_save("noon");
  fleet.tick();
  std::vector<std::byte> message;
  InteractionMessage words{static_cast<std::uint16_t>(hail.value), FederateHandle::none, {}, {}};
  const std::vector<std::byte> parameters = varying(std::string(20'000, 'a'));
  words.parameters = parameters;
  write(message, words);
  const auto say = [&](int rounds) {
    for (int round = 0; round < rounds && pilot.dropped.empty(); ++round) {
      fleet.execution().receive(0, in_frame(message));
      fleet.tick(1);
    }
  };
  say(50);
  EXPECT_EQ(pilot.dropped, "") << "1 MB in 50 flushes";
  say(200);
  EXPECT_NE(pilot.dropped, "") << "who never hears of it does not fill the RTI";
}

/// A vessel of coast's is known to pilot; slow holds up whatever is asked of all.
class ResigningMeanwhile : public ::testing::Test {
 protected:
  using Answer = Keeper::Answer;
  SavedFleet fleet;
  SavedFleet::Member &pilot = fleet.join("pilot"), &coast = fleet.join("coast"),
                     &slow = fleet.join("slow");
  ObjectHandle ship;

  void SetUp() override {
    pilot.ambassador->watch_federates();
    pilot.ambassador->subscribe_object_class_attributes(vessel, motion);
    coast.ambassador->publish_object_class_attributes(vessel, motion);
    ship = coast.ambassador->register_object_instance(vessel);
    fleet.tick();
    pilot.ambassador->request_federation_save("noon");
    ASSERT_EQ(fleet.told(pilot), (ToldWords{"save noon", "saved"}));
    slow.heard.save_answer = slow.heard.restore_answer = Answer::nothing;
  }
  void expect_ship_left_behind() {
    coast.ambassador->resign(ResignAction::unconditionally_divest_attributes);
    fleet.tick();
    EXPECT_EQ(pilot.heard.log.back(), std::string("coast ") + to_string(ResignReason::resigned));
    EXPECT_TRUE(pilot.heard.objects.contains(ship.value));
    for (const std::uint64_t drops : fleet.execution().counters().drops) EXPECT_EQ(drops, 0u);
  }
};

TEST_F(ResigningMeanwhile, FollowsTheActionOfWhoHasBegunItsSave) {
  coast.heard.save_answer = Answer::begun_only;
  pilot.ambassador->request_federation_save("later");
  fleet.tick();
  expect_ship_left_behind();
}

TEST_F(ResigningMeanwhile, FollowsTheActionOfWhoHasCompletedItsSave) {
  pilot.ambassador->request_federation_save("later");
  fleet.tick();
  expect_ship_left_behind();
}

TEST_F(ResigningMeanwhile, FollowsTheActionOfWhoHasRestoredItself) {
  pilot.ambassador->request_federation_restore("noon");
  fleet.tick();
  expect_ship_left_behind();
}

TEST(Save, AtATimeWaitsForEveryConstrainedFederate) {
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
  EXPECT_EQ(
      error_thrown_by([&] { pilot.ambassador->request_federation_save("x", LogicalTime(2.0)); }),
      HlaError::federate_unable_to_use_time);
  pilot.ambassador->enable_time_regulation(1.0);
  coast.ambassador->enable_time_constrained();
  fleet.tick();
  pilot.ambassador->request_federation_save("x", LogicalTime(2.0));
  EXPECT_EQ(fleet.told(coast), ToldWords{});
  pilot.ambassador->time_advance_request(LogicalTime(5.0));
  coast.ambassador->time_advance_request(LogicalTime(1.5));
  EXPECT_EQ(fleet.told(coast), ToldWords{});
  coast.ambassador->time_advance_request(LogicalTime(3.0));
  EXPECT_EQ(fleet.told(coast), (ToldWords{"save x at 2.000000", "saved"}));
  EXPECT_EQ(
      error_thrown_by([&] { pilot.ambassador->request_federation_save("y", LogicalTime(4.0)); }),
      HlaError::logical_time_already_passed);
}

TEST(Save, TellsNothingElseMeanwhileAndThenAll) {
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast");
  for (auto* each : {&pilot, &coast}) {
    each->ambassador->publish_interaction_class(hail);
    each->ambassador->subscribe_interaction_class(hail);
  }
  fleet.tick();
  coast.heard.save_answer = Keeper::Answer::nothing;
  pilot.ambassador->request_federation_save("noon");
  fleet.tick(1);
  // It has not heard of the save yet, and what it sent is under way.
  std::vector<std::byte> message;
  InteractionMessage words{static_cast<std::uint16_t>(hail.value), FederateHandle::none, {}, {}};
  const std::vector<std::byte> parameters = varying("ahoy");
  words.parameters = parameters;
  write(message, words);
  fleet.execution().receive(1, in_frame(message));
  fleet.tick();
  EXPECT_TRUE(pilot.heard.interactions.empty());
  coast.ambassador->federate_save_begun();
  coast.ambassador->federate_save_complete();
  fleet.tick();
  ASSERT_EQ(pilot.heard.interactions.size(), 1u);
}

TEST(Save, ThatHasFailedIsAnsweredInVainByWhoWasNotToldYet) {
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &late = fleet.join("late", "sailor", CallbackModel::evoked);
  late.ambassador->request_federation_save("noon");
  fleet.tick();
  pilot.heard.told.clear();
  ASSERT_EQ(fleet.store->saves.size(), 0u);  // who evokes nothing is waited for
  pilot.ambassador->abort_federation_save();
  fleet.tick();
  while (late.ambassador->evoke_multiple_callbacks()) {
  }
  EXPECT_EQ(fleet.told(late), (ToldWords{"save noon", "not saved: save aborted; save aborted"}));
  EXPECT_EQ(error_thrown_by([&] { late.ambassador->federate_save_begun(); }),
            HlaError::save_not_initiated);
  pilot.ambassador->request_federation_save("later");
  fleet.tick();
  while (late.ambassador->evoke_multiple_callbacks()) {
  }
  EXPECT_EQ(fleet.told(pilot),
            (ToldWords{"not saved: save aborted; save aborted", "save later", "saved"}));
}

TEST(Save, WaitsForEvokedCallbacks) {
  SavedFleet fleet;
  auto& pilot = fleet.join("pilot", "sailor", CallbackModel::evoked);
  pilot.ambassador->request_federation_save("noon");
  EXPECT_EQ(fleet.told(pilot), ToldWords{});
  while (pilot.ambassador->evoke_multiple_callbacks()) {
  }
  fleet.tick();
  while (pilot.ambassador->evoke_multiple_callbacks()) {
  }
  EXPECT_EQ(fleet.told(pilot), (ToldWords{"save noon", "saved"}));
}

}  // namespace
}  // namespace rink::rti::testing
