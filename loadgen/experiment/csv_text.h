// Quotes texts for comma-separated files.
#pragma once

#include <string>

namespace rink::loadgen {

/// `text`, in quotes if it contains a separator (RFC 4180).
inline std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + '"';
}

}  // namespace rink::loadgen
