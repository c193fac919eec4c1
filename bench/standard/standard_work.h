// Work for an RTI by the standard's C++ API alone.
#pragma once

#include <RTI/RTI1516.h>

#include <string>

#include "bench/standard/work.h"

namespace rink_driver {

/// How the federates of a run connect.
struct StandardPlace {
  std::wstring settings;  ///< local settings designator, as the RTI wants it
  std::wstring model;
};

/// Updates of `object_count` objects, `rounds` of each, to each of the subscribers; `count` is of
/// reflections.
Outcome standard_updates(const StandardPlace& place, int subscribers, std::uint64_t rounds);
/// An interaction to another federate and one back.
Outcome standard_round_trips(const StandardPlace& place, std::uint64_t count);
/// Regulating and constrained federates advance by their lookahead, step for step.
Outcome standard_advances(const StandardPlace& place, int federates, std::uint64_t steps);
/// Federates connect, join and leave, one after the other.
Outcome standard_joins(const StandardPlace& place, std::uint64_t count);
/// Federates that join late discover all objects and receive a value of each; `count` is of values.
Outcome standard_late_joiners(const StandardPlace& place, std::uint64_t joiners);

}  // namespace rink_driver
