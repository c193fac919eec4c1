// Digests of models and their comparison.
#include "rti/fom/fom_digest.h"

#include <algorithm>

#include "im/basics/fnv_hash.h"
#include "rti/fom/attribute_codec.h"
#include "rti/fom/quantised_codec.h"

namespace rink::rti {

namespace {

struct Element {
  std::string name, content;
};

std::string number(std::uint64_t value) { return " " + std::to_string(value); }

/// By name, for their numbers depend on the order of modules.
std::string names_of(const Fom& fom, DimensionSet dimensions) {
  std::vector<std::string> names;
  dimensions.for_each([&](DimensionHandle each) { names.push_back(fom.at(each).name); });
  std::ranges::sort(names);
  std::string all;
  for (const std::string& name : names) all += " " + name;
  return all;
}

/// Each class's path from the root: two classes may share a name.
template <class Class>
std::string path_of(const std::vector<Class>& classes, std::size_t index) {
  std::string path = classes[index].name;
  for (auto parent = classes[index].parent; parent; parent = classes[parent.value].parent)
    path = classes[parent.value].name + "." + path;
  return path;
}

/// An inherited member is described by the class that defines it.
template <class Class, class Members>
std::size_t inherited_count(const std::vector<Class>& classes, const Class& each, Members members) {
  return each.parent ? (classes[each.parent.value].*members).size() : 0;
}

void add_objects(const Fom& fom, std::vector<Element>& elements) {
  const auto& classes = fom.object_classes();
  for (std::uint32_t i = 0; i < classes.size() && !fom.is_management(ObjectClassHandle{i}); ++i) {
    const std::string name = "object class '" + path_of(classes, i) + "'";
    elements.push_back({name, ""});
    for (std::size_t k = inherited_count(classes, classes[i], &ObjectClass::attributes);
         k < classes[i].attributes.size(); ++k) {
      const Attribute& each = classes[i].attributes[k];
      elements.push_back({"attribute '" + each.name + "' of " + name,
                          each.data_type + number(each.size.value_or(0xffffffffu)) +
                              number(static_cast<std::uint64_t>(each.transportation)) +
                              number(static_cast<std::uint64_t>(each.order)) +
                              names_of(fom, each.dimensions) +
                              (each.codec ? std::string(each.codec->name()) : "") +
                              (each.baselines ? " baselines" : "")});
    }
  }
}

void add_interactions(const Fom& fom, std::vector<Element>& elements) {
  const auto& classes = fom.interaction_classes();
  for (std::uint32_t i = 0; i < classes.size() && !fom.is_management(InteractionClassHandle{i});
       ++i) {
    const InteractionClass& own = classes[i];
    const std::string name = "interaction class '" + path_of(classes, i) + "'";
    elements.push_back({name, number(static_cast<std::uint64_t>(own.transportation)) +
                                  number(static_cast<std::uint64_t>(own.order)) +
                                  names_of(fom, own.dimensions)});
    for (std::size_t k = inherited_count(classes, own, &InteractionClass::parameters);
         k < own.parameters.size(); ++k)
      elements.push_back(
          {"parameter '" + own.parameters[k].name + "' of " + name,
           own.parameters[k].data_type + number(own.parameters[k].size.value_or(0xffffffffu))});
  }
}

std::vector<Element> elements_of(const Fom& fom) {
  std::vector<Element> elements;
  add_objects(fom, elements);
  add_interactions(fom, elements);
  for (const Dimension& each : fom.dimensions())
    elements.push_back({"dimension '" + each.name + "'", number(each.upper_bound.value_or(0))});
  if (const std::string switches = fom.switches().text(); !switches.empty())
    elements.push_back({"the table of switches", switches});
  return elements;
}

}  // namespace

std::vector<FomDigestEntry> digest(const Fom& fom) {
  std::vector<FomDigestEntry> entries;
  for (const Element& each : elements_of(fom))
    entries.push_back({hash_of<Fnv32>(each.name), hash_of<Fnv32>(each.content)});
  return entries;
}

std::string difference(const Fom& own, std::span<const FomDigestEntry> other) {
  const std::vector<Element> elements = elements_of(own);
  std::vector<std::string> differences;
  std::size_t shared = 0;
  for (const Element& each : elements) {
    const auto found = std::ranges::find(other, hash_of<Fnv32>(each.name), &FomDigestEntry::name);
    if (found == other.end()) differences.push_back(each.name + " is unknown to the federation");
    else if (found->content != hash_of<Fnv32>(each.content))
      differences.push_back(each.name + " differs");
    shared += found != other.end();
  }
  if (shared < other.size())
    differences.push_back(std::to_string(other.size() - shared) +
                          " of the federation's elements are missing");
  if (differences.empty())
    return std::ranges::equal(digest(own), other)
               ? ""
               : "the same elements stand in another order: load the modules in the federation's";
  return differences.front() + (differences.size() > 1
                                    ? " (and " + std::to_string(differences.size() - 1) + " more)"
                                    : "");
}

}  // namespace rink::rti
