// Finds entities near a bat at one instant: every entity's true place, in cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "loadgen/measure/truth/relevance.h"

namespace rink::loadgen {

/// An entity in play, under a number of the caller's.
struct Placed {
  std::uint32_t entity = 0;
  Vector2 centre{0.0, 0.0}, half_extent{0.0, 0.0};  ///< m
};

struct Relevant {
  std::uint32_t entity = 0;
  double depth = 0.0;  ///< see depth(); 0 or more, and 0 of all that Encounters finds
  friend bool operator==(const Relevant&, const Relevant&) = default;
};

/// The cell of `count` in a row in which `cell`, a distance in cells, is; the first or last for
/// what is outside.
std::uint32_t clamped_cell(double cell, std::uint32_t count);

/// Binned by counting sort into cells of the area's reach. Placed entities lie anywhere; those
/// outside the world share its rim cells.
class Surroundings {
 public:
  /// `length` x `width` [m] is where most entities are.
  Surroundings(const RelevanceArea& area, double length, double width);

  /// Replaces the entities by `placed`.
  void build(std::span<const Placed> placed);
  /// Writes all that is relevant to a bat at `bat` to `found` in ascending order, but for `own`,
  /// which is the bat itself.
  void find(const Vector2& bat, std::uint32_t own, std::vector<Relevant>& found) const;

  /// Asserts that every entity is in the cell in which its place is, once.
  void check() const;

 private:
  std::uint32_t column(double x) const;
  std::uint32_t row(double y) const;

  RelevanceArea area_;
  double cell_ = 1.0;
  std::uint32_t columns_ = 1, rows_ = 1;
  double farthest_ = 0.0;  ///< largest half extent
  std::vector<std::uint32_t> begins_, cell_of_;
  std::vector<Placed> sorted_;
};

}  // namespace rink::loadgen
