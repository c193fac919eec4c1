// Keeps places of the nearest, and copies these at the end.
#include "game/players/attention.h"

namespace rink::game {

std::vector<SeenEntity> nearest_of(std::span<const SeenEntity> seen, const Vector2& from,
                                   std::size_t most) {
  Nearest<const SeenEntity*> nearest;
  nearest.clear(most);
  for (const SeenEntity& each : seen) nearest.show(&each, (each.position - from).squaredNorm());
  std::vector<SeenEntity> chosen;
  for (const auto& found : nearest.found()) chosen.push_back(*found.thing);
  return chosen;
}

}  // namespace rink::game
