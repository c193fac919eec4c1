// Writes records under the first free number.
#include "game/control/match_records.h"

#include <cerrno>
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

std::filesystem::path MatchRecords::write(const KeyLog& log) {
  std::error_code error;
  require_writable();
  const auto file = [this] { return folder_ / ("match-" + std::to_string(next_) + ".keys"); };
  while (std::filesystem::exists(file(), error)) ++next_;
  write_packed_key_log(file(), log);
  return file();
}

std::optional<std::string> MatchRecords::keep(const KeyLog& log) {
  return first_error([&] { write(log); });
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
