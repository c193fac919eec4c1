// Judges received states, and mixes their bits.
#include "game/replication/exact/exact_state.h"

#include <algorithm>

#include "game/physics/subdomain.h"

namespace rink::game {

bool is_possible(const ExactState& state, const physics::WorldSpec& spec, double now) {
  const physics::BodyState& b = state.body;
  const physics::Flight& f = b.flight;
  const physics::Vector2 velocity(f.vx, f.vy);
  const double margin = 1.0;  // m; a scored puck lies a little beyond its goal's line
  return std::isfinite(f.time) && f.time <= now && f.time >= 0.0 && f.x > -margin &&
         f.x < spec.field.length + margin && f.y > -margin && f.y < spec.field.width + margin &&
         velocity.allFinite() && velocity.norm() <= exact::speed_max &&
         b.acceleration.norm() <= 1e6 && b.drag.minCoeff() >= 0.0 && b.drag.maxCoeff() <= 1e6 &&
         b.impacts_begin <= now && b.repeats_instant <= now &&
         b.last_hop <= now + physics::Subdomain::glide_max(spec) &&
         physics::Subdomain::is_possible(b, exact_number_max);
}

bool has_room_for(const physics::BodyState& body, const physics::Subdomain& part) {
  const physics::WorldSpec& spec = part.world().spec();
  if (physics::Subdomain::is_out_of_play(body) || spec.allow_overlap) return true;
  constexpr double rounding = 1e-6;  // m
  const physics::Vector2 place = body.motion().at(part.world().now()).position,
                         extent = body.extent();
  if (!place.allFinite()) return false;
  // A puck may be between the posts of a goal, beyond the field.
  if (body.kind == physics::BodyKind::puck) {
    const double radius = body.flight.radius;
    if (place.x() < radius || place.x() > spec.field.length - radius) return true;
    return part.world().is_free(place, std::max(radius - rounding, rounding * rounding));
  }
  return part.world().inside().is_free(
      place, physics::Vector2((extent - physics::Vector2::Constant(rounding)).cwiseMax(1e-12)));
}

std::uint64_t digest_of(std::uint32_t number, const physics::BodyState& body) {
  std::uint64_t digest = number;
  const auto mix = [&](std::uint64_t word) {
    digest = (digest ^ word) * 0x9e3779b97f4a7c15ULL, digest ^= digest >> 29;
  };
  for (const double value :
       {body.flight.x, body.flight.y, body.flight.vx, body.flight.vy, body.flight.time,
        body.acceleration.x(), body.acceleration.y(), body.drag.x(), body.drag.y(), body.spin})
    mix(std::bit_cast<std::uint64_t>(value + 0.0));  // -0 moves nobody otherwise than 0
  mix(body.flags);
  return digest;
}

}  // namespace rink::game
