// posix_spawn with a pipe for what the server says.
#include "game/view/host_process.h"

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

extern char** environ;

namespace rink::view {

HostProcess::HostProcess(const std::string& port, const std::string& records) {
  const std::string server = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rink-serve").string();
  std::array<std::string, 8> words{server, "match", "--address", "0.0.0.0", "--port", port, "--record", records};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("cannot host: no pipe to the server");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  const int trouble = posix_spawn(&process_, server.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  said_ = ends[0];
  std::string said;
  for (char letter = 0; trouble == 0 && letter != '\n' && read(said_, &letter, 1) == 1;) said += letter;
  if (said.starts_with("listening")) return;
  if (trouble == 0) waitpid(process_, nullptr, 0);
  close(said_);
  process_ = -1;
  throw std::runtime_error("cannot host: " + (said.empty() ? server + " cannot be run" : said.substr(0, said.find('\n'))));
}

HostProcess::~HostProcess() {
  if (process_ < 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  close(said_);
}

}  // namespace rink::view
