// Key logs as files: reads text and packed ones, and writes text.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "game/control/key_log.h"

namespace rink::game {

/// Seals the log, whatever `is_sealed` says.
void write_key_log(std::ostream& stream, const KeyLog& log);
/// Throws SceneError if the file cannot be written.
void write_key_log(const std::filesystem::path& file, const KeyLog& log);

/// Reads text and packed logs. Throws SceneError naming file, line, the text there and what was
/// expected.
KeyLog read_key_log(const std::filesystem::path& file);
/// As above; `name` is named in errors.
KeyLog read_key_log(std::istream& stream, const std::string& name);

}  // namespace rink::game
