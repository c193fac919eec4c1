// The folder for an experiment's results.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

/// A result that cannot be written; the message names the file and the system's reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `report`, or the first of `report-2`, `report-3`, ... in `parent` that does not exist yet or was
/// left behind without a single run.
std::filesystem::path free_directory(const std::filesystem::path& parent);

/// A file that grows by whole lines, each of them on the disk before the next thing happens:
/// neither kill -9 nor a loss of power takes more than the last.
class LineFile {
 public:
  /// Keeps the first `kept_bytes` of the file. Throws OutputError, also if another process has the
  /// file open here.
  LineFile(std::filesystem::path path, std::size_t kept_bytes);
  ~LineFile();
  LineFile(LineFile&& other) noexcept;
  LineFile& operator=(LineFile&&) = delete;
  /// Appends `line`, given without its end. Throws OutputError; a partly written line is removed if
  /// the system allows it.
  void append(std::string line);

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::size_t length_;
};

/// A folder with runs.jsonl, which grows run by run, and files that are written whole.
class ResultsDirectory {
 public:
  /// Makes `path` if it does not exist. Throws OutputError if it cannot be made or written, or if
  /// it already holds results and `may_replace` is false; otherwise starts an empty runs.jsonl and
  /// removes older results.
  ResultsDirectory(const std::filesystem::path& path, bool may_replace);

  /// Continues with the first `whole_bytes` of the runs.jsonl in `path` and drops the rest. Throws
  /// OutputError.
  static ResultsDirectory resumed(const std::filesystem::path& path, std::size_t whole_bytes);

  const std::filesystem::path& path() const { return path_; }
  /// `path()/name`, made if it does not exist. Throws OutputError.
  std::filesystem::path subdirectory(const std::string& name) const;
  /// Sets the line to write before the first run; it is not written earlier, so that a folder
  /// without a run stays free.
  void set_head(const nlohmann::ordered_json& head);
  /// Adds a line to runs.jsonl, on the disk when this returns. Throws OutputError.
  void append(const RunRecord& record);
  /// Writes `content` to `path()/name`. Throws OutputError.
  void write(const std::string& name, const std::string& content) const;

 private:
  ResultsDirectory(const std::filesystem::path& path, LineFile runs)
      : path_(path), runs_(std::move(runs)) {}

  std::filesystem::path path_;
  LineFile runs_;
  std::string head_;
};

}  // namespace rink::loadgen
