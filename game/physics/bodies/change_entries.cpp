// Writes what an event did to each of its bodies into the journal.
#include "game/physics/bodies/change_entries.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "im/basics/sorted_set.h"

namespace rink::physics::inline RINK_PRECISION {

std::uint64_t conditions_of(const Bodies& bodies, std::uint32_t body) {
  const Body& b = bodies[body];
  std::uint64_t digest = b.mouth;
  const auto mix = [&](std::uint64_t word) {
    digest = (digest ^ word) * 0x9e3779b97f4a7c15ULL, digest ^= digest >> 29;
  };
  const auto mix_real = [&](Real value) {
    mix(std::bit_cast<std::uint64_t>(static_cast<double>(value)));
  };
  if (bodies.has_spins()) mix_real(bodies.spin(body));
  if (const std::uint8_t lasting =
          b.flags & (Body::gone | Body::held | Body::frozen | Body::curved);
      lasting != 0) {
    mix(lasting);
    for (const RealVector& v :
         {bodies.law(body).acceleration, bodies.law(body).drag, bodies.build(body).thrust})
      mix_real(v.x()), mix_real(v.y());
    if (bodies.is_slowed())
      mix_real(bodies.rest_time(body)), mix_real(bodies.slowing(body).x()),
          mix_real(bodies.slowing(body).y());
  }
  return digest;
}

namespace {

/// Drops the bodies that the current event found at places which they reached only after it. None
/// of them was near enough to take part, or else the check rejects the window.
void forget_later(Journal& journal, const Bodies& bodies) {
  const auto later = std::erase_if(journal.sight.looked_at, [&](std::uint32_t body) {
    return bodies[body].time > journal.time && !bodies[body].is(Body::touched);
  });
  if (later > 0 && std::ranges::any_of(journal.sight.looked_at, [&](std::uint32_t body) {
        return !bodies[body].is(Body::touched);
      }))
    journal.parts = Journal::Parts::unsure;
}

/// Whether the event was an impact of two free pucks without loss, and of nobody else. Which way it
/// took depends on what else came at its instant, anywhere.
bool is_free_impact(const Journal& journal, const Bodies& bodies) {
  const auto is_free = [&](std::uint32_t body) {
    const Body& b = bodies[body];
    return b.kind == BodyKind::puck && (b.flags & ~Body::touched) == 0;
  };
  const auto is_touched = [&](std::uint32_t body) { return bodies[body].is(Body::touched); };
  return bodies.touched().size() == 2 && journal.mixed_digest == 0 && journal.sight.reach == 0.0 &&
         std::ranges::all_of(bodies.touched(), is_free) &&
         std::ranges::all_of(journal.sight.looked_at, is_touched);
}

}  // namespace

void enter_changes(Journal& journal, const Bodies& bodies, bool may_be_quiet) {
  assert(journal.rooms_of.size() == bodies.count());
  if (journal.sight.reach > 0.0)
    make_sorted_set(journal.sight.looked_at);  // by a pile and a joint impact
  if (journal.parts != Journal::Parts::none) {
    // Who else a pile looked for may be where it flew to later, and only its own place tells.
    if (journal.sight.reach > 0.0) journal.parts = Journal::Parts::unsure;
    forget_later(journal, bodies);
  }
  if (may_be_quiet && is_free_impact(journal, bodies)) {
    const std::uint32_t low = bodies.touched()[0], high = bodies.touched()[1];
    journal.enter_impact({low, bodies[low], conditions_of(bodies, low)},
                         {high, bodies[high], conditions_of(bodies, high)});
    journal.sight.clear();
    ++journal.event;
    return;
  }
  const auto enter = [&](std::uint32_t body) {
    journal.enter({body, bodies[body], conditions_of(bodies, body) ^ journal.mixed_digest});
    if ((bodies[body].flags & (Body::curved | Body::held | Body::frozen | Body::gone)) == 0) return;
    journal.changes.back().motion = static_cast<std::uint32_t>(journal.motions.size());
    journal.motions.push_back(bodies.motion(body));
  };
  for (const std::uint32_t body : bodies.touched()) enter(body);
  for (const std::uint32_t body : journal.sight.looked_at)
    if ((bodies[body].flags & Body::touched) == 0) enter(body);
  journal.sight.clear();
  journal.mixed_digest = 0;
  ++journal.event;
}

}  // namespace rink::physics::inline RINK_PRECISION
