// Contacts that close at the same instant: one problem, not a sequence, so that nobody's number
// decides who is hit first.
#pragma once

#include <cstdint>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/contact/contact_problem.h"
#include "game/physics/contact/impact_solver.h"
#include "game/physics/engine/contact_detection.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Impacts among bodies that touch, directly or through others.
class JointImpacts {
 public:
  struct Uses {
    Clock& clock;
    Bodies& bodies;
    ContactDetection& detection;
    ImpactHistory& history;
    RestContacts& rests;
    EventRecord& record;
    const Observers& observers;
  };
  JointImpacts(const WorldSpec& spec, const Uses& uses);
  JointImpacts(const JointImpacts&) = delete;
  JointImpacts& operator=(const JointImpacts&) = delete;

  /// The impact at hand together with all others that close at this instant. False if there are
  /// none, or if no solution was found that keeps the energy; then nothing has changed, and no
  /// other is looked for until the instant is over.
  bool collide(const Contact& contact, Real time);
  /// An impact that comes alone here would be joint if any of those who touch were hit at this
  /// instant, however far away, by somebody whom this world does not have. So it concerns all of
  /// them, and the journal says so, if there is one; nothing else changes.
  void record_dependencies(const Contact& contact, Real time);

 private:
  /// Whether joint impacts are looked for at all.
  bool is_wanted() const { return !is_rough_ && !clock_.solver_failed; }
  bool gather(const Contact& contact, Real time);
  std::uint32_t place_of(std::uint32_t body, Real time);
  void add_touch(std::uint32_t place, Partner partner, const Contact& at_hand, Real time);
  bool does_another_close(const Contact& at_hand) const;
  void record_dependency();
  void apply(const Contact& at_hand, Real time);
  void count_further(std::uint32_t body, Partner partner, Real time);

  Clock& clock_;
  Bodies& bodies_;
  ContactDetection& detection_;
  ImpactHistory& history_;
  RestContacts& rests_;
  EventRecord& record_;
  const Observers& observers_;
  bool is_rough_;
  Real tolerance_;
  std::vector<std::uint32_t> members_;
  ContactProblem problem_;         // theirs, in the same order
  std::vector<Partner> partners_;  // of its touches
  std::vector<RealVector> velocities_before_;
  ImpactSolver solver_;
};

/// What it is when the two meet. Of two bodies, either may come first.
EventKind impact_kind(const Bodies& bodies, std::uint32_t body, Partner partner);

}  // namespace rink::physics::inline RINK_PRECISION
