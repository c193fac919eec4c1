// Two pucks that nothing holds, hitting each other fast and giving back all: nearly every event of
// a gas.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/contact/contact_problem.h"
#include "game/physics/engine/contact_detection.h"
#include "game/physics/engine/next_events.h"
#include "game/physics/engine/prediction.h"
#include "game/physics/flight/motion.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// What an impact of two pucks depends on beside their flights.
struct BounceLaw {
  Real rest_speed;        ///< slower ones may come to rest on each other [m/s]
  Real given_back = 1.0;  ///< restitution
  Real drag = 0.0;        ///< linear, of both [1/s]
};

/// Restarts the flights of both after an impact, and returns the square of the distance of their
/// centres [m^2]. Nothing, and nothing done, if they are in line with an axis, where they might
/// come to rest on each other, or hardly approach or part.
[[gnu::always_inline]] inline std::optional<Real> bounce_freely(Bodies& bodies, std::uint32_t low,
                                                                std::uint32_t high, Real time,
                                                                const BounceLaw& law) {
  const Body &a = bodies[low], &b = bodies[high];
  const Real elapsed_a = a.time < time ? time - a.time : 0.0,
             elapsed_b = b.time < time ? time - b.time : 0.0;
  const WarpedTime warped_a = warp_unaccelerated(elapsed_a, law.drag),
                   warped_b = warp_unaccelerated(elapsed_b, law.drag);
  const Real ax = a.x + a.vx * warped_a.s, ay = a.y + a.vy * warped_a.s,
             bx = b.x + b.vx * warped_b.s, by = b.y + b.vy * warped_b.s, avx = a.vx * warped_a.e,
             avy = a.vy * warped_a.e, bvx = b.vx * warped_b.e, bvy = b.vy * warped_b.e;
  const Real x = ax - bx, y = ay - by;
  if (x == 0.0 || y == 0.0) return std::nullopt;
  const Real approach = x * (bvx - avx) + y * (bvy - avy), length_max = std::abs(x) + std::abs(y),
             square = x * x + y * y;
  const Real speed_max = std::abs(avx) + std::abs(avy) + std::abs(bvx) + std::abs(bvy);
  Real parting = law.given_back * approach;
  if (!(approach >= 1.01 * law.rest_speed * length_max)) return std::nullopt;
  if (!(parting >= 1.01 * (separation_min * speed_max) * length_max)) {
    if (law.given_back != 0.0) return std::nullopt;
    parting = least_parting({avx, avy}, {bvx, bvy}, std::sqrt(square));
  }
  const Real impulse = (approach + parting) / ((a.inverse_mass + b.inverse_mass) * square);
  const Real kick_a = impulse * a.inverse_mass, kick_b = impulse * b.inverse_mass;
  bodies.restart(low, {ax, ay}, {avx + kick_a * x, avy + kick_a * y}, std::max(a.time, time));
  bodies.restart(high, {bx, by}, {bvx - kick_b * x, bvy - kick_b * y}, std::max(b.time, time));
  return square;
}

/// The arithmetic of Impact without its questions, so the same bits.
class FreeImpact {
 public:
  struct Uses {
    Bodies& bodies;
    ContactDetection& detection;
    NextEvents& events;
    Prediction& prediction;
    EventRecord& record;
    const Observers& observers;
  };
  FreeImpact(const WorldSpec& spec, const Uses& uses);
  FreeImpact(const FreeImpact&) = delete;
  FreeImpact& operator=(const FreeImpact&) = delete;

  /// False, with nothing done, for anything else; also if other impacts may come at this instant
  /// (`is_crowded`), and where a third one touches, which matters to
  /// a journal alone. Who is near is looked at where the next events are predicted, so what was
  /// done until then is taken back if there is one.
  bool collide(std::uint32_t body, Partner partner, Real time, bool is_crowded);
  /// Whether the world has such impacts.
  bool is_wanted() const { return is_wanted_; }

 private:
  bool may_be_free(const Body& a, const Body& b) const {
    return (a.flags | b.flags) == 0 && a.kind == BodyKind::puck && b.kind == BodyKind::puck &&
           is_wanted_ && restitution_(a.material, b.material) == 1.0;
  }
  bool predict_alone(std::uint32_t low, std::uint32_t high);
  [[gnu::always_inline]] inline void notify(std::uint32_t low, const Flight& before_low,
                                            std::uint32_t high, const Flight& before_high,
                                            Real time);

  const RestitutionTable& restitution_;
  Bodies& bodies_;
  ContactDetection& detection_;
  NextEvents& events_;
  Prediction& prediction_;
  EventRecord& record_;
  const Observers& observers_;
  Real rest_speed_;
  bool is_wanted_;  // decided by the spec
};

}  // namespace rink::physics::inline RINK_PRECISION
