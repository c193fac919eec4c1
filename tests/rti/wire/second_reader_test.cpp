// A conversation recorded byte by byte, and what a second reader, written in Python from
// docs/wire.md, makes of it: the very things that were said and heard.
#include "tests/rti/wire/second_reader_session.h"

#include <fstream>
#include <initializer_list>
#include <numeric>

#include "tests/places.h"
#include "tests/rti/python.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

/// A pilot, who moves a vessel and a ferry through the view of a watchman.
void talk(Session& session) {
  Clerk& pilot = session.enter("pilot");
  Clerk& watchman = session.enter("watchman");
  const AttributeSet motion{position, speed}, everything{position, speed, destination};
  watchman.ambassador.watch_federates();
  watchman.said.push_back("watch_federates");
  for (Clerk* clerk : {&pilot, &watchman}) {
    clerk->publish(vessel, motion);
    clerk->publish(ferry, everything);
    clerk->exchange_interactions(hail);
  }
  Ambassador& seen_by = watchman.ambassador;
  const RegionHandle view = seen_by.create_region();
  watchman.said.push_back(line_of("create_region", wire_number(view)));
  const auto look = [&](double x, double y) {
    seen_by.set_region(view, {x, y, x + 10.0, y + 10.0});
    seen_by.commit_region_modifications(view);
    watchman.said.push_back(
        line_of("bounds", wire_number(view), hex(x), hex(y), hex(x + 10.0), hex(y + 10.0)));
  };
  look(0.0, 0.0);
  watchman.subscribe(vessel, motion, view);
  watchman.subscribe(ferry, everything);
  session.tick();
  // Each publication is answered, and each change of who hears it told; oneself does not count.
  for (const char* line :
       {"class_relevance Vessel - -", "class_relevance Ferry - -", "interaction_relevance Hail 0 0",
        "interaction_relevance Hail 1 1", "class_relevance Vessel position+speed position+speed",
        "class_relevance Ferry position+speed position+speed",
        "class_relevance Ferry position+speed+destination position+speed+destination"})
    pilot.heard.push_back(line);
  for (const char* line : {"class_relevance Vessel - -", "class_relevance Ferry - -",
                           "interaction_relevance Hail 1 1"})
    watchman.heard.push_back(line);
  const ObjectHandle boat = pilot.add(vessel, "Fram"), crossing = pilot.add(ferry, "");
  watchman.add(vessel, "Watch");
  session.tick();
  const RegionHandle place = pilot.ambassador.create_region();
  pilot.said.push_back(line_of("create_region", wire_number(place)));
  pilot.ambassador.set_region(place, {5.0, 5.0, 6.0, 6.0});
  pilot.ambassador.commit_region_modifications(place);
  pilot.said.push_back(
      line_of("bounds", wire_number(place), hex(5.0), hex(5.0), hex(6.0), hex(6.0)));
  pilot.ambassador.associate_regions_for_updates(boat, place);
  pilot.said.push_back(line_of("associate", boat.value, wire_number(place)));
  session.tick();
  for (int i = 0; i < 20; ++i) {
    const Stamp stamp{0.1 * i, static_cast<std::uint64_t>(i) << (i % 8 * 7)};
    pilot.update(boat, motion, values_of(1.0f * static_cast<float>(i), -2.5f, 0.5f), stamp);
    if (i % 3 == 0) {
      std::vector<std::byte> values = values_of(3.0f, 4.0f, 5.0f);
      const std::vector<std::byte> where = varying("port " + std::to_string(i));
      values.insert(values.end(), where.begin(), where.end());
      pilot.update(crossing, everything, values, stamp);
    }
    if (i % 5 == 0) pilot.send(hail, "hail " + std::to_string(i), stamp);
    if (i % 7 == 0) look(i % 2 == 0 ? 0.0 : 50.0, 0.25 * i);
    session.tick();
  }
  watchman.send(hail, "", {2.5, 0}, pilot.ambassador.federate());
  pilot.ambassador.register_synchronization_point("harbour closed", bytes_of("at dusk"));
  pilot.said.push_back(
      line_of("register_synchronization_point", "harbour closed", hex(bytes_of("at dusk")), "-"));
  session.tick();
  pilot.ambassador.synchronization_point_achieved("harbour closed");
  pilot.said.push_back("synchronization_point_achieved harbour closed 1");
  watchman.ambassador.synchronization_point_achieved("harbour closed", false);
  watchman.said.push_back("synchronization_point_achieved harbour closed 0");
  session.tick();
  pilot.remove(boat);
  session.tick();
  pilot.ambassador.resign();
  pilot.said.push_back("resign");
  watchman.heard.push_back("interaction_relevance Hail 0 0");
  session.tick();
}

