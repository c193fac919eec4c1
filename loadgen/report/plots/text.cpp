// Escaping and number formats, none of which depends on the locale.
#include "loadgen/report/plots/text.h"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace rink::loadgen {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default: {
        const bool is_control =
            static_cast<unsigned char>(letter) < 0x20 && letter != '\n' && letter != '\t';
        safe += is_control ? std::string("\xEF\xBF\xBD") : std::string(1, letter);
      }
    }
  }
  return safe;
}

std::string short_number(double value, int digits) {
  assert(digits > 0);
  const char* unit = "";
  for (const char* larger : {" k", " M", " G"}) {
    if (std::abs(value) < 999.5) break;
    value /= 1000.0;
    unit = larger;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.*g%s", digits, value, unit);
  return text;
}

std::string short_bytes_per_s(double value) {
  const std::string number = short_number(value);
  return number + (number.find(' ') == std::string::npos ? " B/s" : "B/s");
}

std::string plain_number(std::optional<double> value, int digits) {
  assert(digits > 0);
  if (!value || !std::isfinite(*value)) return "\xE2\x80\x93";
  if (*value == 0.0) return "0";
  const int before_point = static_cast<int>(std::floor(std::log10(std::abs(*value)))) + 1;
  const int decimals = std::min(std::max(digits - before_point, 0), 12);
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", decimals, *value);
  return text;
}

std::string exact_number(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return {};
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), *value).ptr};
}

}  // namespace rink::loadgen
