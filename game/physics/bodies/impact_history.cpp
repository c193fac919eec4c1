// Counting impacts, and the numbers from which on they are too many.
#include "game/physics/bodies/impact_history.h"

#include <algorithm>
#include <cassert>
#include <tuple>

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
constexpr std::uint32_t jammed_min = 10'000;
constexpr std::uint32_t rests_max = 8;     // at one instant
constexpr std::uint32_t restless_min = 8;  // impacts within contact_time: glides would end at once

}  // namespace

ImpactHistory::ImpactHistory(const WorldSpec& spec, Bodies& bodies, const Observers& observers)
    : bodies_(bodies),
      observers_(observers),
      contact_time_(spec.contact_time),
      rest_speed_(rest_speed(spec)) {
  assert(spec.contact_time > 0.0);
}

void ImpactHistory::read(std::uint32_t body, BodyState& state) const {
  const ImpactCounts& counts = impact_counts_[body];
  state.impacts_begin = counts.window_start, state.last_hop = counts.last_hop,
  state.impacts = counts.impacts, state.hops = counts.hops;
  state.repeats = counts.repeats.count, state.repeats_instant = counts.repeats.instant;
}

void ImpactHistory::write(std::uint32_t body, const BodyState& state) {
  assert(body < impact_counts_.size());
  ImpactCounts& counts = impact_counts_[body];
  counts.window_start = state.impacts_begin, counts.last_hop = state.last_hop,
  counts.impacts = state.impacts, counts.hops = state.hops;
  counts.repeats = {state.repeats_instant, state.repeats};
  counts.first_contacts = {};  // counted anew: they matter from thousands on, when the count of
                               // events at one instant has long had its say
}

void ImpactHistory::note_impact(std::uint32_t body, Real time) {
  bodies_.keep(body);
  ImpactCounts& counts = impact_counts_[body];
  if (time - counts.window_start > contact_time_) {
    counts.window_start = time;
    counts.impacts = 0;
  }
  ++counts.impacts;
  if (observers_.journal != nullptr) observers_.journal->mix_digest(body, counts.impacts);
}

bool ImpactHistory::would_be_worn(std::uint32_t body, Real time) const {
  assert(body < impact_counts_.size());
  const ImpactCounts& counts = impact_counts_[body];
  return !(time - counts.window_start > contact_time_) && counts.impacts + 1 >= impacts_max;
}

void ImpactHistory::take_back(std::uint32_t body, const ImpactCounts& before) {
  assert(body < impact_counts_.size());
  ImpactCounts& counts = impact_counts_[body];
  if (std::tie(before.window_start, before.impacts) < std::tie(counts.window_start, counts.impacts))
    counts.window_start = before.window_start, counts.impacts = before.impacts;
  RepeatCount& contacts = counts.first_contacts;
  const RepeatCount& earlier = before.first_contacts;
  if (std::tie(earlier.instant, earlier.count) < std::tie(contacts.instant, contacts.count))
    contacts = earlier;
}

bool ImpactHistory::is_pressed_hard(const Contact& c, Real approach, Real time) const {
  return is_worn(c.body, approach, time) ||
         (!bodies_.is_fixed(c.partner) && is_worn(c.partner, approach, time));
}

bool ImpactHistory::is_worn(std::uint32_t body, Real approach, Real time) const {
  const ImpactCounts& counts = impact_counts_[body];
  if (counts.impacts >= impacts_max) return true;
  return approach < rest_speed_ &&
         (counts.impacts >= slow_impacts_max ||
          (counts.last_hop >= 0.0 && time - counts.last_hop < 4.0 * contact_time_));
}

void ImpactHistory::note_hop(std::span<const std::uint32_t> members, Real time) {
  assert(!members.empty());
  for (const std::uint32_t body : members) {
    ImpactCounts& counts = impact_counts_[body];
    if (time - counts.last_hop > 8.0 * contact_time_) counts.hops = 0;
    counts.last_hop = time;
    ++counts.hops;
    if (observers_.journal != nullptr)
      observers_.journal->mix_digest(body, 0x80000000u | counts.hops);
  }
}

bool ImpactHistory::is_restless(const Contact& c) const {
  return impact_counts_[c.body].impacts >= restless_min ||
         (!bodies_.is_fixed(c.partner) && impact_counts_[c.partner].impacts >= restless_min);
}

void ImpactHistory::count_meeting(const Contact& c, Real instant_begin) {
  assert(is_body(c.body) && c.body != c.partner);
  for (const Partner p : {c.body, c.partner})
    if (!bodies_.is_fixed(p)) impact_counts_[p].first_contacts.add(instant_begin);
}

std::uint32_t ImpactHistory::first_contacts(const Contact& c) const {
  return std::max(
      impact_counts_[c.body].first_contacts.count,
      bodies_.is_fixed(c.partner) ? 0u : impact_counts_[c.partner].first_contacts.count);
}

bool ImpactHistory::is_jammed(const Contact& c) const { return first_contacts(c) > jammed_min; }

bool ImpactHistory::is_stalled(const Contact& c) const {
  return first_contacts(c) > 2 * jammed_min;
}

bool ImpactHistory::is_stuck(const Contact& c, Real time) {
  const auto has_had_enough = [&](std::uint32_t body) {
    return impact_counts_[body].repeats.add(time) > repeats_max;
  };
  const bool is_own = has_had_enough(c.body),
             is_other = !bodies_.is_fixed(c.partner) && has_had_enough(c.partner);
  return is_own || is_other;
}

bool ImpactHistory::has_rested_enough(std::uint32_t body, Real time) {
  return impact_counts_[body].repeats.add(time) > rests_max;
}

}  // namespace rink::physics::inline RINK_PRECISION
