// Writes results so that a full disk or a read-only folder is noticed when it happens.
#include "loadgen/results.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

namespace rink::loadgen {
namespace {

constexpr std::array result_names{"runs.jsonl", "summary.csv", "report.html"};

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw OutputError(file.string() + ": cannot be written: " + (error != 0 ? std::strerror(error) : "unknown reason"));
}

void make_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path)) {
    throw OutputError(path.string() + ": cannot be made a folder: " + (error ? error.message() : "a file of that name is in the way"));
  }
}

}  // namespace

std::filesystem::path free_directory(const std::filesystem::path& parent) {
  const auto is_taken = [](const std::filesystem::path& path) {
    std::error_code is_missing;
    const auto size = std::filesystem::file_size(path / "runs.jsonl", is_missing);
    return std::filesystem::exists(path) && (is_missing || size > 0);
  };
  std::filesystem::path path = parent / "report";
  for (int number = 2; is_taken(path); ++number) path = parent / ("report-" + std::to_string(number));
  return path;
}

ResultsDirectory::ResultsDirectory(const std::filesystem::path& path, bool may_replace) : path_(path) {
  make_directory(path_);
  for (const char* name : result_names) {
    std::error_code is_missing;
    const auto size = std::filesystem::file_size(path_ / name, is_missing);
    if (is_missing || size == 0) continue;
    if (!may_replace) throw OutputError((path_ / name).string() + ": already there; choose another --out or replace the results with --force");
    std::error_code ignored;  // what cannot be removed cannot be written either and is noticed then
    std::filesystem::remove(path_ / name, ignored);
  }
  errno = 0;
  runs_.open(path_ / "runs.jsonl", std::ios::trunc);
  if (!runs_) refuse(path_ / "runs.jsonl", errno);
}

std::filesystem::path ResultsDirectory::subdirectory(const std::string& name) const {
  make_directory(path_ / name);
  return path_ / name;
}

void ResultsDirectory::append(const RunRecord& record) {
  errno = 0;
  runs_ << to_json(record).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n' << std::flush;
  if (!runs_) refuse(path_ / "runs.jsonl", errno);
}

void ResultsDirectory::write(const std::string& name, const std::string& content) const {
  errno = 0;
  std::ofstream stream(path_ / name, std::ios::binary | std::ios::trunc);
  stream << content << std::flush;
  if (!stream) refuse(path_ / name, errno);
}

}  // namespace rink::loadgen
