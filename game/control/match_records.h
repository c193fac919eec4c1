// Where the records of matches are kept: a folder with one key log for each.
#pragma once

#include <filesystem>

#include "game/control/key_log.h"

namespace rink::game {

/// Names files match-1.keys, match-2.keys and so on; none that is there is overwritten.
class MatchRecords {
 public:
  /// The folder is made when it is needed.
  explicit MatchRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws SceneError unless records can be written there: to be asked before a match is played.
  void require_writable() const;

  /// Where it stands now. Throws SceneError if it cannot be written.
  std::filesystem::path write(const KeyLog& log);

 private:
  std::filesystem::path folder_;
  std::uint32_t next_ = 1;
};

}  // namespace rink::game
