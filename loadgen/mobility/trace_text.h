// Lines, words and numbers of a text file.
#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace rink::loadgen {

/// The lines of a text, one after the other, without their ends.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}
  /// Goes to the next line; false after the last.
  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    ++number_;
    return true;
  }
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }  ///< of the line, from 1

 private:
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

/// The number that `word` is as a whole, perhaps one that is not finite.
inline std::optional<double> number_in(std::string_view word) {
  double number = 0.0;
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

/// Writes the words of `line`, between any of `spaces`, to `words`.
inline void list_words(std::string_view line, std::string_view spaces,
                       std::vector<std::string_view>& words) {
  words.clear();
  while (true) {
    const std::size_t begin = line.find_first_not_of(spaces);
    if (begin == std::string_view::npos) return;
    line.remove_prefix(begin);
    const std::size_t end = line.find_first_of(spaces);
    words.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end);
  }
}

}  // namespace rink::loadgen
