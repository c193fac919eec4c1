// How long the two ends of a conversation wait for each other.
#pragma once

namespace rink::rti {

/// How long a silent peer is waited for.
struct Patience {
  double heartbeat_s = 1.0;   ///< a side that has nothing else to say says so this often
  double lost_after_s = 5.0;  ///< a side that has said nothing for so long is lost
};

}  // namespace rink::rti
