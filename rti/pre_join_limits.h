// Limits on the requests of a connection that has not joined.
#pragma once

#include <cstdint>

namespace rink::rti {

/// Counts what a connection has asked since the last flush, which answers.
struct PreJoinLimits {
  static constexpr std::uint16_t max = 64;
  std::uint16_t count = 0;
  bool wants_list = false, wants_report = false;  ///< repeated requests of one kind count as one

  /// False if that is too much.
  bool ask() { return ++count <= max; }
};

}  // namespace rink::rti
