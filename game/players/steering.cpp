// Bang-bang control along each axis, since keys are down or up.
#include "game/players/steering.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/basics/checked.h"

namespace rink::game {

KeysHeld keys_towards(int push_x, int push_y) {
  KeysHeld keys;
  if (push_x != 0) keys.set(push_x > 0 ? Key::right : Key::left, true);
  if (push_y != 0) keys.set(push_y > 0 ? Key::up : Key::down, true);
  return keys;
}

double speed_to_stop_within(double distance, double thrust) {
  assert(!(distance < 0.0) && thrust >= 0.0);
  return std::sqrt(2.0 * thrust * distance);
}

double top_speed(const PlayerRules& rules) {
  assert(rules.thrust >= 0.0 && rules.bat_drag >= 0.0);
  return rules.bat_drag > 0.0 ? rules.thrust / rules.bat_drag : rules.thrust;
}

int pushed_along(int held, double need, double start, double stop) {
  assert(held >= -1 && held <= 1);
  assert(start >= stop && stop >= 0.0 && "or a key that goes down would go up at once");
  if (held != 0 && held * need > stop) return held;
  return need > start ? 1 : need < -start ? -1 : 0;
}

int push_x(KeysHeld keys) {
  return (keys.is_down(Key::right) ? 1 : 0) - (keys.is_down(Key::left) ? 1 : 0);
}
int push_y(KeysHeld keys) {
  return (keys.is_down(Key::up) ? 1 : 0) - (keys.is_down(Key::down) ? 1 : 0);
}

KeysHeld keys_to_reach(const PlayerView& view, const Vector2& target, double cruise_speed,
                       const PlayerRules& rules, KeysHeld held) {
  const Vector2 way = target - view.position;
  const double distance = std::sqrt(way.squaredNorm());
  // Half the acceleration for braking, since a decision may come a whole period late.
  const double speed = std::min(cruise_speed, speed_to_stop_within(distance, 0.5 * rules.thrust));
  const double there = 2.0 * rules.thrust * decision_period *
                       decision_period;  // nearer than this four keys cannot hold a bat
  const Vector2 wanted = distance > there ? Vector2(way * (speed / distance)) : Vector2(0.0, 0.0);
  // The loss by drag until the next decision must be compensated as well. In units of the change by
  // one decision's acceleration:
  const Vector2 missing = (wanted - view.velocity * (1.0 - rules.bat_drag * decision_period)) /
                          (rules.thrust * decision_period);
  constexpr double start = 1.0, stop = 0.0;
  return keys_towards(pushed_along(push_x(held), missing.x(), start, stop),
                      pushed_along(push_y(held), missing.y(), start, stop));
}

physics::WarpedTime under_friction(const physics::WarpedTime& free, double ahead,
                                   const Vector2& velocity, const PlayerRules& rules) {
  assert(ahead >= 0.0 && rules.puck_friction >= 0.0 && rules.puck_drag >= 0.0);
  if (rules.puck_friction == 0.0 || velocity.isZero(0.0)) return free;
  const double drag = rules.puck_drag, slowing = rules.puck_friction / velocity.norm();
  const double rest = drag > 0.0 ? physics::log1p_of(drag / slowing) / drag : 1.0 / slowing;
  if (ahead < rest) return {free.s - slowing * free.q, 0.0, free.e - slowing * free.s};
  const physics::WarpedTime whole = physics::warp(rest, drag);
  return {whole.s - slowing * whole.q, 0.0, 0.0};
}

void Hands::check() const {
  assert(delay_ <= delay_max && next_ <= delay_max);
  assert(stuck_ < stuck_decisions && escaping_ <= escape_decisions);
  assert(!(escape_.is_down(Key::left) && escape_.is_down(Key::right)));
  assert(!(escape_.is_down(Key::up) && escape_.is_down(Key::down)));
}

KeysHeld Hands::hold(KeysHeld wanted, const Vector2& velocity, RandomStream& random) {
  if constexpr (checks_whole_structures) check();
  wishes_[next_] = wanted;
  const KeysHeld due = wishes_[(next_ + delay_max + 1 - delay_) % (delay_max + 1)];
  next_ = (next_ + 1) % (delay_max + 1);
  if (escaping_ > 0) {
    --escaping_;
    return held_ = escape_;
  }
  const bool is_stuck = held_.bits() != 0 && velocity.squaredNorm() < still_speed * still_speed;
  stuck_ = is_stuck ? stuck_ + 1 : 0;
  if (stuck_ < stuck_decisions) return held_ = due;
  stuck_ = 0;
  escaping_ = escape_decisions;
  const int up = static_cast<int>(random.below(3)) - 1,
            right = static_cast<int>(random.below(3)) -
                    1;  // apart: the order of arguments is the compiler's
  escape_ = keys_towards(right, up);
  return held_ = escape_;
}

}  // namespace rink::game