/// Two who keep time, hand an attribute over and look through regions.
void negotiate(Session& session) {
  Clerk& pilot = session.enter("pilot");
  Clerk& watchman = session.enter("watchman");
  const AttributeSet motion{position, speed}, pace{speed};
  for (Clerk* clerk : {&pilot, &watchman}) {
    clerk->publish(vessel, motion);
    clerk->exchange_interactions(hail);
  }
  for (const char* line :
       {"class_relevance Vessel - -", "interaction_relevance Hail 0 0",
        "interaction_relevance Hail 1 1", "class_relevance Vessel position position"})
    pilot.heard.push_back(line);
  for (const char* line : {"class_relevance Vessel - -", "interaction_relevance Hail 1 1"})
    watchman.heard.push_back(line);
  const DimensionHandle x = watchman.ambassador.get_dimension_handle("X");
  const RegionHandle strip = watchman.ambassador.create_region(DimensionSet{x});
  watchman.say(line_of("create_region_over", wire_number(strip), 1));
  watchman.ambassador.set_range_bounds(strip, x, {0.0, 8.5});
  watchman.ambassador.commit_region_modifications(strip);
  watchman.say(line_of("ranges", wire_number(strip), hex(0.0) + ".." + hex(8.5)));
  const std::array pairs{AttributeRegions{AttributeSet{position}, {strip}}};
  watchman.ambassador.subscribe_object_class_attributes_with_regions(vessel, pairs);
  watchman.say(line_of("Vessel", "subscribe", "1:" + std::to_string(wire_number(strip))));
  const ObjectHandle boat = pilot.add(vessel, "Fram");
  watchman.add(vessel, "Watch");
  pilot.update(boat, motion, values_of(1.0f, 2.0f, 3.0f), {0.5, 0});
  session.tick();
  watchman.ambassador.request_attribute_value_update_with_regions(vessel, pairs);
  watchman.say(line_of("Vessel", "request", "1:" + std::to_string(wire_number(strip))));
  watchman.ambassador.subscribe_object_class_attributes_with_regions(vessel, pairs, false);
  watchman.say(line_of("Vessel", "subscribe_passively", "1:" + std::to_string(wire_number(strip))));
  pilot.heard.push_back("class_relevance Vessel position -");
  session.tick();

  watchman.ambassador.attribute_ownership_acquisition(boat, pace, bytes_of("mine"));
  watchman.say(line_of("acquire", boat.value, 2, hex(bytes_of("mine"))));
  session.tick();
  pilot.ambassador.attribute_ownership_divestiture_if_wanted(boat, pace);
  pilot.say(line_of("give_if_wanted", boat.value, 2, "-"));
  session.tick();
  pilot.ambassador.query_attribute_ownership(boat, speed);
  pilot.say(line_of("query_ownership", boat.value, speed.value));
  pilot.ambassador.set_automatic_resign_directive(ResignAction::delete_objects);
  pilot.say("resign_action 1");
  session.tick();

  pilot.ambassador.enable_time_regulation(0.5);
  pilot.say("enable_time_regulation " + hex(0.5));
  watchman.ambassador.enable_time_constrained();
  watchman.say("enable_time_constrained");
  session.tick();
  session.tick();
  pilot.ambassador.change_interaction_order_type(hail, Order::timestamp);
  const auto hail_at = [&](double time, const char* words) {
    const RetractionHandle handle =
        pilot.ambassador.send_interaction(hail, bytes_of(words), LogicalTime(time));
    pilot.say(line_of("timed", handle.number, stamp_text({time, 0}), "send", "Hail", "-",
                      stamp_text({}), hex(bytes_of(words))));
    return handle;
  };
  hail_at(2.0, "second");
  hail_at(1.0, "first");
  const RetractionHandle regretted = hail_at(1.5, "never");
  pilot.ambassador.retract(regretted);
  pilot.say(line_of("retract", regretted.number));
  watchman.ambassador.time_advance_request(LogicalTime(3.0));
  watchman.say("time_advance_request " + hex(3.0));
  watchman.ambassador.query_time_bounds();
  watchman.say("query_time_bounds");
  session.tick();
  pilot.ambassador.modify_lookahead(1.0);
  pilot.say("modify_lookahead " + hex(1.0));
  pilot.ambassador.time_advance_request(LogicalTime(4.0));
  pilot.say("time_advance_request " + hex(4.0));
  session.tick();
  session.tick();
  watchman.ambassador.query_management();
  watchman.say("query_management");
  session.tick();
  pilot.ambassador.disable_time_regulation();
  pilot.say("disable_time_regulation");
  session.tick();
}

