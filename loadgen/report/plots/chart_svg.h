// Draws charts.
#pragma once

#include <string>

#include "loadgen/report/plots/chart.h"

namespace rink::loadgen {

std::string to_svg(const Chart& chart);

}  // namespace rink::loadgen
