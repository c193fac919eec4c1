// What the second reader runs on.
#pragma once

#include <cstdio>
#include <string>

namespace rink::rti::testing {

/// What a shell's `command` prints.
inline std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  for (int letter = 0; (letter = std::fgetc(pipe)) != EOF;) text += static_cast<char>(letter);
  return pclose(pipe) == 0 ? text : "failed: " + text;
}

inline bool has_python() { return output_of("python3 -c 'print(1)' 2>/dev/null") == "1\n"; }

}  // namespace rink::rti::testing
