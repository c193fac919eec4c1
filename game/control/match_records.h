// Where the records of matches are kept: a folder with one key log for each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "game/control/key_log.h"

namespace rink::game {

/// Names files match-1.keys, match-2.keys and so on; none that is there is overwritten.
class MatchRecords {
 public:
  /// The folder is made when it is needed.
  explicit MatchRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Where it stands now. Throws SceneError if it cannot be written.
  std::filesystem::path write(const KeyLog& log);
  /// The same for a match that goes on all the same: what went wrong, when it begins to.
  std::optional<std::string> keep(const KeyLog& log);
  /// What would go wrong if a match were kept now; nothing if nothing would.
  std::optional<std::string> test();
  /// Whether the last record could not be kept.
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
