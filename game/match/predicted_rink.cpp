// Sets the world up from what was told, presses again what was not felt yet, plays forward, and
// looks at each body at the instant that is its own.
#include "game/match/predicted_rink.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/control/bat_controller.h"
#include "im/basics/checked.h"

namespace rink::game {
namespace {

constexpr double sample_step =
    4e-3;  ///< s: between, bodies are shown on chords; a bounce at 2 m/s is cut by at most 4 mm
constexpr double kept_longest = 2.0;  ///< s of the past
constexpr double blended_furthest =
    0.3;  ///< m: a puck that is further off was put elsewhere, in a goal or on a spot
constexpr double near_bat =
    0.12;  ///< m from a bat's front, within which a puck is in its owner's time
constexpr double slowest = 0.3, fastest = 3.0;  ///< of a puck's time as it goes from one player's
                                                ///< to the other's, against real time

Vector2 thrust_of(const KeysHeld& held, double thrust) {
  BatController controller(thrust);
  for (const Key key : all_keys)
    if (held.is_down(key)) controller.press(key, true);
  return controller.thrust();
}

}  // namespace

void Corrections::count(double jump) {
  assert(jump >= 0.0);
  greatest = std::max(greatest, jump);
  if (jump <= visible) return;
  ++visible_count;
  sum += jump;
  last_visible = jump;
}

PredictedRink::PredictedRink(const Scene& scene, std::optional<std::uint32_t> own_player)
    : scene_(scene),
      own_(own_player),
      ids_(body_count()),
      held_(scene.bodies.bats.size()),
      left_at_(body_count(), Vector2(0.0, 0.0)),
      lags_(scene.bodies.pucks.size(), 0.0),
      blends_(body_count()),
      shown_bats_(scene.bodies.bats.size()),
      shown_pucks_(scene.bodies.pucks.size()) {
  assert(!own_player || *own_player < scene.bodies.bats.size());
  scene_.world.allow_overlap = true;  // what is told is rounded
  if constexpr (checks_whole_structures) check();
}

void PredictedRink::check() const {
  assert(ids_.size() == body_count() && left_at_.size() == body_count() &&
         blends_.size() == body_count());
  assert(held_.size() == scene_.bodies.bats.size() && shown_bats_.size() == held_.size());
  assert(lags_.size() == scene_.bodies.pucks.size() && shown_pucks_.size() == lags_.size());
  assert(applied_ <= keys_.size() && (own_ || keys_.empty()));
  assert(std::ranges::is_sorted(keys_, {}, &PressedKey::instant));
  assert(std::ranges::none_of(lags_, [](double lag) { return lag < 0.0; }));
  assert(has_heard() == !track_.empty() && (has_heard() || !has_looked_));
  for (std::size_t k = 0; k < track_.size(); ++k) {
    assert(track_[k].positions.size() == body_count() &&
           track_[k].velocities.size() == body_count());
    assert(k == 0 || track_[k - 1].time < track_[k].time);
  }
  assert(!has_heard() || track_.back().time >= told_.time);
}

void PredictedRink::press(Key key, bool is_down, double instant) {
  assert(own_ && std::isfinite(instant) && instant >= now_);
  keys_.push_back(
      {keys_.empty() ? instant : std::max(instant, keys_.back().instant), key, is_down});
  if constexpr (checks_whole_structures) check();
}

void PredictedRink::hear(const ToldRink& told) {
  assert(told.bats.size() == scene_.bodies.bats.size() &&
         told.pucks.size() == scene_.bodies.pucks.size());
  if (world_ && told.time < told_.time) return;
  std::vector<std::uint8_t> was_known;
  for (std::size_t body = 0; has_looked_ && body < body_count(); ++body)
    was_known.push_back(is_known(body) ? 1 : 0);
  told_ = told;
  for (; felt_ < told.own_felt && !keys_.empty(); ++felt_) keys_.pop_front();
  felt_ = std::max(felt_, told.own_felt);
  std::vector<Vector2> before;
  for (std::size_t body = 0; has_looked_ && body < body_count(); ++body)
    before.push_back(was_known[body] != 0 ? at(body, time_of(body)).position : Vector2(0.0, 0.0));
  set_up();
  if (!has_looked_) return;
  play(now_);
  for (std::size_t body = 0; body < body_count(); ++body) {
    if (was_known[body] == 0 || !is_known(body)) {
      blends_[body] = {};
      continue;
    }
    const Vector2 jump = before[body] - at(body, time_of(body)).position;
    const double length = jump.norm();
    if (length > blended_furthest && body >= held_.size()) {
      blends_[body] = {};
    } else if (length > 0.0) {
      corrections_of(body).count(length);
      blends_[body].begin(jump + blends_[body].at(now_), now_);
    }
  }
  if constexpr (checks_whole_structures) check();
}

void PredictedRink::rewind(double now) {
  assert(std::isfinite(now));
  now_ = now;
  blends_.assign(body_count(), {});
  if (world_) set_up();
  if constexpr (checks_whole_structures) check();
}

Corrections& PredictedRink::corrections_of(std::size_t body) {
  assert(body < body_count());
  if (body >= held_.size()) return puck_corrections_;
  return own_ == body ? own_corrections_ : other_corrections_;
}

void PredictedRink::set_up() {
  world_.emplace(scene_.world);
  applied_ = 0;
  for (const Post& post : scene_.bodies.posts) world_->add(post.body);
  for (std::uint32_t bat = 0; bat < held_.size(); ++bat) add_bat(bat);
  for (std::size_t puck = 0; puck < scene_.bodies.pucks.size(); ++puck) add_puck(puck);
  while (!track_.empty() && track_.back().time >= told_.time) track_.pop_back();
  sample(told_.time);
}

void PredictedRink::add_bat(std::uint32_t bat) {
  const ToldBody& told = told_.bats[bat];
  ids_[bat].reset();
  left_at_[bat] = told.position;
  held_[bat] = told.held;
  if (!told.is_known) return;
  physics::BatSpec body = scene_.bodies.bats[bat].body;
  body.position = inside(told.position, body);
  body.velocity = told.velocity;
  ids_[bat] = world_->add(body);
  set_thrust(bat);
}

void PredictedRink::add_puck(std::size_t puck) {
  const ToldBody& told = told_.pucks[puck];
  std::optional<physics::BodyId>& id = ids_[held_.size() + puck];
  id.reset();
  left_at_[held_.size() + puck] = told.position;
  if (!told.is_in_play || !told.is_known) return;
  physics::PuckSpec body = scene_.bodies.pucks[puck].body;
  body.position = inside(told.position, body.radius);
  body.velocity = told.velocity;
  id = world_->add(body);
}

/// Rounding may have put a bat a little into a wall or over the halfway line.
Vector2 PredictedRink::inside(const Vector2& position, const physics::BatSpec& bat) const {
  const physics::Field& field = scene_.world.field;
  Vector2 low = bat.half_extent, high = Vector2(field.length, field.width) - bat.half_extent;
  if (field.bats_keep_to_half && bat.half == physics::Half::left)
    high.x() = field.length / 2 - bat.half_extent.x();
  if (field.bats_keep_to_half && bat.half == physics::Half::right)
    low.x() = field.length / 2 + bat.half_extent.x();
  return position.cwiseMax(low).cwiseMin(high);
}

/// Likewise a puck, which may be on its way into a goal.
Vector2 PredictedRink::inside(const Vector2& position, double radius) const {
  const physics::Field& field = scene_.world.field;
  const bool is_at_goal = std::abs(position.y() - field.width / 2) < field.goal_width / 2;
  const double margin = is_at_goal ? 0.0 : radius;
  return {std::clamp(position.x(), margin, field.length - margin),
          std::clamp(position.y(), radius, field.width - radius)};
}

void PredictedRink::set_thrust(std::uint32_t bat) {
  if (ids_[bat])
    world_->set_thrust(*ids_[bat], thrust_of(held_[bat], scene_.bodies.bats[bat].thrust));
}

/// One that was due before what was told, but not felt by then, was late: it is felt at the next
/// occasion.
void PredictedRink::apply_keys_until(double instant) {
  for (; applied_ < keys_.size() && keys_[applied_].instant <= instant; ++applied_) {
    held_[*own_].set(keys_[applied_].key, keys_[applied_].is_down);
    set_thrust(*own_);
  }
}

void PredictedRink::play(double until) {
  assert(world_ && !track_.empty());
  double time = track_.back().time;
  apply_keys_until(time);
  while (time < until) {
    time = std::min(until, time + sample_step);
    if (applied_ < keys_.size()) time = std::min(time, keys_[applied_].instant);
    while (world_->advance(time - told_.time)) {
    }  // pucks may score; the score is the server's
    apply_keys_until(time);
    sample(time);
  }
}

void PredictedRink::sample(double time) {
  Sample sample{.time = time, .positions = {}, .velocities = {}};
  for (std::size_t body = 0; body < body_count(); ++body) {
    const auto& id = ids_[body];
    const bool is_in_play = id && world_->is_in_play(*id);
    sample.positions.push_back(id ? world_->position(*id) : left_at_[body]);
    sample.velocities.push_back(is_in_play ? world_->velocity(*id) : Vector2(0.0, 0.0));
  }
  track_.push_back(std::move(sample));
}

void PredictedRink::forget_before(double time) {
  while (track_.size() > 2 && track_[1].time < time) track_.pop_front();
}

ShownBody PredictedRink::at(std::size_t body, double time) const {
  assert(body < body_count() && !track_.empty());
  const auto after =
      std::lower_bound(track_.begin(), track_.end(), time,
                       [](const Sample& sample, double t) { return sample.time < t; });
  if (after == track_.end())
    return {track_.back().positions[body], track_.back().velocities[body], time};
  if (after == track_.begin() || after->time == time)
    return {after->positions[body], after->velocities[body], time};
  const auto before = std::prev(after);
  const Vector2 way = after->positions[body] - before->positions[body];
  if (way.norm() > blended_furthest)
    return {before->positions[body], before->velocities[body], time};
  const double part = (time - before->time) / (after->time - before->time);
  assert(part >= 0.0 && part <= 1.0);
  return {before->positions[body] + part * way, before->velocities[body], time};
}

void PredictedRink::advance(double now, double delay) {
  assert(now >= now_ && delay >= 0.0);
  const double dt = has_looked_ ? now - now_ : 0.0;
  now_ = now;
  delay_ = delay;
  if (!world_) return;
  play(now);
  for (std::size_t puck = 0; puck < lags_.size(); ++puck)
    lags_[puck] = puck_lag(puck, lags_[puck], has_looked_ ? dt : kept_longest);
  has_looked_ = true;
  forget_before(now - kept_longest);
  for (std::size_t bat = 0; bat < shown_bats_.size(); ++bat) shown_bats_[bat] = shown(bat);
  for (std::size_t puck = 0; puck < shown_pucks_.size(); ++puck)
    shown_pucks_[puck] = shown(held_.size() + puck);
  if constexpr (checks_whole_structures) check();
}

double PredictedRink::time_of(std::size_t body) const {
  if (body >= held_.size()) return now_ - lags_[body - held_.size()];
  return own_ == body ? now_ : now_ - delay_;
}

ShownBody PredictedRink::shown(std::size_t body) const {
  ShownBody shown = at(body, time_of(body));
  shown.position += blends_[body].at(now_);
  return shown;
}

/// Solves lag = delay w(x(now - lag)), as far as a puck's time may run slower or faster than real
/// time.
double PredictedRink::puck_lag(std::size_t puck, double lag, double dt) const {
  assert(puck < lags_.size() && dt >= 0.0);
  double wanted = std::min(lag, delay_);
  for (int round = 0; round < 4; ++round)
    wanted =
        0.5 * (wanted + delay_ * portion_of_delay(at(held_.size() + puck, now_ - wanted).position));
  return std::clamp(wanted, std::max(0.0, lag - (fastest - 1.0) * dt), lag + (1.0 - slowest) * dt);
}

/// 0 at the own bat, 1 at the other, linear between: the local perception filter of Sharkey, Ryan
/// and Roberts (1998).
double PredictedRink::portion_of_delay(const Vector2& puck) const {
  if (!own_) return 1.0;
  if (held_.size() != 2 || !is_known(1 - *own_)) return portion_in_crowd(puck);
  const std::uint32_t other = 1 - *own_;
  const double own_x = at(*own_, now_).position.x(),
               other_x = at(other, now_ - delay_).position.x();
  const double direction = own_x < other_x ? 1.0 : -1.0,
               span = std::abs(other_x - own_x) - 2.0 * near_bat;
  if (span <= 0.0) return 0.0;
  return std::clamp((direction * (puck.x() - own_x) - near_bat) / span, 0.0, 1.0);
}

/// Among many bats, or where the other is out of sight: 0 near the own one, on all sides, and 1
/// where that cannot get soon.
double PredictedRink::portion_in_crowd(const Vector2& puck) const {
  assert(own_ && *own_ < held_.size());
  const Vector2 beside =
      ((puck - at(*own_, now_).position).cwiseAbs() - scene_.bodies.bats[*own_].body.half_extent)
          .cwiseMax(0.0);
  return std::clamp((beside.norm() - near_bat) / (crowd_reach - near_bat), 0.0, 1.0);
}

}  // namespace rink::game
