// Why the RTI drops a connection on its own account.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rink::rti {

enum class Violation : std::uint8_t {
  malformed,     ///< bytes that are no message, or a value out of its range
  oversized,     ///< a frame longer than its sender may send
  wrong_phase,   ///< anything but a join from one that has not joined, or a second join
  unknown_name,  ///< a class, attribute, object, region or label that does not exist
  undeclared,    ///< a class or attribute that its sender has not published
  not_owned,     ///< an object of another federate
  over_limit,    ///< more objects or regions than allowed
  silent,        ///< silent for too long
  refused,       ///< its join was refused
  untimely,      ///< a time stamp, lookahead or request that its logical time forbids
};
inline constexpr std::size_t violation_count = 10;
const char* to_string(Violation violation);
/// A sentence about the federate that did it, for the message with which it is dropped.
const char* explain(Violation violation);

}  // namespace rink::rti