/// Names, transportation, requests, advisories of one object, values kept back, and forgetting.
void arrange(Session& session) {
  Clerk &owner = session.enter("owner"), &guest = session.enter("guest");
  const AttributeSet motion{position, speed};
  owner.publish(vessel, motion);
  guest.publish(vessel, motion);
  session.tick();
  for (Clerk* each : {&owner, &guest}) each->heard.push_back("class_relevance Vessel - -");
  Ambassador& ours = owner.ambassador;
  Ambassador& theirs = guest.ambassador;
  const std::array<std::string_view, 2> pair{"Maud", "Gjoa"};
  ours.reserve_object_instance_name("Fram");
  ours.reserve_multiple_object_instance_names(pair);
  owner.said.insert(owner.said.end(), {"names reserve Fram", "names reserve_set Maud,Gjoa"});
  theirs.reserve_object_instance_name("Fram");
  theirs.reserve_multiple_object_instance_names(pair);
  guest.said.insert(guest.said.end(), {"names reserve Fram", "names reserve_set Maud,Gjoa"});
  session.tick();
  ours.release_object_instance_name("Gjoa");
  owner.said.push_back("names release Gjoa");
  guest.is_registering = true;
  guest.add(vessel, "Maud");
  session.tick();
  const ObjectHandle fram = owner.add(vessel, "Fram");
  owner.update(fram, AttributeSet{speed}, values_of(1.0f),
               {});  // kept back: nobody listens, and nothing was ever sent
  owner.said.pop_back();
  session.tick();
  guest.subscribe(vessel, motion);
  session.tick();
  owner.heard.push_back("class_relevance Vessel position+speed position+speed");
  session.tick();
  owner.said.push_back(
      line_of("update", fram.value, "Vessel", "speed", stamp_text({}), hex(values_of(1.0f))));
  guest.subscribe(vessel, {});
  session.tick();
  owner.heard.push_back("class_relevance Vessel - -");
  session.tick();
  owner.update(fram, AttributeSet{speed}, values_of(2.0f), {1.5, 0});
  owner.said.back() = "spare " + std::to_string(fram.value) + " 10";
  session.tick();
  ours.enable_attribute_relevance_advisory_switch();
  owner.said.push_back("attribute_relevance_advisory 1");
  theirs.subscribe_object_class_attributes(vessel, motion, {}, false);
  guest.said.push_back("subscribe Vessel position+speed - passive");
  session.tick();
  owner.heard.push_back("class_relevance Vessel position+speed -");
  session.tick();
  owner.said.push_back(
      line_of("update", fram.value, "Vessel", "speed", stamp_text({1.5, 0}), hex(values_of(2.0f))));
  guest.subscribe(vessel, motion);
  owner.heard.push_back("class_relevance Vessel position+speed position+speed");
  session.tick();
  theirs.request_attribute_value_update(vessel, motion, bytes_of("now"));
  theirs.request_attribute_value_update(fram, AttributeSet{speed});
  guest.said.push_back("request_update class " + std::to_string(vessel.value) + " 11 " +
                       hex(bytes_of("now")));
  guest.said.push_back("request_update object " + std::to_string(fram.value) + " 10 -");
  session.tick();
  ours.request_attribute_transportation_type_change(fram, AttributeSet{speed},
                                                    Transportation::best_effort);
  owner.said.push_back("change_transportation object " + std::to_string(fram.value) + " 10 1");
  session.tick();
  theirs.query_attribute_transportation_type(fram, speed);
  theirs.query_interaction_transportation_type(ours.federate(), hail);
  guest.said.push_back("query_transportation object " + std::to_string(fram.value) + " 1");
  guest.said.push_back("query_transportation interaction " + std::to_string(hail.value) + " 0");
  session.tick();
  theirs.local_delete_object_instance(fram);
  guest.said.push_back("local_delete " + std::to_string(fram.value));
  guest.heard.push_back("remove " + std::to_string(fram.value));  // which confirms it
  session.tick();
}

class SecondReader : public ::testing::TestWithParam<void (*)(Session&)> {};

TEST_P(SecondReader, HearsEveryByteOfAConversationByTheWirePageAlone) {
  if (!has_python()) GTEST_SKIP() << "there is no python3";
  Session session;
  GetParam()(session);
  const test::TemporaryFolder folder("second-reader");
  const std::string base = std::filesystem::path(folder).string();
  std::ofstream(base + "/model.xml") << harbour_xml;
  std::ofstream(base + "/session", std::ios::binary) << session.record();
  const std::string heard =
      output_of("python3 -B '" + test::source_folder() + "/tests/rti/wire/second_reader.py' '" +
                base + "/model.xml' '" + base + "/session' 2>&1");
  EXPECT_EQ(heard, session.expected());
  EXPECT_GT(std::ranges::count(heard, '\n'), 40);
}

INSTANTIATE_TEST_SUITE_P(Of, SecondReader, ::testing::Values(talk, negotiate, arrange),
                         [](const auto& each) {
                           return each.param == talk        ? "objects"
                                  : each.param == negotiate ? "time_and_ownership"
                                                            : "names_and_relevance";
                         });

}  // namespace
}  // namespace rink::rti::testing
