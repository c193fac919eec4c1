// The file for what a run is to leave, tried out before the run.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "game/net/flags.h"

namespace rink::game {

/// If the run leaves no record, nor does it leave the empty file of that trial.
class RecordFile {
 public:
  /// `path` may be empty: no file. Throws std::runtime_error, naming `flag`, if it cannot be
  /// written.
  RecordFile(const std::string& flag, const std::string& path)
      : path_(path), is_new_(!path.empty() && !std::filesystem::exists(path)) {
    require_writable(flag, path);
  }
  ~RecordFile() {
    std::error_code error;
    if (is_new_ && std::filesystem::is_regular_file(path_, error) &&
        std::filesystem::file_size(path_, error) == 0)
      std::filesystem::remove(path_, error);
  }
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

 private:
  std::string path_;
  bool is_new_;
};

}  // namespace rink::game
