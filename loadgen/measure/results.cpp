// Writes results so that a full disk or a read-only folder is noticed at once.
#include "loadgen/measure/results.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "game/model/system_reason.h"
#include "loadgen/measure/run_fields.h"

namespace rink::loadgen {
namespace {

constexpr std::array result_names{"runs.jsonl", "summary.csv",   "comparisons.csv",
                                  "tidy.csv",   "discovery.csv", "report.html"};

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw OutputError(file.string() + ": cannot be written: " + game::system_reason(error));
}

void make_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path)) {
    throw OutputError(path.string() + ": cannot be made a folder: " +
                      (error ? error.message() : "a file of that name is in the way"));
  }
}

std::string line_of(const nlohmann::ordered_json& object) {
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::filesystem::path free_directory(const std::filesystem::path& parent) {
  const auto is_taken = [](const std::filesystem::path& path) {
    std::error_code is_missing;
    const auto size = std::filesystem::file_size(path / "runs.jsonl", is_missing);
    return std::filesystem::exists(path) && (is_missing || size > 0);
  };
  std::filesystem::path path = parent / "report";
  for (int number = 2; is_taken(path); ++number)
    path = parent / ("report-" + std::to_string(number));
  return path;
}

LineFile::LineFile(std::filesystem::path path, std::size_t kept_bytes)
    : path_(std::move(path)), descriptor_(-1), length_(kept_bytes) {
  descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) refuse(path_, errno);
  const bool is_taken =
      flock(descriptor_, LOCK_EX | LOCK_NB) != 0 &&
      errno == EWOULDBLOCK;  // two that write at once would overwrite each other's lines
  const bool is_cut = !is_taken && (ftruncate(descriptor_, static_cast<off_t>(kept_bytes)) == 0 ||
                                    errno == EINVAL);  // EINVAL: a device, which has no length
  if (is_cut && (kept_bytes == 0 || lseek(descriptor_, 0, SEEK_END) >= 0)) return;
  const int error = errno;
  close(descriptor_);
  if (is_taken)
    throw OutputError(
        path_.string() +
        ": another rink compare is writing it; wait for that to end, or choose another --out");
  refuse(path_, error);
}

LineFile::LineFile(LineFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      length_(other.length_) {}

LineFile::~LineFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void LineFile::append(std::string line) {
  assert(descriptor_ >= 0 && line.find('\n') == std::string::npos && "one whole line");
  line += '\n';
  for (std::size_t written = 0; written < line.size();) {
    const ssize_t count = ::write(descriptor_, line.data() + written, line.size() - written);
    if (count > 0) written += static_cast<std::size_t>(count);
    if (count >= 0 || errno == EINTR) continue;
    const int error = errno;
    if (ftruncate(descriptor_, static_cast<off_t>(length_)) == 0) lseek(descriptor_, 0, SEEK_END);
    refuse(path_, error);
  }
  length_ += line.size();
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
    refuse(path_, errno);  // EINVAL: a pipe or device, which keeps nothing anyway
}

namespace {

/// `path`, ready for a first run.
std::filesystem::path cleared(const std::filesystem::path& path, bool may_replace) {
  make_directory(path);
  for (const char* name : result_names) {
    std::error_code is_missing;
    const auto size = std::filesystem::file_size(path / name, is_missing);
    if (is_missing || size == 0) continue;
    if (!may_replace)
      throw OutputError((path / name).string() +
                        ": already there; choose another --out, go on with --resume, or replace "
                        "the results with --force");
    std::error_code ignored;  // a file that cannot be removed cannot be written either, which is
                              // noticed then
    std::filesystem::remove(path / name, ignored);
  }
  return path / "runs.jsonl";
}

}  // namespace

ResultsDirectory::ResultsDirectory(const std::filesystem::path& path, bool may_replace)
    : path_(path), runs_(cleared(path, may_replace), 0) {}

ResultsDirectory ResultsDirectory::resumed(const std::filesystem::path& path,
                                           std::size_t whole_bytes) {
  return {path, LineFile(path / "runs.jsonl", whole_bytes)};
}

std::filesystem::path ResultsDirectory::subdirectory(const std::string& name) const {
  make_directory(path_ / name);
  return path_ / name;
}

void ResultsDirectory::set_head(const nlohmann::ordered_json& head) { head_ = line_of(head); }

void ResultsDirectory::append(const RunRecord& record) {
  if (!head_.empty()) runs_.append(std::exchange(head_, {}));
  runs_.append(line_of(to_json(record)));
}

void ResultsDirectory::write(const std::string& name, const std::string& content) const {
  errno = 0;
  std::ofstream stream(path_ / name, std::ios::binary | std::ios::trunc);
  stream << content << std::flush;
  if (!stream) refuse(path_ / name, errno);
}

}  // namespace rink::loadgen
