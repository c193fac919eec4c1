// How a world may be divided into parts that are played apart.
#pragma once

#include <cstdint>

namespace rink::physics {

/// Changes cost, never results.
struct SlabPlan {
  int tile_cells = 64;    ///< the side of a tile, in cells of the grid; 4 or more
  int block_radius = -1;  ///< cells around an event that was put off, and along the edges of a
                          ///< tile, in which all else is, too; below 0 lets the world choose
  double window = 1.0;    ///< the length of a window, in units of that in which a third of the
                          ///< pending events come
  std::uint32_t bodies_min = 20'000;  ///< with fewer bodies all is played in order
};

}  // namespace rink::physics
