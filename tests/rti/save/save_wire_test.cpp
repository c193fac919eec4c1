// A save and a restore as the second reader understands them, from docs/wire.md alone; and what
// waits for its time in a save.
#include <filesystem>
#include <fstream>

#include "tests/places.h"
#include "tests/rti/python.h"
#include "tests/rti/save/saved_fleet.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

TEST(SavedOnTheWire, EveryByteIsUnderstoodByTheWirePageAlone) {
  if (!has_python()) GTEST_SKIP() << "there is no python3";
  SavedFleet fleet;
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast", "guard");
  pilot.ambassador->request_federation_restore("never");
  fleet.tick();
  pilot.ambassador->enable_time_regulation(1.0);
  fleet.tick();
  pilot.ambassador->request_federation_save("noon", LogicalTime(0.5));
  fleet.tick();
  coast.heard.save_answer = Keeper::Answer::nothing;
  pilot.ambassador->request_federation_save("later");
  fleet.tick();
  pilot.ambassador->query_federation_save_status();
  fleet.tick();
  coast.ambassador->abort_federation_save();
  fleet.tick();
  pilot.ambassador->request_federation_restore("noon");
  fleet.tick();
  pilot.ambassador->query_federation_restore_status();
  fleet.tick();
  const test::TemporaryFolder folder("save-wire");
  const std::string base = std::filesystem::path(folder).string();
  std::ofstream(base + "/model.xml") << harbour_xml;
  std::ofstream(base + "/session", std::ios::binary) << fleet.record;
  const std::string heard =
      output_of("python3 -B '" + test::source_folder() + "/tests/rti/wire/second_reader.py' '" +
                base + "/model.xml' '" + base + "/session' 2>&1");
  EXPECT_EQ(heard.find("failed: "), std::string::npos) << heard;
  for (const char* line :
       {"save request_restore never 0", "save_notice restore_refused 1 never there is none",
        "save request_at_time noon 3fe0000000000000 0", "save begun 2", "save complete 2",
        "save_notice initiate_at_time 2 noon 3fe0000000000000", "save_notice saved 2",
        "save_notice initiate 3 later", "save_status 0 0:0:3 1:1:1", "save abort 3",
        "save_notice not_saved 3 save aborted 5", "save_notice restore_confirmed 4 noon",
        "save_notice restore_begun 4", "save_notice initiate_restore 4 noon coast 1",
        "save restore_complete 4", "restored 0 ", "save_status 1 0:0:0 1:1:0"})
    EXPECT_NE(heard.find(line), std::string::npos) << line << "\n" << heard;
}

TEST(SavedInTime, AMessageThatWaitsIsDeliveredInItsTurnAfterTheRestore) {
  SavedFleet fleet;
  const AttributeSet there{destination};
  const auto crew = [&] {
    fleet.join("pilot");
    fleet.join("coast");
  };
  crew();
  Ambassador *pilot = fleet.members[0].ambassador.get(), *coast = fleet.members[1].ambassador.get();
  pilot->publish_object_class_attributes(ferry, there);
  coast->subscribe_object_class_attributes(ferry, there);
  const ObjectHandle ship = pilot->register_object_instance(ferry);
  pilot->enable_time_regulation(1.0);
  coast->enable_time_constrained();
  fleet.tick();
  const std::vector<std::byte> home = varying("home"), away = varying("away");
  const RetractionHandle first =
      pilot->update_attribute_values(ship, there, home, LogicalTime(5.0));
  pilot->update_attribute_values(ship, there, away, LogicalTime(4.0));
  coast->time_advance_request(LogicalTime(3.0));
  fleet.tick();
  pilot->request_federation_save("noon");
  fleet.tick();
  ASSERT_EQ(fleet.members[1].heard.told, (ToldWords{"save noon", "saved"}));
  fleet.begin();
  crew();
  pilot = fleet.members[0].ambassador.get();
  coast = fleet.members[1].ambassador.get();
  coast->request_federation_restore("noon");
  fleet.tick();
  Keeper& heard = fleet.members[1].heard;
  ASSERT_EQ(heard.told.back(), "restored");
  heard.told.clear();
  EXPECT_EQ(error_thrown_by([&] { coast->time_advance_request(LogicalTime(9.0)); }),
            HlaError::in_time_advancing_state);  // it asked for 3 before it was saved
  pilot->retract(first);
  pilot->time_advance_request(LogicalTime(10.0));
  fleet.tick();
  EXPECT_EQ(heard.granted, 3.0);
  coast->time_advance_request(LogicalTime(9.0));
  fleet.tick();
  EXPECT_EQ(heard.told, (ToldWords{"at 4.000000"}));
  EXPECT_EQ(heard.objects.at(ship.value).values.at(destination.value), away);
  EXPECT_EQ(heard.granted, 9.0);
}

}  // namespace
}  // namespace rink::rti::testing
