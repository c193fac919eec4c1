// Writes and reads changes, and finds bodies in others' zones.
#include "game/peer/session/part_change.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/peer/message_bytes.h"
#include "game/physics/subdomain.h"

namespace rink::peer {

namespace {

/// As that of the other messages of every window, most of which are short.
constexpr std::size_t checksum_size = 4;

}  // namespace

std::vector<std::uint8_t> written(PartChange message) { return bytes_from(message, checksum_size); }
bool read(std::span<const std::uint8_t> bytes, PartChange& message) {
  return read_whole(bytes, message, checksum_size);
}

Vector2 place_of(const BodyState& state, double time) {
  return physics::Subdomain::is_out_of_play(state) ? Vector2(state.flight.x, state.flight.y)
                                                   : state.motion().at(time).position;
}

std::optional<std::uint32_t> first_elsewhere(std::span<const Handover::Body> bodies, double time,
                                             const Division& division,
                                             std::span<const PeerNumber> owners) {
  constexpr double rounding = 1e-6;  // m: far more than a place is rounded by
  assert(std::isfinite(time));
  for (const auto& [body, state] : bodies) {
    const Box place = Box::around(place_of(state, time), {0.0, 0.0});
    if (std::ranges::none_of(
            owners, [&](PeerNumber owner) { return division.is_near(owner, place, rounding); }))
      return body;
  }
  return std::nullopt;
}

}  // namespace rink::peer
