// What a world writes down for the portion that looks at it.
#include <bit>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

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
  if (spec_.surface_friction) mix_real(bodies_.spin(body));
  if (const std::uint8_t lasting =
          b.flags & (Body::gone | Body::held | Body::frozen | Body::curved);
      lasting != 0) {
    mix(lasting);
    for (const RealVector& v :
         {bodies_.law(body).acceleration, bodies_.law(body).drag, bodies_.build(body).thrust})
      mix_real(v.x()), mix_real(v.y());
    if (bodies_.is_slowed())
      mix_real(bodies_.rest_time(body)), mix_real(bodies_.slowing(body).x()),
          mix_real(bodies_.slowing(body).y());
  }
  return digest;
}

void Engine::enter_changes() {
  Journal& journal = *observers_.journal;
  const auto enter = [&](std::uint32_t body) {
    journal.enter({body, bodies_[body], conditions_of(body) ^ journal.stirred});
    if ((bodies_[body].flags & (Body::curved | Body::held | Body::frozen | Body::gone)) == 0)
      return;
    journal.changes.back().motion = static_cast<std::uint32_t>(journal.motions.size());
    journal.motions.push_back(bodies_.motion(body));
  };
  for (const std::uint32_t body : bodies_.touched()) enter(body);
  for (const std::uint32_t body : journal.looked_at)
    if ((bodies_[body].flags & Body::touched) == 0) enter(body);
  journal.looked_at.clear();
  journal.stirred = 0;
  ++journal.event;
}

}  // namespace rink::physics::inline RINK_PRECISION
