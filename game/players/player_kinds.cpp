// The one list of all kinds of players; a new kind is one file and one line here.
#include "game/players/player_kinds.h"

#include <algorithm>
#include <cassert>
#include <iterator>

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

const std::vector<std::string>& player_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Kind& kind : kinds) all.emplace_back(kind.name);
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
