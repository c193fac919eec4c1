// Writes records under the first free number, those of matches that go on again and again.
#include "game/control/match_records.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <utility>

#include "game/control/key_log_packed.h"
#include "game/model/system_reason.h"

namespace rink::game {
void MatchRecords::require_writable() const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw SceneError(folder_.string() +
                     ": this folder for records of matches cannot be made: " + error.message());
  const std::filesystem::path attempt = folder_ / ".match";
  errno = 0;
  const bool is_writable = static_cast<bool>(std::ofstream(attempt));
  const std::string reason = system_reason(errno);
  std::filesystem::remove(attempt, error);
  if (!is_writable)
    throw SceneError(folder_.string() +
                     ": records of matches cannot be written to this folder: " + reason);
}

/// Gives the whole record the first name that nobody has: no link replaces a file.
void MatchRecords::place(const std::filesystem::path& whole) {
  std::error_code error;
  while (open_.empty()) {
    const std::filesystem::path file = folder_ / ("match-" + std::to_string(next_++) + ".keys");
    std::filesystem::create_hard_link(whole, file, error);
    if (!error) {
      open_ = file;
    } else if (error != std::errc::file_exists) {
      // A file system without links: an empty file takes the name meanwhile.
      errno = 0;
      std::FILE* const fresh = std::fopen(file.c_str(), "wbx");  // only if nobody has it
      if (fresh != nullptr) {
        std::fclose(fresh), open_ = file;
        return replace(whole);
      }
      if (errno != EEXIST)
        throw SceneError(file.string() + ": cannot be written: " + system_reason(errno));
    }
  }
  std::filesystem::remove(whole, error);
}

void MatchRecords::replace(const std::filesystem::path& whole) {
  std::error_code error;
  std::filesystem::rename(whole, open_, error);
  if (error) throw SceneError(open_.string() + ": cannot be written: " + error.message());
}

/// Beside its place first, so that none is ever half written, by a name that no other program's
/// has.
void MatchRecords::write_open(const KeyLog& log) {
  static std::atomic<std::uint64_t> count = 0;
  require_writable();
  const std::filesystem::path whole =
      folder_ / (".match-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
  try {
    write_packed_key_log(whole, log);
    if (open_.empty()) place(whole);
    else replace(whole);
  } catch (const SceneError&) {
    std::error_code ignored;
    std::filesystem::remove(whole, ignored);
    if (!open_until_ && !open_.empty()) std::filesystem::remove(open_, ignored), open_.clear();
    throw;
  }
  open_until_ = log.until;
}

std::filesystem::path MatchRecords::write(const KeyLog& log) {
  const auto close = [this] {
    open_until_.reset();
    return std::exchange(open_, {});
  };
  try {
    write_open(log);
  } catch (const SceneError&) {
    close();
    throw;
  }
  return close();
}

std::optional<std::string> MatchRecords::keep(const KeyLog& log) {
  return first_error([&] { write(log); });
}

std::optional<std::string> MatchRecords::follow(
    double now_s, const std::function<std::optional<KeyLog>()>& record_so_far) {
  if (now_s < due_s_) return std::nullopt;
  due_s_ = now_s + period_s;
  const std::optional<KeyLog> log = record_so_far();
  if (!log || (open_until_ && log->until == open_until_)) return std::nullopt;
  return first_error([&] { write_open(*log); });
}

std::optional<std::string> MatchRecords::test() {
  return first_error([this] { require_writable(); });
}

template <class Attempt>
std::optional<std::string> MatchRecords::first_error(Attempt attempt) {
  const bool was_failing = std::exchange(is_failing_, false);
  try {
    attempt();
  } catch (const SceneError& error) {
    is_failing_ = true;
    if (!was_failing) return error.what();
  }
  return std::nullopt;
}

}  // namespace rink::game
