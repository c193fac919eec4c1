// Stands where Cyclone DDS was not there.
#include <stdexcept>

#include "loadgen/dds/dds_absence.h"
#include "loadgen/dds/dds_engine.h"

namespace rink::loadgen {

DdsEnding serve_by_dds(const DdsServeOptions&, const DdsClock&,
                       const std::function<void(std::uint32_t)>&) {
  throw std::runtime_error(dds_absence);
}

DdsEnding play_by_dds(const DdsBotsOptions&, const DdsClock&) {
  throw std::runtime_error(dds_absence);
}

}  // namespace rink::loadgen
