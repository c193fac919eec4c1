// The federation file: which federation, which object model, and where its nodes are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rti/fom/fom.h"

namespace rink::rti {

struct Node {
  std::string name;
  std::string address;      ///< host name or IP address
  std::uint16_t port = 0;   ///< 1 to 65535
};

/// A TOML file with `federation`, `fom` (one path, or a list of modules in the order in which they merge), and either `address` and `port` or a list of
/// `[[node]]`, each with `name`, `address`, `port`.
struct FederationFile {
  std::string federation;
  std::vector<std::string> fom;  ///< paths of its modules, never empty; relative ones resolved from the federation file's folder
  std::vector<Node> nodes;   ///< never empty; the first is the one to ask
};

/// Throws `FileError` that names file, line, key and what is allowed.
FederationFile load_federation_file(const std::string& path);
/// The same from text; `source` stands for the file's name in errors and for its folder.
FederationFile parse_federation_file(std::string_view toml, const std::string& source);

}  // namespace rink::rti
