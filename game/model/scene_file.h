// Scenes from TOML files (docs/scenes.md) and presets by name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "game/model/scene.h"

namespace rink::game {

/// The scene in file `scene` if that is a path (it has a directory or ends in .toml), else the
/// preset of that name: ../share/rink/scenes/NAME.toml seen from the running executable. Throws
/// SceneError naming file, line, key, value and what was expected.
Scene load_scene(const std::string& scene);

/// The text of the file that load_scene() reads. Throws SceneError if it cannot be read.
std::string scene_text(const std::string& scene);

/// The scene that `text` describes; `file` is named in errors and, without its extension, names a
/// scene that does not name itself.
Scene parse_scene(std::string_view text, const std::filesystem::path& file);

/// Names of the presets beside the running executable, in alphabetical order; empty if there is no
/// such folder.
std::vector<std::string> preset_names();

}  // namespace rink::game
