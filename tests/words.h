// Names for the cases of a test: GoogleTest allows letters, digits and underscores only.
#pragma once

#include <cctype>
#include <cstdio>
#include <string>
#include <string_view>

namespace rink::test {

/// `text` with an underscore for each run of other characters between its words.
inline std::string words(std::string_view text) {
  std::string name;
  for (const char character : text) {
    const bool is_word = std::isalnum(static_cast<unsigned char>(character)) != 0;
    if (is_word) name += character;
    else if (!name.empty() && name.back() != '_') name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  return name;
}

/// A number as a word: 0.5 is 0_5.
inline std::string words(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", number);
  return words(text);
}

}  // namespace rink::test
