// Sorts bodies by whether the keeper of a copy has them.
#include "game/peer/standby/known_bodies.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "game/peer/standby/packed_states.h"

namespace rink::peer {

void leave_out_known(PartRecord& record, PeerNumber keeper, const Share& share,
                     const Validator& scene) {
  PartInput& committed = record.committed;
  assert(committed.known.empty());
  StatePacker others(scene);
  [[maybe_unused]] const bool is_read =
      unpack(committed.states, scene, [&](const Handover::Body& body) {
        const bool is_known = share.owns(body.number)
                                  ? share.knows(keeper, body.number)
                                  : share.roles().has_ghost_of(keeper, body.number);
        if (is_known) committed.known.push_back(body.number);
        else others.add(body.number, body.state);
      });
  assert(is_read);
  committed.states = others.take();
}

std::string put_back_known(PartRecord& record, const Share& share, const Validator& scene) {
  if (!record.repeated.known.empty()) return "sends a ghost of a run without its state";
  if (record.committed.known.empty()) return {};
  std::vector<std::uint32_t> known = std::exchange(record.committed.known, {});
  // First, for a state is a hundred times as long as a number.
  std::ranges::sort(known);
  if (const auto twice = std::ranges::adjacent_find(known); twice != known.end())
    return "has body " + std::to_string(*twice) + " twice";
  std::vector<Handover::Body> bodies;
  for (const std::uint32_t body : known) {
    if (!scene.has_body(body) || share.roles().of(body) == Role::away)
      return "says that body " + std::to_string(body) + " is here, which is not";
    // That of the window's start, should it be played already.
    bodies.push_back({body, share.subdomain().state_before(body)});
  }
  if (!unpack(record.committed.states, scene,
              [&](const Handover::Body& body) { bodies.push_back(body); }))
    return "sends what are no states of bodies";
  std::ranges::sort(bodies, {}, &Handover::Body::number);
  const auto twice = std::ranges::adjacent_find(bodies, {}, &Handover::Body::number);
  if (twice != bodies.end()) return "has body " + std::to_string(twice->number) + " twice";
  StatePacker packer(scene);
  for (const auto& [body, state] : bodies) packer.add(body, state);
  record.committed.states = packer.take();
  return {};
}

}  // namespace rink::peer
