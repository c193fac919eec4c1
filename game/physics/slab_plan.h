// How a world may be divided into parts that are played apart.
#pragma once

#include <cstdint>

#include "game/physics/workers.h"

namespace rink::physics {

/// Changes cost, never results.
struct SlabPlan {
  int tile_cells = 64;   ///< the side of a tile, in cells of the grid; 4 or more
  int block_radius = 1;  ///< cells around an event that was put off, and along the edges of a tile,
                         ///< in which no impact is played; one more for some time after a window
                         ///< that had to be undone
  double window = 1.0;   ///< the length of a window, in units of that in which a third of the
                         ///< pending events come
  std::uint32_t bodies_min = 20'000;  ///< with fewer bodies all is played in order
  double last_pass_max =
      0.25;  ///< where more of a window's events than this part were left to the last pass, or it
             ///< had to be undone, some are played in order, ever more if it happens again
  Workers* workers = nullptr;      ///< play the tiles of a pass at once, and must outlive the
                                   ///< world; null: the caller alone
  std::uint32_t shared_min = 500;  ///< with fewer events a pass is played by one worker
};

}  // namespace rink::physics
