// Facts about the machine, from its files, on which figures depend.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace rink::loadgen {

/// Each reads files below `root`, which is / but in tests; missing facts are "unknown".

/// The first processor's frequency governor, such as "performance"; "none" if there is none.
std::string governor(const std::filesystem::path& root);
/// "none seen", or the kind of host: "virtual machine", "container", both, with the vendor's name.
std::string virtualisation(const std::filesystem::path& root);
/// The mean number of runnable processes over the last 1, 5 and 15 minutes.
std::string load(const std::filesystem::path& root);
/// Versions of those of the Debian packages `names` that are installed, "name version" by commas.
std::string packages(const std::filesystem::path& root, std::span<const char* const> names);

}  // namespace rink::loadgen
