// The XML of one or several FOM modules: where each element stands, and how modules merge (IEEE
// 1516.2-2010, "FOM module merging").
#pragma once

#include <deque>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <vector>

#include "rti/fom/fom_module.h"

namespace rink::rti {

/// Definitions may be repeated if they agree, semantics aside; a class may be named without content
/// to define subclasses of it (scaffolding). All else is a conflict, an InconsistentFDD that names
/// both places. An error names file, line, element and the clause of IEEE 1516.2-2010 that it
/// breaks.
///
/// A module that defines the management classes (HLAmanager with HLAfederate) is taken for the
/// standard's management and initialization module. Those classes, its dimensions and what it says
/// about the root of interactions stand behind every model anyhow, and are left out here.
class FomModules {
 public:
  using Node = pugi::xml_node;
  /// Elements of one name in the modules that have it, in their order.
  struct Group {
    std::string name;
    std::vector<Node> nodes;
  };

  /// Throws `FileError` unless each is well-formed XML whose outermost element is <objectModel>.
  /// The texts must outlive it.
  explicit FomModules(std::span<const FomModule> modules);

  const std::vector<Node>& models() const { return models_; }
  std::string place(const Node& node) const;  ///< "harbour.xml:12"
  [[noreturn]] void fail(const Node& node, const std::string& what) const;
  /// Notes what is understood otherwise than it is meant.
  void warn(const Node& node, const std::string& what);
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// "<attribute> 'speed'"
  static std::string path(const Node& node);
  /// The one word that the child holds; throws if it is missing or holds anything else.
  std::string text(const Node& node, const char* child) const;
  std::string text_or(const Node& node, const char* child, const char* otherwise) const {
    return node.child(child) ? text(node, child) : otherwise;
  }
  /// All children `element` of the parents, by name, in the order of their first appearance. Throws
  /// if one parent has two of a name, which `where` may say more of.
  std::vector<Group> groups(std::span<const Node> parents, const char* element,
                            const std::string& where = "") const;
  /// The children of that name in each model.
  std::vector<Node> sections(const char* element) const;
  /// Throws InconsistentFDD unless both agree; `of` follows the element's name, as " of class
  /// 'Vessel'".
  void require_same(const Node& first, const Node& second, const std::string& of) const;
  /// Compares one child, which either may lack.
  void require_same_child(const Node& first, const Node& second, const char* child) const;
  [[noreturn]] void conflict(const Node& here, const std::string& what, const Node& there) const;
  /// Throws if a module that is not the standard's defines a name of the standard's: those that
  /// begin with HLA in any case.
  void require_unreserved(const Group& group) const;
  bool is_standard(const Node& node) const { return is_standard_[index_of(node)]; }
  /// True in a module of IEEE 1516.2-2025, where modules may add members to a class of another.
  bool may_extend(const Node& node) const;

 private:
  std::size_t index_of(const Node& node) const;
  void take_for_standard(pugi::xml_node model);
  [[noreturn]] static void fail(const FomModule& module, std::ptrdiff_t offset,
                                const std::string& what);

  std::span<const FomModule> modules_;
  std::deque<pugi::xml_document> documents_;
  std::vector<Node> models_;
  std::vector<bool> is_standard_;  ///< by module
  std::vector<std::string> warnings_;
};

}  // namespace rink::rti
