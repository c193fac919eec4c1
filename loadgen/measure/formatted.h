// Texts by printf's formats, which the compiler checks.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

namespace rink::loadgen {

/// What std::printf would print, cut behind 511 letters.
[[gnu::format(printf, 1, 2)]] inline std::string formatted(const char* format, ...) {
  char text[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace rink::loadgen
