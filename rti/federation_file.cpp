// Reads the federation file; every error names file, line and key.
#include "rti/federation_file.h"

#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>

namespace rink::rti {

namespace {

/// Makes errors that name the line of what is being read.
class FederationReader {
 public:
  explicit FederationReader(const std::string& source) : source_(source) {}

  [[noreturn]] void fail(const toml::source_region& where, const std::string& what) const {
    throw FileError(source_ + ":" + std::to_string(where.begin.line) + ": " + what);
  }

  void allow(const toml::table& table, std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, value] : table) {
      if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
      std::string allowed;
      for (const std::string_view each : keys)
        allowed += (allowed.empty() ? "" : ", ") + std::string(each);
      fail(key.source(), "unknown key '" + std::string(key.str()) + "'; allowed are " + allowed);
    }
  }

  std::string word(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) fail(table.source(), "key '" + std::string(key) + "' is missing");
    const auto value = node->value_exact<std::string>();
    if (!value || value->empty())
      fail(node->source(), "key '" + std::string(key) + "' must be a text that is not empty");
    return *value;
  }

  /// The node of the RTI needs an address; the others may have one.
  Node node(const toml::table& table, const std::string& name, bool is_asked) const {
    if (!is_asked && !table.contains("address") && !table.contains("port")) return {name};
    const toml::node* port = table.get("port");
    if (port == nullptr) fail(table.source(), "key 'port' is missing");
    const auto value = port->value_exact<std::int64_t>();
    if (!value || *value < 1 || *value > 65535)
      fail(port->source(), "key 'port' must be a whole number from 1 to 65535");
    return {name, word(table, "address"), static_cast<std::uint16_t>(*value)};
  }

  std::vector<Node> nodes(const toml::node& list) const {
    const toml::array* array = list.as_array();
    if (array == nullptr || array->empty())
      fail(list.source(), "key 'node' must be a list of tables: [[node]]");
    std::vector<Node> nodes;
    for (const toml::node& each : *array) {
      const toml::table* table = each.as_table();
      if (table == nullptr) fail(each.source(), "key 'node' must be a list of tables: [[node]]");
      allow(*table, {"name", "address", "port"});
      nodes.push_back(node(*table, word(*table, "name"), nodes.empty()));
      if (nodes.back().name.size() > 255)
        fail(table->get("name")->source(), "key 'name' must be at most 255 bytes long");
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
        if (nodes[i].name == nodes.back().name)
          fail(table->source(), "key 'name': two nodes are called '" + nodes[i].name + "'");
    }
    if (nodes.size() == 1)
      fail(list.source(),
           "key 'node' lists the RTI's node alone; list those that join it, too, or give 'address' "
           "and 'port' instead and let anybody join");
    return nodes;
  }

  std::vector<std::string> modules(const toml::table& table) const {
    const toml::node* list = table.get("fom");
    if (list == nullptr || !list->is_array()) return {resolved(word(table, "fom"))};
    std::vector<std::string> paths;
    for (const toml::node& each : *list->as_array()) {
      const auto path = each.value_exact<std::string>();
      if (!path || path->empty())
        fail(each.source(), "key 'fom' must be a text that is not empty, or a list of such");
      paths.push_back(resolved(*path));
      if (std::count(paths.begin(), paths.end(), paths.back()) > 1)
        fail(each.source(), "key 'fom' names '" + *path + "' twice");
    }
    if (paths.empty()) fail(list->source(), "key 'fom' must name at least one module");
    return paths;
  }

  std::string resolved(const std::filesystem::path& path) const {
    return path.is_absolute() ? path.string()
                              : (std::filesystem::path(source_).parent_path() / path).string();
  }

  FederationFile file(const toml::table& table) const {
    allow(table, {"federation", "fom", "address", "port", "node"});
    FederationFile file;
    file.federation = word(table, "federation");
    if (file.federation.size() > 255)
      fail(table.get("federation")->source(), "key 'federation' must be at most 255 bytes long");
    file.fom = modules(table);
    const toml::node* list = table.get("node");
    if (list != nullptr && table.contains("address"))
      fail(table.get("address")->source(),
           "key 'address' and a list of [[node]] exclude each other");
    if (list != nullptr && table.contains("port"))
      fail(table.get("port")->source(), "key 'port' and a list of [[node]] exclude each other");
    file.nodes = list != nullptr ? nodes(*list) : std::vector{node(table, "rti", true)};
    file.is_listed = list != nullptr;
    return file;
  }

 private:
  std::string source_;
};

}  // namespace

std::vector<std::string> FederationFile::members() const {
  std::vector<std::string> names;
  if (is_listed)
    for (const Node& each : nodes) names.push_back(each.name);
  if (!names.empty()) names.erase(names.begin());
  return names;
}

FederationFile parse_federation_file(std::string_view toml, const std::string& source) {
  const FederationReader reader(source);
  try {
    return reader.file(toml::parse(toml, source));
  } catch (const toml::parse_error& error) {
    reader.fail(error.source(),
                std::string("no well-formed TOML: ") + std::string(error.description()));
  }
}

FederationFile load_federation_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw FileError(path + ": can't be read; expected a federation file in TOML");
  return parse_federation_file(text.str(), path);
}

}  // namespace rink::rti
