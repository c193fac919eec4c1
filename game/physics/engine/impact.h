// What two bodies do to each other at the instant they touch.
#pragma once

#include <cstdint>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/engine/bounce.h"
#include "game/physics/engine/clusters.h"
#include "game/physics/engine/contact_detection.h"
#include "game/physics/engine/joint_impacts.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Decides whether they come to rest on each other, hop, stop, are part of a joint impact, or
/// bounce.
class Impact {
 public:
  struct Uses {
    Clock& clock;
    Bodies& bodies;
    ContactDetection& detection;
    ImpactHistory& history;
    Jams& jams;
    RestContacts& rests;
    EventRecord& record;
    const Observers& observers;
  };
  Impact(const WorldSpec& spec, const Uses& uses);
  Impact(const Impact&) = delete;
  Impact& operator=(const Impact&) = delete;

  /// `is_crowded`: other impacts may come at this instant.
  void collide(std::uint32_t body, Partner partner, Real time, bool is_crowded);
  /// The glide of the body's cluster has come to its end.
  void go_on(std::uint32_t body, Real time) { clusters_.go_on(body, time); }
  /// Before the post goes: it bears nobody any more.
  void leave(std::uint32_t post, Real time) { clusters_.leave(post, time); }

 private:
  void collide_ordered(std::uint32_t body, Partner partner, Real time, bool is_crowded);
  bool rest_or_hop(const Contact& contact, Real approach, Real time);

  const Clock& clock_;
  Bodies& bodies_;
  ContactDetection& detection_;
  ImpactHistory& history_;
  RestContacts& rests_;
  EventRecord& record_;
  Clusters clusters_;
  JointImpacts joint_impacts_;
  Bounce bounce_;
  Real rest_speed_;
  bool allows_overlap_;
};

}  // namespace rink::physics::inline RINK_PRECISION
