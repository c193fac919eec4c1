// spdlog, once for all commands: its headers take the compiler longer than most commands do.
#include "game/apps/command.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "game/net/interrupt.h"

namespace rink::game {

double now_s() {
  return 1e-9 * static_cast<double>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                        std::chrono::steady_clock::now().time_since_epoch())
                                        .count());
}

/// spdlog's default would mix errors with the report on the standard output.
void speak_as(const std::string& command) {
  spdlog::set_default_logger(spdlog::stderr_color_mt(command));
  spdlog::set_pattern("%n: %v");
}

void complain_of(const std::string& text) { spdlog::error("{}", text); }
void warn_of(const std::string& text) { spdlog::warn("{}", text); }

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

int run_command(Flags& flags, int count, char** words, const Command& command) {
  if (const auto status = flags.parse(count, words, command.bad_flags)) return *status;
  if (command.hears_interrupts) hear_interrupts();
  try {
    return command.run();
  } catch (const FlagError& error) {
    flags.explain(error);
    return command.bad_flags;
  } catch (const std::exception& error) {
    complain(error.what());
    return command.status_of(error);
  }
}

}  // namespace rink::game
