// Whether a window that tiles played is the one that one loop would have played.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "game/physics/engine/engine.h"
#include "game/physics/flight/motion.h"
#include "game/physics/flight/straight_flight.h"
#include "game/physics/real.h"
#include "game/physics/slabs/courses.h"
#include "game/physics/slabs/tile.h"
#include "game/physics/workers.h"

namespace rink::physics::inline RINK_PRECISION {

/// The check of slabs.h: it is right if no course that came late meets one that lasts as well.
class WindowCheck {
 public:
  /// `tiles` are that of the last pass, then those of the workers in their order.
  WindowCheck(const Engine::Parts& parts, const SharedWindow& shared, std::span<Tile* const> tiles)
      : parts_(parts), shared_(shared), tiles_(tiles) {
    assert(tiles.size() >= 2);
  }

  /// By `workers`, each of them its own tiles' part; by the caller if null.
  bool is_right(Workers* workers = nullptr) const;

 private:
  struct Course {
    std::uint32_t body;
    const Flight& flight;
  };

  bool are_right(std::span<const Courses::Late> late, Real speed) const;
  CellGrid::Range range_of(const Courses::Late& late, Real end, Real speed) const;
  bool meets_unseen(const Courses::Late& late, Real speed) const;
  bool meets_unseen(const Courses::Late& late, std::uint32_t other, Real end, Real speed) const;
  bool touched_unseen(const Courses::Late& late, const Course& other, Real speed) const;
  bool is_in_sight(const Courses::Late& late, std::uint32_t other) const;
  bool meets_by(const Courses::Late& late, const Course& other, Real end) const;
  Motion motion_of(const Course& course) const;
  std::uint32_t latest_of(std::uint32_t body) const;
  Real end_of(const Courses::Late& late) const;
  const Courses::Replaced& course_at(std::uint32_t at) const;
  Real greatest_speed() const;

  const Engine::Parts& parts_;
  const SharedWindow& shared_;
  std::span<Tile* const> tiles_;
};

}  // namespace rink::physics::inline RINK_PRECISION
