// Numbers as the tables for a terminal show them.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

namespace rink::loadgen {

/// Three significant digits or all digits before the point, `-` if absent; `scale` turns the
/// figure's unit into the column's.
inline std::string table_number(const std::optional<double>& value, double scale = 1.0) {
  if (!value) return "-";
  const double scaled = *value * scale;
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", scaled >= 99.95 ? 0 : scaled >= 9.995 ? 1 : 2, scaled);
  return text;
}

}  // namespace rink::loadgen
