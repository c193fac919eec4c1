// Files of traces: a JSON value per line and a last line that proves that none is missing or
// altered.
#pragma once

#include <cstdint>
#include <fstream>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "im/basics/fnv_hash.h"

namespace rink::game {

/// A trace that cannot be used; the message names file, line and what was expected.
class TraceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes line by line; the last line is {"lines": count, "fnv1a": hash of all bytes before it}.
class TraceWriter {
 public:
  explicit TraceWriter(std::string file);
  void line(const nlohmann::ordered_json& value);
  /// A line that is JSON already, without its end.
  void line_of_text(std::string text);
  /// Throws std::runtime_error naming the file if anything could not be written.
  void finish();

 private:
  void note_error();

  std::string file_;
  int error_ = 0;  ///< errno of the first failure
  std::ofstream stream_;
  std::uint64_t lines_ = 0;
  Fnv64 hash_;
};

/// Reads what TraceWriter wrote, whole or not at all.
class TraceReader {
 public:
  /// Throws TraceError if the file cannot be read, has no last line as above, or does not match it.
  explicit TraceReader(std::string file);
  /// The next line. Throws TraceError if there is none or it is not JSON.
  nlohmann::json next();
  /// The next line as text, without its end, unchecked; valid as long as the reader.
  std::string_view next_text();
  bool is_at_end() const { return read_ == lines_; }
  [[noreturn]] void refuse(const std::string& expected) const;
  /// Refuses `what` of another version than the wanted one, and names both; 0 stands for a file
  /// without a version.
  void require_version(int found, int wanted, const std::string& what) const;

 private:
  std::string file_, text_;
  std::size_t position_ = 0;
  std::uint64_t read_ = 0, lines_ = 0;
};

}  // namespace rink::game
