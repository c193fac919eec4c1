// Plays what was shown into the bots' eyes.
#include "game/node/match/match_bots.h"

#include <algorithm>
#include <utility>

#include "game/net/peer/network/session_error.h"
#include "game/net/peer/network/unguessable_number.h"
#include "game/players/attention.h"
#include "game/players/player_kinds.h"
#include "game/players/random_plan.h"

namespace rink::game {
namespace {

constexpr double plan_s = 600.0;       ///< random keys are drawn for so long
constexpr double windows_ahead = 2.0;  ///< as the clocks of nodes' clients are

}  // namespace

MatchBots::MatchBots(const Scene& scene, SharedPlay& play, const Settings& settings)
    : scene_(scene), play_(play), settings_(settings), game_(scene) {
  assert(play.has_begun() && play.match() != nullptr && !settings.kinds.empty());
  for (std::uint32_t k = 0; k < settings_.count; ++k)
    play_.ask_seat({.token = std::max<std::uint64_t>(1, unguessable_number())});
}

MatchBots::Bot MatchBots::bot_at(std::uint32_t number) const {
  const std::string& kind = settings_.kinds[number % settings_.kinds.size()];
  Bot bot{.number = number, .player = nullptr, .due = decision_phase(number)};
  const Bat& bat = scene_.bodies.bats[number];
  if (kind == "random") bot.plan = random_player_plan(settings_.seed, number, plan_s);
  else
    bot.player = make_player(
        kind, rules_of(scene_, number),
        {.number = number, .team = bat.team, .half_extent = bat.body.half_extent}, settings_.seed);
  return bot;
}

void MatchBots::take_seats() {
  while (const auto answer = play_.next_seat()) {
    if (!answer->player)
      throw SessionError(ExitStatus::not_admitted,
                         "--bots: no bat of the match is free: expected fewer");
    bots_.push_back(bot_at(*answer->player));
  }
}

void MatchBots::begin_match() {
  game_ = Game(scene_);
  for (Bot& bot : bots_) bot = bot_at(bot.number);
}

void MatchBots::look() {
  constexpr double all_that_came = 1e9;
  play_.check();
  take_seats();
  const std::uint32_t before = state_.number;
  state_ = play_.match()->state();
  if (state_.number == 0) return;
  if (state_.number != before) begin_match();
  while (play_.show_next(all_that_came, game_)) {
  }
  for (Bot& bot : bots_) act(bot);
  if (state_.phase != MatchPhase::over || asked_for_ == state_.number) return;
  asked_for_ = state_.number;
  for (const Bot& bot : bots_) play_.match()->ask_rematch(bot.number);
}

/// In a pause nothing is shown.
void MatchBots::act(Bot& bot) {
  if (bot.player) {
    if (game_.now() < bot.due) return;
    while (bot.due <= game_.now()) bot.due += decision_period;
    return hold(bot, decide(bot));
  }
  for (; bot.next < bot.plan.size() && bot.plan[bot.next].time <= game_.now(); ++bot.next)
    press(bot, bot.plan[bot.next].key, bot.plan[bot.next].kind == InputKind::key_down);
}

KeysHeld MatchBots::decide(Bot& bot) const {
  const EntityId bat = *game_.bat(bot.number);
  const Vector2 position = game_.position(bat);
  std::vector<SeenEntity> pucks;
  for (const Entity& entity : game_.entities())
    if (entity.kind == physics::BodyKind::puck && game_.simulator().is_in_play(entity.id))
      pucks.push_back({.id = entity.id.index,
                       .kind = physics::BodyKind::puck,
                       .position = game_.position(entity.id),
                       .velocity = game_.velocity(entity.id),
                       .half_extent = entity.half_extent});
  pucks = nearest_of(pucks, position, bot.player->pucks_wanted());
  return bot.player->decide({.position = position, .velocity = game_.velocity(bat), .pucks = pucks},
                            game_.now());
}

void MatchBots::hold(Bot& bot, KeysHeld wanted) {
  for (const Key key : all_keys)
    if (wanted.is_down(key) != bot.held.is_down(key)) press(bot, key, wanted.is_down(key));
  bot.held = wanted;
}

void MatchBots::press(Bot& bot, Key key, bool is_down) {
  play_.press(bot.number, key, is_down, game_.now() + windows_ahead * settings_.window);
  ++presses_;
}

}  // namespace rink::game
