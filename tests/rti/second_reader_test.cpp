// A conversation recorded byte by byte, and what a second reader, written in Python from docs/wire.md, makes of it: the very things that were said and heard.
#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <numeric>
#include <sstream>

#include "tests/places.h"
#include "tests/rti/rig.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

template <class... Parts>
std::string line_of(const Parts&... parts) {
  std::ostringstream text;
  const char* gap = "";
  ((text << gap << parts, gap = " "), ...);
  return text.str();
}

std::string hex(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}
std::string hex(double number) { return hex(std::bit_cast<std::uint64_t>(number)); }
std::string hex(Bytes bytes) {
  std::string text;
  for (const std::byte byte : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(byte));
    text += digits;
  }
  return text.empty() ? "-" : text;
}
std::string stamp_text(const Stamp& stamp) { return hex(stamp.time) + " " + std::to_string(stamp.tag); }
std::string word(std::string_view text) { return text.empty() ? "-" : std::string(text); }
std::string list_of_handles(std::span<const FederateHandle> handles) {
  std::string text;
  for (const FederateHandle handle : handles) text += (text.empty() ? "" : ",") + std::to_string(handle.value);
  return word(text);
}
std::string name_of(ObjectClassHandle object_class) { return harbour().at(object_class).name; }
std::string name_of(InteractionClassHandle interaction_class) { return harbour().at(interaction_class).name; }
std::string names_of(ObjectClassHandle object_class, AttributeSet set) {
  std::string text;
  for (std::uint32_t k = 0; k < harbour().at(object_class).attributes.size(); ++k)
    if (set.contains({k})) text += (text.empty() ? "" : "+") + harbour().at(object_class).attributes[k].name;
  return word(text);
}

/// A handle holds a mark of its federate above the number that travels.
std::uint32_t wire_number(RegionHandle region) { return region.value % region_max; }

/// A federate that writes down what it says and what it is told, in the second reader's words.
class Clerk final : public FederateAmbassador {
 public:
  std::vector<std::string> said, heard;
  Ambassador ambassador{harbour(), *this};

  void join(const std::string& name) {
    ambassador.join("rink", name, "clerk");
    said.push_back(line_of("join version", protocol_version, "model", hex(harbour().hash()), "rink", name, "clerk"));
  }
  void publish(ObjectClassHandle object_class, AttributeSet set) {
    ambassador.publish_object_class_attributes(object_class, set);
    said.push_back(line_of("publish", name_of(object_class), names_of(object_class, set)));
  }
  void subscribe(ObjectClassHandle object_class, AttributeSet set, RegionHandle region = {}) {
    ambassador.subscribe_object_class_attributes(object_class, set, region);
    said.push_back(line_of("subscribe", name_of(object_class), names_of(object_class, set), region ? std::to_string(wire_number(region)) : "-", "active"));
  }
  void exchange_interactions(InteractionClassHandle interaction_class) {
    ambassador.publish_interaction_class(interaction_class);
    said.push_back(line_of("publish_interaction", name_of(interaction_class), 1));
    ambassador.subscribe_interaction_class(interaction_class);
    said.push_back(line_of("subscribe_interaction", name_of(interaction_class), 1));
  }
  ObjectHandle add(ObjectClassHandle object_class, const std::string& name) {
    const ObjectHandle object = ambassador.register_object_instance(object_class, name);
    said.push_back(line_of("register", object.value, name_of(object_class), word(name)));
    if (!has_block_) heard.front() += " " + std::to_string(object.value / object_block);
    has_block_ = true;
    classes_[object.value] = object_class;
    return object;
  }
  void update(ObjectHandle object, AttributeSet set, const std::vector<std::byte>& values, const Stamp& stamp) {
    ambassador.update_attribute_values(object, set, values, stamp);
    said.push_back(line_of("update", object.value, name_of(classes_.at(object.value)), names_of(classes_.at(object.value), set), stamp_text(stamp), hex(values)));
  }
  void remove(ObjectHandle object) {
    ambassador.delete_object_instance(object);
    said.push_back(line_of("delete", object.value));
  }
  void send(InteractionClassHandle interaction_class, std::string_view words, const Stamp& stamp, FederateHandle receiver = {}) {
    if (receiver) ambassador.send_directed_interaction(interaction_class, receiver, bytes_of(words), stamp);
    else ambassador.send_interaction(interaction_class, bytes_of(words), stamp);
    said.push_back(line_of("send", name_of(interaction_class), receiver ? std::to_string(receiver.value) : "-", stamp_text(stamp), hex(bytes_of(words))));
  }

