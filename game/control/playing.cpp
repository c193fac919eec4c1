// Advances the game from one decision to the next; these stops do not affect the game.
#include "game/control/playing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <tuple>

#include "game/players/player_kinds.h"
#include "game/players/random_plan.h"
#include "im/basics/checked.h"

namespace rink::game {
namespace {

bool is_earlier(const InputEvent& a, const InputEvent& b) {
  return std::tuple(a.time, a.player) < std::tuple(b.time, b.player);
}

}  // namespace

Playing::Playing(const Scene& scene, const std::vector<std::string>& kinds, std::uint64_t seed,
                 double until, const physics::SimulatorChoice& engine)
    : game_(scene, engine) {
  assert(!kinds.empty());
  for (std::uint32_t number = 0; number < game_.player_count(); ++number) {
    const std::string& kind = kinds[number % kinds.size()];
    if (kind == "random") {
      const std::vector<InputEvent> keys = random_player_plan(seed, number, until);
      planned_.insert(planned_.end(), keys.begin(), keys.end());
      continue;
    }
    if (kind == hand || kind == nobody) continue;
    assert(is_player_kind(kind));
    const Bat& bat = scene.bodies.bats[number];
    const PlayerSeat seat{.number = number, .team = bat.team, .half_extent = bat.body.half_extent};
    seats_.push_back({number,
                      decision_phase(number),
                      make_player(kind, rules_of(scene, number), seat, seed),
                      {},
                      {}});
  }
  std::stable_sort(planned_.begin(), planned_.end(), is_earlier);
  for (const InputEvent& event : planned_) game_.submit(event);
  std::stable_sort(seats_.begin(), seats_.end(),
                   [](const Seat& a, const Seat& b) { return a.phase < b.phase; });
  if constexpr (checks_whole_structures) check();
}

void Playing::check() const {
  assert(std::ranges::is_sorted(seats_, {}, &Seat::phase));
  for ([[maybe_unused]] const Seat& seat : seats_) {
    assert(seat.player != nullptr && seat.number < game_.player_count());
    assert(seat.phase >= 0.0 && seat.phase < decision_period);
  }
  for ([[maybe_unused]] const std::vector<InputEvent>* keys : {&planned_, &decided_}) {
    assert(std::ranges::is_sorted(*keys, is_earlier));
    assert(std::ranges::all_of(*keys, [this](const InputEvent& event) {
      return event.time >= 0.0 && event.player < game_.player_count();
    }));
  }
  assert(located_s_ <= game_.now());
}

void Playing::record_events(bool is_wanted) {
  records_events_ = is_wanted;
  game_.record_events(is_wanted);
}

bool Playing::play_until(double instant, physics::EventBudget* budget) {
  if (budget != nullptr) game_.advance(instant, *budget);
  else game_.advance(instant);
  serve_count_ += served_in(game_).size();
  if (records_events_)
    happened_.insert(happened_.end(), game_.events().begin(), game_.events().end());
  return !game_.is_cut_short();
}

bool Playing::play(double until, physics::EventBudget* budget) {
  happened_.clear();
  for (; !seats_.empty(); ++turn_) {
    Seat& seat = seats_[turn_ % seats_.size()];
    const double instant =
        static_cast<double>(turn_ / seats_.size()) * decision_period + seat.phase;
    if (instant > until) break;
    // Players that decide at one instant see the same state and press together, as in the replay of
    // the log.
    if ((game_.now() < instant || game_.is_cut_short()) && !play_until(instant, budget))
      return false;
    assert(game_.now() == instant);
    decide(seat, instant);
  }
  if (!play_until(until, budget)) return false;
  if constexpr (checks_whole_structures) check();
  return true;
}

void Playing::decide(Seat& seat, double instant) {
  const std::optional<EntityId> bat = game_.bat(seat.number);
  if (!bat) return;
  const Vector2 position = game_.position(*bat);
  if (seat.decisions++ % look_about_interval == 0) look_about(seat, position, instant);
  seen_.clear();
  for (const auto& watched : seat.watched.found()) {
    const EntityId puck = watched.thing;
    if (!game_.simulator().is_in_play(puck)) continue;
    seen_.push_back({.id = puck.index,
                     .kind = physics::BodyKind::puck,
                     .position = game_.position(puck),
                     .velocity = game_.velocity(puck),
                     .half_extent = game_.simulator().half_extent(puck)});
  }
  press(seat,
        seat.player->decide(
            {.position = position, .velocity = game_.velocity(*bat), .pucks = seen_}, instant),
        instant);
}

/// Positions up to a decision old suffice for choosing; finding them anew for every player would
/// take three quarters of all the work.
void Playing::look_about(Seat& seat, const Vector2& from, double instant) {
  seat.watched.clear(seat.player->pucks_wanted());
  if (seat.player->pucks_wanted() == 0) return;
  if (located_s_ < 0.0 || instant - located_s_ >= decision_period) locate_pucks(instant);
  for (const Located& located : located_)
    seat.watched.show(located.puck, (located.position - from).squaredNorm());
}

void Playing::locate_pucks(double instant) {
  located_.clear();
  located_s_ = instant;
  for (const Entity& entity : game_.entities())
    if (entity.kind == physics::BodyKind::puck && game_.simulator().is_in_play(entity.id))
      located_.push_back({entity.id, game_.position(entity.id)});
}

void Playing::press(Seat& seat, KeysHeld wanted, double instant) {
  for (const Key key : all_keys) {
    if (wanted.is_down(key) == seat.held.is_down(key)) continue;
    submit(
        {instant, seat.number, wanted.is_down(key) ? InputKind::key_down : InputKind::key_up, key});
  }
  seat.held = wanted;
}

void Playing::press(std::uint32_t player, Key key, bool is_down) {
  assert(
      std::ranges::none_of(seats_, [player](const Seat& seat) { return seat.number == player; }));
  submit({game_.now(), player, is_down ? InputKind::key_down : InputKind::key_up, key});
}

void Playing::push(std::uint32_t player, const Push& push) {
  assert(
      std::ranges::none_of(seats_, [player](const Seat& seat) { return seat.number == player; }));
  submit({.time = game_.now(), .player = player, .kind = InputKind::push, .push = push});
}

void Playing::submit(const InputEvent& event) {
  const InputEvent queued = game_.submit(event);
  assert(queued.time >= event.time && queued.player == event.player && queued.key == event.key);
  decided_.insert(std::upper_bound(decided_.begin(), decided_.end(), queued, is_earlier), queued);
}

std::vector<InputEvent> Playing::keys() const {
  std::vector<InputEvent> all;
  std::merge(planned_.begin(), planned_.end(), decided_.begin(), decided_.end(),
             std::back_inserter(all), is_earlier);
  std::erase_if(all, [this](const InputEvent& event) { return event.time > game_.now(); });
  return all;
}

}  // namespace rink::game
