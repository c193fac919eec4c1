// Places of elements, and the comparison of definitions that several modules give.
#include "rti/fom/fom_modules.h"

#include <algorithm>
#include <optional>
#include <sstream>

namespace rink::rti {

namespace {

using Node = pugi::xml_node;

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
std::vector<Node> parts_of(const Node& node) {
  std::vector<Node> parts;
  for (const Node& child : node.children())
    if (child.type() == pugi::node_element && std::string_view(child.name()) != "semantics")
      parts.push_back(child);
  return parts;
}

/// The first part of `b` that differs from that of `a`; `b` itself if it has fewer or other parts.
std::optional<Node> difference(const Node& a, const Node& b) {
  const std::vector<Node> in_a = parts_of(a), in_b = parts_of(b);
  if (in_a.empty() && in_b.empty())
    return words_of(a.text().get()) == words_of(b.text().get()) ? std::nullopt : std::optional(b);
  for (std::size_t i = 0; i < std::min(in_a.size(), in_b.size()); ++i) {
    if (std::string_view(in_a[i].name()) != in_b[i].name()) return b;
    if (const auto found = difference(in_a[i], in_b[i])) return found;
  }
  return in_a.size() == in_b.size() ? std::nullopt : std::optional(b);
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
      fail(module, result.offset, std::string("no well-formed XML: ") + result.description());
    const Node model = models_.emplace_back(document.document_element());
    if (std::string_view(model.name()) != "objectModel")
      fail(model,
           "the outermost element must be <objectModel>, not <" + std::string(model.name()) + ">");
  }
}

const FomModule& FomModules::module_of(const Node& node) const {
  for (std::size_t i = 0; i < documents_.size(); ++i)
    if (node.root() == documents_[i].root()) return modules_[i];
  return modules_.front();
}

std::string FomModules::place(const Node& node) const {
  const FomModule& module = module_of(node);
  return module.source + ":" + std::to_string(line_of(module.xml, node.offset_debug()));
}

void FomModules::fail(const FomModule& module, std::ptrdiff_t offset, const std::string& what) {
  throw FileError(module.source + ":" + std::to_string(line_of(module.xml, offset)) + ": " + what,
                  HlaError::error_reading_fdd);
}

void FomModules::fail(const Node& node, const std::string& what) const {
  fail(module_of(node), node.offset_debug(), what);
}

void FomModules::conflict(const Node& here, const std::string& what, const Node& there) const {
  throw FileError(place(here) + ": " + to_string(HlaError::inconsistent_fdd) + ": " + what +
                      " at " + place(there),
                  HlaError::inconsistent_fdd);
}

std::string FomModules::path(const Node& node) {
  const char* name = node.child("name").text().get();
  return "<" + std::string(node.name()) + ">" +
         (*name != 0 ? " '" + std::string(name) + "'" : std::string());
}

std::string FomModules::text(const Node& node, const char* child) const {
  const Node found = node.child(child);
  std::istringstream words(found.text().get());
  std::string word, rest;
  if (!found) fail(node, path(node) + " lacks <" + child + ">");
  if (!(words >> word) || words >> rest)
    fail(found, std::string("<") + child + "> of " + path(node) + " must hold one word, not '" +
                    found.text().get() + "'");
  return word;
}

std::vector<FomModules::Group> FomModules::groups(std::span<const Node> parents,
                                                  const char* element) const {
  std::vector<Group> all;
  for (const Node& parent : parents)
    for (const Node& node : parent.children(element)) {
      const std::string name = text(node, "name");
      auto found = std::ranges::find(all, name, &Group::name);
      if (found == all.end()) found = all.insert(all.end(), {name, {}});
      else if (found->nodes.back().parent() == parent)
        fail(node, path(node) + " is declared twice");
      found->nodes.push_back(node);
    }
  return all;
}

std::vector<FomModules::Node> FomModules::sections(const char* element) const {
  std::vector<Node> all;
  for (const Node& model : models_)
    if (const Node found = model.child(element)) all.push_back(found);
  return all;
}

void FomModules::require_same(const Node& first, const Node& second, const std::string& of) const {
  const auto found = difference(first, second);
  if (!found) return;
  const std::string in = *found == second ? "" : " in <" + std::string(found->name()) + ">";
  conflict(*found, path(second) + of + " differs" + in + " from its definition", first);
}

void FomModules::require_same_child(const Node& first, const Node& second,
                                    const char* child) const {
  const Node a = first.child(child), b = second.child(child);
  if (a && b ? !difference(a, b) : !a && !b) return;
  conflict(b ? b : second, path(second) + " differs in <" + child + "> from its definition", first);
}

void FomModules::require_unreserved(const Group& group) const {
  if (!is_reserved(group.name) ||
      std::ranges::any_of(group.nodes, [this](const Node& node) { return is_standard(node); }))
    return;
  fail(group.nodes.front(),
       path(group.nodes.front()) + ": names that begin with HLA are the standard's");
}

}  // namespace rink::rti
