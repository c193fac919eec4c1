// fork, a pipe, and a deadline.
#include "bench/accuracy/guarded.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <system_error>

namespace rink::accuracy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr rlim_t memory_max = rlim_t{4} << 30;

void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)  // these reserve terabytes that they never use
  const rlimit limit{memory_max, memory_max};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

[[noreturn]] void be_child(const std::function<std::string()>& work, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    std::signal(number, number == SIGTERM ? SIG_DFL : SIG_IGN);  // the parent decides
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0)
    dup2(nowhere, STDERR_FILENO), dup2(nowhere, STDOUT_FILENO);
  limit_memory();
  std::string bytes;
  try {
    bytes = work();
  } catch (const std::exception&) {
    _exit(1);
  }
  for (std::size_t written = 0; written < bytes.size();) {
    const ssize_t count = write(output, bytes.data() + written, bytes.size() - written);
    if (count <= 0) _exit(1);
    written += static_cast<std::size_t>(count);
  }
  _exit(0);
}

std::string limit_text(double limit_s) {
  char text[48];
  std::snprintf(text, sizeof text, "longer than %g s", limit_s);
  return text;
}

/// What the child wrote until it closed its end; why_not is empty unless it was stopped.
Outcome collected(int input, double limit_s, const std::atomic<bool>* is_interrupted) {
  const auto deadline = Clock::now() + std::chrono::duration<double>(limit_s);
  Outcome outcome{std::string(), ""};
  while (true) {
    if (is_interrupted != nullptr && is_interrupted->load()) return {{}, "interrupted"};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return {{}, limit_text(limit_s)};
    pollfd waiting{input, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(std::min<long>(left, 200))) <= 0)
      continue;  // interrupted, or nothing yet
    std::array<char, 4096> part;
    const ssize_t count = read(input, part.data(), part.size());
    if (count == 0) return outcome;
    if (count > 0) outcome.output->append(part.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

Outcome guarded(const std::function<std::string()>& work, double limit_s,
                const std::atomic<bool>* is_interrupted) {
  assert(work && limit_s > 0.0);
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe to a process of its own");
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "no process of its own");
  if (child == 0) close(ends[0]), be_child(work, ends[1], parent);
  close(ends[1]);
  Outcome outcome = collected(ends[0], limit_s, is_interrupted);
  close(ends[0]);
  if (!outcome.output) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!outcome.output) return outcome;
  if (WIFSIGNALED(status))
    return {
        {},
        "signal " + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")"};
  if (WEXITSTATUS(status) != 0) return {{}, "gave up"};
  return outcome;
}

}  // namespace rink::accuracy
