// A federate that subscribes to the management object model, and what it reads and says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rti/management/management_values.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {

inline const ObjectClassHandle federate_class =
    *harbour().object_class("HLAobjectRoot.HLAmanager.HLAfederate");
inline const ObjectClassHandle federation_class =
    *harbour().object_class("HLAobjectRoot.HLAmanager.HLAfederation");

inline InteractionClassHandle manager_interaction(const std::string& name) {
  return *harbour().interaction_class("HLAinteractionRoot.HLAmanager." + name);
}

/// Subscribes to all of the management object model, and reads what it hears.
class Warden {
 public:
  explicit Warden(Rig& rig) : rig_(rig), station_(rig.join("warden")) {
    station_.ambassador.subscribe_object_class_attributes(federate_class,
                                                          harbour().attributes(federate_class));
    station_.ambassador.subscribe_object_class_attributes(federation_class,
                                                          harbour().attributes(federation_class));
    rig.settle();
  }
  Ambassador& ambassador() { return station_.ambassador; }
  Recorder& heard() { return station_.heard; }
  /// The object of the federate of that name; none if there is none.
  ObjectHandle object_of(const std::string& name) const {
    for (const auto& [object, known] : station_.heard.objects)
      if (known.object_class == federate_class &&
          text(ObjectHandle{object}, "HLAfederateName") == name)
        return {object};
    return {};
  }
  ObjectHandle federation() const {
    for (const auto& [object, known] : station_.heard.objects)
      if (known.object_class == federation_class) return {object};
    return {};
  }
  std::int32_t count(const std::string& federate, const char* attribute) const {
    return reader(object_of(federate), attribute).count();
  }
  double time(const std::string& federate, const char* attribute) const {
    return reader(object_of(federate), attribute).time();
  }
  std::string text(ObjectHandle object, const char* attribute) const {
    return std::string(reader(object, attribute).text());
  }
  ManagementReader reader(ObjectHandle object, const char* attribute) const {
    static const std::vector<std::byte> nothing;
    const auto known = station_.heard.objects.find(object.value);
    if (known == station_.heard.objects.end()) return ManagementReader(nothing);
    const auto value = known->second.values.find(
        harbour().attribute(known->second.object_class, attribute)->value);
    return ManagementReader(value == known->second.values.end() ? nothing : value->second);
  }
  /// Asks for the current values of all that it knows.
  void ask() {
    station_.ambassador.request_attribute_value_update(federate_class,
                                                       harbour().attributes(federate_class));
    rig_.settle();
  }
  void send(const std::string& name, const std::vector<std::byte>& parameters) {
    station_.ambassador.publish_interaction_class(manager_interaction(name));
    station_.ambassador.send_interaction(manager_interaction(name), parameters, {});
    rig_.settle();
  }

 private:
  Rig& rig_;
  Station& station_;
};

std::vector<std::byte> written(auto write) {
  std::vector<std::byte> bytes;
  write(ManagementWriter(bytes));
  return bytes;
}

inline std::vector<std::byte> timing(FederateHandle federate, std::uint64_t period) {
  return written([&](ManagementWriter to) { to.handle(federate.value), to.count(period); });
}

}  // namespace rink::rti::testing
