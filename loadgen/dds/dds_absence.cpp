// Said by the build.
#include "loadgen/dds/dds_absence.h"

namespace rink::loadgen {

#ifdef RINK_HAS_CYCLONE_DDS
const char* const dds_absence = nullptr;
#else
const char* const dds_absence =
    "this build has no Cyclone DDS: install Debian's cyclonedds-dev and cyclonedds-tools, as "
    "./rink setup does, and configure again (cmake --preset release --fresh)";
#endif

}  // namespace rink::loadgen
