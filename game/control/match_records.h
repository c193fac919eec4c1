// The folder of match records, with one key log for each match.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "game/control/key_log.h"

namespace rink::game {

/// Files are named match-1.keys, match-2.keys and so on; none of another match is overwritten. A
/// match that is followed has its file from its first second on, at all times a whole record.
class MatchRecords {
 public:
  /// The folder is made when it is needed.
  explicit MatchRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  static constexpr double period_s = 1.0;  ///< of real time; a killed program loses no more

  /// Once every period writes what `record_so_far` gives, if it gives anything new: the record of
  /// the match that goes on, which write() or keep() ends. `now_s` is real time [s], which never
  /// falls. Returns the error when it first occurs.
  std::optional<std::string> follow(double now_s,
                                    const std::function<std::optional<KeyLog>()>& record_so_far);
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
  void place(const std::filesystem::path& whole);
  void replace(const std::filesystem::path& whole);
  void write_open(const KeyLog& log);
  template <class Attempt>
  std::optional<std::string> first_error(Attempt attempt);

  std::filesystem::path folder_;
  std::uint32_t next_ = 1;
  std::filesystem::path open_;        ///< the file of the match that is followed, if any
  std::optional<double> open_until_;  ///< what it holds [s]
  double due_s_ = 0.0;
  bool is_failing_ = false;
};

}  // namespace rink::game
