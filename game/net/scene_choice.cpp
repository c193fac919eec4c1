// Changes a scene in this order: scaled, then counted, then seeded.
#include "game/net/scene_choice.h"

#include <utility>

#include "game/model/scene_file.h"

namespace rink::game {

Scene chosen_scene(const SceneChoice& choice) {
  Scene scene = load_scene(choice.scene);
  if (choice.bats > 0) scene = scaled_to_bats(std::move(scene), choice.bats);
  if (choice.bat_count > 0)
    scene = with_count(std::move(scene), physics::BodyKind::bat, choice.bat_count);
  if (choice.puck_count > 0)
    scene = with_count(std::move(scene), physics::BodyKind::puck, choice.puck_count);
  if (choice.seed > 0) scene = with_seed(std::move(scene), choice.seed);
  return scene;
}

}  // namespace rink::game
