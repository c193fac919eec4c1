// A child process that cannot outlive its parent, whose output is read while it runs.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rink::game {

/// How a process ended.
struct Ending {
  int exit_status = -1;  ///< -1 if a signal ended it
  int signal = 0;        ///< 0 if it exited by itself
  double cpu_s = 0.0;    ///< processor time it used, user and system [s]
  bool is_success() const { return exit_status == 0; }
  /// E.g. `ended with status 3` or `was ended by signal 11 (Segmentation fault)`.
  std::string text() const;
};

/// Settings of a process.
struct ProcessSettings {
  std::vector<int> processors{};       ///< that it may run on; all that are allowed if empty
  int signal_when_orphaned = SIGKILL;  ///< from the kernel, when the thread that started it dies
  bool joins_errors = false;           ///< its standard error joins its standard output
};

/// A running program in a process group of its own, so that a Ctrl-C at the terminal reaches only
/// the parent, which then decides. The destructor kills it; and the kernel (PR_SET_PDEATHSIG) sends
/// it a signal when the thread that started it dies, even by kill -9.
class Process {
 public:
  /// Throws std::system_error if `executable` cannot be started.
  Process(const std::filesystem::path& executable, const std::vector<std::string>& arguments,
          const ProcessSettings& settings = {});
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  /// Reads the process's output and checks whether it ended, waiting up to `limit` for one of the
  /// two.
  void attend(std::chrono::milliseconds limit);
  pid_t id() const { return id_; }
  /// Absent while it runs.
  const std::optional<Ending>& ending() const { return ending_; }
  /// The rest of the first line of its standard output that starts with `beginning`, once that line
  /// is complete.
  std::optional<std::string> line_after(const std::string& beginning) const;
  /// Its standard output since the last call, of more than 128 kB the end; `line_after` no longer
  /// finds these lines.
  std::string take_output();
  /// The last lines of its standard error, at most 2 kB, on one line: newlines become ` / `, other
  /// control characters `?`.
  std::string stderr_tail() const;

  /// Asks the whole group to end (SIGTERM), waits up to `grace`, then kills it. Returns when the
  /// process is gone.
  void stop(std::chrono::milliseconds grace);

 private:
  void read_into(int& descriptor, std::string& text, std::size_t kept_max);
  void reap();
  void signal_group(int signal) const;

  pid_t id_ = -1;
  int output_ = -1, errors_ = -1;
  std::string output_text_, errors_text_;
  std::optional<Ending> ending_;
};

/// The processors that this process may run on, ascending.
std::vector<int> allowed_processors();

}  // namespace rink::game