  void joined(FederateHandle federate) override { heard.push_back(line_of("joined", federate.value)); }
  void synchronization_point_registration_succeeded(std::string_view label) override { heard.push_back(line_of("registered", label, 0)); }
  void announce_synchronization_point(std::string_view label, Bytes tag) override { heard.push_back(line_of("announced", label, hex(tag))); }
  void federation_synchronized(std::string_view label, std::span<const FederateHandle> failed) override { heard.push_back(line_of("synchronized", label, list_of_handles(failed))); }
  void federate_joined(FederateHandle handle, std::string_view name, std::string_view type) override { heard.push_back(line_of("federate_joined", handle.value, name, type)); }
  void federate_resigned(FederateHandle handle, std::string_view name, std::string_view type, ResignReason reason) override {
    heard.push_back(line_of("federate_resigned", handle.value, static_cast<int>(reason), name, type));
  }
  void discover_object_instance(ObjectHandle object, ObjectClassHandle object_class, std::string_view name) override {
    classes_[object.value] = object_class;
    heard.push_back(line_of("discover", object.value, name_of(object_class), word(name)));
  }
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values, const Stamp& stamp) override {
    heard.push_back(line_of("reflect", object.value, name_of(classes_.at(object.value)), names_of(classes_.at(object.value), set), stamp_text(stamp), hex(values)));
  }
  void attributes_in_scope(ObjectHandle object) override { heard.push_back(line_of("in_scope", object.value)); }
  void attributes_out_of_scope(ObjectHandle object) override { heard.push_back(line_of("out_of_scope", object.value)); }
  void remove_object_instance(ObjectHandle object) override { heard.push_back(line_of("remove", object.value)); }
  void receive_interaction(InteractionClassHandle interaction_class, Bytes parameters, FederateHandle sender, const Stamp& stamp) override {
    heard.push_back(line_of("receive", name_of(interaction_class), sender.value, stamp_text(stamp), hex(parameters)));
  }

  // Time.
  void say(const std::string& line) { said.push_back(line); }
  void time_regulation_enabled(LogicalTime time) override { heard.push_back(line_of("time_regulation_enabled", hex(time.value), hex(time.value + ambassador.query_lookahead()))); }
  void time_constrained_enabled(LogicalTime time) override { heard.push_back(line_of("time_constrained_enabled", hex(time.value))); }
  void time_advance_grant(LogicalTime time) override { heard.push_back(line_of("time_advance_grant", hex(time.value))); }
  void request_retraction(const RetractionHandle& handle) override { heard.push_back(line_of("request_retraction", handle.sender.value, handle.number, hex(handle.time))); }
  void time_bounds(double galt, double lits) override { heard.push_back(line_of("time_bounds", hex(galt), hex(lits))); }
  static std::string timed_text(const TimedStamp& timed) { return line_of("timed", timed.handle.sender.value, static_cast<int>(timed.is_in_order), timed.handle.number, stamp_text(timed.stamp)); }
  void receive_interaction_with_time(InteractionClassHandle interaction_class, Bytes parameters, FederateHandle sender, const TimedStamp& timed) override {
    heard.push_back(line_of(timed_text(timed), "receive", name_of(interaction_class), sender.value, stamp_text({}), hex(parameters)));
  }
  void remove_object_instance_with_time(ObjectHandle object, const TimedStamp& timed) override { heard.push_back(line_of(timed_text(timed), "remove", object.value)); }

  // Ownership.
  void note(const char* what, ObjectHandle object, AttributeSet set, Bytes tag = {}) {
    char bits[9];
    std::snprintf(bits, sizeof bits, "%x", static_cast<unsigned>(set.bits));
    heard.push_back(line_of(what, object.value, bits, hex(tag)));
  }
  void request_attribute_ownership_release(ObjectHandle object, AttributeSet set, Bytes tag) override { note("release_requested", object, set, tag); }
  void attribute_ownership_acquisition_notification(ObjectHandle object, AttributeSet set, Bytes tag) override { note("acquired", object, set, tag); }
  void attribute_ownership_divested(ObjectHandle object, AttributeSet set) override { note("divested", object, set); }
  void inform_attribute_ownership(ObjectHandle object, AttributeHandle attribute, FederateHandle owner) override { heard.push_back(line_of("owner", object.value, attribute.value, owner.value)); }
  void provide_attribute_value_update(ObjectHandle object, AttributeSet set) override { heard.push_back(line_of("provide", object.value, set.bits)); }

  // Reports.
  void report_management(const std::vector<FederationReport>& reports) override {
    for (const FederationReport& report : reports) {
      heard.push_back(line_of("report", report.federation, report.model, report.filter, "objects", report.objects, "drops", std::accumulate(report.drops.begin(), report.drops.end(), std::uint64_t{0})));
      for (const FederateReport& each : report.federates) {
        const FederateCounts& counts = each.counts;
        heard.push_back(line_of("federate", each.federate.value, each.name, each.type, "updates", counts.updates_sent, "reflections", counts.reflections_received, "sent", counts.interactions_sent,
                                "received", counts.interactions_received, "owned", counts.objects_owned, "time", int{counts.is_time_regulating}, int{counts.is_time_constrained}, hex(counts.logical_time)));
      }
    }
    heard.push_back("report ends");
  }

 private:
  std::map<std::uint32_t, ObjectClassHandle> classes_;
  bool has_block_ = false;
};

