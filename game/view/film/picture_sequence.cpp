// Every picture is of an instant that follows from its number, so the same record gives the same
// pictures.
#include "game/view/film/picture_sequence.h"

#include <cassert>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "game/match/replay_match.h"
#include "game/net/interrupt.h"
#include "game/view/feel/impact_effects.h"
#include "game/view/render/image_file.h"

namespace rink::view {
namespace {

std::filesystem::path picture_file(const std::string& folder, std::size_t number) {
  char name[40];
  std::snprintf(name, sizeof name, "frame-%06zu.png", number);
  return std::filesystem::path(folder) / name;
}

}  // namespace

void require_film_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw std::runtime_error(folder + ": this folder for pictures cannot be made: " +
                             (error ? error.message() : "it is a file"));
  const bool has_content = !std::filesystem::is_empty(folder, error);
  if (error) throw std::runtime_error(folder + ": cannot be read: " + error.message());
  if (has_content)
    throw std::runtime_error(folder +
                             ": has content already; pictures go into a new or empty folder");
}

std::size_t write_pictures(const FilmSettings& settings) {
  assert(settings.frames_per_s > 0.0 && settings.frames_per_s <= film_frames_per_s_max);
  game::ReplayMatch match(settings.record);
  require_film_folder(settings.folder);
  Interface interface;
  Renderer renderer;
  const Target target(settings.size.width, settings.size.height, 0);
  const Canvas canvas{target.framebuffer(), 0, 0, settings.size.width, settings.size.height};
  const double aspect = static_cast<double>(settings.size.width) / settings.size.height;
  ImpactEffects effects;
  std::size_t count = 0;
  for (bool is_over = false; !is_over && !game::is_interrupted;) {
    const double now_s = static_cast<double>(count) / settings.frames_per_s;
    match.advance(now_s);
    is_over = match.sight().phase == Phase::over;
    Picture picture = picture_of(match.sight(), {}, settings.view, aspect);
    if (!match.sight().winner) picture.dimming = 0.0f;  // it only breaks off
    if (settings.view.has_effects) {
      effects.look(match.sight(), now_s);
      effects.add_to(picture);
    }
    do {
      interface.begin(settings.size, 0.0);
      renderer.draw(picture, canvas);
      interface.draw(picture);
      interface.finish(canvas, true);
    } while (!renderer.is_settled());
    try {
      write_png(picture_file(settings.folder, count + 1).string(),
                read_pixels(target.framebuffer(), settings.size.width, settings.size.height));
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string(error.what()) + "; " + std::to_string(count) +
                               " pictures were written before");
    }
    ++count;
  }
  return count;
}

}  // namespace rink::view
