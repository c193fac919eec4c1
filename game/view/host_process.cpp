// fork and exec with a pipe for what the server says.
#include "game/view/host_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace rink::view {

HostProcess::HostProcess(const std::string& port, const std::string& records,
                         const std::string& key_file) {
  const std::string server =
      (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rink-serve").string();
  std::vector<std::string> words{server,   "match", "--address", "0.0.0.0",
                                 "--port", port,    "--record",  records};
  if (!key_file.empty()) words.insert(words.end(), {"--key-file", key_file});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("cannot host: no pipe to the server");
  const pid_t owner = getpid();
  process_ = fork();
  if (process_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // a window that is killed cannot end its host itself
    if (getppid() != owner) _exit(127);
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    execv(server.c_str(), arguments.data());
    _exit(127);
  }
  close(ends[1]);
  said_ = ends[0];
  std::string said;
  for (char letter = 0; process_ > 0 && letter != '\n' && read(said_, &letter, 1) == 1;)
    said += letter;
  if (said.starts_with("listening")) {
    fcntl(said_, F_SETFL, O_NONBLOCK);
    return;
  }
  if (process_ > 0) waitpid(process_, nullptr, 0);
  close(said_);
  process_ = -1;
  throw std::runtime_error("cannot host: " + (said.empty() ? server + " cannot be run"
                                                           : said.substr(0, said.find('\n'))));
}

std::string HostProcess::take_words() {
  std::array<char, 4096> buffer;
  std::string words;
  for (ssize_t count; (count = read(said_, buffer.data(), buffer.size())) > 0;)
    words.append(buffer.data(), static_cast<std::size_t>(count));
  return words;
}

HostProcess::~HostProcess() {
  if (process_ < 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  close(said_);
}

}  // namespace rink::view
