// What can be asked of any engine through its interface alone.
#include "game/physics/simulator.h"

namespace rink::physics::inline RINK_PRECISION {

std::uint32_t escape_count(const Simulator& simulator) {
  const Field& field = simulator.spec().field;
  std::uint32_t count = 0;
  for (BodyId body; body.index < simulator.body_count(); ++body.index) {
    if (!simulator.is_in_play(body)) continue;
    const Vector2 position = simulator.position(body);
    const bool is_inside = position.x() >= 0.0 && position.x() <= field.length &&
                           position.y() >= 0.0 && position.y() <= field.width;
    if (!is_inside) ++count;  // also where a coordinate is not a number
  }
  return count;
}

}  // namespace rink::physics::inline RINK_PRECISION
