// Derives a player's rules from a scene.
#include "game/players/player.h"

#include <cassert>
#include <cmath>

namespace rink::game {

double decision_phase(std::uint32_t number) {
  constexpr double slots = 25.0;
  const double turns = 0.61803398874989484820 * static_cast<double>(number);
  const double phase = decision_period * std::floor(slots * (turns - std::floor(turns))) / slots;
  assert(phase >= 0.0 && phase < decision_period);
  return phase;
}

PlayerRules rules_of(const Scene& scene, std::uint32_t number) {
  PlayerRules rules{.field = scene.world.field,
                    .puck_drag = scene.world.puck_drag,
                    .bat_drag = scene.world.bat_drag};
  rules.puck_friction = scene.world.puck_friction;
  rules.possession_s = scene.rules.possession_s;
  if (scene.bodies.bats.empty()) return rules;
  assert(number < scene.bodies.bats.size());
  const Bat& bat = scene.bodies.bats[number];
  rules.thrust = bat.thrust;
  rules.bat_mass = bat.body.mass;
  if (scene.bodies.pucks.empty()) return rules;
  const physics::PuckSpec& puck = scene.bodies.pucks.front().body;
  rules.puck_mass = puck.mass;
  rules.restitution = scene.world.restitution(puck.material, bat.body.material);
  return rules;
}

Reach reach_of(const PlayerRules& rules, const PlayerSeat& seat) {
  const physics::Field& field = rules.field;
  Reach reach{seat.half_extent, Vector2(field.length, field.width) - seat.half_extent};
  if (field.bats_keep_to_half && seat.team == Team::left)
    reach.high.x() = field.length / 2 - seat.half_extent.x();
  if (field.bats_keep_to_half && seat.team == Team::right)
    reach.low.x() = field.length / 2 + seat.half_extent.x();
  return reach;
}

}  // namespace rink::game
