// Places of elements, and the comparison of definitions that several modules give.
#include "rti/fom/fom_modules.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>

namespace rink::rti {

namespace {

using XmlNode = pugi::xml_node;

std::size_t line_of(std::string_view text, std::ptrdiff_t offset) {
  const auto end = text.begin() +
                   std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

/// The words of a text, one space between them.
std::string words_of(const char* text) {
  std::istringstream words(text);
  std::string word, all;
  while (words >> word) all += (all.empty() ? "" : " ") + word;
  return all;
}

/// The parts of a definition that are compared; semantics for readers are not.
std::vector<XmlNode> parts_of(const XmlNode& node) {
  std::vector<XmlNode> parts;
  for (const XmlNode& child : node.children())
    if (child.type() == pugi::node_element && std::string_view(child.name()) != "semantics")
      parts.push_back(child);
  return parts;
}

/// The first part of `b` that differs from that of `a`; `b` itself if it has fewer or other parts.
std::optional<XmlNode> difference(const XmlNode& a, const XmlNode& b) {
  const std::vector<XmlNode> in_a = parts_of(a), in_b = parts_of(b);
  if (in_a.empty() && in_b.empty())
    return words_of(a.text().get()) == words_of(b.text().get()) ? std::nullopt : std::optional(b);
  for (std::size_t i = 0; i < std::min(in_a.size(), in_b.size()); ++i) {
    if (std::string_view(in_a[i].name()) != in_b[i].name()) return b;
    if (const auto found = difference(in_a[i], in_b[i])) return found;
  }
  return in_a.size() == in_b.size() ? std::nullopt : std::optional(b);
}

/// The clause of IEEE 1516.2-2010 that speaks of an element.
std::string_view clause_of(XmlNode node) {
  struct Clause {
    std::string_view element, number;
  };
  constexpr std::array clauses = {
      Clause{"modelIdentification", "4.1"},
      Clause{"objectClass", "4.2"},
      Clause{"objects", "4.2"},
      Clause{"interactionClass", "4.3"},
      Clause{"interactions", "4.3"},
      Clause{"attribute", "4.4"},
      Clause{"parameter", "4.5"},
      Clause{"dimensions", "4.6"},
      Clause{"time", "4.7"},
      Clause{"tags", "4.8"},
      Clause{"synchronizations", "4.9"},
      Clause{"transportations", "4.10"},
      Clause{"updateRates", "4.11"},
      Clause{"switches", "4.12"},
      Clause{"dataTypes", "4.13"},
      Clause{"notes", "4.14"},
  };
  for (; node; node = node.parent())
    if (const auto found = std::ranges::find(clauses, node.name(), &Clause::element);
        found != clauses.end())
      return found->number;
  return "4";
}
std::string cited(std::string_view clause) {
  return " (IEEE 1516.2-2010, " + std::string(clause) + ")";
}

XmlNode named_child(const XmlNode& parent, const char* element, const char* name) {
  for (const XmlNode& child : parent.children(element))
    if (std::string_view(child.child("name").text().get()) == name) return child;
  return {};
}

/// The standard's own module defines the federate of the management object model.
bool defines_management(const XmlNode& model) {
  const XmlNode root = named_child(model.child("objects"), "objectClass", "HLAobjectRoot"),
                manager = named_child(root, "objectClass", "HLAmanager");
  return named_child(named_child(manager, "objectClass", "HLAfederate"), "attribute",
                     "HLAfederateHandle");
}

bool is_reserved(std::string_view name) {
  const auto is = [&](std::size_t i, char letter) { return (name[i] | 0x20) == letter; };
  return name.size() >= 3 && is(0, 'h') && is(1, 'l') && is(2, 'a');
}

}  // namespace

FomModules::FomModules(std::span<const FomModule> modules) : modules_(modules) {
  for (const FomModule& module : modules) {
    pugi::xml_document& document = documents_.emplace_back();
    const pugi::xml_parse_result result =
        document.load_buffer(module.xml.data(), module.xml.size());
    if (!result)
      fail(module, result.offset,
           std::string("no well-formed XML: ") + result.description() + cited("4"));
    const XmlNode model = models_.emplace_back(document.document_element());
    if (std::string_view(model.name()) != "objectModel")
      fail(model,
           "the outermost element must be <objectModel>, not <" + std::string(model.name()) + ">");
    if (model.attribute("DTDversion"))
      fail(model,
           "<objectModel> is of IEEE 1516.2-2000; expected a model of 2010, with names in "
           "elements of their own");
    // Every object has this attribute, whatever a module says of it.
    XmlNode root = named_child(model.child("objects"), "objectClass", "HLAobjectRoot");
    root.remove_child(named_child(root, "attribute", "HLAprivilegeToDeleteObject"));
    is_standard_.push_back(module.is_standard);
    if (defines_management(model)) take_for_standard(model);
  }
}

void FomModules::take_for_standard(XmlNode model) {
  is_standard_.back() = true;
  XmlNode objects = named_child(model.child("objects"), "objectClass", "HLAobjectRoot"),
          interactions =
              named_child(model.child("interactions"), "interactionClass", "HLAinteractionRoot");
  objects.remove_child(named_child(objects, "objectClass", "HLAmanager"));
  interactions.remove_child(named_child(interactions, "interactionClass", "HLAmanager"));
  XmlNode dimensions = model.child("dimensions");
  for (const char* own : {"HLAfederate", "HLAserviceGroup"})
    dimensions.remove_child(named_child(dimensions, "dimension", own));
}

std::size_t FomModules::index_of(const XmlNode& node) const {
  for (std::size_t i = 0; i < documents_.size(); ++i)
    if (node.root() == documents_[i].root()) return i;
  return 0;
}

bool FomModules::may_extend(const XmlNode& node) const {
  const std::string_view space = models_[index_of(node)].attribute("xmlns").value();
  return space.ends_with("IEEE1516-2025");
}

std::string FomModules::place(const XmlNode& node) const {
  const FomModule& module = modules_[index_of(node)];
  return module.source + ":" + std::to_string(line_of(module.xml, node.offset_debug()));
}

void FomModules::fail(const FomModule& module, std::ptrdiff_t offset, const std::string& what) {
  throw FileError(module.source + ":" + std::to_string(line_of(module.xml, offset)) + ": " + what,
                  HlaError::error_reading_fdd);
}

void FomModules::fail(const XmlNode& node, const std::string& what) const {
  fail(modules_[index_of(node)], node.offset_debug(), what + cited(clause_of(node)));
}

void FomModules::warn(const XmlNode& node, const std::string& what) {
  warnings_.push_back(place(node) + ": " + what + cited(clause_of(node)));
}

void FomModules::conflict(const XmlNode& here, const std::string& what,
                          const XmlNode& there) const {
  throw FileError(place(here) + ": " + to_string(HlaError::inconsistent_fdd) + ": " + what +
                      " at " + place(there) + cited(clause_of(here)),
                  HlaError::inconsistent_fdd);
}

std::string FomModules::path(const XmlNode& node) {
  const char* name = node.child("name").text().get();
  return "<" + std::string(node.name()) + ">" +
         (*name != 0 ? " '" + std::string(name) + "'" : std::string());
}

std::string FomModules::text(const XmlNode& node, const char* child) const {
  const XmlNode found = node.child(child);
  std::istringstream words(found.text().get());
  std::string word, rest;
  if (!found) fail(node, path(node) + " lacks <" + child + ">");
  if (!(words >> word) || words >> rest)
    fail(found, std::string("<") + child + "> of " + path(node) + " must hold one word, not '" +
                    found.text().get() + "'");
  return word;
}

std::vector<FomModules::Group> FomModules::groups(std::span<const XmlNode> parents,
                                                  const char* element,
                                                  const std::string& where) const {
  std::vector<Group> all;
  for (const XmlNode& parent : parents)
    for (const XmlNode& node : parent.children(element)) {
      const std::string name = text(node, "name");
      auto found = std::ranges::find(all, name, &Group::name);
      if (found == all.end()) found = all.insert(all.end(), {name, {}});
      else if (found->nodes.back().parent() == parent)
        fail(node, path(node) + " is declared twice" + where);
      found->nodes.push_back(node);
    }
  return all;
}

std::vector<FomModules::Node> FomModules::sections(const char* element) const {
  std::vector<XmlNode> all;
  for (const XmlNode& model : models_)
    if (const XmlNode found = model.child(element)) all.push_back(found);
  return all;
}

void FomModules::require_same(const XmlNode& first, const XmlNode& second,
                              const std::string& of) const {
  const auto found = difference(first, second);
  if (!found) return;
  const std::string in = *found == second ? "" : " in <" + std::string(found->name()) + ">";
  conflict(*found, path(second) + of + " differs" + in + " from its definition", first);
}

void FomModules::require_same_child(const XmlNode& first, const XmlNode& second,
                                    const char* child) const {
  const XmlNode a = first.child(child), b = second.child(child);
  if (a && b ? !difference(a, b) : !a && !b) return;
  conflict(b ? b : second, path(second) + " differs in <" + child + "> from its definition", first);
}

void FomModules::require_unreserved(const Group& group) const {
  if (!is_reserved(group.name) ||
      std::ranges::any_of(group.nodes, [this](const XmlNode& node) { return is_standard(node); }))
    return;
  fail(group.nodes.front(),
       path(group.nodes.front()) + ": names that begin with HLA are the standard's");
}

}  // namespace rink::rti
