// Counts elements.
#include "rti/fom/module_summary.h"

#include <pugixml.hpp>
#include <span>
#include <string_view>

#include "rti/fom/fom_modules.h"

namespace rink::rti {

namespace {

using XmlNode = pugi::xml_node;

/// Classes below a node, and the members that they declare themselves.
void count_classes(const XmlNode& parent, const char* element, const char* member,
                   std::size_t& classes, std::size_t& members) {
  for (const XmlNode& node : parent.children(element)) {
    ++classes;
    for ([[maybe_unused]] const XmlNode& each : node.children(member)) ++members;
    count_classes(node, element, member, classes, members);
  }
}

std::size_t element_count(const XmlNode& parent) {
  std::size_t count = 0;
  for (const XmlNode& child : parent.children())
    count += child.type() == pugi::node_element ? 1u : 0u;
  return count;
}

void add(std::string& text, std::size_t count, const char* one, const char* many,
         const char* joint = ", ") {
  if (count == 0) return;
  text += (text.empty() ? "" : joint) + std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::string ModuleSummary::text() const {
  std::string all;
  add(all, object_classes, "object class", "object classes");
  add(all, attributes, "attribute", "attributes", " with ");
  add(all, interaction_classes, "interaction class", "interaction classes");
  add(all, parameters, "parameter", "parameters", " with ");
  add(all, dimensions, "dimension", "dimensions");
  add(all, data_types, "data type", "data types");
  add(all, enumerators, "enumerator", "enumerators", " with ");
  add(all, transportations, "transportation type", "transportation types");
  add(all, switches, "switch", "switches");
  add(all, update_rates, "update rate", "update rates");
  if (all.empty()) all = "nothing that federates exchange";
  return is_standard ? "the standard's management and initialization module; beside it " + all
                     : all;
}

ModuleSummary summarize(const FomModule& module) {
  const FomModules modules(std::span(&module, 1));
  const XmlNode& model = modules.models().front();
  ModuleSummary summary;
  summary.name = model.child("modelIdentification").child("name").text().get();
  summary.is_standard = modules.is_standard(model);
  count_classes(model.child("objects"), "objectClass", "attribute", summary.object_classes,
                summary.attributes);
  count_classes(model.child("interactions"), "interactionClass", "parameter",
                summary.interaction_classes, summary.parameters);
  summary.dimensions = element_count(model.child("dimensions"));
  summary.transportations = element_count(model.child("transportations"));
  summary.switches = element_count(model.child("switches"));
  summary.update_rates = element_count(model.child("updateRates"));
  for (const XmlNode& kind : model.child("dataTypes").children())
    for (const XmlNode& type : kind.children()) {
      if (type.type() != pugi::node_element) continue;
      ++summary.data_types;
      for ([[maybe_unused]] const XmlNode& each : type.children("enumerator"))
        ++summary.enumerators;
    }
  return summary;
}

}  // namespace rink::rti
