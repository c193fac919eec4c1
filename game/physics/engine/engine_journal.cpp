// What a world writes down for the portion that looks at it.
#include <bit>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

BodyState Engine::state_of(std::uint32_t body) const {
  const Body& b = bodies_[body];
  const Build& build = builds_[body];
  const Rhythm& rhythm = rhythms_[body];
  BodyState state;
  state.flight = b;
  state.mass = build.mass, state.inverse_mass = build.inverse_mass,
  state.half_extent = build.half_extent, state.thrust = build.thrust, state.half = build.half;
  state.acceleration = laws_[body].acceleration, state.drag = laws_[body].drag;
  state.impacts_begin = rhythm.window_start, state.last_hop = rhythm.last_hop,
  state.impacts = rhythm.impacts, state.hops = rhythm.hops;
  state.repeats = rhythm.repeats.count, state.repeats_instant = rhythm.repeats.instant;
  if (is_slowed()) state.rest_time = rest_times_[body], state.slowing = slowing_[body];
  if (is_rough()) state.spin = spins_[body];
  state.jam = (b.flags & frozen) != 0 ? jams_[body] : 0;
  state.kind = b.kind, state.material = b.material, state.mouth = b.mouth;
  state.flags = static_cast<std::uint8_t>(b.flags & (gone | held | frozen));
  return state;
}

/// Before it changes otherwise than in a free impact, which leaves all but its flight.
void Engine::keep_state(std::uint32_t body) {
  Journal& journal = *journal_;
  if (journal.marks[body].number > journal.mark) return;
  journal.keep_flight(body, bodies_[body]);
  journal.marks[body].number = journal.mark + 1;
  journal.marks[body].state = static_cast<std::uint32_t>(journal.states.size());
  journal.states.push_back({body, state_of(body)});
}

/// A digest of all but the flight, the same whichever way an impact took. The rhythm of impacts
/// follows from their list, where `stirred` stands for it.
std::uint64_t Engine::conditions_of(std::uint32_t body) const {
  const Body& b = bodies_[body];
  std::uint64_t digest = b.mouth;
  const auto mix = [&](std::uint64_t word) {
    digest = (digest ^ word) * 0x9e3779b97f4a7c15ULL, digest ^= digest >> 29;
  };
  const auto mix_real = [&](Real value) {
    mix(std::bit_cast<std::uint64_t>(static_cast<double>(value)));
  };
  if (is_rough()) mix_real(spins_[body]);
  if (const std::uint8_t lasting = b.flags & (gone | held | frozen | curved); lasting != 0) {
    mix(lasting);
    for (const RealVector& v : {laws_[body].acceleration, laws_[body].drag, builds_[body].thrust})
      mix_real(v.x()), mix_real(v.y());
    if (is_slowed())
      mix_real(rest_times_[body]), mix_real(slowing_[body].x()), mix_real(slowing_[body].y());
  }
  return digest;
}

void Engine::enter_changes() {
  Journal& journal = *journal_;
  const auto enter = [&](std::uint32_t body) {
    journal.enter(body, bodies_[body], conditions_of(body) ^ journal.stirred);
    if ((bodies_[body].flags & (curved | held | frozen | gone)) == 0) return;
    journal.changes.back().motion = static_cast<std::uint32_t>(journal.motions.size());
    journal.motions.push_back(motion(body));
  };
  for (const std::uint32_t body : touched_) enter(body);
  for (const std::uint32_t body : journal.looked_at)
    if ((bodies_[body].flags & touched) == 0) enter(body);
  journal.looked_at.clear();
  journal.stirred = 0;
  ++journal.event;
}

}  // namespace rink::physics::inline RINK_PRECISION
