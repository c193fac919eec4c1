// What others have written, in messages of one line.
#pragma once

#include <cstddef>
#include <string>

namespace rink {

/// The beginning of the text, without bytes that end a line or control a terminal.
inline std::string printable(const std::string& text, std::size_t shown_max = 60) {
  std::string shown = text.substr(0, shown_max);
  for (char& byte : shown)
    if (static_cast<unsigned char>(byte) < 0x20 || static_cast<unsigned char>(byte) > 0x7e)
      byte = '?';
  return text.size() > shown_max ? shown + "..." : shown;
}

}  // namespace rink
