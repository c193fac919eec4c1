// Piles: large pressed clusters, which move on together with all who may come into contact on the
// way, and as one where nothing gives way any more.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/physics/bodies/tolerances.h"
#include "game/physics/engine/clusters.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr std::size_t pile_max = 4096;      // bodies
constexpr std::size_t pile_min = 32;        // bodies besides one
constexpr double closing_max = 100.0;       // of the rest speed: who may come during a glide
constexpr double sight = 4.0;               // of the gap up to which they belong to the pile
constexpr double overlap_max = 1e-9;        // m; where more is allowed there are no piles
constexpr double pile_turn = 1.0 / 8.0;     // of a normal during a glide [rad]
constexpr double flow_accuracy = 1e-6;      // of speeds; the opening makes room for it
constexpr double load_accuracy = 1e-12;     // of thrusts, squared
constexpr double borne_part = 1e-4;         // of the strongest thrust [N]: what is less is borne
constexpr double one_body_glides = 1000.0;  // longest ones, before it is looked at again

}  // namespace

/// Gathers the pile, and lets it move on. Answers whether it could; else nobody is freed, and a
/// cluster is to be gathered anew.
bool Clusters::flow(const Contact& c, Real time) {
  const Real gap = closing_max * rest_speed_ * glide_max_;
  gather(c, {gap, infinity, pile_max, sight * gap, Real(spec_.contact_time)}, time);
  const Real thrust = thrust_max();
  if (!may_flow(thrust)) return false;
  for (std::size_t place = 0; place < members_.size(); ++place)
    problem_.velocities[place] = bodies_.velocity(members_[place]);
  const Real energy = problem_.energy();
  Glide glide = glide_of(thrust, pile_turn, infinity);
  glide.opening += 2.0 * flow_accuracy * problem_.speed();
  for (Touch& touch : problem_.touches)
    touch.wanted = glide.opening - std::max<Real>(0.0, touch.gap) / glide.duration;
  if (!interior_.solve(problem_, flow_accuracy)) return false;
  problem_.velocities = interior_.velocities();
  if (flow_as_one(time)) return record_.note(EventKind::freeze, time, c.body), true;
  glide.duration = std::min(glide.duration, glide_of(thrust, pile_turn, infinity).duration);
  if (!find_forces(glide)) return false;
  free_members(time);
  history_.note_hop(members_, time);
  begin_glide(glide_solver_.accelerations(), time + glide.duration);
  record_.note(EventKind::hop, time, c.body, c.partner);
  record_.counters().hop_energy += static_cast<double>(
      std::max<Real>(0.0, problem_.energy() - energy) + glide_solver_.work_max());
  return true;
}

/// Gaps up to which anybody belongs to a pile are those across which a post may bear one.
void Clusters::leave(std::uint32_t post, Real time) {
  const std::vector<std::uint32_t> frozen = jams_.table().frozen;
  for (const std::uint32_t body : frozen)
    if (bodies_[body].is(Body::frozen) &&
        detection_.contact_within(body, post, closing_max * rest_speed_ * glide_max_, time))
      jams_.wake(body, time);
}

/// To something fixed: a pile that moves as one bounces off a wall as anything does.
bool Clusters::comes_slowly(const Contact& c, Real time) const {
  if (!bodies_.is_fixed(c.partner)) return false;
  const RealVector normal = detection_.contact(c.body, c.partner, time).gap.normal;
  return -normal.dot(motion_at(bodies_, c.body, time).velocity) < rest_speed_;
}

bool Clusters::meet_within_pile(const Contact& c, Real time) {
  if (!bodies_[c.body].is(Body::frozen)) return false;
  std::size_t others = 0;
  bool is_within = c.partner == partner::none || comes_slowly(c, time);
  jams_.for_each_other(c.body, [&](std::uint32_t other) {
    ++others;
    is_within = is_within || other == c.partner;
  });
  if (!is_within || others < pile_min) return false;
  rests_.rouse(c.body, time);
  return flow(c, time);
}

