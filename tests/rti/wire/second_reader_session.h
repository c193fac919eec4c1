// A session of federates that write down what they say and hear in the second reader's words, and
// every byte between them.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <deque>
#include <numeric>
#include <sstream>
#include <string>

#include "rti/management/federation_report.h"
#include "rti/objects/name_book.h"
#include "rti/wire/message.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {

template <class... Parts>
inline std::string line_of(const Parts&... parts) {
  std::ostringstream text;
  const char* gap = "";
  ((text << gap << parts, gap = " "), ...);
  return text.str();
}

inline std::string hex(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}
inline std::string hex(double number) { return hex(std::bit_cast<std::uint64_t>(number)); }
inline std::string hex(Bytes bytes) {
  std::string text;
  for (const std::byte byte : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(byte));
    text += digits;
  }
  return text.empty() ? "-" : text;
}
inline std::string stamp_text(const Stamp& stamp) {
  return hex(stamp.time) + " " + std::to_string(stamp.tag);
}
inline std::string word(std::string_view text) { return text.empty() ? "-" : std::string(text); }
inline std::string list_of_handles(std::span<const FederateHandle> handles) {
  std::string text;
  for (const FederateHandle handle : handles)
    text += (text.empty() ? "" : ",") + std::to_string(handle.value);
  return word(text);
}
inline std::string name_of(ObjectClassHandle object_class) {
  return harbour().at(object_class).name;
}
inline std::string name_of(InteractionClassHandle interaction_class) {
  return harbour().at(interaction_class).name;
}
inline std::string names_of(ObjectClassHandle object_class, AttributeSet set) {
  std::string text;
  for (std::uint32_t k = 0; k < harbour().at(object_class).attributes.size(); ++k)
    if (set.contains({k}))
      text += (text.empty() ? "" : "+") + harbour().at(object_class).attributes[k].name;
  return word(text);
}

/// A handle holds a mark of its federate above the number that travels.
inline std::uint32_t wire_number(RegionHandle region) { return region.value % region_max; }

/// A federate that writes down what it says and what it is told, in the second reader's words.
class Clerk final : public FederateAmbassador {
 public:
  std::vector<std::string> said, heard;
  Ambassador ambassador{harbour(), *this};

