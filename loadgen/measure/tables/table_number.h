// Numbers as the tables for a terminal show them.
#pragma once

#include <optional>
#include <string>

#include "loadgen/measure/formatted.h"

namespace rink::loadgen {

/// Three significant digits or all digits before the point, `-` if absent; `scale` turns the
/// figure's unit into the column's.
inline std::string table_number(const std::optional<double>& value, double scale = 1.0) {
  if (!value) return "-";
  const double scaled = *value * scale;
  return formatted("%.*f", scaled >= 99.95 ? 0 : scaled >= 9.995 ? 1 : 2, scaled);
}

}  // namespace rink::loadgen
