// Counting impacts, and the numbers from which on they are too many.
#include "game/physics/bodies/impact_history.h"

#include <algorithm>

#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/tolerances.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr std::uint32_t slow_impacts_max = 8;  // within contact_time, before a hop
constexpr std::uint32_t impacts_max = 24;      // of impacts at any speed, where impacts lose energy
/// Impacts of one body at one and the same instant. Free bodies in overlap part after a few; a body
/// that lies in two fixed ones at once never would.
constexpr std::uint32_t repeats_max = 100;
/// Impacts within roundings of the clock: more than an elastic series takes, masses 1e12 apart.
constexpr std::uint32_t hemmed_in_min = 10'000;
constexpr std::uint32_t rests_max = 8;  // at one instant

}  // namespace

ImpactHistory::ImpactHistory(const WorldSpec& spec, Bodies& bodies, const Observers& observers)
    : bodies_(bodies),
      observers_(observers),
      contact_time_(spec.contact_time),
      rest_speed_(rest_speed(spec)) {}

void ImpactHistory::read(std::uint32_t body, BodyState& state) const {
  const Rhythm& rhythm = rhythms_[body];
  state.impacts_begin = rhythm.window_start, state.last_hop = rhythm.last_hop,
  state.impacts = rhythm.impacts, state.hops = rhythm.hops;
  state.repeats = rhythm.repeats.count, state.repeats_instant = rhythm.repeats.instant;
}

void ImpactHistory::write(std::uint32_t body, const BodyState& state) {
  Rhythm& rhythm = rhythms_[body];
  rhythm.window_start = state.impacts_begin, rhythm.last_hop = state.last_hop,
  rhythm.impacts = state.impacts, rhythm.hops = state.hops;
  rhythm.repeats = {state.repeats_instant, state.repeats};
  rhythm.meetings = {};  // counted anew: they matter from thousands on, when the count of events at
                         // one instant has long had its say
}

void ImpactHistory::note_impact(std::uint32_t body, Real time) {
  bodies_.keep(body);
  Rhythm& rhythm = rhythms_[body];
  if (time - rhythm.window_start > contact_time_) {
    rhythm.window_start = time;
    rhythm.impacts = 0;
  }
  ++rhythm.impacts;
  if (observers_.journal != nullptr) observers_.journal->stir(body, rhythm.impacts);
}

bool ImpactHistory::is_pressed_hard(const Contact& c, Real approach, Real time) const {
  return is_worn(c.body, approach, time) ||
         (!bodies_.is_fixed(c.partner) && is_worn(c.partner, approach, time));
}

bool ImpactHistory::is_worn(std::uint32_t body, Real approach, Real time) const {
  const Rhythm& rhythm = rhythms_[body];
  if (rhythm.impacts >= impacts_max) return true;
  return approach < rest_speed_ &&
         (rhythm.impacts >= slow_impacts_max ||
          (rhythm.last_hop >= 0.0 && time - rhythm.last_hop < 4.0 * contact_time_));
}

void ImpactHistory::note_hop(std::span<const std::uint32_t> members, Real time) {
  for (const std::uint32_t body : members) {
    Rhythm& rhythm = rhythms_[body];
    if (time - rhythm.last_hop > 8.0 * contact_time_) rhythm.hops = 0;
    rhythm.last_hop = time;
    ++rhythm.hops;
    if (observers_.journal != nullptr) observers_.journal->stir(body, 0x80000000u | rhythm.hops);
  }
}

void ImpactHistory::count_meeting(const Contact& c, Real instant_begin) {
  for (const Partner p : {c.body, c.partner})
    if (!bodies_.is_fixed(p)) rhythms_[p].meetings.add(instant_begin);
}

std::uint32_t ImpactHistory::meetings(const Contact& c) const {
  return std::max(rhythms_[c.body].meetings.count,
                  bodies_.is_fixed(c.partner) ? 0u : rhythms_[c.partner].meetings.count);
}

bool ImpactHistory::is_hemmed_in(const Contact& c) const { return meetings(c) > hemmed_in_min; }

bool ImpactHistory::is_beyond_hope(const Contact& c) const {
  return meetings(c) > 2 * hemmed_in_min;
}

bool ImpactHistory::is_stuck(const Contact& c, Real time) {
  const auto has_had_enough = [&](std::uint32_t body) {
    return rhythms_[body].repeats.add(time) > repeats_max;
  };
  const bool is_own = has_had_enough(c.body),
             is_other = !bodies_.is_fixed(c.partner) && has_had_enough(c.partner);
  return is_own || is_other;
}

bool ImpactHistory::has_rested_enough(std::uint32_t body, Real time) {
  return rhythms_[body].repeats.add(time) > rests_max;
}

}  // namespace rink::physics::inline RINK_PRECISION