bool Clusters::may_flow(Real thrust) const {
  return thrust > 0.0 && !bodies_.is_slowed() && has_turning() &&
         clear_time_ >= Real(spec_.contact_time) &&
         std::all_of(problem_.touches.begin(), problem_.touches.end(), [](const Touch& touch) {
           return touch.restitution < 1.0 && touch.gap > -overlap_max;
         });
}

/// Only now that the pile moves on: one that cannot keeps its rest contacts.
void Clusters::free_members(Real time) {
  for (const std::uint32_t body : members_) rests_.free(body, time);
}

/// Of their centre of mass.
RealVector Clusters::drift() const {
  RealVector momentum(0.0, 0.0);
  for (std::size_t place = 0; place < members_.size(); ++place)
    momentum += problem_.masses[place] * problem_.velocities[place];
  return momentum / mass();
}

bool Clusters::share_drag() const {
  const Real drag = bodies_.own_drag(members_.front());
  return std::all_of(members_.begin(), members_.end(),
                     [&](std::uint32_t body) { return bodies_.own_drag(body) == drag; });
}

/// What is left of `velocity` where what is fixed and near lets nobody come nearer; nor farther, if
/// it `holds`.
RealVector Clusters::along_fixed(RealVector velocity, bool holds) const {
  for (RealVector before(infinity, infinity); velocity != before;) {
    before = velocity;
    for (const Touch& touch : problem_.touches) {
      if (touch.other != fixed_place || touch.gap > rest_speed_ * glide_max_ ||
          (!holds && touch.normal.dot(velocity) > 0.0))
        continue;
      for (int axis = 0; axis < 2; ++axis)
        if (touch.normal[axis] != 0.0) velocity[axis] = 0.0;
    }
  }
  return velocity;
}

/// Where forces bear all thrust, what the bodies still move against each other would be lost
/// between them within the room that they have: they move on as one, until something acts on them.
bool Clusters::flow_as_one(Real time) {
  const std::optional<RealVector> common =
      common_velocity(drift(), [&](const RealVector& velocity) { return could_flow_at(velocity); });
  if (!common) return false;
  free_members(time);
  history_.note_hop(members_, time);
  move_as_one(*common, time);
  return true;
}

bool Clusters::could_flow_at(const RealVector& common) {
  const Real apart = problem_.energy() - 0.5 * mass() * common.squaredNorm();
  return (common == RealVector(0.0, 0.0) || share_drag()) &&
         apart <= 0.5 * mass() * rest_speed_ * rest_speed_ && bears_thrust(common);
}

void Clusters::move_as_one(const RealVector& common, Real time) {
  std::fill(problem_.velocities.begin(), problem_.velocities.end(), common);
  velocities_.assign(members_.size(), RealVector(0.0, 0.0));
  begin_glide(velocities_, time + one_body_glides * glide_max_);
}

/// Of contacts that last while all move on at `common`.
void Clusters::load_thrust(const RealVector& common) {
  loads_ = problem_;
  std::erase_if(loads_.touches, [&](const Touch& touch) {
    return touch.gap > rest_speed_ * glide_max_ ||
           (touch.other == fixed_place && touch.normal.dot(common) > 0.0);
  });
  for (std::size_t place = 0; place < members_.size(); ++place)
    loads_.velocities[place] = bodies_.build(members_[place]).thrust;
}

bool Clusters::bears_thrust(const RealVector& common) {
  load_thrust(common);
  for (Touch& touch : loads_.touches) touch.wanted = 0.0;
  Real strongest = 0.0;
  for (std::size_t place = 0; place < members_.size(); ++place)
    strongest = std::max(strongest, loads_.masses[place] * loads_.velocities[place].norm());
  if (!interior_.solve(loads_, load_accuracy)) return false;
  for (std::size_t place = 0; place < members_.size(); ++place)
    if (loads_.masses[place] * interior_.velocities()[place].norm() > borne_part * strongest)
      return false;
  return true;
}

}  // namespace rink::physics::inline RINK_PRECISION
