// What a machine says about itself in its files, as far as figures depend on it.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace rink::loadgen {

/// Each reads files below `root`, which is / but in tests; what they do not say is "unknown".

/// How the first processor chooses its frequency, such as "performance"; "none" where nothing does.
std::string governor(const std::filesystem::path& root);
/// "none seen", or what hosts the machine: "virtual machine", "container", both, with the vendor's
/// name for it.
std::string virtualisation(const std::filesystem::path& root);
/// The mean number of runnable processes over the last 1, 5 and 15 minutes.
std::string load(const std::filesystem::path& root);
/// Versions of those of the Debian packages `names` that are installed, "name version" by commas.
std::string packages(const std::filesystem::path& root, std::span<const char* const> names);

}  // namespace rink::loadgen
