// Coulomb friction with the table: of pucks that slide on their own, and of those that are pushed,
// whose friction turns with their velocity.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/body.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Knows no rest contacts: who is pushed together, and along which axis, it is told. It does
/// nothing to what friction does not slow.
class Friction {
 public:
  Friction(const WorldSpec& spec, Bodies& bodies);
  Friction(const Friction&) = delete;
  Friction& operator=(const Friction&) = delete;

  /// What accelerates the body along an axis besides its partners and its drag [m/s^2].
  Real own_push(std::uint32_t body, int axis) const;

  /// The law for the velocity that the body has now. One that is pushed along `pushed_axis` shares
  /// the law of its group there.
  void slide(std::uint32_t body, std::optional<int> pushed_axis);

  /// Stops what friction has slowed down to nothing.
  void reset_friction(int axis, const std::vector<std::uint32_t>& members);
  /// Against the velocities of the pucks as they are; of those at rest along the axis of a group
  /// that may stand, it remains to be found, by resist().
  void face(const std::vector<std::uint32_t>& members);
  /// Whether a puck slides across the axis, so that its friction turns.
  bool has_sliders(int axis, const std::vector<std::uint32_t>& members) const;
  /// Aims the friction of the sliding pucks of a group that nothing fixed holds, against the
  /// velocities that they will have half-way to the next time that it is aimed, and answers when
  /// that is [s]; never where they keep their direction.
  Real aim(int axis, const std::vector<std::uint32_t>& members, Real time);
  /// One sweep of static friction over `accelerations` [m/s^2], by body: each puck at rest resists
  /// its own along the axis as far as Coulomb's law lets it. Answers the largest change.
  Real resist(int axis, const std::vector<std::uint32_t>& members,
              std::vector<Real>& accelerations);
  /// Whether the body is a puck at rest that bears less than it could.
  bool bears_more(std::uint32_t body, int axis) const;

 private:
  RealVector along(const RealVector& velocity) const;
  bool is_sliding(std::uint32_t body) const;
  bool slides_across(int axis, std::uint32_t body) const;
  Real push_of(int axis, const std::vector<std::uint32_t>& members) const;
  Real until_stop(int axis, const std::vector<std::uint32_t>& members) const;
  Real arc_of(int axis, const std::vector<std::uint32_t>& members) const;
  void aim_half_way(int axis, const std::vector<std::uint32_t>& members, Real half);

  Bodies& bodies_;
  double friction_;    // the most, per mass [m/s^2]
  Real contact_time_;  // s
};

}  // namespace rink::physics::inline RINK_PRECISION
