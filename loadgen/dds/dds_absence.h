// Whether this build has Cyclone DDS, for programs that do not load it.
#pragma once

namespace rink::loadgen {

/// How to get the library where this build has none; null where it is there.
extern const char* const dds_absence;

}  // namespace rink::loadgen
