// The one list of all kinds of players; a new kind is one file and one line here.
#include "game/players/player.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/players/chaser.h"
#include "game/players/gathering.h"
#include "game/players/hotspot.h"
#include "game/players/waypoint.h"

namespace rink::game {
namespace {

using Make = std::unique_ptr<Player> (*)(const PlayerRules&, const PlayerSeat&, std::uint64_t);

struct Kind {
  const char* name;
  Make make;
};

template <class Made>
std::unique_ptr<Player> made(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed) {
  return std::make_unique<Made>(rules, seat, seed);
}

template <const Skill& skill>
std::unique_ptr<Player> chaser(const PlayerRules& rules, const PlayerSeat& seat,
                               std::uint64_t seed) {
  return std::make_unique<Chaser>(rules, seat, seed, skill);
}

constexpr Kind kinds[] = {{"chaser", chaser<club_skill>},
                          {"chaser-beginner", chaser<beginner_skill>},
                          {"chaser-expert", chaser<expert_skill>},
                          {"waypoint", made<Waypoint>},
                          {"hotspot", made<Hotspot>},
                          {"gathering", made<Gathering>}};

}  // namespace

double decision_phase(std::uint32_t number) {
  constexpr double slots = 25.0;
  const double turns = 0.61803398874989484820 * static_cast<double>(number);
  return decision_period * std::floor(slots * (turns - std::floor(turns))) / slots;
}

PlayerRules rules_of(const Scene& scene, std::uint32_t number) {
  PlayerRules rules{.field = scene.world.field,
                    .puck_drag = scene.world.puck_drag,
                    .bat_drag = scene.world.bat_drag};
  rules.puck_friction = scene.world.puck_friction;
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

const std::vector<std::string>& player_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Kind& kind : kinds) all.push_back(kind.name);
    return all;
  }();
  return names;
}

bool is_player_kind(std::string_view name) {
  return name == "random" || std::ranges::find(player_kinds(), name) != player_kinds().end();
}

std::unique_ptr<Player> make_player(std::string_view kind, const PlayerRules& rules,
                                    const PlayerSeat& seat, std::uint64_t seed) {
  const auto found =
      std::ranges::find_if(kinds, [&](const Kind& other) { return other.name == kind; });
  assert(found != std::end(kinds));
  return found->make(rules, seat, seed);
}

}  // namespace rink::game
