// What a rink is made of: the field, its materials, and the three kinds of bodies, as plain values
// to create a World from.
#pragma once

#include <Eigen/Core>
#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "game/physics/slab_plan.h"

namespace rink::physics {

using Vector2 = Eigen::Vector2d;

/// Names a body of one World: bodies are numbered in order of creation, and a number is never used
/// again.
struct BodyId {
  std::uint32_t index = 0;
  friend auto operator<=>(const BodyId&, const BodyId&) = default;
};

enum class BodyKind : std::uint8_t { puck, bat, post };

/// The index of a material in WorldSpec::restitution.
using MaterialId = std::uint8_t;

/// One number of 0 or more for each pair of materials, symmetric.
class PairTable {
 public:
  explicit PairTable(std::size_t material_count = 1, double everywhere = 0.0)
      : material_count_(material_count), values_(material_count * material_count, everywhere) {
    assert(material_count > 0 && material_count <= 256 && everywhere >= 0.0);
  }
  void set(MaterialId a, MaterialId b, double value) {
    assert(a < material_count_ && b < material_count_ && value >= 0.0);
    values_[a * material_count_ + b] = values_[b * material_count_ + a] = value;
  }
  double operator()(MaterialId a, MaterialId b) const { return values_[a * material_count_ + b]; }
  std::size_t material_count() const { return material_count_; }

 private:
  std::size_t material_count_;
  std::vector<double> values_;
};

/// How much of the closing speed an impact gives back, per pair of materials: symmetric, each entry
/// in [0, 1].
class RestitutionTable : public PairTable {
 public:
  explicit RestitutionTable(std::size_t material_count = 1, double everywhere = 1.0)
      : PairTable(material_count, everywhere) {
    assert(everywhere <= 1.0);
  }
  void set(MaterialId a, MaterialId b, double value) {
    assert(value <= 1.0);
    PairTable::set(a, b, value);
  }
};

/// What surfaces do to each other sideways at an impact (docs/physics.md, "Spin"): the tangential
/// impulse is at most `coefficient` times the normal one (the surfaces slide), and less if that
/// suffices to turn their relative speed into -`tangential_restitution` of it (they stick).
struct SurfaceFriction {
  PairTable coefficient;  ///< 0 or more; 0 is smooth
  RestitutionTable tangential_restitution{1, 0.0};
};

/// The table [0, length] x [0, width] in metres. Goals are openings of `goal_width`, centred in the
/// end walls x = 0 and x = length; 0 means none. The edges of an opening are points of the wall, so
/// a puck that meets one bounces as off a post without extent.
struct Field {
  double length = 1.0;
  double width = 1.0;
  double goal_width = 0.0;
  MaterialId wall = 0;
  bool bats_keep_to_half =
      false;  ///< bats of Half::left and Half::right bounce off the halfway line x = length/2
};

/// How pending events are kept: a calendar of buckets, constant time (event_queue.h), a binary heap
/// (event_heap.h), or by windows, beyond which they wait with their bodies (window_queue.h).
enum class QueuePolicy : std::uint8_t { calendar, heap, windows };

/// Everything that is true of a World before it has bodies.
struct WorldSpec {
  Field field;
  double puck_drag = 0.0;      ///< dv/dt = -puck_drag v for every puck [1/s], 0 or more
  double bat_drag = 0.0;       ///< dv/dt = -bat_drag v for every bat [1/s], 0 or more
  double puck_friction = 0.0;  ///< Coulomb friction of every puck with the table: the deceleration
                               ///< mu g along its velocity until it rests [m/s^2], 0 or more
  RestitutionTable restitution;
  std::optional<SurfaceFriction> surface_friction;  ///< absent: surfaces are smooth and nothing
                                                    ///< spins; tables are as large as `restitution`
  bool accounts_energy =
      false;  ///< keep the books behind World::dissipated(); never changes the motion
  double contact_time =
      5e-4;  ///< time scale of pressed contact [s], above 0: impacts that follow each other faster
             ///< are taken together (docs/physics.md, "Degenerate contact")
  double cell_size = 0.0;  ///< lower limit for the side of a grid cell [m]; 0 lets the world
                           ///< choose. Changes cost, never results.
  QueuePolicy queue = QueuePolicy::calendar;  ///< changes cost, never results
  std::optional<SlabPlan> slabs =
      SlabPlan{};  ///< how many bodies in free flight are played by tiles that know nothing of each
                   ///< other, and by windows whatever `queue` says, unless that is a heap; nothing:
                   ///< all in order. Changes cost, never results; no part of a snapshot
  bool allow_overlap = false;  ///< bodies may be added where others are; those that overlap and
                               ///< approach collide at once, none is ever moved
};

struct PuckSpec {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  double radius = 0.04;                            ///< m, above 0
  double mass = 1.0;                               ///< kg, above 0
  MaterialId material = 0;
  double spin = 0.0;  ///< rad/s, anticlockwise; 0 where surfaces are smooth
};

/// A disc that never moves; radius 0 or more.
struct PostSpec {
  Vector2 position{0.0, 0.0};
  double radius = 0.0;
  MaterialId material = 0;
};

enum class Half : std::uint8_t { left, right, both };

/// An axis-aligned rectangle that moves under thrust and never turns.
struct BatSpec {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};
  Vector2 half_extent{0.05, 0.05};  ///< m, both above 0
  double mass = 1.0;                ///< kg, above 0
  MaterialId material = 0;
  Half half = Half::both;
};

enum class End : std::uint8_t { left, right };

}  // namespace rink::physics
