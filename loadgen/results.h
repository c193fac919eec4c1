// The folder that an experiment's results go to.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "loadgen/run_record.h"

namespace rink::loadgen {

/// A result that cannot be written; the message names the file and the system's reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `report`, or the first of `report-2`, `report-3`, ... in `parent` that does not exist yet or was left behind without a single run.
std::filesystem::path free_directory(const std::filesystem::path& parent);

/// A folder with runs.jsonl, which grows run by run, and files that are written whole.
class ResultsDirectory {
 public:
  /// Makes `path` if it is not there. Throws OutputError if it cannot be made or written, or if it already holds results and `may_replace` is false;
  /// otherwise starts an empty runs.jsonl and removes an older summary.csv and report.html.
  ResultsDirectory(const std::filesystem::path& path, bool may_replace);

  const std::filesystem::path& path() const { return path_; }
  /// `path()/name`, made if it is not there. Throws OutputError.
  std::filesystem::path subdirectory(const std::string& name) const;
  /// Adds a line to runs.jsonl and hands it to the system at once, so that an interrupt loses nothing. Throws OutputError.
  void append(const RunRecord& record);
  /// Writes `content` to `path()/name`. Throws OutputError.
  void write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
  std::ofstream runs_;
};

}  // namespace rink::loadgen