  void join(const std::string& name) {
    ambassador.join("rink", name, "clerk");
    said.push_back(line_of("join version", protocol_version, "model", hex(harbour().hash()), "rink",
                           name, "clerk"));
  }
  void publish(ObjectClassHandle object_class, AttributeSet set) {
    ambassador.publish_object_class_attributes(object_class, set);
    said.push_back(line_of("publish", name_of(object_class), names_of(object_class, set)));
  }
  void subscribe(ObjectClassHandle object_class, AttributeSet set, RegionHandle region = {}) {
    ambassador.subscribe_object_class_attributes(object_class, set, region);
    said.push_back(line_of("subscribe", name_of(object_class), names_of(object_class, set),
                           region ? std::to_string(wire_number(region)) : "-", "active"));
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
  void update(ObjectHandle object, AttributeSet set, const std::vector<std::byte>& values,
              const Stamp& stamp) {
    ambassador.update_attribute_values(object, set, values, stamp);
    said.push_back(line_of("update", object.value, name_of(classes_.at(object.value)),
                           names_of(classes_.at(object.value), set), stamp_text(stamp),
                           hex(values)));
  }
  void remove(ObjectHandle object) {
    ambassador.delete_object_instance(object);
    said.push_back(line_of("delete", object.value));
  }
  void send(InteractionClassHandle interaction_class, std::string_view words, const Stamp& stamp,
            FederateHandle receiver = {}) {
    if (receiver)
      ambassador.send_directed_interaction(interaction_class, receiver, bytes_of(words), stamp);
    else ambassador.send_interaction(interaction_class, bytes_of(words), stamp);
    said.push_back(line_of("send", name_of(interaction_class),
                           receiver ? std::to_string(receiver.value) : "-", stamp_text(stamp),
                           hex(bytes_of(words))));
  }

  void joined(FederateHandle federate) override {
    heard.push_back(line_of("joined", federate.value));
  }
  void synchronization_point_registration_succeeded(std::string_view label) override {
    heard.push_back(line_of("registered", label, 0));
  }
  void announce_synchronization_point(std::string_view label, Bytes tag) override {
    heard.push_back(line_of("announced", label, hex(tag)));
  }
  void federation_synchronized(std::string_view label,
                               std::span<const FederateHandle> failed) override {
    heard.push_back(line_of("synchronized", label, list_of_handles(failed)));
  }
  void federate_joined(FederateHandle handle, std::string_view name,
                       std::string_view type) override {
    heard.push_back(line_of("federate_joined", handle.value, name, type));
  }
  void federate_resigned(FederateHandle handle, std::string_view name, std::string_view type,
                         ResignReason reason) override {
    heard.push_back(
        line_of("federate_resigned", handle.value, static_cast<int>(reason), name, type));
  }
  void discover_object_instance(ObjectHandle object, ObjectClassHandle object_class,
                                std::string_view name) override {
    classes_[object.value] = object_class;
    heard.push_back(line_of(
        "discover", object.value, name_of(object_class),
        name == NameBook::default_name(object) ? "-" : name));  // a default name is not sent
  }
  void object_instance_name_reservation_succeeded(std::string_view name) override {
    heard.push_back(line_of("names granted", name));
  }
  void object_instance_name_reservation_failed(std::string_view name) override {
    heard.push_back(line_of(is_registering ? "names registration_refused" : "names refused", name));
  }
  void multiple_object_instance_name_reservation_succeeded(
      const std::vector<std::string>& names) override {
    heard.push_back(line_of("names set_granted", list_of(names)));
  }
  void multiple_object_instance_name_reservation_failed(
      const std::vector<std::string>& names) override {
    heard.push_back(line_of("names set_refused", list_of(names)));
  }
  void provide_attribute_value_update(ObjectHandle object, AttributeSet set, Bytes tag) override {
    heard.push_back(line_of("provide", object.value, binary(set), hex(tag)));
  }
  void confirm_attribute_transportation_type_change(ObjectHandle object, AttributeSet set,
                                                    Transportation type) override {
    heard.push_back(line_of("transportation object confirmation", object.value,
                            static_cast<std::uint32_t>(set.bits), static_cast<int>(type)));
  }
  void report_attribute_transportation_type(ObjectHandle object, AttributeHandle attribute,
                                            Transportation type) override {
    heard.push_back(line_of("transportation object answer", object.value, attribute.value,
                            static_cast<int>(type)));
  }
  void confirm_interaction_transportation_type_change(InteractionClassHandle each,
                                                      Transportation type) override {
    heard.push_back(
        line_of("transportation interaction confirmation", each.value, 0, static_cast<int>(type)));
  }
  void report_interaction_transportation_type(FederateHandle federate, InteractionClassHandle each,
                                              Transportation type) override {
    heard.push_back(line_of("transportation interaction answer", each.value, federate.value,
                            static_cast<int>(type)));
  }
  void turn_updates_on_for_object_instance(ObjectHandle object, AttributeSet set) override {
    heard.push_back(line_of("object_relevance", object.value, binary(set)));
  }
  static std::string list_of(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& each : names) text += (text.empty() ? "" : ",") + each;
    return text;
  }
  static std::string binary(AttributeSet set) {
    std::string text;
    for (AttributeBits bits = set.bits; bits != 0; bits >>= 1)
      text.insert(text.begin(), (bits & 1u) != 0 ? '1' : '0');
    return text.empty() ? "0" : text;
  }
  bool is_registering = false;  ///< by a name that is taken
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp& stamp) override {
    heard.push_back(line_of("reflect", object.value, name_of(classes_.at(object.value)),
                            names_of(classes_.at(object.value), set), stamp_text(stamp),
                            hex(values)));
  }
  void attributes_in_scope(ObjectHandle object) override {
    heard.push_back(line_of("in_scope", object.value));
  }
  void attributes_out_of_scope(ObjectHandle object) override {
    heard.push_back(line_of("out_of_scope", object.value));
  }
  void remove_object_instance(ObjectHandle object) override {
    heard.push_back(line_of("remove", object.value));
  }
  void receive_interaction(InteractionClassHandle interaction_class, Bytes parameters,
                           FederateHandle sender, const Stamp& stamp) override {
    heard.push_back(line_of("receive", name_of(interaction_class), sender.value, stamp_text(stamp),
                            hex(parameters)));
  }

  // Time.
  void say(const std::string& line) { said.push_back(line); }
  void time_regulation_enabled(LogicalTime time) override {
    heard.push_back(line_of("time_regulation_enabled", hex(time.value),
                            hex(time.value + ambassador.query_lookahead())));
  }
  void time_constrained_enabled(LogicalTime time) override {
    heard.push_back(line_of("time_constrained_enabled", hex(time.value)));
  }
  void time_advance_grant(LogicalTime time) override {
    heard.push_back(line_of("time_advance_grant", hex(time.value)));
  }
  void request_retraction(const RetractionHandle& handle) override {
    heard.push_back(
        line_of("request_retraction", handle.sender.value, handle.number, hex(handle.time)));
  }
  void time_bounds(double galt, double lits) override {
    heard.push_back(line_of("time_bounds", hex(galt), hex(lits)));
  }
  static std::string timed_text(const TimedStamp& timed) {
    return line_of("timed", timed.handle.sender.value, static_cast<int>(timed.is_in_order),
                   timed.handle.number, stamp_text(timed.stamp));
  }
  void receive_interaction_with_time(InteractionClassHandle interaction_class, Bytes parameters,
                                     FederateHandle sender, const TimedStamp& timed) override {
    heard.push_back(line_of(timed_text(timed), "receive", name_of(interaction_class), sender.value,
                            stamp_text({}), hex(parameters)));
  }
  void remove_object_instance_with_time(ObjectHandle object, const TimedStamp& timed) override {
    heard.push_back(line_of(timed_text(timed), "remove", object.value));
  }

  // Ownership.
  void note(const char* what, ObjectHandle object, AttributeSet set, Bytes tag = {}) {
    char bits[9];
    std::snprintf(bits, sizeof bits, "%x", static_cast<unsigned>(set.bits));
    heard.push_back(line_of(what, object.value, bits, hex(tag)));
  }
  void request_attribute_ownership_release(ObjectHandle object, AttributeSet set,
                                           Bytes tag) override {
    note("release_requested", object, set, tag);
  }
  void attribute_ownership_acquisition_notification(ObjectHandle object, AttributeSet set,
                                                    Bytes tag) override {
    note("acquired", object, set, tag);
  }
  void attribute_ownership_divested(ObjectHandle object, AttributeSet set) override {
    note("divested", object, set);
  }
  void inform_attribute_ownership(ObjectHandle object, AttributeHandle attribute,
                                  FederateHandle owner) override {
    heard.push_back(line_of("owner", object.value, attribute.value, owner.value));
  }

  // Reports.
  void report_management(const std::vector<FederationReport>& reports) override {
    for (const FederationReport& report : reports) {
      heard.push_back(line_of(
          "report", report.federation, report.model, report.filter, "objects", report.objects,
          "drops", std::accumulate(report.drops.begin(), report.drops.end(), std::uint64_t{0})));
      for (const FederateReport& each : report.federates) {
        const FederateCounts& counts = each.counts;
        heard.push_back(line_of("federate", each.federate.value, each.name, each.type, "updates",
                                counts.updates_sent, "reflections", counts.reflections_received,
                                "sent", counts.interactions_sent, "received",
                                counts.interactions_received, "owned", counts.objects_owned, "time",
                                int{counts.is_time_regulating}, int{counts.is_time_constrained},
                                hex(counts.logical_time)));
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
      for (const std::string& line : clerks_[i].heard)
        text += std::to_string(i) + "d " + line + "\n";
      for (const std::string& line : clerks_[i].said)
        text += std::to_string(i) + "u " + line + "\n";
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

}  // namespace rink::rti::testing