/// An RTI and its clerks, every byte between them kept in the second reader's form.
class Session final : public Outlet {
 public:
  Session() : execution_(harbour(), settings()) {}
  Clerk& enter(const std::string& name) {
    Clerk& clerk = clerks_.emplace_back();
    execution_.connect(static_cast<ConnectionId>(clerks_.size() - 1));
    clerk.join(name);
    tick();
    return clerk;
  }
  void tick() {
    for (std::size_t i = 0; i < clerks_.size(); ++i) {
      const Bytes bytes = clerks_[i].ambassador.outgoing();
      keep('u', static_cast<std::uint32_t>(i), bytes);
      execution_.receive(static_cast<ConnectionId>(i), bytes);
      clerks_[i].ambassador.clear_outgoing();
    }
    execution_.match();
    execution_.flush(*this);
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) {
      keep('d', connection, part);
      EXPECT_TRUE(clerks_[connection].ambassador.receive(part));
    }
  }
  void drop(ConnectionId, std::string_view) override {}

  const std::string& record() const { return record_; }
  /// What all said and heard, in the second reader's order.
  std::string expected() const {
    std::string text;
    for (std::size_t i = 0; i < clerks_.size(); ++i) {
      for (const std::string& line : clerks_[i].heard) text += std::to_string(i) + "d " + line + "\n";
      for (const std::string& line : clerks_[i].said) text += std::to_string(i) + "u " + line + "\n";
    }
    return text;
  }

 private:
  static FederationSettings settings() {
    FederationSettings settings;
    settings.filter = "region";
    return settings;
  }
  void keep(char direction, std::uint32_t connection, Bytes bytes) {
    record_ += direction;
    record_ += text_of(values_of(connection, static_cast<std::uint32_t>(bytes.size())));
    record_ += text_of(bytes);
  }
  FederationExecution execution_;
  std::deque<Clerk> clerks_;
  std::string record_;
};

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
    watchman.said.push_back(line_of("bounds", wire_number(view), hex(x), hex(y), hex(x + 10.0), hex(y + 10.0)));
  };
  look(0.0, 0.0);
  watchman.subscribe(vessel, motion, view);
  watchman.subscribe(ferry, everything);
  session.tick();
  // Each publication is answered, and each change of who hears it told; oneself does not count.
  for (const char* line : {"class_relevance Vessel - -", "class_relevance Ferry - -", "interaction_relevance Hail 0 0", "interaction_relevance Hail 1 1",
                           "class_relevance Vessel position+speed position+speed", "class_relevance Ferry position+speed position+speed",
                           "class_relevance Ferry position+speed+destination position+speed+destination"})
    pilot.heard.push_back(line);
  for (const char* line : {"class_relevance Vessel - -", "class_relevance Ferry - -", "interaction_relevance Hail 1 1"}) watchman.heard.push_back(line);
  const ObjectHandle boat = pilot.add(vessel, "Fram"), crossing = pilot.add(ferry, "");
  watchman.add(vessel, "Watch");
  session.tick();
  const RegionHandle place = pilot.ambassador.create_region();
  pilot.said.push_back(line_of("create_region", wire_number(place)));
  pilot.ambassador.set_region(place, {5.0, 5.0, 6.0, 6.0});
  pilot.ambassador.commit_region_modifications(place);
  pilot.said.push_back(line_of("bounds", wire_number(place), hex(5.0), hex(5.0), hex(6.0), hex(6.0)));
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
  pilot.said.push_back(line_of("register_synchronization_point", "harbour closed", hex(bytes_of("at dusk")), "-"));
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
    const RetractionHandle handle = pilot.ambassador.send_interaction(hail, bytes_of(words), LogicalTime(time));
    pilot.say(line_of("timed", handle.number, stamp_text({time, 0}), "send", "Hail", "-", stamp_text({}), hex(bytes_of(words))));
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

std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  for (int letter = 0; (letter = std::fgetc(pipe)) != EOF;) text += static_cast<char>(letter);
  return pclose(pipe) == 0 ? text : "failed: " + text;
}

class SecondReader : public ::testing::TestWithParam<void (*)(Session&)> {};

TEST_P(SecondReader, HearsEveryByteOfAConversationByTheWirePageAlone) {
  if (output_of("python3 -c 'print(1)' 2>/dev/null") != "1\n") GTEST_SKIP() << "there is no python3";
  Session session;
  GetParam()(session);
  const test::TemporaryFolder folder("second-reader");
  const std::string base = std::filesystem::path(folder).string();
  std::ofstream(base + "/model.xml") << harbour_xml;
  std::ofstream(base + "/session", std::ios::binary) << session.record();
  const std::string heard = output_of("python3 -B '" + test::source_folder() + "/tests/rti/second_reader.py' '" + base + "/model.xml' '" + base + "/session' 2>&1");
  EXPECT_EQ(heard, session.expected());
  EXPECT_GT(std::ranges::count(heard, '\n'), 40);
}

INSTANTIATE_TEST_SUITE_P(Of, SecondReader, ::testing::Values(talk, negotiate), [](const auto& each) { return each.param == talk ? "objects" : "time_and_ownership"; });

}  // namespace
}  // namespace rink::rti::testing
