// Which program took the figures.
#pragma once

namespace rink::loadgen {

/// Abbreviated, followed by `+changes` if tracked files had been changed since; "unknown" if built without git.
const char* built_commit();
const char* built_version();
/// The options that the compiler was given beyond the warnings.
const char* built_flags();

}  // namespace rink::loadgen
