// Packs the bodies in a peer's zones and around them.
#include "game/peer/standby/part_at_start.h"

#include <cassert>

#include "game/peer/standby/packed_states.h"

namespace rink::peer {

PartSnapshot part_at_start(const Start& start, const Division& division, PeerNumber peer,
                           double halo, const Validator& scene) {
  assert(peer < division.peer_count() && start.body_count() == scene.body_count());
  StatePacker packer(scene);
  start.visit([&](std::uint32_t body, const physics::World& world, physics::BodyId id) {
    const Vector2 place = world.position(id);
    if (division.owner_of(place) == peer ||
        division.is_near(peer, Box::around(place, world.half_extent(id)), halo))
      packer.add(body, physics::Subdomain::state_in(world, id.index));
  });
  return {.states = packer.take()};
}

}  // namespace rink::peer
