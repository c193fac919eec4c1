// What became of periodic state on its way out.
#pragma once

#include <cstdint>

namespace rink::rti {

struct BaselineCounters {
  std::uint64_t keyframes = 0;  ///< taken
  std::uint64_t blocks_encoded = 0,
                blocks_shared = 0;  ///< blocks, and how often one went out as it was
  std::uint64_t differences_sent = 0, absolutes_sent = 0;  ///< records
  std::uint64_t acknowledged = 0;                          ///< keyframes, by all federates together
  std::uint64_t acknowledgements_ignored = 0;              ///< too late, or of what was never sent
  std::uint64_t refused = 0;                               ///< by federates who lacked a baseline
};

}  // namespace rink::rti
