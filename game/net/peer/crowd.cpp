// Turns observations into the bots' keys.
#include "game/net/peer/crowd.h"

#include <algorithm>
#include <cassert>

#include "game/players/player_kinds.h"
#include "game/players/random_plan.h"

namespace rink::game {

/// 0 is nothing.
std::uint8_t input_of(const InputEvent& event) {
  return static_cast<std::uint8_t>(1 + 2 * static_cast<unsigned>(event.key) +
                                   (event.kind == InputKind::key_down ? 1 : 0));
}

InputEvent event_of(std::uint8_t input, double time, std::uint32_t player) {
  const unsigned number = (input - 1u) % 8;
  return {time, player, number % 2 == 1 ? InputKind::key_down : InputKind::key_up,
          static_cast<Key>(number / 2)};
}

Crowd::Crowd(const Scene& scene, const Game& start, const Settings& settings) {
  const auto& [kinds, seed, first, count, from, until] = settings;
  assert(count == 0 || !kinds.empty());
  for (std::uint32_t number = first; number < first + count; ++number) {
    const Bat& bat = scene.bodies.bats[number];
    Bot bot{.bat = start.bat(number)->index,
            .controller = BatController(bat.thrust),
            .player = nullptr,
            .plan = {}};
    const std::string& kind = kinds[number % kinds.size()];
    const PlayerSeat seat{.number = number, .team = bat.team, .half_extent = bat.body.half_extent};
    if (kind == "random") bot.plan = random_player_plan(seed, number, until);
    else bot.player = make_player(kind, rules_of(scene, number), seat, seed);
    while (bot.next < bot.plan.size() && bot.plan[bot.next].time < from) ++bot.next;
    bots_.push_back(std::move(bot));
  }
}

std::uint32_t Crowd::pucks_wanted(const Scene& scene, const std::vector<std::string>& kinds) {
  std::uint32_t wanted = 0;
  for (const std::string& kind : kinds)
    if (kind != "random" && !scene.bodies.bats.empty())
      wanted = std::max(wanted, make_player(kind, rules_of(scene, 0), {}, 1)->pucks_wanted());
  return wanted;
}

void Crowd::act(peer::Session& session) {
  for (const peer::Observation& observation : session.peer().observations()) {
    const auto bot = std::find_if(bots_.begin(), bots_.end(),
                                  [&](const Bot& one) { return one.bat == observation.bat; });
    if (bot == bots_.end() || observation.time <= bot->decided) continue;
    bot->decided = observation.time;
    decide(session, *bot, observation);
  }
}

void Crowd::decide(peer::Session& session, Bot& bot, const peer::Observation& observation) {
  if (!bot.player) {
    for (; bot.next < bot.plan.size() && bot.plan[bot.next].time <= observation.time; ++bot.next)
      press(session, bot, observation, bot.plan[bot.next].key,
            bot.plan[bot.next].kind == InputKind::key_down);
    return;
  }
  seen_.clear();
  const std::size_t count =
      std::min<std::size_t>(observation.pucks.size(), bot.player->pucks_wanted());
  for (const peer::Observation::Puck& puck : std::span(observation.pucks).first(count))
    seen_.push_back({.id = puck.number,
                     .kind = physics::BodyKind::puck,
                     .position = puck.position,
                     .velocity = puck.velocity,
                     .half_extent = Vector2::Constant(puck.radius)});
  const KeysHeld wanted = bot.player->decide(
      {.position = observation.position, .velocity = observation.velocity, .pucks = seen_},
      observation.time);
  for (const Key key : all_keys)
    if (wanted.is_down(key) != bot.controller.keys().is_down(key))
      press(session, bot, observation, key, wanted.is_down(key));
}

void Crowd::press(peer::Session& session, Bot& bot, const peer::Observation& observation, Key key,
                  bool is_down) {
  bot.controller.press(key, is_down);
  const InputEvent event{0.0, 0, is_down ? InputKind::key_down : InputKind::key_up, key};
  session.press(observation, {bot.bat, bot.controller.thrust(), input_of(event)});
  ++presses_;
}

}  // namespace rink::game
