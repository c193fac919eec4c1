// The window that a peer plays.
#pragma once

#include <cstdint>

namespace rink::peer {

/// The steps of the protocol are numbered; instants are in seconds.
struct Window {
  std::uint32_t number = 0;
  double start = 0.0, end = 0.0;
};

}  // namespace rink::peer
