// A recorded match as numbered pictures, of which other programs make a film.
#pragma once

#include <cstddef>
#include <string>

#include "game/view/interface.h"
#include "game/view/picture_of.h"
#include "game/view/render/offscreen.h"
#include "game/view/render/renderer.h"

namespace rink::view {

struct FilmSettings {
  std::string record;          ///< of the match
  std::string folder;          ///< new, or empty
  double frames_per_s = 60.0;  ///< of simulated time
  WindowSize size;             ///< pixels
  ViewChoice view;
};

inline constexpr double film_frames_per_s_max = 1000.0;

/// Throws std::runtime_error, which names the folder, if it has content or cannot be made.
void require_film_folder(const std::string& folder);

/// Draws the match from its beginning to its end, or to shortly after it was won, into
/// frame-000001.png and so on. Returns how many there are. Throws std::runtime_error that names the
/// picture which cannot be written, and says how many were; game::SceneError for a bad record. A
/// context of OpenGL must be current.
std::size_t write_pictures(const FilmSettings& settings);

}  // namespace rink::view
