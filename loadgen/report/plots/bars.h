// Bars made of stacked parts, one beside the other.
#pragma once

#include <string>

#include "loadgen/report/plots/chart.h"

namespace rink::loadgen {

std::string svg_of_bars(const Chart& chart);

}  // namespace rink::loadgen
