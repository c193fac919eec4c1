// How much a connection that has not joined may ask.
#pragma once

#include <cstdint>

namespace rink::rti {

/// What a connection has asked since the last flush, which answers it.
struct PreJoinLimits {
  static constexpr std::uint16_t max = 64;
  std::uint16_t count = 0;
  bool wants_list = false, wants_report = false;  ///< asked for twice, given once

  /// False if that is too much.
  bool ask() { return ++count <= max; }
};

}  // namespace rink::rti
