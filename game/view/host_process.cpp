// Starts the server; its first line shows whether it listens.
#include "game/view/host_process.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace rink::view {
namespace {

constexpr std::chrono::seconds farewell{10};  // far more than writing a match's record takes

std::string server_path() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rink-serve").string();
}

/// The server is asked to end, not killed, when its owner is gone, so that its records are
/// complete.
game::Process started(const std::vector<std::string>& arguments) try {
  return game::Process(server_path(), arguments,
                       {.signal_when_orphaned = SIGTERM, .joins_errors = true});
} catch (const std::system_error&) {
  throw std::runtime_error("cannot host: " + server_path() + " cannot be run");
}

std::vector<std::string> arguments_for(const std::string& port, const std::string& records,
                                       const std::string& key_file) {
  std::vector<std::string> words{"match", "--address", "0.0.0.0", "--port",
                                 port,    "--record",  records};
  if (!key_file.empty()) words.insert(words.end(), {"--key-file", key_file});
  return words;
}

}  // namespace

HostProcess::HostProcess(const std::string& port, const std::string& records,
                         const std::string& key_file)
    : server_(started(arguments_for(port, records, key_file))) {
  while (words_.find('\n') == std::string::npos && !server_.ending()) {
    server_.attend(std::chrono::milliseconds(100));
    words_ += server_.take_output();
  }
  const std::size_t end = std::min(words_.find('\n'), words_.size());
  if (!words_.starts_with("listening"))
    throw std::runtime_error("cannot host: " + (words_.empty() ? server_path() + " cannot be run"
                                                               : words_.substr(0, end)));
  words_.erase(0, end + 1);
}

std::string HostProcess::take_words() {
  server_.attend(std::chrono::milliseconds(0));
  return std::exchange(words_, {}) + server_.take_output();
}

HostProcess::~HostProcess() {
  if (!server_.ending()) server_.stop(farewell);
}

}  // namespace rink::view
