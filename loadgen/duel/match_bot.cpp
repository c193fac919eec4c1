// Looks at the sight every decision_period.
#include "loadgen/duel/match_bot.h"

#include "game/players/attention.h"
#include "game/players/player_kinds.h"

namespace rink::loadgen {

std::vector<game::SeenEntity> nearest_pucks(const game::MatchSight& sight,
                                            const game::Vector2& from, std::size_t most) {
  std::vector<game::SeenEntity> pucks;
  for (const game::Thing& thing : sight.things)
    if (thing.kind == physics::BodyKind::puck)
      pucks.push_back({.id = thing.id,
                       .kind = thing.kind,
                       .position = thing.position,
                       .velocity = thing.velocity,
                       .half_extent = thing.half_extent});
  return game::nearest_of(pucks, from, most);
}

void MatchBot::act(game::NetworkMatch& match, double now_s) {
  if (kind_ == pointer) {
    const bool plays = match.sight().phase == game::MatchPhase::playing;
    return match.reach(0, plays ? hand_.place(match.sight(), now_s) : std::nullopt);
  }
  if (now_s < next_s_ || match.sight().phase != game::MatchPhase::playing ||
      match.scene() == nullptr || !match.player())
    return;
  next_s_ = now_s + game::decision_period;
  if (!player_) {
    const std::uint32_t number = *match.player();
    const game::Bat& bat = match.scene()->bodies.bats[number];
    player_ = game::make_player(
        kind_, game::rules_of(*match.scene(), number),
        {.number = number, .team = bat.team, .half_extent = bat.body.half_extent}, seed_);
  }
  decide(match);
}

void MatchBot::decide(game::NetworkMatch& match) {
  const game::MatchSight& sight = match.sight();
  const game::Thing* own = nullptr;
  for (const game::Thing& thing : sight.things)
    if (thing.kind == physics::BodyKind::bat && thing.team == sight.own_team) own = &thing;
  if (own == nullptr) return;
  const std::vector<game::SeenEntity> pucks =
      nearest_pucks(sight, own->position, player_->pucks_wanted());
  const game::KeysHeld wanted = player_->decide(
      {.position = own->position, .velocity = own->velocity, .pucks = pucks}, sight.time);
  for (const game::Key key : game::all_keys)
    if (wanted.is_down(key) != held_.is_down(key)) match.press(0, key, wanted.is_down(key));
  held_ = wanted;
}

}  // namespace rink::loadgen
