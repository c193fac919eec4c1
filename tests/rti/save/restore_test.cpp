// Restoring a federation: everything is as it was saved, or nothing changes (IEEE 1516.1-2010, 4.24
// to 4.31).
#include "rti/save/saved_federation.h"
#include "rti/wire/save_messages.h"
#include "tests/rti/save/saved_fleet.h"

namespace rink::rti::testing {
namespace {

const ToldWords save_of_noon{"save noon", "saved"};

ToldWords restored_as(const std::string& name, bool has_asked = false) {
  ToldWords words{"restore begun", "restore noon as " + name, "restored"};
  if (has_asked) words.insert(words.begin(), "confirmed noon");
  return words;
}

/// A pilot with a vessel that a coast guard sees, saved.
class Restore : public ::testing::Test {
 protected:
  SavedFleet fleet;
  SavedFleet::Member *pilot = nullptr, *coast = nullptr;
  ObjectHandle ship;

  void SetUp() override {
    crew();
    pilot->ambassador->publish_object_class_attributes(vessel, motion);
    coast->ambassador->subscribe_object_class_attributes(vessel, motion);
    ship = pilot->ambassador->register_object_instance(vessel, "Pequod");
    pilot->ambassador->update_attribute_values(ship, motion, motion_of(1.0f, 2.0f, 3.0f), {1.0, 7});
    fleet.tick();
    pilot->ambassador->request_federation_save("noon");
    ASSERT_EQ(fleet.told(*pilot), save_of_noon);
    coast->heard.told.clear();
  }
  void crew() {
    pilot = &fleet.join("pilot");
    coast = &fleet.join("coast", "guard");
  }
  void expect_as_saved() {
    ASSERT_TRUE(coast->heard.objects.contains(ship.value));
    const Recorder::Known& known = coast->heard.objects.at(ship.value);
    EXPECT_EQ(known.name, "Pequod");
    EXPECT_TRUE(known.is_in_scope);
    EXPECT_EQ(known.values.at(position.value), values_of(1.0f, 2.0f));
    EXPECT_EQ(known.values.at(speed.value), values_of(3.0f));
    EXPECT_EQ(known.stamp, (Stamp{1.0, 7}));
    EXPECT_EQ(coast->ambassador->get_object_instance_handle("Pequod"), ship);
    EXPECT_EQ(pilot->ambassador->get_object_instance_name(ship), "Pequod");
    EXPECT_TRUE(pilot->ambassador->is_attribute_owned_by_federate(ship, position));
    // And it goes on from there.
    pilot->ambassador->update_attribute_values(ship, motion, motion_of(4.0f, 5.0f, 6.0f), {2.0, 8});
    fleet.tick();
    EXPECT_EQ(coast->heard.objects.at(ship.value).values.at(speed.value), values_of(6.0f));
  }
};

TEST_F(Restore, UndoesWhatTheSameFederatesDidSince) {
  pilot->ambassador->update_attribute_values(ship, motion, motion_of(9.0f, 9.0f, 9.0f), {2.0, 0});
  fleet.tick();
  pilot->ambassador->delete_object_instance(ship);
  const ObjectHandle other = pilot->ambassador->register_object_instance(vessel, "Other");
  fleet.tick();
  ASSERT_TRUE(coast->heard.objects.contains(other.value));
  coast->ambassador->request_federation_restore("noon");
  EXPECT_EQ(fleet.told(*coast), restored_as("coast", true));
  EXPECT_EQ(fleet.told(*pilot), restored_as("pilot"));
  EXPECT_FALSE(coast->heard.objects.contains(other.value));
  EXPECT_EQ(error_thrown_by([&] { coast->ambassador->get_object_instance_handle("Other"); }),
            HlaError::object_instance_not_known);
  expect_as_saved();
  // The handle that was given after the save is given again.
  EXPECT_EQ(pilot->ambassador->register_object_instance(vessel, "Other"), other);
  fleet.tick();
  EXPECT_TRUE(coast->heard.objects.contains(other.value));
}

TEST_F(Restore, BringsBackAFederationWhoseRtiAndFederatesHaveEnded) {
  const FederateHandle saved_pilot = pilot->ambassador->federate();
  fleet.begin();
  coast = &fleet.join("coast", "guard");  // in another order: its handle becomes another
  pilot = &fleet.join("pilot");
  coast->ambassador->request_federation_restore("noon");
  EXPECT_EQ(fleet.told(*coast), restored_as("coast", true));
  EXPECT_EQ(fleet.told(*pilot), restored_as("pilot"));
  EXPECT_EQ(pilot->heard.restored_handle, saved_pilot);
  EXPECT_EQ(pilot->ambassador->federate(), saved_pilot);
  EXPECT_EQ(coast->heard.discoveries.count(ship.value), 0u);  // it knew the ship when it saved
  expect_as_saved();
}

TEST_F(Restore, TakesAFederateOfTheTypeWhereNoneHasTheName) {
  fleet.begin();
  pilot = &fleet.join("another");
  coast = &fleet.join("coast", "guard");
  pilot->ambassador->request_federation_restore("noon");
  EXPECT_EQ(fleet.told(*pilot), restored_as("pilot", true));
  fleet.tick();
  coast->ambassador->watch_federates();
  fleet.tick();
  EXPECT_EQ(coast->heard.federates[pilot->ambassador->federate().value], "pilot");
}

TEST_F(Restore, IsRefusedByNameWhereFederatesAreMissingOrTooMany) {
  const auto refused = [&](SavedFleet::Member& member, const std::string& why) {
    member.ambassador->request_federation_restore("noon");
    EXPECT_EQ(fleet.told(member), (ToldWords{"refused noon: " + why}));
  };
  fleet.begin();
  auto& first = fleet.join("pilot");
  refused(first, "a federate of type 'guard' is missing, as was 'coast'");
  fleet.join("coast", "guard");
  fleet.join("third", "guard");
  refused(first, "it has no federate of type 'guard' for 'third'");
}

TEST_F(Restore, IsRefusedByNameOfWhatIsNoSaveOfThisFederation) {
  const std::vector<std::byte> whole = fleet.store->saves.at("noon");
  const auto refused = [&](const std::string& why) {
    pilot->ambassador->request_federation_restore("noon");
    EXPECT_EQ(fleet.told(*pilot), (ToldWords{"refused noon: " + why}));
    EXPECT_EQ(fleet.told(*coast), ToldWords{});
  };
  const auto changed = [&](const auto& change) {
    SavedFederation saved;
    EXPECT_EQ(decode(whole, saved), "");
    change(saved);
    fleet.store->saves["noon"] = encoded(saved);
  };
  fleet.store->saves.clear();
  refused("there is none");
  fleet.store->saves["noon"] = bytes_of("a letter");
  refused("it is no saved federation");
  changed([](SavedFederation& saved) { saved.federation = "other"; });
  refused("it is of federation 'other'");
  changed([](SavedFederation& saved) { saved.fom_hash ^= 1; });
  refused("it is of another object model");
  changed([](SavedFederation& saved) { saved.state.resize(saved.state.size() / 2); });
  refused("it is damaged: its state cannot be read");
  const auto damaged = [&](const auto& change) {
    changed(change);
    refused("it is damaged: its state cannot be read");
  };
  damaged([](SavedFederation& saved) { saved.federates[1].slot = 0xfffffffe; });
  damaged([](SavedFederation& saved) { saved.federates[1].slot = 0; });
  damaged([](SavedFederation& saved) { std::swap(saved.federates[0], saved.federates[1]); });
  damaged([](SavedFederation& saved) { saved.federates[0].handle = {1}; });
  damaged([](SavedFederation& saved) { saved.federates[0].name = "somebody"; });
  damaged([](SavedFederation& saved) {
    saved.federates[0].ambassador.resize(AmbassadorStateMessage::state_max + 1);
  });
  std::vector<std::byte>& bytes = fleet.store->saves["noon"];
  bytes = whole;
  bytes[8] = std::byte{2};
  refused("it is of version 2; expected is version 1");
  bytes = whole;
  bytes.back() ^= std::byte{1};
  refused("it is damaged: its hash is another");
  bytes = whole;
  pilot->ambassador->request_federation_restore("noon");
  EXPECT_EQ(fleet.told(*pilot), restored_as("pilot", true));
  expect_as_saved();
}

TEST_F(Restore, OfASaveTornAnywhereIsRefused) {
  const std::vector<std::byte> whole = fleet.store->saves.at("noon");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    SavedFederation saved;
    const std::string why = decode(Bytes(whole).first(size), saved);
    EXPECT_TRUE(why.starts_with(size < 8 ? "it is no saved federation" : "it is torn: ")) << size;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::vector<std::byte> flipped = whole;
    flipped[at] ^= std::byte{0x10};
    SavedFederation saved;
    EXPECT_NE(decode(flipped, saved), "") << at;
  }
}

TEST_F(Restore, ThatFailsLeavesEverythingAsItWas) {
  using Answer = Keeper::Answer;
  pilot->ambassador->update_attribute_values(ship, motion, motion_of(9.0f, 9.0f, 9.0f), {2.0, 0});
  fleet.tick();
  const auto expect_failure = [&](const std::string& expected, const auto& end) {
    coast->heard.restore_answer = Answer::nothing;
    pilot->ambassador->request_federation_restore("noon");
    fleet.tick();
    EXPECT_EQ(error_thrown_by([&] { pilot->ambassador->create_region(); }),
              HlaError::restore_in_progress);
    EXPECT_EQ(error_thrown_by([&] { pilot->ambassador->federate_save_begun(); }),
              HlaError::restore_in_progress);
    end(*coast->ambassador);
    EXPECT_EQ(fleet.told(*pilot),
              (ToldWords{"confirmed noon", "restore begun", "restore noon as pilot",
                         "not restored: " + expected}));
    EXPECT_TRUE(pilot->ambassador->is_attribute_owned_by_federate(ship, speed));
  };
  expect_failure("restore aborted; restore aborted",
                 [](Ambassador& rti) { rti.abort_federation_restore(); });
  expect_failure(
      "federate reported failure during restore; federate 'coast' could not restore itself",
      [](Ambassador& rti) { rti.federate_restore_not_complete(); });
  EXPECT_EQ(coast->heard.objects.at(ship.value).values.at(speed.value), values_of(9.0f));
  expect_failure("federate resigned during restore; federate 'coast' left",
                 [&](Ambassador&) { fleet.lose(1); });
}

TEST_F(Restore, KnowsWhatBecomesOfTheObjectsOfWhoIsLost) {
  pilot->ambassador->set_automatic_resign_directive(
      ResignAction::unconditionally_divest_attributes);
  fleet.tick();
  pilot->ambassador->request_federation_save("noon");
  ASSERT_EQ(fleet.told(*pilot), save_of_noon);
  fleet.begin();
  crew();
  pilot->ambassador->request_federation_restore("noon");
  ASSERT_EQ(fleet.told(*pilot), restored_as("pilot", true));
  fleet.lose(0);
  fleet.tick();
  EXPECT_TRUE(coast->heard.objects.contains(ship.value));
}

TEST_F(Restore, TellsHowFarEachFederateIs) {
  coast->heard.restore_answer = Keeper::Answer::nothing;
  fleet.begin();
  coast = &fleet.join("coast", "guard");
  pilot = &fleet.join("pilot");
  coast->heard.restore_answer = Keeper::Answer::nothing;
  pilot->ambassador->request_federation_restore("noon");
  fleet.tick();
  pilot->ambassador->query_federation_restore_status();
  fleet.tick();
  EXPECT_EQ(pilot->heard.restore_status,
            (std::vector<FederateRestoreStatus>{
                {coast->ambassador->federate(), {1}, RestoreStatus::restoring},
                {pilot->ambassador->federate(), {0}, RestoreStatus::waiting}}));
  auto& late = fleet.join("late");
  EXPECT_EQ(late.heard.refusal, Refusal::restore_in_progress);
  coast->ambassador->federate_restore_complete();
  fleet.tick();
  pilot->ambassador->query_federation_restore_status();
  fleet.tick();
  EXPECT_EQ(pilot->heard.restore_status.size(), 2u);
  EXPECT_EQ(pilot->heard.restore_status[0].status, RestoreStatus::none);
}

TEST_F(Restore, OfMuchIsSentAsTheConnectionsTakeIt) {
  constexpr int count = 8'000;
  const auto name_of = [](int i) { return std::string(200, 'n') + std::to_string(i); };
  for (int i = 0; i < count; ++i) {
    pilot->ambassador->register_object_instance(vessel, name_of(i));
    if (i % 500 == 0) fleet.tick(1);
  }
  fleet.tick(20);
  fleet.most_at_once = 0;
  pilot->ambassador->request_federation_save("noon");
  fleet.tick(100);
  ASSERT_EQ(pilot->heard.told, save_of_noon);
  SavedFederation saved;
  ASSERT_EQ(decode(fleet.store->saves.at("noon"), saved), "");
  for (const SavedFederate& each : saved.federates)
    EXPECT_GT(each.ambassador.size(), 1u << 20) << each.name;
  EXPECT_LT(fleet.most_at_once, 600u << 10);
  fleet.begin();
  crew();
  fleet.most_at_once = 0;
  pilot->ambassador->request_federation_restore("noon");
  fleet.tick(100);
  EXPECT_EQ(pilot->heard.told, restored_as("pilot", true));
  EXPECT_LT(fleet.most_at_once, 600u << 10);
  for (const int i : {0, count / 2, count - 1})
    EXPECT_TRUE(coast->ambassador->get_object_instance_handle(name_of(i)));
  expect_as_saved();
  // A federate that goes while the states are handed out ends the restore.
  fleet.begin();
  crew();
  pilot->ambassador->request_federation_restore("noon");
  fleet.tick(3);
  fleet.lose(1);
  fleet.tick();
  EXPECT_EQ(pilot->heard.told.back(),
            "not restored: federate resigned during restore; federate 'coast' left");
  pilot->ambassador->publish_object_class_attributes(vessel, motion);
  EXPECT_TRUE(pilot->ambassador->register_object_instance(vessel, "Pequod"));
}

TEST_F(Restore, OfARestoredFederationIsSavedByTheSameBytes) {
  const std::vector<std::byte> whole = fleet.store->saves.at("noon");
  fleet.begin();
  crew();
  pilot->ambassador->request_federation_restore("noon");
  ASSERT_EQ(fleet.told(*pilot), restored_as("pilot", true));
  pilot->ambassador->request_federation_save("noon");
  ASSERT_EQ(fleet.told(*pilot), save_of_noon);
  SavedFederation before, after;
  ASSERT_EQ(decode(whole, before), "");
  ASSERT_EQ(decode(fleet.store->saves.at("noon"), after), "");
  EXPECT_EQ(before.state, after.state);
  ASSERT_EQ(before.federates.size(), after.federates.size());
  for (std::size_t i = 0; i < before.federates.size(); ++i)
    EXPECT_EQ(before.federates[i].ambassador, after.federates[i].ambassador) << i;
}

TEST_F(Restore, OfAnAmbassadorWithAnothersBlockOfHandlesIsRefused) {
  SavedFederation saved;
  ASSERT_EQ(decode(fleet.store->saves.at("noon"), saved), "");
  ASSERT_EQ(saved.federates.size(), 2u);
  saved.federates[1].ambassador = saved.federates[0].ambassador;
  fleet.store->saves["noon"] = encoded(saved);
  fleet.has_damaged_states = true;
  pilot->ambassador->request_federation_restore("noon");
  fleet.tick();
  EXPECT_EQ(pilot->dropped, "");
  EXPECT_NE(coast->dropped, "");
}

const ObjectClassHandle tide = *harbour().object_class("Tide");
const AttributeSet level{*harbour().attribute(tide, "level")};

/// What the federate of that connection has to send by datagram arrives.
std::size_t take_datagrams(SavedFleet& fleet, ConnectionId id) {
  Ambassador& rti = *fleet.members[id].ambassador;
  const std::span<const Datagram> datagrams = rti.outgoing_datagrams();
  for (const Datagram& each : datagrams) fleet.execution().receive_datagram(id, each.head);
  rti.clear_outgoing_datagrams();
  return datagrams.size();
}

TEST_F(Restore, LeavesDatagramsToWhoJoinsLater) {
  pilot->ambassador->request_federation_restore("noon");
  ASSERT_EQ(fleet.told(*pilot), restored_as("pilot", true));
  auto& late = fleet.join("late", "gauge");
  late.ambassador->publish_object_class_attributes(tide, level);
  coast->ambassador->subscribe_object_class_attributes(tide, level);
  const ObjectHandle water = late.ambassador->register_object_instance(tide);
  fleet.tick();
  late.ambassador->expect_datagrams(400);
  for (const double height : {1.0, 2.0, 3.0}) {
    late.ambassador->update_attribute_values(water, level, values_of(height), {height, 0});
    EXPECT_EQ(take_datagrams(fleet, 2), 1u);
    fleet.tick(1);
    EXPECT_EQ(coast->heard.objects.at(water.value).values.at(0), values_of(height));
  }
}

TEST_F(Restore, ThatFailsLeavesDatagramsToItsFederates) {
  pilot->ambassador->publish_object_class_attributes(tide, level);
  coast->ambassador->subscribe_object_class_attributes(tide, level);
  const ObjectHandle water = pilot->ambassador->register_object_instance(tide);
  fleet.tick();
  coast->heard.restore_answer = Keeper::Answer::not_complete;
  pilot->ambassador->request_federation_restore("noon");
  fleet.tick();
  ASSERT_TRUE(pilot->heard.told.back().starts_with("not restored"));
  pilot->ambassador->expect_datagrams(400);
  std::size_t sent = 0;
  for (const double height : {1.0, 2.0, 3.0}) {
    pilot->ambassador->update_attribute_values(water, level, values_of(height), {height, 0});
    sent += take_datagrams(fleet, 0);
    fleet.tick(1);
  }
  EXPECT_GT(sent, 0u);
}

}  // namespace
}  // namespace rink::rti::testing
