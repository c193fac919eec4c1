// A recorded match that was not played to its end, from where it can go on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log.h"

namespace rink::game {

struct BegunMatch {
  Game game;                       ///< at the record's end, where nobody holds a key or pushes
  std::vector<InputEvent> events;  ///< all that led there, for the record of the whole
};

/// Plays `log` in `scene`. Throws SceneError, which names `file`, if it is not complete, was
/// recorded in another scene, plays otherwise than it was recorded, or its match is over.
BegunMatch begun_match(const KeyLog& log, const Scene& scene, const std::string& file);

/// The record that was written last in the folder of MatchRecords, and not before `since`.
std::optional<std::filesystem::path> newest_record(
    const std::filesystem::path& folder,
    std::filesystem::file_time_type since = std::filesystem::file_time_type::min());

}  // namespace rink::game
