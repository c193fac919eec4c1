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

std::vector<std::string> arguments_for(const HostSettings& settings) {
  std::vector<std::string> words{settings.scene, "--address", settings.address, "--port",
                                 settings.port,  "--record",  settings.records};
  if (!settings.key_file.empty()) words.insert(words.end(), {"--key-file", settings.key_file});
  if (!settings.is_announced) words.emplace_back("--no-discovery");
  if (!settings.continued.empty()) words.insert(words.end(), {"--continue", settings.continued});
  words.insert(words.end(), settings.sharing.begin(), settings.sharing.end());
  return words;
}

}  // namespace

HostProcess::HostProcess(const HostSettings& settings) : server_(started(arguments_for(settings))) {
  while (words_.find('\n') == std::string::npos && !server_.ending()) {
    server_.attend(std::chrono::milliseconds(100));
    words_ += server_.take_output();
  }
  const std::size_t end = std::min(words_.find('\n'), words_.size());
  const std::string first = words_.substr(0, end), listens = "listening on ",
                    shares = "nodes reach this one at ";
  if (!first.starts_with(settings.sharing.empty() ? listens : shares))
    throw std::runtime_error("cannot host: " +
                             (first.empty() ? server_path() + " cannot be run" : first));
  if (!settings.sharing.empty()) node_place_ = first.substr(shares.size());
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
