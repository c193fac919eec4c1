// Formats numbers for files and messages.
#pragma once

#include <array>
#include <charconv>
#include <optional>
#include <string>

#include "loadgen/experiment/parameter.h"

namespace rink::loadgen {

/// All digits that tell `value` from its neighbours; empty if absent.
inline std::string csv_number(std::optional<double> value) {
  return value ? shortest(*value) : std::string();
}

/// At most six significant digits; empty if absent.
inline std::string six_digits(std::optional<double> value) {
  if (!value) return {};
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), *value,
                                       std::chars_format::general, 6)
                             .ptr};
}

}  // namespace rink::loadgen
