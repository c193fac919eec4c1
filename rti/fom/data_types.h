// The data types that the modules of a model declare, and the size of each.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rti/fom/fom_modules.h"

namespace rink::rti {

/// Basic, simple, enumerated, array, fixed and variant record types of IEEE 1516.2, beside the
/// standard's own. Every member throws `FileError` at what is wrong.
class DataTypes {
 public:
  using Node = pugi::xml_node;
  using Size = std::optional<std::uint32_t>;  ///< [bytes]; nothing: it varies

  /// The modules must outlive it.
  explicit DataTypes(FomModules& modules) : modules_(modules) {}
  void read();
  /// Of a declared type or one of the standard's; `user` is the element that names it.
  Size size_of(const std::string& type, const Node& user);
  /// Bytes that lie before each field of a fixed record, beside the fields before it: those of the
  /// encoding HLAfixedRecord, none in an encoding of the model's own. The record has a fixed size.
  std::vector<std::uint32_t> padding_of(const Node& record);
  /// Those that nothing uses too: another module may.
  void check();
  const std::map<std::string, Node>& declared() const { return declared_; }

 private:
  [[noreturn]] void fail(const Node& node, const std::string& what) const {
    modules_.fail(node, what);
  }
  static std::string path(const Node& node) { return FomModules::path(node); }
  std::string text(const Node& node, const char* child) const { return modules_.text(node, child); }
  void declare(const Node& node);
  void check_variants(const Node& node);
  std::vector<std::string> enumerators_of(const std::string& type) const;
  std::optional<std::uint64_t> cardinality_of(const Node& node) const;
  Size size_of_array(const Node& node);
  Size size_of_record(const Node& node);
  std::uint32_t boundary_of(const std::string& type, const Node& user);

  FomModules& modules_;
  std::map<std::string, Node> declared_;
  std::map<std::string, Size> sizes_;
  std::set<std::string> being_sized_;
};

}  // namespace rink::rti
