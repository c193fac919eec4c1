// One step down by what the load asks for, single steps up.
#include "game/net/server/overload/overload_control.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace rink::game {
namespace {

/// Steps of at most a factor of two, so that a step up needs no more than half of a tick idle.
constexpr std::array<std::uint32_t, 8> steps{1, 2, 3, 4, 6, 8, 12, OverloadControl::divisor_max};

/// Of a tick's length, what ticks take at most that make up for those that were late.
constexpr double catches_up = 0.9;

/// Part of the time below which clients are told more often where the game alone takes too long:
/// told at most twice as often, they take no more than half.
constexpr double telling_min = 0.25;

/// The least step that is at least `divisor`, or the last.
std::uint32_t step_from(double divisor) {
  for (const std::uint32_t each : steps)
    if (each >= divisor) return each;
  return steps.back();
}

/// The last step that is at most `divisor`, or 1.
std::uint32_t step_to(double divisor) {
  std::uint32_t last = 1;
  for (const std::uint32_t each : steps)
    if (each <= divisor) last = each;
  return last;
}

std::uint32_t step_below(std::uint32_t divisor) {
  assert(divisor > 1);
  std::uint32_t below = 1;
  for (const std::uint32_t each : steps)
    if (each < divisor) below = each;
  return below;
}

}  // namespace

OverloadControl::OverloadControl(const Settings& settings)
    : settings_(settings), calm_needed_s_(settings.calm_s) {
  assert(settings.tick_s > 0.0 && settings.late_s > 0.0 && settings.calm_s > 0.0);
  assert(0.0 < settings.load_max && settings.load_max < 1.0);
}

bool OverloadControl::ticked(double due_s, double begin_s, double end_s, double telling_s) {
  assert(begin_s <= end_s);
  const bool is_late = end_s > due_s + settings_.tick_s;
  (is_late ? calm_ : late_) = {};
  Stretch& stretch = is_late ? late_ : calm_;
  if (stretch.ticks++ == 0) {
    stretch.from_s = end_s;
    return false;
  }
  stretch.busy_s += end_s - begin_s;
  stretch.telling_s += telling_s;
  if (!is_late) return speed_up(end_s);
  if (end_s < stretch.from_s + settings_.late_s) return false;
  return slow_down(end_s);
}

/// A server that is late never waits, so that the time between two ticks is what one takes,
/// receiving included. What a tick costs beside telling clients is unknown, so that one step may
/// not do; the next follows after as long.
bool OverloadControl::slow_down(double end_s) {
  const double ticks = static_cast<double>(late_.ticks - 1),
               between_s = (end_s - late_.from_s) / ticks, telling_s = late_.telling_s / ticks,
               load = between_s / settings_.tick_s;
  late_ = {};
  // After a stall, and after ticks were left out, the ticks catch up by themselves.
  if (load < catches_up) return false;
  if (between_s - telling_s >= catches_up * settings_.tick_s)
    return share_out(between_s, telling_s);
  divisor_most_ = divisor_max;
  const std::uint32_t wanted = step_from(std::max(divisor_ + 1.0, divisor_ * load));
  if (wanted <= divisor_) return false;
  const bool is_relapse = has_sped_up_ && end_s < sped_up_s_ + 2.0 * calm_needed_s_;
  calm_needed_s_ =
      is_relapse ? std::min(2.0 * calm_needed_s_, settings_.calm_max_s) : settings_.calm_s;
  has_sped_up_ = false;
  return change_to(wanted);
}

/// Simulating alone takes longer than a tick, so that no divisor brings the ticks in time. They
/// come every `between_s`, of which sending takes `telling_s` [s]. Sending gets half of the time,
/// as long as each client is updated within `told_within_s`: with few updates and ever longer ticks
/// clients had no news for half a minute.
bool OverloadControl::share_out(double between_s, double telling_s) {
  const double within_s = settings_.told_within_s, game_s = between_s - telling_s;
  if (divisor_ > 1 && (telling_s < telling_min * between_s || divisor_ * between_s > within_s)) {
    divisor_most_ = std::min(step_below(divisor_), step_to(within_s / between_s));
    return change_to(divisor_most_);
  }
  const std::uint32_t wanted = std::min(
      {step_to(divisor_ * telling_s / game_s), step_to((within_s - divisor_ * telling_s) / game_s),
       telling_s > game_s ? divisor_max : divisor_most_});  // a bound that has aged
  return wanted > divisor_ && change_to(wanted);
}

/// Work grows at most as the turns do.
bool OverloadControl::speed_up(double end_s) {
  if (end_s < calm_.from_s + calm_needed_s_) return false;
  const double load = calm_.busy_s / (static_cast<double>(calm_.ticks - 1) * settings_.tick_s);
  calm_ = {};
  if (divisor_ == 1) return false;
  const std::uint32_t next = step_below(divisor_);
  if (load * divisor_ > settings_.load_max * next) return false;
  has_sped_up_ = true;
  sped_up_s_ = end_s;
  divisor_most_ = divisor_max;
  return change_to(next);
}

bool OverloadControl::change_to(std::uint32_t divisor) {
  assert(divisor != divisor_ && 1 <= divisor && divisor <= divisor_max);
  divisor_ = divisor;
  divisor_reached_ = std::max(divisor_reached_, divisor);
  ++changes_;
  return true;
}

std::uint64_t OverloadControl::ticks_left_out(double due_s, double now_s) const {
  const double behind_s = now_s - due_s;
  if (behind_s <= settings_.behind_max_s) return 0;
  return static_cast<std::uint64_t>(std::floor(behind_s / settings_.tick_s));
}

}  // namespace rink::game
