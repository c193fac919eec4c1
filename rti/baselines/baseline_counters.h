// Counts of how periodic state was sent.
#pragma once

#include <cstdint>

namespace rink::rti {

struct BaselineCounters {
  std::uint64_t keyframes = 0;  ///< taken
  std::uint64_t blocks_encoded = 0,
                blocks_shared = 0;  ///< blocks, and how often one was sent unchanged
  std::uint64_t differences_sent = 0, absolutes_sent = 0;  ///< records
  std::uint64_t acknowledged = 0;                          ///< keyframes, by all federates together
  std::uint64_t acknowledgements_ignored = 0;              ///< too late, or of a keyframe that was
                                                           ///< never sent
  std::uint64_t refused = 0;                               ///< by federates that lacked a baseline
};

}  // namespace rink::rti
