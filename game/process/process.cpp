// fork, exec, poll and wait4 behind one object; between fork and exec only async-signal-safe calls
// are made.
#include "game/process/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

namespace rink::game {
namespace {

constexpr std::size_t output_kept_max = 64 * 1024;
constexpr std::size_t errors_kept_max = 8 * 1024;
constexpr std::size_t stderr_tail_max = 2 * 1024;

struct Pipe {
  int read_end = -1, write_end = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  return {ends[0], ends[1]};
}

/// The program that a child executes.
struct Program {
  const char* path;
  char* const* arguments;
  const cpu_set_t* processors;  ///< null: any
  int signal_when_orphaned;
  pid_t parent;
  int output, errors;  ///< descriptors that it writes to
  int failure;         ///< a descriptor for the error of exec, which closes on success
};

/// The child's side of the fork.
[[noreturn]] void exec_child(const Program& program) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, program.signal_when_orphaned);
  if (getppid() != program.parent) _exit(127);  // the parent died before the line above
  if (program.processors) sched_setaffinity(0, sizeof *program.processors, program.processors);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(number, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(program.output, STDOUT_FILENO);
  dup2(program.errors, STDERR_FILENO);
  execv(program.path, program.arguments);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = write(program.failure, &error, sizeof error);
  _exit(127);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::string Ending::text() const {
  if (signal == 0) return "ended with status " + std::to_string(exit_status);
  return "was ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

Process::Process(const std::filesystem::path& executable, const std::vector<std::string>& arguments,
                 const ProcessSettings& settings) {
  const std::string path = executable.string();
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  cpu_set_t set;
  CPU_ZERO(&set);
  assert(std::ranges::all_of(settings.processors,
                             [](int one) { return one >= 0 && one < CPU_SETSIZE; }));
  for (const int processor : settings.processors)
    CPU_SET(static_cast<std::size_t>(processor), &set);

  const Pipe output = make_pipe(), errors = make_pipe(), failure = make_pipe();
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) {
    exec_child({.path = path.c_str(),
                .arguments = pointers.data(),
                .processors = settings.processors.empty() ? nullptr : &set,
                .signal_when_orphaned = settings.signal_when_orphaned,
                .parent = parent,
                .output = output.write_end,
                .errors = settings.joins_errors ? output.write_end : errors.write_end,
                .failure = failure.write_end});
  }
  const int fork_error = errno;
  close(output.write_end);
  close(errors.write_end);
  close(failure.write_end);
  int error = id_ < 0 ? fork_error : 0;
  if (id_ > 0) {
    setpgid(id_, id_);  // both sides do it, so that it is done in time
    [[maybe_unused]] const ssize_t got = read(failure.read_end, &error, sizeof error);
  }
  close(failure.read_end);
  if (error != 0) {
    if (id_ > 0) waitpid(id_, nullptr, 0);
    close(output.read_end);
    close(errors.read_end);
    throw std::system_error(error, std::generic_category(), "cannot start " + path);
  }
  output_ = output.read_end;
  errors_ = errors.read_end;
  for (const int descriptor : {output_, errors_}) fcntl(descriptor, F_SETFL, O_NONBLOCK);
}

Process::~Process() {
  if (!ending_) stop(std::chrono::milliseconds(0));
  if (output_ >= 0) close(output_);
  if (errors_ >= 0) close(errors_);
}

void Process::attend(std::chrono::milliseconds limit) {
  std::array<pollfd, 2> watched{pollfd{output_, POLLIN, 0},
                                pollfd{errors_, POLLIN, 0}};  // poll skips a negative descriptor
  poll(watched.data(), watched.size(), static_cast<int>(limit.count()));
  read_into(output_, output_text_, output_kept_max);
  read_into(errors_, errors_text_, errors_kept_max);
  reap();
  if (ending_) {  // its last output
    read_into(output_, output_text_, output_kept_max);
    read_into(errors_, errors_text_, errors_kept_max);
  }
}

void Process::read_into(int& descriptor, std::string& text, std::size_t kept_max) {
  std::array<char, 4096> bytes;
  while (descriptor >= 0) {
    const ssize_t got = read(descriptor, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return;
    if (got <= 0) {
      close(descriptor);
      descriptor = -1;
      return;
    }
    text.append(bytes.data(), static_cast<std::size_t>(got));
    if (text.size() > 2 * kept_max) text.erase(0, text.size() - kept_max);
  }
}

void Process::reap() {
  if (ending_) return;
  assert(id_ > 0 && "a process that could not be started is none");
  int status = 0;
  rusage used{};
  if (wait4(id_, &status, WNOHANG, &used) != id_) return;
  ending_.emplace();
  if (WIFSIGNALED(status)) {
    ending_->signal = WTERMSIG(status);
  } else {
    ending_->exit_status = WEXITSTATUS(status);
  }
  ending_->cpu_s = seconds(used.ru_utime) + seconds(used.ru_stime);
}

std::optional<std::string> Process::line_after(const std::string& beginning) const {
  std::size_t start = 0;
  while (start < output_text_.size()) {
    const std::size_t end = output_text_.find('\n', start);
    if (end == std::string::npos) return std::nullopt;
    if (output_text_.compare(start, beginning.size(), beginning) == 0)
      return output_text_.substr(start + beginning.size(), end - start - beginning.size());
    start = end + 1;
  }
  return std::nullopt;
}

std::string Process::take_output() { return std::exchange(output_text_, {}); }

std::string Process::stderr_tail() const {
  std::string text = errors_text_;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (text.size() > stderr_tail_max) text.erase(0, text.size() - stderr_tail_max);
  std::string words;
  for (const char letter : text) {
    if (letter == '\n') {
      words += " / ";
    } else {
      words += static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f ? '?' : letter;
    }
  }
  return words;
}

void Process::signal_group(int signal) const {
  assert(id_ > 0 && "the group 0 is our own");
  kill(-id_, signal);
}

void Process::stop(std::chrono::milliseconds grace) {
  assert(grace.count() >= 0);
  constexpr std::chrono::milliseconds step{5};
  if (grace.count() > 0) signal_group(SIGTERM);
  for (std::chrono::milliseconds waited{0}; !ending_ && waited < grace; waited += step) {
    attend(std::chrono::milliseconds(0));
    if (!ending_) usleep(5'000);
  }
  signal_group(SIGKILL);  // also whatever the process itself started
  while (!ending_) {
    attend(std::chrono::milliseconds(0));
    if (!ending_) usleep(1'000);
  }
}

std::vector<int> allowed_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> processors;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return processors;
  for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (CPU_ISSET(static_cast<std::size_t>(processor), &set)) processors.push_back(processor);
  }
  return processors;
}

}  // namespace rink::game
