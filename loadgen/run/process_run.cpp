// Waits for lines of processes, and reads their reports.
#include "loadgen/run/process_run.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace rink::loadgen {

std::string with_stderr_tail(const std::string& what, const game::Process& process) {
  const std::string words = process.stderr_tail();
  return words.empty() ? what : what + ", saying: " + words;
}

std::string awaited_line(const RunnerSettings& settings, game::Process& process,
                         const std::string& beginning, const std::string& who) {
  const auto deadline = after(settings.listen_limit_s);
  while (true) {
    settings.heed_interrupt();
    process.attend(look_interval);
    if (const auto line = process.line_after(beginning)) return *line;
    if (process.ending())
      throw Failure{
          with_stderr_tail(who + " " + process.ending()->text() + " before it listened", process)};
    if (Clock::now() > deadline) {
      process.stop(settings.stop_grace);
      throw Failure{with_stderr_tail(
          who + " did not listen within " + decimal(settings.listen_limit_s) + " s", process)};
    }
  }
}

nlohmann::json report_at(const std::filesystem::path& path, const std::string& who) {
  std::ifstream stream(path);
  if (!stream) throw Failure{who + " wrote no report"};
  nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
  if (report.is_discarded()) throw Failure{who + " wrote a report that is not JSON"};
  return report;
}

}  // namespace rink::loadgen
