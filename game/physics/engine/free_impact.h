// Two pucks that nothing holds, hitting each other fast and giving back all: nearly every event of
// a gas.
#pragma once

#include <cstdint>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/engine/contact_detection.h"
#include "game/physics/engine/next_events.h"
#include "game/physics/engine/prediction.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

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
