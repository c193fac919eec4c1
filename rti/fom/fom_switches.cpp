// Reads <switches>.
#include "rti/fom/fom_switches.h"

#include <algorithm>
#include <array>

#include "rti/fom/fom_modules.h"

namespace rink::rti {

namespace {

struct Switch {
  const char* name;
  bool FomSwitches::*value;
};
constexpr std::array known_switches = {
    Switch{"autoProvide", &FomSwitches::auto_provide},
    Switch{"attributeScopeAdvisory", &FomSwitches::attribute_scope_advisory},
    Switch{"attributeRelevanceAdvisory", &FomSwitches::attribute_relevance_advisory},
    Switch{"objectClassRelevanceAdvisory", &FomSwitches::object_class_relevance_advisory},
    Switch{"interactionRelevanceAdvisory", &FomSwitches::interaction_relevance_advisory},
};
/// Switches that stay off whatever a model says: the RTI does not convey regions of updates and
/// interactions, does not report services and exceptions, and has no delayed evaluation of
/// subscriptions.
constexpr std::array never_on = {"conveyRegionDesignatorSets", "serviceReporting",
                                 "exceptionReporting", "delaySubscriptionEvaluation"};
/// Those of IEEE 1516.2-2025 alone, whatever their value.
constexpr std::array of_2025 = {"nonRegulatedGrant", "advisoriesUseKnownClass", "allowRelaxedDDM",
                                "sendServiceReportsToFile"};
/// This switch stays on: the sender of an interaction is always conveyed.
constexpr const char* always_on = "conveyProducingFederate";
constexpr std::array resign_actions = {
    "UnconditionallyDivestAttributes",    "DeleteObjects",
    "CancelPendingOwnershipAcquisitions", "DeleteObjectsThenDivest",
    "CancelThenDeleteThenDivest",         "NoAction"};

bool is_enabled(const FomModules& modules, const pugi::xml_node& node) {
  const std::string value = node.attribute("isEnabled").value();
  if (value != "true" && value != "false")
    modules.fail(node, "<" + std::string(node.name()) + "> of <switches> has isEnabled \"" + value +
                           "\"; allowed are true, false");
  return value == "true";
}

void read_switch(FomModules& modules, const pugi::xml_node& node, FomSwitches& switches) {
  const std::string name = node.name();
  if (name == "automaticResignAction") {
    const std::string action = node.attribute("resignAction").value();
    const auto found = std::ranges::find(resign_actions, action);
    if (found == resign_actions.end())
      modules.fail(node, "<automaticResignAction> of <switches> has resignAction \"" + action +
                             "\"; allowed are the standard's, such as CancelThenDeleteThenDivest");
    switches.automatic_resign_action = static_cast<ResignAction>(found - resign_actions.begin());
    return;
  }
  const bool is_on = is_enabled(modules, node);
  const auto known =
      std::ranges::find_if(known_switches, [&](const Switch& each) { return name == each.name; });
  if (known != known_switches.end()) {
    switches.*(known->value) = is_on;
    return;
  }
  if (name == always_on) {
    if (!is_on)
      modules.warn(node, "<" + name +
                             "> stays on: receivers of an interaction always learn its "
                             "sender");
    return;
  }
  if (std::ranges::find(of_2025, name) != of_2025.end())
    return modules.warn(node, "<" + name + "> has no effect");
  if (std::ranges::find(never_on, name) == never_on.end())
    modules.fail(node, "<switches> holds <" + name + ">, which is no switch of the standard");
  if (is_on) modules.warn(node, "<" + name + "> stays off: this RTI does not do that");
}

}  // namespace

std::string FomSwitches::text() const {
  if (*this == FomSwitches()) return "";
  std::string bits;
  for (const Switch& each : known_switches) bits += this->*(each.value) ? '1' : '0';
  return bits + std::to_string(static_cast<unsigned>(automatic_resign_action));
}

FomSwitches read_switches(FomModules& modules) {
  FomSwitches switches;
  const std::vector<pugi::xml_node> tables = modules.sections("switches");
  for (const pugi::xml_node& table : tables)
    for (const pugi::xml_node& node : table.children()) {
      if (node.type() != pugi::node_element) continue;
      for (const pugi::xml_node& other : tables)
        for (const char* value : {"isEnabled", "resignAction"})
          if (const pugi::xml_node same = other.child(node.name());
              same &&
              std::string_view(same.attribute(value).value()) != node.attribute(value).value())
            modules.conflict(
                same, "switch <" + std::string(node.name()) + "> differs from its definition",
                node);
      read_switch(modules, node, switches);
    }
  return switches;
}

}  // namespace rink::rti
