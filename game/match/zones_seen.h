// The division of the field among peers, as one of them knows it: zones, its halo, and the source
// of each body.
#pragma once

#include <cstdint>
#include <vector>

namespace rink::game {

struct ZonesSeen {
  struct Zone {
    std::uint32_t peer = 0;
    double low_x = 0.0, low_y = 0.0, high_x = 0.0, high_y = 0.0;  ///< m, within the field
  };
  std::uint32_t own_peer = 0;
  double halo =
      0.0;  ///< m: others' bodies that are so near to the own zones are simulated here, too
  std::vector<Zone> zones;
  std::vector<std::uint32_t> ghosts;  ///< ids of the things that are
  std::vector<std::uint32_t>
      received;  ///< and of those beyond, which their owners send because the player sees them
  std::uint64_t own_count = 0;  ///< of bodies in the own zones
};

}  // namespace rink::game
