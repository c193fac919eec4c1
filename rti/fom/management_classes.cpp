// Makes classes of two tables.
#include "rti/fom/management_classes.h"

#include <algorithm>
#include <array>
#include <span>

namespace rink::rti {

namespace {

/// An attribute or parameter: the standard's data type, whose size is 0 where it varies.
struct Member {
  const char *name, *data_type;
  std::uint32_t size;
};
constexpr Member handle(const char* name) { return {name, "HLAhandle", 4}; }
constexpr Member count(const char* name) { return {name, "HLAcount", 4}; }
constexpr Member truth(const char* name) { return {name, "HLAboolean", 4}; }
constexpr Member text(const char* name) { return {name, "HLAunicodeString", 0}; }
constexpr Member handles(const char* name) { return {name, "HLAhandleList", 0}; }

constexpr std::array federation_attributes = {
    text("HLAfederationName"),
    handles("HLAfederatesInFederation"),
    text("HLARTIversion"),
    text("HLAMIMdesignator"),
    text("HLAFOMmoduleDesignatorList"),
    text("HLAtimeImplementationName"),
    truth("HLAautoProvide"),
};
constexpr std::array federate_attributes = {
    handle("HLAfederateHandle"),
    text("HLAfederateName"),
    text("HLAfederateType"),
    text("HLARTIversion"),
    truth("HLAtimeConstrained"),
    truth("HLAtimeRegulating"),
    Member{"HLAfederateState", "HLAfederateState", 4},
    Member{"HLAtimeManagerState", "HLAtimeState", 4},
    Member{"HLAlogicalTime", "HLAlogicalTime", 8},
    Member{"HLAlookahead", "HLAtimeInterval", 8},
    Member{"HLAGALT", "HLAlogicalTime", 8},
    Member{"HLALITS", "HLAlogicalTime", 8},
    count("HLAreflectionsReceived"),
    count("HLAupdatesSent"),
    count("HLAinteractionsReceived"),
    count("HLAinteractionsSent"),
    count("HLAobjectInstancesThatCanBeDeleted"),
    count("HLAobjectInstancesDeleted"),
    count("HLAobjectInstancesRemoved"),
    count("HLAobjectInstancesRegistered"),
    count("HLAobjectInstancesDiscovered"),
};

constexpr std::array of_federate = {handle("HLAfederate")};
constexpr std::array timing = {Member{"HLAreportPeriod", "HLAseconds", 4}};
constexpr std::array object_publication = {count("HLAnumberOfClasses"), handle("HLAobjectClass"),
                                           handles("HLAattributeList")};
constexpr std::array object_subscription = {count("HLAnumberOfClasses"), handle("HLAobjectClass"),
                                            truth("HLAactive"), handles("HLAattributeList")};
constexpr std::array interaction_list = {handles("HLAinteractionClassList")};
constexpr std::array switches = {truth("HLAautoProvide")};
constexpr std::array points = {Member{"HLAsyncPoints", "HLAsynchPointList", 0}};

struct Interaction {
  int depth;  ///< below HLAmanager
  const char* name;
  std::span<const Member> parameters;
};
const std::array interactions = {
    Interaction{0, "HLAmanager", {}},
    Interaction{1, "HLAfederate", of_federate},
    Interaction{2, "HLAadjust", {}},
    Interaction{3, "HLAsetTiming", timing},
    Interaction{2, "HLArequest", {}},
    Interaction{3, "HLArequestPublications", {}},
    Interaction{3, "HLArequestSubscriptions", {}},
    Interaction{2, "HLAreport", {}},
    Interaction{3, "HLAreportObjectClassPublication", object_publication},
    Interaction{3, "HLAreportObjectClassSubscription", object_subscription},
    Interaction{3, "HLAreportInteractionPublication", interaction_list},
    Interaction{3, "HLAreportInteractionSubscription", interaction_list},
    Interaction{1, "HLAfederation", {}},
    Interaction{2, "HLAadjust", {}},
    Interaction{3, "HLAsetSwitches", switches},
    Interaction{2, "HLArequest", {}},
    Interaction{3, "HLArequestSynchronizationPoints", {}},
    Interaction{2, "HLAreport", {}},
    Interaction{3, "HLAreportSynchronizationPoints", points},
};

std::optional<std::uint32_t> size_of(const Member& member) {
  return member.size != 0 ? std::optional(member.size) : std::nullopt;
}

template <class Class>
auto root_of(std::vector<Class>& classes, const char* name) {
  const auto is_root = [name](const Class& each) { return !each.parent && each.name == name; };
  auto found = std::ranges::find_if(classes, is_root);
  if (found == classes.end()) {
    found = classes.insert(classes.end(), Class{});
    found->name = name;
  }
  decltype(Class::parent) handle;
  handle.value = static_cast<std::uint32_t>(found - classes.begin());
  return handle;
}

ObjectClassHandle append(std::vector<ObjectClass>& classes, ObjectClassHandle parent,
                         const char* name, std::span<const Member> members) {
  ObjectClass added;
  added.name = name;
  added.parent = parent;
  added.attributes = classes[parent.value].attributes;
  for (const Member& each : members) {
    Attribute attribute;
    attribute.name = each.name;
    attribute.data_type = each.data_type;
    attribute.size = size_of(each);
    add_attribute(added.attributes, std::move(attribute));
  }
  if (added.attributes.size() > attribute_max)
    throw FileError("HLAobjectRoot has " + std::to_string(classes[parent.value].attributes.size()) +
                    " attributes, which leaves no room for those of " + added.name);
  classes.push_back(std::move(added));
  return {static_cast<std::uint32_t>(classes.size() - 1)};
}

InteractionClassHandle append(std::vector<InteractionClass>& classes, InteractionClassHandle parent,
                              const Interaction& interaction) {
  InteractionClass added;
  added.name = interaction.name;
  added.parent = parent;
  added.parameters = classes[parent.value].parameters;
  for (const Member& each : interaction.parameters)
    added.parameters.push_back({each.name, each.data_type, size_of(each)});
  classes.push_back(std::move(added));
  return {static_cast<std::uint32_t>(classes.size() - 1)};
}

}  // namespace

void append_management_classes(std::vector<ObjectClass>& object_classes,
                               std::vector<InteractionClass>& interaction_classes) {
  const ObjectClassHandle manager =
      append(object_classes, root_of(object_classes, "HLAobjectRoot"), "HLAmanager", {});
  append(object_classes, manager, "HLAfederation", federation_attributes);
  append(object_classes, manager, "HLAfederate", federate_attributes);
  std::array<InteractionClassHandle, 5> path{
      root_of(interaction_classes, "HLAinteractionRoot")};  // by depth + 1: the superclass of those
                                                            // that follow
  for (const Interaction& each : interactions) {
    const auto depth = static_cast<std::size_t>(each.depth);
    path[depth + 1] = append(interaction_classes, path[depth], each);
  }
}

}  // namespace rink::rti
