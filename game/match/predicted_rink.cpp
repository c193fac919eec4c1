// Starts again from the newest update, applies pending keys again, plays forward, and samples each
// body at its own instant.
#include "game/match/predicted_rink.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/basics/checked.h"

namespace rink::game {
namespace {

constexpr double sample_step =
    4e-3;  ///< s: between, bodies are shown on chords; a bounce at 2 m/s is cut by at most 4 mm
constexpr double kept_longest = 2.0;  ///< s of the past
constexpr double near_bat =
    0.12;  ///< m from a bat's front, within which a puck is in its owner's time
constexpr double slowest = 0.3, fastest = 3.0;  ///< of a puck's time, against real time, on its way
                                                ///< from one player's time to the other's

}  // namespace

PredictedRink::PredictedRink(const Scene& scene, std::optional<std::uint32_t> own_player)
    : own_(own_player),
      world_(scene),
      lags_(world_.puck_count(), 0.0),
      blends_(world_.bat_count(), world_.puck_count(), own_player),
      shown_bats_(world_.bat_count()),
      shown_pucks_(world_.puck_count()) {
  if constexpr (checks_whole_structures) check();
}

void PredictedRink::check() const {
  assert(shown_bats_.size() == world_.bat_count());
  assert(lags_.size() == world_.puck_count() && shown_pucks_.size() == lags_.size());
  assert(own_ || keys_.count() == 0);
  assert(std::ranges::none_of(lags_, [](double lag) { return lag < 0.0; }));
  assert(has_received() == !track_.is_empty() && (has_received() || !has_looked_));
  assert(!has_received() || track_.end() >= received_time());
  keys_.check();
  track_.check(world_.body_count());
}

void PredictedRink::press(Key key, bool is_down, double instant) {
  assert(own_ && std::isfinite(instant) && instant >= now_);
  keys_.press(key, is_down, instant);
  if constexpr (checks_whole_structures) check();
}

void PredictedRink::push(const Push& push, double instant) {
  assert(own_ && std::isfinite(instant) && instant >= now_ && is_sound(push));
  keys_.push(push, instant);
  if constexpr (checks_whole_structures) check();
}

PulledBat PredictedRink::own_bat() const {
  assert(own_ && has_looked_);
  return {shown_bats_[*own_].position, shown_bats_[*own_].velocity, world_.thrust(*own_),
          world_.drag()};
}

void PredictedRink::receive(const ReceivedRink& received) {
  if (has_received() && received.time < received_time()) return;
  const auto before = seen();
  world_.set_up(received);
  keys_.felt(received.own_felt);
  push_own_bat();
  begin();
  if (!has_looked_) return;
  play(now_);
  for (std::size_t body = 0; body < world_.body_count(); ++body)
    if (before[body] && world_.is_known(body))
      blends_.jump(body, *before[body] - track_.at(body, time_of(body)).position, now_);
    else blends_.forget(body);
  if constexpr (checks_whole_structures) check();
}

/// The shown place of each body without its blend; nothing of unknown ones, or before anything was
/// shown.
std::vector<std::optional<Vector2>> PredictedRink::seen() const {
  std::vector<std::optional<Vector2>> places(world_.body_count());
  for (std::size_t body = 0; has_looked_ && body < places.size(); ++body)
    if (world_.is_known(body)) places[body] = track_.at(body, time_of(body)).position;
  return places;
}

void PredictedRink::rewind(double now) {
  assert(std::isfinite(now));
  now_ = now;
  blends_.forget_all();
  if (has_received()) {
    world_.rewind();
    keys_.apply_again();
    push_own_bat();
    begin();
  }
  if constexpr (checks_whole_structures) check();
}

/// The own push that the update includes is known, also along an axis where the bat is held.
void PredictedRink::push_own_bat() {
  if (own_ && world_.received().bats[*own_].push != keys_.felt_push())
    world_.push(*own_, keys_.felt_push());
}

void PredictedRink::begin() {
  track_.drop_from(received_time());
  track_.add(world_.sample(received_time()));
}

/// A key that was due before the newest update but is not in it was late: it takes effect at the
/// next occasion.
void PredictedRink::apply_keys_until(double instant) {
  while (const PendingKeys::PressedKey* pressed = keys_.take_until(instant))
    if (pressed->push) world_.push(*own_, *pressed->push);
    else world_.press(*own_, pressed->key, pressed->is_down);
}

void PredictedRink::play(double until) {
  double time = track_.end();
  apply_keys_until(time);
  while (time < until) {
    time = std::min({until, time + sample_step, keys_.next_instant()});
    world_.advance(time);
    apply_keys_until(time);
    track_.add(world_.sample(time));
  }
}

void PredictedRink::advance(double now, double delay) {
  assert(now >= now_ && delay >= 0.0);
  const double dt = has_looked_ ? now - now_ : 0.0;
  now_ = now;
  delay_ = delay;
  if (!has_received()) return;
  play(now);
  for (std::size_t puck = 0; puck < lags_.size(); ++puck)
    lags_[puck] = puck_lag(puck, lags_[puck], has_looked_ ? dt : kept_longest);
  has_looked_ = true;
  track_.forget_before(now - kept_longest);
  for (std::size_t bat = 0; bat < shown_bats_.size(); ++bat) shown_bats_[bat] = shown(bat);
  for (std::size_t puck = 0; puck < shown_pucks_.size(); ++puck)
    shown_pucks_[puck] = shown(world_.bat_count() + puck);
  if constexpr (checks_whole_structures) check();
}

double PredictedRink::time_of(std::size_t body) const {
  if (body >= world_.bat_count()) return now_ - lags_[body - world_.bat_count()];
  return own_ == body ? now_ : now_ - delay_;
}

ShownBody PredictedRink::shown(std::size_t body) const {
  ShownBody shown = track_.at(body, time_of(body));
  shown.position += blends_.at(body, now_);
  return shown;
}

/// Solves lag = delay w(x(now - lag)), within the limits of a puck's time against real time.
double PredictedRink::puck_lag(std::size_t puck, double lag, double dt) const {
  assert(puck < lags_.size() && dt >= 0.0);
  double wanted = std::min(lag, delay_);
  for (int round = 0; round < 4; ++round)
    wanted =
        0.5 * (wanted + delay_ * portion_of_delay(
                                     track_.at(world_.bat_count() + puck, now_ - wanted).position));
  return std::clamp(wanted, std::max(0.0, lag - (fastest - 1.0) * dt), lag + (1.0 - slowest) * dt);
}

/// 0 at the own bat, 1 at the other, linear between: the local perception filter of Sharkey, Ryan
/// and Roberts (1998).
double PredictedRink::portion_of_delay(const Vector2& puck) const {
  if (!own_) return 1.0;
  if (world_.bat_count() != 2 || !world_.is_known(1 - *own_)) return portion_in_crowd(puck);
  const std::uint32_t other = 1 - *own_;
  const double own_x = track_.at(*own_, now_).position.x(),
               other_x = track_.at(other, now_ - delay_).position.x();
  const double direction = own_x < other_x ? 1.0 : -1.0,
               span = std::abs(other_x - own_x) - 2.0 * near_bat;
  if (span <= 0.0) return 0.0;
  return std::clamp((direction * (puck.x() - own_x) - near_bat) / span, 0.0, 1.0);
}

/// Among many bats, or if the other is out of sight: 0 near the own one, on all sides, and 1 where
/// it cannot get soon.
double PredictedRink::portion_in_crowd(const Vector2& puck) const {
  assert(own_ && *own_ < world_.bat_count());
  const Vector2 beside =
      ((puck - track_.at(*own_, now_).position).cwiseAbs() - world_.half_extent(*own_))
          .cwiseMax(0.0);
  return std::clamp((beside.norm() - near_bat) / (crowd_reach - near_bat), 0.0, 1.0);
}

}  // namespace rink::game
