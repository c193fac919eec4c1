// Files for the results of a run, which are tested before the run.
#pragma once

#include <string>

namespace rink::game {

/// Throws std::runtime_error if `path` is given and cannot be written, before a run that would be
/// lost. An existing file keeps its content.
void require_writable(const std::string& flag, const std::string& path);
/// `text` and an end of line. Throws std::runtime_error if it cannot be written.
void write_file(const std::string& path, const std::string& text);

/// A run without a record does not leave the empty file of that test either.
class RecordFile {
 public:
  /// `path` may be empty: no file. Throws std::runtime_error, naming `flag`, if it cannot be
  /// written.
  RecordFile(const std::string& flag, const std::string& path);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

 private:
  std::string path_;
  bool is_new_;
};

}  // namespace rink::game
