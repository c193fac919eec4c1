// Replays the same keys at the same instants in the same scene.
#include "game/control/replay.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/control/game.h"
#include "game/model/listed.h"
#include "game/model/scene_file.h"
#include "im/basics/checked.h"

namespace rink::game {

void require_complete(const KeyLog& log, const std::string& file) {
  std::string missing;
  const auto need = [&](bool is_there, const char* what) {
    if (!is_there) add_to_list(missing, what);
  };
  need(log.until.has_value(), "until (how far the game was played)");
  need(log.hash.has_value(), "hash (in which it ended)");
  need(log.is_sealed, "its last line, end (it was cut off or written by hand)");
  if (!missing.empty())
    throw SceneError(file + ": cannot be replayed, for it lacks " + missing +
                     "; rink simulate --record and rink serve --record write complete logs");
}

Scene recorded_scene(const KeyLog& log, const std::string& file) {
  Scene scene = log.scene_text.empty() ? load_scene(log.scene)
                                       : parse_scene(log.scene_text, file + " (its scene)");
  scene.name = log.scene;
  if (scene.seed != log.seed) scene = with_seed(std::move(scene), log.seed);
  if (log.bat_count) scene = with_count(std::move(scene), physics::BodyKind::bat, *log.bat_count);
  if (log.puck_count)
    scene = with_count(std::move(scene), physics::BodyKind::puck, *log.puck_count);
  if (log.bats && *log.bats != scene.bodies.bats.size())
    scene = scaled_to_bats(std::move(scene), *log.bats);
  require_fit(log, scene, file);
  return scene;
}

std::uint64_t replay(const KeyLog& log, const Scene& scene) {
  assert(log.until && log.hash);
  Game game(scene);
  for (const InputEvent& event : log.events) game.submit(event);
  game.advance(*log.until);
  return game.hash();
}

namespace {

/// Whether inputs of the game's present instant are still to be played: what is submitted there
/// would come at it, not after it.
bool is_instant_open(const Game& game) {
  if (game.simulator().exact_world() == nullptr || game.player_count() == 0) return false;
  return game.copy().submit({.time = game.now()}).time == game.now();
}

}  // namespace

/// Inputs of the last instant that the game has not come to yet would be played by a replay.
KeyLog log_of(const Game& game, const Scene& scene, std::string scene_text,
              std::vector<InputEvent> events) {
  KeyLog log = key_log_for(scene);
  log.scene_text = std::move(scene_text);
  log.until = game.now();
  if (!game.is_cut_short()) log.hash = game.hash();  // a replay plays instants to their end
  log.events = std::move(events);
  std::erase_if(log.events, [&](const InputEvent& event) { return event.time > game.now(); });
  const auto is_last = [&](const InputEvent& event) { return event.time == game.now(); };
  if (std::ranges::any_of(log.events, is_last) && is_instant_open(game))
    std::erase_if(log.events, is_last);
  std::stable_sort(log.events.begin(), log.events.end(),
                   [](const InputEvent& a, const InputEvent& b) { return a.time < b.time; });
  return log;
}

Replay::Replay(KeyLog log, Scene scene)
    : log_(std::move(log)), scene_(std::move(scene)), game_(scene_) {
  assert(log_.until && log_.hash);
  assert(!log_.fingerprint || *log_.fingerprint == fingerprint(scene_));
  for (const InputEvent& event : log_.events) game_.submit(event);
  kept_.push_back(game_.copy());
}

void Replay::seek(double instant) {
  assert(!std::isnan(instant));
  instant = std::clamp(instant, 0.0, end());
  const auto before = std::min(kept_.size() - 1, static_cast<std::size_t>(instant / kept_every));
  assert(kept_[before].now() <= instant);
  if (instant < game_.now() || kept_[before].now() > game_.now()) game_ = kept_[before].copy();
  play(instant);
  assert(game_.now() == instant);
  if constexpr (checks_whole_structures) check();
}

void Replay::check() const {
  assert(!kept_.empty() && end() >= 0.0 && now() >= 0.0 && now() <= end());
  for (std::size_t k = 0; k < kept_.size(); ++k)
    assert(kept_[k].now() == kept_every * static_cast<double>(k));
  assert(kept_.back().now() <= end());
}

/// Stops on the way do not affect the game.
void Replay::play(double until) {
  for (double stop = kept_every * static_cast<double>(kept_.size()); stop <= until;
       stop += kept_every) {
    game_.advance(stop);
    kept_.push_back(game_.copy());
  }
  game_.advance(until);
  if (until == end()) is_as_recorded_ = game_.hash() == *log_.hash;
}

}  // namespace rink::game
