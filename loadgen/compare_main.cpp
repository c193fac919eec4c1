// rink-compare: runs an experiment over real sockets under every scheme and writes a table and a report.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <iostream>
#include <nlohmann/json.hpp>

#include "loadgen/campaign.h"
#include "loadgen/game_plan.h"
#include "loadgen/open_files.h"
#include "loadgen/process.h"
#include "loadgen/report.h"
#include "loadgen/table.h"

namespace {

using namespace rink::loadgen;

enum ExitStatus { success = 0, bad_usage = 2, some_invalid = 3, nothing_measured = 4, output_failed = 5, interrupted = 130 };

constexpr const char* footer = R"(
The folder then holds runs.jsonl (a line per run), summary.csv (means over seeds), report.html (reads offline),
provenance.json, keys/ (the key log of each game) and cells/ (the reports of the processes).

Exit status: 0 all runs valid; 2 bad usage, experiment or scene; 3 some run does not count; 4 no run counts;
             5 results could not be written; 130 interrupted (what was measured is kept).

Example: rink compare full --out full-report)";

constexpr std::size_t files_besides_clients = 64;

std::atomic<bool> is_interrupted = false;

void on_signal(int) { is_interrupted.store(true); }

void heed_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a reader that went away must not cost the results
}

struct Options {
  std::string experiment = "default";
  std::string out, programs;
  bool may_replace = false;
};

std::filesystem::path own_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

/// The file itself if there is one, else the installed experiment of that name.
std::filesystem::path find_experiment(const std::string& name) {
  if (std::filesystem::exists(name) && !std::filesystem::is_directory(name)) return name;
  const auto installed = own_folder() / "../share/rink/scenes/experiments" / (name.ends_with(".toml") ? name : name + ".toml");
  if (std::filesystem::exists(installed)) return installed.lexically_normal();
  throw ExperimentError(name + ": no such file, and no installed experiment " + installed.lexically_normal().string());
}

void expect_program(const std::filesystem::path& program) {
  if (access(program.c_str(), X_OK) != 0) throw ExperimentError(program.string() + ": not there or not executable; build it first (./rink does)");
}

void expect_enough_files(const Experiment& experiment) {
  const std::size_t most = *std::max_element(experiment.clients.begin(), experiment.clients.end());
  const std::size_t limit = raise_open_file_limit();
  if (limit >= most + files_besides_clients) return;
  throw ExperimentError(std::to_string(most) + " clients need " + std::to_string(most + files_besides_clients) + " open files but only " +
                        std::to_string(limit) + " are allowed: raise the hard limit (ulimit -Hn)");
}

/// All but the folder for the reports. Throws ExperimentError if a program is missing.
RunnerSettings runner_settings(const Options& options) {
  RunnerSettings settings;
  const std::filesystem::path programs = options.programs.empty() ? own_folder() : std::filesystem::path(options.programs);
  settings.serve = programs / "rink-serve";
  settings.bots = programs / "rink-bots";
  expect_program(settings.serve);
  expect_program(settings.bots);
  settings.is_interrupted = &is_interrupted;
  pin_apart(settings, allowed_processors());
  return settings;
}

/// Writes what the runs give together; returns why that failed, or an empty text.
std::string write_results(const ResultsDirectory& results, const Experiment& experiment, const std::vector<RunRecord>& runs, const Provenance& provenance) {
  try {
    results.write("summary.csv", to_csv(summarise(runs)));
    results.write("provenance.json", to_json(provenance).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    results.write("report.html", report_of(experiment, runs, provenance));
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

ExitStatus status_of(const Outcome& outcome) {
  if (outcome.was_interrupted) return interrupted;
  if (!outcome.output_failure.empty()) return output_failed;
  const auto valid = std::count_if(outcome.runs.begin(), outcome.runs.end(), [](const RunRecord& run) { return run.valid; });
  if (valid == 0) return nothing_measured;
  return static_cast<std::size_t>(valid) < outcome.runs.size() ? some_invalid : success;
}

ExitStatus compare(const Options& options, const std::vector<std::string>& command_line) {
  const Experiment experiment = load_experiment(find_experiment(options.experiment), {});
  expect_enough_files(experiment);
  RunnerSettings settings = runner_settings(options);
  ResultsDirectory results(options.out.empty() ? free_directory(".") : std::filesystem::path(options.out), options.may_replace);
  settings.directory = results.subdirectory("cells");
  const Provenance provenance = provenance_of(command_line, wake_up_lateness());

  Progress progress(std::cerr, isatty(STDERR_FILENO) != 0, cells_of(experiment).size(), experiment.warm_up_s + experiment.duration_s + 1.0);
  const auto write_keys = [&experiment](const Cell& cell, const std::filesystem::path& file) { write_game_plan(experiment, cell, file); };
  Outcome outcome = run_campaign(experiment, settings, results, write_keys, progress);
  if (!outcome.runs.empty()) {
    const std::string failure = write_results(results, experiment, outcome.runs, provenance);
    if (outcome.output_failure.empty()) outcome.output_failure = failure;
    std::cout << table_of(outcome.runs, isatty(STDOUT_FILENO) != 0) << std::flush;
  }
  if (outcome.was_interrupted) {
    std::cerr << "rink-compare: interrupted; kept " << outcome.runs.size() << " of " << cells_of(experiment).size() << " runs\n";
  }
  if (!outcome.output_failure.empty()) std::cerr << "rink-compare: " << outcome.output_failure << "\n";
  if (!outcome.runs.empty() && outcome.output_failure.empty()) std::cout << "report: " << (results.path() / "report.html").string() << "\n" << std::flush;
  return status_of(outcome);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Runs every mode x scheme x policy x client count x seed of an experiment as a server and its bots over loopback, and compares them."};
  app.add_option("EXPERIMENT", options.experiment, "an experiment file (docs/experiments.md), or the name of an installed one: default, five_hundred, full")
      ->capture_default_str();
  app.add_option("--out", options.out, "folder for the results (default: report, or report-2, ... if taken)");
  app.add_flag("--force", options.may_replace, "replace results that are already there");
  app.add_option("--programs", options.programs, "folder of rink-serve and rink-bots (default: that of rink-compare)");
  app.footer(footer);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? success : bad_usage;
  }
  heed_signals();
  try {
    return compare(options, std::vector<std::string>(argv, argv + argc));
  } catch (const ExperimentError& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return bad_usage;
  } catch (const OutputError& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return output_failed;
  } catch (const std::exception& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return nothing_measured;
  }
}
