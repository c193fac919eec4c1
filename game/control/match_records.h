// The folder of match records, with one key log for each match.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "game/control/key_log.h"

namespace rink::game {

/// Files are named match-1.keys, match-2.keys and so on; none is overwritten.
class MatchRecords {
 public:
  /// The folder is made when it is needed.
  explicit MatchRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes a record and returns its path. Throws SceneError if it cannot be written.
  std::filesystem::path write(const KeyLog& log);
  /// Writes a record without throwing, since the match goes on. Returns the error when it first
  /// occurs.
  std::optional<std::string> keep(const KeyLog& log);
  /// The error that writing a record now would give; nothing if none.
  std::optional<std::string> test();
  /// True if the last record could not be written.
  bool is_failing() const { return is_failing_; }

 private:
  void require_writable() const;
  template <class Attempt>
  std::optional<std::string> first_error(Attempt attempt);

  std::filesystem::path folder_;
  std::uint32_t next_ = 1;
  bool is_failing_ = false;
};

}  // namespace rink::game
