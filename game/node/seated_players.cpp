// Presses keys by the newest observation of each bat, which names its owner.
#include "game/node/seated_players.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "game/net/peer/crowd.h"

namespace rink::game {

SeatedPlayers::SeatedPlayers(const SharedGame& game, std::uint32_t first, std::uint32_t count)
    : game_(game) {
  assert(first <= game.bat_count() && count <= game.bat_count() - first);
  for (std::uint32_t player = first; player < first + count; ++player)
    players_.push_back(at_start(player));
}

std::vector<SeatedPlayers::Player>::iterator SeatedPlayers::place_of(std::uint32_t player) {
  return std::ranges::lower_bound(players_, player, {}, &Player::number);
}

void SeatedPlayers::seat(std::uint32_t player) {
  assert(player < game_.bat_count());
  {
    const std::lock_guard lock(mutex_);
    left_.erase(player);
  }
  if (is_seated(player)) return;
  Player seated = at_start(player);
  seated.seen.time = -1.0;
  players_.insert(place_of(player), std::move(seated));
}

SeatedPlayers::Player SeatedPlayers::at_start(std::uint32_t player) const {
  const Game& start = game_.start();
  const EntityId bat = *start.bat(player);
  return {player,
          BatController(game_.scene().bodies.bats[player].thrust),
          {.bat = bat.index,
           .owner = 0,
           .time = start.now(),
           .position = start.position(bat),
           .velocity = start.velocity(bat),
           .pucks = {}}};
}

void SeatedPlayers::begin_session(std::span<const std::uint32_t> known) {
  for (Player& player : players_) {
    player = at_start(player.number);
    if (std::ranges::find(known, player.number) == known.end()) player.seen.time = -1.0;
  }
  const std::lock_guard lock(mutex_);
  waiting_.clear();
}

void SeatedPlayers::unseat(std::uint32_t player) {
  if (is_seated(player)) players_.erase(place_of(player));
}

bool SeatedPlayers::is_seated(std::uint32_t player) const {
  return std::ranges::binary_search(players_, player, {}, &Player::number);
}

void SeatedPlayers::press(std::uint32_t player, Key key, bool is_down, double time) {
  assert(player < game_.bat_count());
  const std::lock_guard lock(mutex_);
  if (!left_.contains(player)) waiting_.push_back({player, key, is_down, time});
}

void SeatedPlayers::leave(std::uint32_t player) {
  const std::lock_guard lock(mutex_);
  left_.insert(player);
}

SeatedPlayers::Taken SeatedPlayers::take(peer::Session& session, bool begins_together) {
  Taken taken;
  if (session.window() == 0)
    for (Player& player : players_)
      player.seen.owner = session.division().owner_of(player.seen.position);
  std::vector<Pressed> waiting;
  {
    const std::lock_guard lock(mutex_);
    waiting = std::exchange(waiting_, {});
  }
  for (Player& player : players_)
    if (player.seen.time == session.peer().now())
      send_waiting(player, {session, begins_together}, taken);
  std::vector<Pressed> kept;
  for (const Pressed& pressed : waiting) {
    if (!is_seated(pressed.player)) continue;
    Player& player = *place_of(pressed.player);
    if (player.seen.time != session.peer().now()) {  // its owner has not shown it: not yet
      kept.push_back(pressed);
      continue;
    }
    player.pressed.press(pressed.key, pressed.is_down);
    const InputEvent event{0.0, 0, pressed.is_down ? InputKind::key_down : InputKind::key_up,
                           pressed.key};
    const peer::Press press{.bat = player.seen.bat,
                            .thrust = player.pressed.thrust(),
                            .input = input_of(event),
                            .time = pressed.time};
    if (keeps_unfelt_) player.unfelt.push_back(press), ++player.sent;
    send(player, press, {session, begins_together}, taken);
  }
  if (kept.empty()) return taken;
  const std::lock_guard lock(mutex_);
  waiting_.insert(waiting_.begin(), kept.begin(), kept.end());
  return taken;
}

/// Until the first window was played the owner may not have begun.
void SeatedPlayers::send(Player& player, const peer::Press& press, const Way& way, Taken& taken) {
  if (way.session.window() == 0 && !way.begins_together)
    way.session.peer().players().press(player.seen.owner, press);
  else taken[player.seen.owner].words.push_back(press);
}

void SeatedPlayers::send_waiting(Player& player, const Way& way, Taken& taken) {
  for (; player.sent < player.unfelt.size(); ++player.sent)
    send(player, player.unfelt[player.sent], way, taken);
}

std::vector<SeatedPlayers::Player>::iterator SeatedPlayers::of_bat(std::uint32_t bat) {
  const auto player =
      std::ranges::lower_bound(players_, bat, {}, [](const Player& each) { return each.seen.bat; });
  return player != players_.end() && player->seen.bat == bat ? player : players_.end();
}

void SeatedPlayers::look(const peer::Session& session) {
  for (const peer::Observation& seen : session.peer().observations())
    if (const auto player = of_bat(seen.bat);
        player != players_.end() && seen.time == session.peer().now())
      player->seen = seen;
}

/// The bat's owner feels a player's keys in their order. The last ones of the player before may
/// come in between.
void SeatedPlayers::note_felt(const peer::Key& key) {
  const auto player = of_bat(key.bat);
  if (player == players_.end() || player->unfelt.empty()) return;
  const peer::Press& first = player->unfelt.front();
  if (first.input != key.input || first.thrust != key.thrust) return;
  player->unfelt.pop_front();
  player->sent -= player->sent > 0;
}

/// Who owns a bat now its player learns with the next window.
void SeatedPlayers::send_again(const peer::Session& session) {
  for (Player& player : players_) {
    player.sent = 0;
    player.seen.time = session.window() == 0 ? session.peer().now() : -1.0;
  }
}

void SeatedPlayers::release(std::uint32_t player, const KeysHeld& held) {
  unseat(player);
  seat(player);
  place_of(player)->pressed = BatController(game_.scene().bodies.bats[player].thrust, held, 0);
  for (const Key key : all_keys)
    if (held.is_down(key)) press(player, key, false);
}

bool SeatedPlayers::has_unfelt(std::uint32_t player) {
  if (!is_seated(player)) return false;
  const std::lock_guard lock(mutex_);
  return !place_of(player)->unfelt.empty() ||
         std::ranges::find(waiting_, player, &Pressed::player) != waiting_.end();
}

}  // namespace rink::game
