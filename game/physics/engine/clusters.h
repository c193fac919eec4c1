// Pressed clusters whose normals turn: taken out of contact in one step, and frozen where they are
// in equilibrium.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/contact/contact_problem.h"
#include "game/physics/contact/glide_solver.h"
#include "game/physics/contact/interior_point.h"
#include "game/physics/contact/separation_solver.h"
#include "game/physics/engine/contact_detection.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// A cluster is everybody connected by gaps too small to be seen.
class Clusters {
 public:
  struct Uses {
    Bodies& bodies;
    ContactDetection& detection;
    ImpactHistory& history;
    Jams& jams;
    RestContacts& rests;
    EventRecord& record;
    const Observers& observers;
  };
  Clusters(const WorldSpec& spec, const Uses& uses);
  Clusters(const Clusters&) = delete;
  Clusters& operator=(const Clusters&) = delete;

  /// Gives the cluster around `contact` the nearest velocities (in the metric of the masses) that
  /// part all its contacts by a little: half of what its thrust, or the difference in drag that
  /// closes `contact` by `pressing` [m/s^2], builds up within the contact time. False, with nothing
  /// done to velocities, if an ordinary impact serves: nothing presses, and nothing is lost or the
  /// contact is alone.
  bool hop(const Contact& contact, Real approach, Real pressing, Real time);
  /// After a glide of the body, which comes to its end: all that still hangs together hops anew.
  void go_on(std::uint32_t body, Real time);
  /// Where two of a moving pile meet on their way after all, or one slowly something fixed: it goes
  /// on anew, as if its glide had ended, instead of falling apart into clusters. False if they are
  /// not of one pile, or if it cannot; then its glide has ended at most.
  bool meet_within_pile(const Contact& contact, Real time);
  /// Ends every equilibrium that the post may bear.
  void leave(std::uint32_t post, Real time);
  /// Stops all that hangs together with the contact, for as long as nothing else acts on it.
  void stop_around(const Contact& contact, Real time);

 private:
  /// Up to which gap [m], and which speed of closing or opening [m/s], a contact belongs to the
  /// cluster, and of how many bodies that consists at most. Those within `sight` [m] are asked when
  /// they may come; if one does before `clear` [s], the rest is not gathered. With a sight, members
  /// keep their rest contacts for now.
  struct Limits {
    Real gap, speed;
    std::size_t members = 256;
    Real sight = 0.0, clear = -infinity;
  };

  /// How fast a contact closes, and how that is pressed [m/s^2].
  struct Closing {
    const Contact& contact;
    Real approach, pressing;
  };

  bool hop_gathered(const Closing& closing, const Limits& limits, Real time);
  bool should_flow(const Contact& contact) const;
  bool has_turning() const;
  void gather(const Contact& contact, const Limits& limits, Real time);
  bool is_member(std::uint32_t body) const {
    const std::uint32_t place = places_[body];
    return place < members_.size() && members_[place] == body;
  }
  std::uint32_t place_of(std::uint32_t body, const Limits& limits, Real time);
  void add_contact(std::uint32_t place, Partner partner, const Limits& limits, Real time);
  bool freeze(Real time);
  bool freeze_loosely(const Contact& contact, Real time);
  void part(Real pressure, Real pressing, Real thrust);
  bool glide(const Contact& contact, Real thrust, Real time);
  Glide glide_of(Real thrust, Real turn, Real room) const;
  bool find_forces(const Glide& glide);
  void begin_glide(const std::vector<RealVector>& accelerations, Real end);

  // clusters_piles.cpp
  bool flow(const Contact& contact, Real time);
  bool comes_slowly(const Contact& contact, Real time) const;
  bool may_flow(Real thrust) const;
  bool flow_as_one(Real time);
  void free_members(Real time);
  bool could_flow_at(const RealVector& common);
  bool bears_thrust(const RealVector& common);
  void load_thrust(const RealVector& common);
  bool share_drag() const;
  RealVector drift() const;
  RealVector along_fixed(RealVector velocity, bool holds) const;
  template <class Bears>
  std::optional<RealVector> common_velocity(const RealVector& drift, Bears&& bears) const;
  void move_as_one(const RealVector& common, Real time);
  Real reach_of(const Contact& contact) const;
  void limit_by_face(const Contact& contact, Real time);
  Real mass() const;
  bool is_rattling(Real approach) const;
  Real thrust_max() const;
  Real turning() const;
  Real glancing_speed(Real thrust, Real pressing, Real speed) const;
  Real still_speed() const;

  const WorldSpec& spec_;
  Bodies& bodies_;
  ContactDetection& detection_;
  ImpactHistory& history_;
  Jams& jams_;
  RestContacts& rests_;
  EventRecord& record_;
  const Observers& observers_;
  Real glide_max_, rest_speed_;  // s, m/s
  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> places_;  // by body; of a member, where it is in `members_`
  ContactProblem problem_;             // theirs, in the same order
  SeparationSolver solver_;
  InteriorPoint interior_;
  GlideSolver glide_solver_{interior_};
  std::vector<Drive> drives_;           // of the members
  std::vector<RealVector> velocities_;  // theirs, before a glide was tried
  /// Until the first of them reaches the end of another one's face, or somebody else may come [s].
  Real clear_time_ = 0.0;
  ContactProblem loads_;  // thrusts instead of velocities
};

/// The velocity at which all may move on as one, given that of their centre of mass: `bears` says
/// whether contacts bear all thrust then. What they move away from bears nothing; where it must,
/// thrust brings them back to it at once.
template <class Bears>
std::optional<RealVector> Clusters::common_velocity(const RealVector& drift, Bears&& bears) const {
  const RealVector leaving = along_fixed(drift, false), held = along_fixed(drift, true);
  if (bears(leaving)) return leaving;
  if (held != leaving && bears(held)) return held;
  return std::nullopt;
}

}  // namespace rink::physics::inline RINK_PRECISION
