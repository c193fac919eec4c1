// Writes what an event did to each of its bodies into the journal.
#include "game/physics/bodies/change_entries.h"

#include <bit>
#include <cassert>

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// A digest of all but the flight, the same whichever way an impact took. The rhythm of impacts
/// follows from their list, where `mixed_digest` stands for it.
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

}  // namespace

void enter_changes(Journal& journal, const Bodies& bodies) {
  assert(journal.rooms_of.size() == bodies.count());
  const auto enter = [&](std::uint32_t body) {
    journal.enter({body, bodies[body], conditions_of(bodies, body) ^ journal.mixed_digest});
    if ((bodies[body].flags & (Body::curved | Body::held | Body::frozen | Body::gone)) == 0) return;
    journal.changes.back().motion = static_cast<std::uint32_t>(journal.motions.size());
    journal.motions.push_back(bodies.motion(body));
  };
  for (const std::uint32_t body : bodies.touched()) enter(body);
  for (const std::uint32_t body : journal.looked_at)
    if ((bodies[body].flags & Body::touched) == 0) enter(body);
  journal.looked_at.clear();
  journal.mixed_digest = 0;
  ++journal.event;
}

}  // namespace rink::physics::inline RINK_PRECISION
