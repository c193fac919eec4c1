// Starts the server, then the bots, waits for both within limits and reads their reports.
#include "loadgen/run/cell_runner.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "game/process/process.h"
#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/judge_run.h"
#include "loadgen/measure/tables/discovery_table.h"
#include "loadgen/measure/truth/truth.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/nodes/node_processes.h"
#include "loadgen/run/process_run.h"
#include "rti/federation_execution.h"

namespace rink::loadgen {
namespace {

using std::chrono::milliseconds;

/// One cell while it runs.
class CellRun {
 public:
  CellRun(const RunnerSettings& settings, const Experiment& experiment, const Cell& cell,
          const std::filesystem::path& key_log)
      : settings_(settings),
        experiment_(experiment),
        cell_(cell),
        key_log_(key_log),
        server_report_(settings.directory / (name_of(cell) + ".server.json")),
        bots_report_(settings.directory / (name_of(cell) + ".bots.json")) {}

  void run(RunRecord& record) {
    std::error_code ignored;
    std::filesystem::remove(server_report_, ignored);
    std::filesystem::remove(bots_report_, ignored);
    const std::string server_trace = server_report_.string() + "l",
                      bots_trace =
                          bots_report_.string() + "l";  // NAME.server.jsonl, NAME.bots.jsonl
    std::filesystem::remove(server_trace, ignored);
    std::filesystem::remove(bots_trace, ignored);
    const bool is_dds = cell_.mode == dds_mode;
    std::vector<std::string> serve = (is_dds ? dds_serve_arguments : serve_arguments)(
        experiment_, cell_, key_log_, server_report_);
    if (settings_.wants_truth) serve.insert(serve.end(), {"--evidence", server_trace});
    const bool is_apart = cell_.server_cores == 1;
    game::Process server(
        is_dds ? settings_.dds : settings_.serve, serve,
        {.processors = is_apart ? settings_.server_processors : std::vector<int>{}});
    const std::string address = awaited_line(settings_, server, "listening on ", "the server");
    std::vector<std::string> play = (is_dds ? dds_bots_arguments : bots_arguments)(
        experiment_, cell_, key_log_, address, bots_report_);
    if (settings_.wants_truth) play.insert(play.end(), {"--evidence", bots_trace});
    game::Process bots(is_dds ? settings_.dds : settings_.bots, play,
                       {.processors = is_apart ? settings_.bots_processors : std::vector<int>{}});
    await(server, bots);
    record.server_cpu_s = server.ending()->cpu_s;
    record.bots_cpu_s = bots.ending()->cpu_s;
    record.nodes.busiest_cpu_s = record.server_cpu_s;
    record.nodes.mean_cpu_s = (*record.server_cpu_s + *record.bots_cpu_s) / (1.0 + cell_.clients);
    judge(record, report_at(server_report_, "the server"), report_at(bots_report_, "the bots"));
  }

 private:
  /// Returns when both have ended well.
  void await(game::Process& server, game::Process& bots) {
    const double limit_s = experiment_.warm_up_s + experiment_.duration_s + settings_.join_limit_s;
    auto deadline = after(limit_s);
    bool has_failed = false;
    while (!server.ending() || !bots.ending()) {
      settings_.heed_interrupt();
      (server.ending() ? bots : server).attend(look_interval);
      if (!server.ending()) bots.attend(milliseconds(0));
      const bool fails_now = (server.ending() && !server.ending()->is_success()) ||
                             (bots.ending() && !bots.ending()->is_success());
      if (fails_now && !has_failed) deadline = std::min(deadline, after(survivor_limit_s));
      has_failed = has_failed || fails_now;
      if (Clock::now() > deadline) break;
    }
    // A program that failed is named before one that was only waiting for it.
    std::string why;
    const auto add = [&why](const std::string& reason) {
      why += (why.empty() ? "" : "; ") + reason;
    };
    const auto name_failure = [&](const char* who, const game::Process& process) {
      if (process.ending() && !process.ending()->is_success())
        add(with_stderr_tail(std::string(who) + " " + process.ending()->text(), process));
    };
    name_failure("the server", server);
    name_failure("the bots", bots);
    const auto end_late = [&](const char* who, game::Process& process) {
      if (process.ending()) return;
      process.stop(settings_.stop_grace);
      if (!has_failed)
        add(with_stderr_tail(std::string(who) + " had not ended after " + decimal(limit_s) + " s",
                             process));
    };
    end_late("the server", server);
    end_late("the bots", bots);
    if (!why.empty()) throw Failure{why};
  }

  const RunnerSettings& settings_;
  const Experiment& experiment_;
  const Cell& cell_;
  const std::filesystem::path& key_log_;
  std::filesystem::path server_report_, bots_report_;
};

}  // namespace

std::optional<RunRecord> run_cell(const RunnerSettings& settings, const Experiment& experiment,
                                  const Cell& cell, const std::filesystem::path& key_log) {
  std::optional<ProcessRun> run = run_processes(settings, experiment, cell, key_log);
  if (!run) return std::nullopt;
  return judged(settings, experiment, std::move(*run));
}

RunRecord judged(const RunnerSettings& settings, const Experiment& experiment, ProcessRun run) {
  RunRecord& record = run.record;
  if (!settings.wants_truth || !run.has_reports) return record;
  const std::string trace = (settings.directory / name_of(record.cell)).string();
  add_truth(record, experiment, trace + ".server.jsonl", trace + ".bots.jsonl",
            discovery_file(settings.directory, record.cell));
  return record;
}

std::optional<ProcessRun> run_processes(const RunnerSettings& settings,
                                        const Experiment& experiment, const Cell& cell,
                                        const std::filesystem::path& key_log) {
  ProcessRun run{record_for(experiment, cell)};
  RunRecord& record = run.record;
  try {
    if (cell.parameters.nodes > 1) {
      run_nodes(settings, experiment, key_log, record);
    } else {
      CellRun(settings, experiment, cell, key_log).run(record);
      run.has_reports = true;
    }
  } catch (const Failure& failure) {
    record.valid = false;
    record.why_invalid = failure.why;
  } catch (const std::system_error& error) {
    record.valid = false;
    record.why_invalid = error.what();
  } catch (const Interrupted&) {
    return std::nullopt;
  }
  return run;
}

}  // namespace rink::loadgen
