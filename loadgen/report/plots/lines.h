// Lines and scattered marks with error bars over two axes.
#pragma once

#include <string>

#include "loadgen/report/plots/chart.h"

namespace rink::loadgen {

std::string svg_of_lines(const Chart& chart);

/// Whether any point of `chart` can be shown.
bool has_points(const Chart& chart);

}  // namespace rink::loadgen
