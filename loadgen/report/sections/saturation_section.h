// Where the server saturates, as a section of the report.
#pragma once

#include "loadgen/report/report.h"
#include "loadgen/run/saturation/saturate_command.h"

namespace rink::loadgen {

/// The searches as a table, with the cost per tick and the bytes at the edge.
ReportSection saturation_section(std::span<const Saturation> found, const ServiceLevel& level);

}  // namespace rink::loadgen
