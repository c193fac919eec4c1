// A recorded game played again from its key log alone, to the hash in which it ended.
#pragma once

#include <cstdint>
#include <string>

#include "game/control/key_log.h"

namespace rink::game {

/// Throws SceneError, naming `file` and all that is missing, unless the log tells how far the game was played, in which hash it ended, and has its last line.
void require_complete(const KeyLog& log, const std::string& file);

/// The scene that was played: from the log's own text, or by its name if it has none; with the log's seed and number of bats. Throws SceneError, naming `file`, if there is
/// no such scene, or it is another than the one that was recorded.
Scene recorded_scene(const KeyLog& log, const std::string& file);

/// The hash of the game at the end of a complete log (asserted), played in `scene`.
std::uint64_t replay(const KeyLog& log, const Scene& scene);

}  // namespace rink::game
