// Who has to be looked at after a step: those whose motion changed, and those who move.
#pragma once

#include <span>
#include <vector>

#include "game/physics/real.h"
#include "game/physics/world.h"

namespace rink::physics::inline RINK_PRECISION {

/// One reader's view of a world's changes. What it costs to look depends on how many bodies move or
/// changed, not on how many rest.
class Movers {
 public:
  /// Reads what changed since the last look; at the first one at a world that is every body.
  void look(const World& world);
  /// Whose motion changed, who came, was removed or scored since the look before, by id.
  std::span<const BodyId> changed() const { return changed_; }
  /// Who is in play and not at rest, by id: all others stay where they are until they are among
  /// `changed()`.
  std::span<const BodyId> moving() const { return moving_; }

 private:
  ChangeCursor cursor_;
  std::vector<BodyId> changed_, moving_, still_moving_;
};

}  // namespace rink::physics::inline RINK_PRECISION
