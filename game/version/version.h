// The version, commit and compiler flags of the program, for every command.
#pragma once

#include <string>

namespace rink::game {

/// The commit that was built, abbreviated, followed by `+changes` if tracked files had been changed
/// since; "unknown" if built without git.
const char* built_commit();
/// The version that the top CMakeLists.txt gives, such as "0.2.0".
const char* built_version();
/// The options that the compiler was given beyond the warnings.
const char* built_flags();

/// What `command --version` prints, such as "rink-serve 0.2.0 (commit 0123456789ab)".
std::string version_line(const std::string& command);

}  // namespace rink::game
