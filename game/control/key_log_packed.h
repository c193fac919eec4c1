// Key logs in few bytes, the form in which matches are recorded.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "game/control/key_log.h"

namespace rink::game {

/// The first line of a packed key log, without its end, and of one that has pushes.
inline constexpr const char *packed_version_line = "rink-keys 2",
                            *packed_push_version_line = "rink-keys 4";

/// Three to four bytes for each key that was pressed on key_grid or at whole milliseconds, eleven
/// for any other, and two more for a push (docs/play.md, "Recorded matches"). Seals the log,
/// whatever `is_sealed` says.
void write_packed_key_log(std::ostream& stream, const KeyLog& log);
/// Throws SceneError if the file cannot be written; then no file is left.
void write_packed_key_log(const std::filesystem::path& file, const KeyLog& log);

/// Reads what follows the first line. Throws SceneError naming the file, `name`, and its fault: cut
/// off, altered, or longer than stated. `may_push`: by the first line it may have pushes.
/// read_key_log() reads all forms.
KeyLog read_packed_key_log(std::istream& stream, const std::string& name, bool may_push);

}  // namespace rink::game
