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
  std::string address{};   ///< host name or IP address; empty: none is given
  std::uint16_t port = 0;  ///< 1 to 65535; 0 where there is no address
};

/// A TOML file with `federation`, `fom` (one path, or a list of modules in the order in which they
/// merge), and either `address` and `port`, whose nodes are discovered as they join, or a list of
/// `[[node]]`: the first, with `name`, `address`, `port`, is where the RTI is; the others, each
/// with the `name` of its federate and perhaps an `address` and a `port`, are all the federates
/// that may join.
struct FederationFile {
  std::string federation;
  std::vector<std::string> fom;  ///< paths of its modules, never empty; relative ones resolved from
                                 ///< the federation file's folder
  std::vector<Node> nodes;       ///< never empty; the first is the RTI's
  bool is_listed = false;        ///< the nodes are listed in the file

  /// The names of the federates that the list lets in, in its order; empty if nodes are discovered.
  std::vector<std::string> members() const;
};

/// Throws `FileError` that names file, line, key and what is allowed.
FederationFile load_federation_file(const std::string& path);
/// The same from text; `source` stands for the file's name in errors and for its folder.
FederationFile parse_federation_file(std::string_view toml, const std::string& source);

}  // namespace rink::rti
