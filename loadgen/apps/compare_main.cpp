// rink-compare: runs an experiment over real sockets under every scheme and writes a table and a
// report.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <iostream>
#include <nlohmann/json.hpp>

#include "game/net/flags.h"
#include "game/version/version.h"
#include "loadgen/experiment/plan_text.h"
#include "loadgen/measure/assertion.h"
#include "loadgen/measure/discovery_table.h"
#include "loadgen/measure/equal_error.h"
#include "loadgen/measure/growth.h"
#include "loadgen/measure/modes_table.h"
#include "loadgen/measure/sequential.h"
#include "loadgen/measure/server_cores.h"
#include "loadgen/report/artefact.h"
#include "loadgen/report/dictionary.h"
#include "loadgen/report/exhibits/saturation_exhibit.h"
#include "loadgen/report/table.h"
#include "loadgen/report/tidy.h"
#include "loadgen/report/traces.h"
#include "loadgen/report/write_report.h"
#include "loadgen/run/campaign.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/open_files.h"
#include "loadgen/run/process.h"
#include "loadgen/run/resume.h"
#include "loadgen/run/run_journal.h"
#include "loadgen/run/saturation/saturate_command.h"
#include "rti/schemes.h"

namespace {

using namespace rink::loadgen;

enum ExitStatus {
  success = 0,
  bad_usage = 2,
  some_invalid = 3,
  nothing_measured = 4,
  output_failed = 5,
  assertion_failed = 6,
  reader_gone = 7,
  no_baseline = 8,
  width_not_reached = 9,
  bad_report_folder = 10,
  not_repeated = 11,
  no_relevance = 12,
  hung_up = 129,
  interrupted = 130
};

constexpr const char* footer = R"(
The folder then holds runs.jsonl (a line per run), summary.csv (means over seeds with 95 % intervals), comparisons.csv
(ratios to the baseline, paired by seed), tidy.csv (an observation per line; data-dictionary.csv says what each is),
report.html (reads offline), plots/ (each plot as .svg and its data as .csv), provenance.json, keys/ (the key log of each game) and cells/ (the reports of the processes).

Exit status: 0 all runs valid; 2 bad usage, experiment or scene; 3 some run does not count; 4 no run counts;
             5 results could not be written, or may not be replaced; 6 an --assert failed; 7 the table could not be
             printed (the folder is complete); 8 a baseline that no cell has; 9 intervals are wider than --until-width
             asks for after --seeds replications; 10 the folder of --from lacks a file, has one altered or is of another
             version; 11 what --from repeats says something else; 12 a relevance expression that is none; 129 the terminal went
             away; 130 interrupted (what was measured is kept).

Example: rink compare gains --out gains --assert 'filter_recall[scheme=region] >= 0.99')";

/// What an experiment may compare, each with its parameters.
std::string schemes_and_stages() {
  const auto lines = [](const char* title, const std::vector<std::string>& names) {
    std::string text = title, line;
    for (const std::string& name : names) {
      const std::string usage = rink::im::usage_of(name);
      if (line.size() + usage.size() > 110) text += line + "\n", line.clear();
      line += "  " + usage;
    }
    return text + line + "\n";
  };
  return lines("\nSchemes, also put together with and, or, not and parentheses:\n",
               rink::im::filter_names()) +
         lines(
             "\nStages, each behind any of them after with, as in \"aura and not sight with "
             "hysteresis(margin=0.3)\" (docs/im.md):\n",
             rink::im::stage_names());
}

constexpr std::size_t files_besides_clients = 64;

std::atomic<bool> is_interrupted = false, is_hung_up = false;

void on_signal(int number) {
  is_interrupted.store(true);
  if (number == SIGHUP) is_hung_up.store(true);
}

void heed_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a reader that went away must not cost the results
}

struct Options {
  std::string experiment;
  std::string out, programs, from, trace;
  bool may_replace = false, is_resumed = false, is_dry_run = false, keeps_evidence = false;
  std::vector<std::string> assertions;
  std::uint32_t seeds = 0;
  double until_width = 0.0;  ///< a fraction; 0: run the seeds and be done
  SaturateOptions saturate;
};

std::filesystem::path own_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

/// The file itself if there is one, else the installed experiment of that name.
std::filesystem::path find_experiment(const std::string& name) {
  if (std::filesystem::exists(name) && !std::filesystem::is_directory(name)) return name;
  const auto installed = own_folder() / "../share/rink/scenes/experiments" /
                         (name.ends_with(".toml") ? name : name + ".toml");
  if (std::filesystem::exists(installed)) return installed.lexically_normal();
  throw ExperimentError(name + ": no such file, and no installed experiment " +
                        installed.lexically_normal().string());
}

void expect_program(const std::filesystem::path& program) {
  if (access(program.c_str(), X_OK) != 0)
    throw ExperimentError(program.string() +
                          ": not there or not executable; build it first (./rink does)");
}

std::uint32_t allowed_clients() {
  const std::size_t limit = raise_open_file_limit();
  return static_cast<std::uint32_t>(
      std::clamp<std::size_t>(limit, files_besides_clients + 1, 1'000'000) - files_besides_clients);
}

std::size_t files_needed(const Experiment& experiment) {
  std::size_t needed = files_besides_clients;
  for (const Experiment& part : experiment.parts) needed = std::max(needed, files_needed(part));
  if (!experiment.parts.empty() || experiment.transport == TransportKind::virtual_time)
    return needed;
  return *std::max_element(experiment.clients.begin(), experiment.clients.end()) +
         files_besides_clients;
}

void expect_enough_files(const Experiment& experiment) {
  const std::size_t needed = files_needed(experiment), limit = raise_open_file_limit();
  if (limit >= needed) return;
  throw ExperimentError(std::to_string(needed - files_besides_clients) + " clients need " +
                        std::to_string(needed) + " open files but only " + std::to_string(limit) +
                        " are allowed: raise the hard limit (ulimit -Hn)");
}

/// All but the folder for the reports. Throws ExperimentError if a program is missing.
RunnerSettings runner_settings(const Options& options, bool needs_peers) {
  RunnerSettings settings;
  const std::filesystem::path programs =
      options.programs.empty() ? own_folder() : std::filesystem::path(options.programs);
  settings.serve = programs / "rink-serve";
  settings.bots = programs / "rink-bots";
  settings.peer = programs / "rink-peer";
  expect_program(settings.serve);
  expect_program(settings.bots);
  if (needs_peers) expect_program(settings.peer);
  settings.is_interrupted = &is_interrupted;
  settings.keeps_evidence_of_curves = options.keeps_evidence;
  pin_apart(settings, allowed_processors());
  return settings;
}

/// Writes what the runs give together; returns why that failed, or an empty text.
std::string write_results(const ResultsDirectory& results, const Experiment& experiment,
                          const std::vector<RunRecord>& runs, const Provenance& provenance,
                          std::span<const ReportSection> more_sections) {
  try {
    const Baseline baseline = experiment.baseline();
    const auto rows = summarise(runs, baseline);
    const std::string comment = comment_lines(provenance);
    results.write("summary.csv", comment + to_csv(rows));
    results.write("comparisons.csv", comment + comparisons_csv(rows, baseline));
    results.write("tidy.csv", comment + tidy_csv(runs));
    if (const auto discoveries = discoveries_in(results.path() / "cells", runs);
        !discoveries.empty())
      results.write("discovery.csv", comment + discovery_csv(discoveries));
    results.write("data-dictionary.csv", comment + data_dictionary_csv());
    if (const auto compared = equal_errors_of(experiment, runs); !compared.empty())
      results.write("equal_error.csv", comment + to_csv(compared));
    const auto growths = growths_of(without_curves(experiment, runs));
    const auto ratios = cores_ratios_of(runs);
    if (!growths.empty()) results.write("growth.csv", comment + to_csv(growths));
    if (!ratios.empty()) results.write("server_cores.csv", comment + to_csv(ratios));
    results.write(
        "provenance.json",
        to_json(provenance).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    keep_inputs(results, experiment);
    write_report(results, experiment, runs, provenance, more_sections);
    write_manifest(results);
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

/// The experiment's own seeds, or the first so many of them and, where there are fewer, the numbers
/// that follow the largest.
std::vector<std::uint64_t> seeds_of(std::vector<std::uint64_t> own, std::uint32_t count) {
  std::uint64_t next = *std::ranges::max_element(own) + 1;
  while (own.size() < count) own.push_back(next++);
  if (count > 0) own.resize(count);
  return own;
}

void set_seeds(Experiment& experiment, std::uint32_t count) {
  experiment.seeds = seeds_of(experiment.seeds, count);
  for (Experiment& part : experiment.parts) part.seeds = seeds_of(part.seeds, count);
}

/// Replications are added one by one until every row's payload is known to within
/// `options.until_width` of itself, or there are `options.seeds`.
Outcome run_until_narrow(Experiment& experiment, const Options& options,
                         const RunnerSettings& settings, ResultsDirectory& results,
                         const KeyLogWriter& write_keys, std::vector<RunRecord> kept,
                         std::vector<WideRow>& wide) {
  Outcome outcome;
  for (std::uint32_t count = std::min(options.seeds, least_replications); count <= options.seeds;
       ++count) {
    set_seeds(experiment, count);
    Progress progress(std::cerr, isatty(STDERR_FILENO) != 0,
                      cells_of(experiment).size() - kept.size(), expected_cell_s(experiment));
    outcome = run_campaign(experiment, settings, results, write_keys, progress, std::move(kept));
    if (outcome.was_interrupted || !outcome.output_failure.empty()) break;
    wide = wider_rows(summarise(outcome.runs, experiment.baseline()), options.until_width,
                      count - std::min(options.seeds, least_replications) + 1);
    if (wide.empty()) break;
    kept = outcome.runs;
  }
  return outcome;
}

ExitStatus status_of(const Outcome& outcome, bool do_assertions_hold) {
  if (outcome.was_interrupted) return is_hung_up ? hung_up : interrupted;
  if (!outcome.output_failure.empty()) return output_failed;
  const auto valid = std::count_if(outcome.runs.begin(), outcome.runs.end(),
                                   [](const RunRecord& run) { return run.valid; });
  if (valid == 0) return nothing_measured;
  if (!do_assertions_hold) return assertion_failed;
  if (!std::cout) return reader_gone;
  return static_cast<std::size_t>(valid) < outcome.runs.size() ? some_invalid : success;
}

/// Says how each demand turned out; true if all hold.
bool judge(const std::vector<Assertion>& assertions, const Experiment& experiment,
           const Outcome& outcome) {
  if (outcome.was_interrupted && !assertions.empty())
    std::cerr << "rink-compare: interrupted, so no --assert was judged\n";
  if (outcome.was_interrupted || assertions.empty()) return true;
  const auto rows = summarise(outcome.runs, experiment.baseline());
  bool do_all_hold = true;
  for (const Assertion& assertion : assertions) {
    const Assertion::Finding finding = assertion.judge(rows);
    (finding.holds ? std::cout : std::cerr)
        << "assertion " << (finding.holds ? "holds: " : "FAILED: ") << assertion.text() << "\n"
        << finding.words << std::flush;
    do_all_hold = do_all_hold && finding.holds;
  }
  return do_all_hold;
}

/// The folder, and what of it is kept.
Continuation opened_results(const Options& options, const Experiment& experiment,
                            const JournalHead& head) {
  if (!options.is_resumed)
    return {ResultsDirectory(
                options.out.empty() ? free_directory(".") : std::filesystem::path(options.out),
                options.may_replace),
            {},
            {}};
  return continued_in(
      options.out.empty() ? latest_directory(".") : std::filesystem::path(options.out), experiment,
      head, options.may_replace);
}

/// What is repeated must not be overwritten by its repetition.
void expect_other_folder(const Options& options) {
  if (options.out.empty()) return;
  if (std::filesystem::weakly_canonical(options.out) ==
      std::filesystem::weakly_canonical(options.from))
    throw ExperimentError("--out " + options.out +
                          " is the folder of --from: expected another one for the repetition");
}

ExitStatus compare(const Options& options, const std::vector<std::string>& command_line) {
  const std::string standard = options.saturate.is_wanted ? "saturate" : "default";
  Journal repeated;  // read before anything is written
  if (!options.from.empty()) {
    check_manifest(options.from);
    expect_other_folder(options);
    repeated = journal_of_report(options.from);
  }
  Experiment experiment =
      !options.from.empty()
          ? experiment_of_report(options.from)
          : load_experiment(
                find_experiment(options.experiment.empty() ? standard : options.experiment), {});
  if (options.seeds > 0)
    set_seeds(experiment, options.until_width > 0.0 ? std::min(options.seeds, least_replications)
                                                    : options.seeds);
  std::vector<Assertion> assertions;
  for (const std::string& text : options.assertions) assertions.emplace_back(text, experiment);
  if (options.is_dry_run) {
    std::cout << plan_text(experiment, files_needed(experiment), raise_open_file_limit())
              << std::flush;
    return std::cout ? success : reader_gone;
  }
  if (!options.saturate.is_wanted) expect_enough_files(experiment);
  const std::vector<Cell> cells = cells_of(experiment);
  const auto is_virtual_cell = [&experiment](const Cell& cell) {
    return part_of(experiment, cell.part).transport == TransportKind::virtual_time;
  };
  const bool is_virtual = std::ranges::all_of(cells, is_virtual_cell);
  const bool has_peers =
      std::ranges::any_of(cells, [](const Cell& cell) { return cell.mode == peer_mode; });
  RunnerSettings settings = runner_settings(options, has_peers && !is_virtual);
  const JournalHead identity{identity_of(experiment), rink::game::built_commit(), {}};
  Continuation continuation = opened_results(options, experiment, identity);
  std::cerr << continuation.said;
  ResultsDirectory& results = continuation.results;
  settings.directory = results.subdirectory("cells");
  const Provenance provenance = is_virtual ? reproducible_provenance_of(command_line)
                                           : provenance_of(command_line, wake_up_lateness());
  if (continuation.kept.empty())
    results.set_head(to_json(JournalHead{identity.experiment, identity.commit, provenance.facts}));

  Progress progress(std::cerr, isatty(STDERR_FILENO) != 0,
                    cells_of(experiment).size() - continuation.kept.size(),
                    expected_cell_s(experiment));
  const auto is_kept = [&continuation](const Cell& cell) {
    return std::ranges::any_of(continuation.kept,
                               [&cell](const RunRecord& run) { return run.cell == cell; });
  };
  double to_come_s = 0.0;
  for (const Cell& cell : cells)
    to_come_s += is_kept(cell) ? 0.0 : expected_cell_s(experiment, cell);
  progress.expect([&experiment](const Cell& cell) { return expected_cell_s(experiment, cell); },
                  to_come_s);
  const auto write_keys = [&experiment](const Cell& cell, const std::filesystem::path& file) {
    write_game_plan(part_of(experiment, cell.part), cell, file);
  };
  std::vector<Saturation> found;
  std::vector<WideRow> wide;
  Outcome outcome =
      options.saturate.is_wanted ? run_saturation(experiment, options.saturate, allowed_clients(),
                                                  settings, results, write_keys, std::cerr, found)
      : options.until_width > 0.0
          ? run_until_narrow(experiment, options, settings, results, write_keys, continuation.kept,
                             wide)
          : run_campaign(experiment, settings, results, write_keys, progress, continuation.kept);
  if (!outcome.runs.empty()) {
    std::vector<ReportSection> more_sections;
    if (options.saturate.is_wanted)
      more_sections.push_back(saturation_section(found, options.saturate.level));
    const std::string failure =
        write_results(results, experiment, outcome.runs, provenance, more_sections);
    if (outcome.output_failure.empty()) outcome.output_failure = failure;
    const Baseline baseline = experiment.baseline();
    const std::vector<RunRecord> shown = without_curves(experiment, outcome.runs);
    std::cout << (options.saturate.is_wanted
                      ? table_of(found, options.saturate.level)
                      : table_of(shown, isatty(STDOUT_FILENO) != 0, baseline))
              << std::flush;
    if (!options.saturate.is_wanted)
      std::cout << equal_error_table(equal_errors_of(experiment, outcome.runs))
                << modes_table(shown) << growth_table(growths_of(shown))
                << cores_table(cores_ratios_of(outcome.runs)) << std::flush;
  }
  if (outcome.was_interrupted) {
    std::cerr << "rink-compare: interrupted; kept " << outcome.runs.size()
              << (options.saturate.is_wanted ? ""
                                             : " of " + std::to_string(cells_of(experiment).size()))
              << " runs\n";
  }
  if (!outcome.output_failure.empty())
    std::cerr << "rink-compare: " << outcome.output_failure << "\n";
  if (!outcome.runs.empty() && outcome.output_failure.empty())
    std::cout << "report: " << (results.path() / "report.html").string() << "\n" << std::flush;
  const bool do_assertions_hold = judge(assertions, experiment, outcome);
  if (!std::cout)
    std::cerr << "rink-compare: the table could not be printed; it is in "
              << (results.path() / "report.html").string() << "\n";
  for (const WideRow& row : wide)
    std::cerr << "rink-compare: --until-width: after " << row.runs << " replications " << row.words
              << "\n";
  ExitStatus status = status_of(outcome, do_assertions_hold);
  if (!options.from.empty() && !outcome.was_interrupted) {
    const Repetition repetition = repetition_of(repeated.runs, outcome.runs);
    std::cerr << commit_words(repeated, options.from);
    (repetition.is_same() ? std::cout : std::cerr)
        << words_for(repetition, options.from) << std::flush;
    if (status == success && !repetition.is_same()) status = not_repeated;
  }
  return status == success && !wide.empty() ? width_not_reached : status;
}

ExitStatus trace(const std::filesystem::path& folder) {
  const std::size_t written = rink::loadgen::write_traces(folder);
  (written > 0 ? std::cout : std::cerr) << "rink-compare: " << folder.string() << ": traces of "
                                        << written << " valid runs that left evidence\n";
  return written > 0 ? success : nothing_measured;
}

void add_saturate_options(CLI::App& app, SaturateOptions& options) {
  CLI::Option* wanted = app.add_flag(
      "--saturate", options.is_wanted,
      "search the largest number of clients that holds a service level instead (docs/scaling.md)");
  const auto add = [&app, wanted](const char* flag, auto& value, const char* meaning) {
    return app.add_option(flag, value, meaning)->needs(wanted);
  };
  add("--on-time", options.level.on_time_fraction_min,
      "with --saturate: least fraction of ticks on time")
      ->check(rink::game::number_from(0.0, 1.0))
      ->capture_default_str();
  add("--age-ms", options.level.age_p99_ms_max,
      "with --saturate: the 99th percentile of the update age stays below [ms]")
      ->check(rink::game::number_from(0.001, 1e6))
      ->capture_default_str();
  add("--resolution", options.resolution,
      "with --saturate: relative width of the bracket at the end")
      ->check(rink::game::number_from(0.001, 10.0))
      ->capture_default_str();
  add("--most", options.most,
      "with --saturate: never more clients than this (default: the experiment's largest number)")
      ->check(rink::game::number_from(1, 100'000));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Runs every mode x scheme x policy x client count x seed of an experiment as a server and "
      "its bots over loopback, and compares them."};
  app.set_version_flag("--version", rink::game::version_line("rink-compare"));
  app.add_option(
      "EXPERIMENT", options.experiment,
      "an experiment file (docs/experiments.md), or the name of an installed one: default, gains, "
      "full, virtual, modes (with and without a server, in virtual time; over sockets: "
      "modes_sockets) and others listed there");
  app.add_option("--out", options.out,
                 "folder for the results (default: report, or report-2, ... if taken)");
  app.add_flag("--force", options.may_replace,
               "replace results that are already there; with --resume: go on even if experiment or "
               "program have changed");
  CLI::Option* resume = app.add_flag("--resume", options.is_resumed,
                                     "go on where an interrupted or killed run of the same "
                                     "experiment stopped (in --out, or the last report)");
  app.add_flag("--dry-run", options.is_dry_run,
               "print the cells, their order and the time they take, and touch nothing")
      ->excludes(resume);
  app.add_option("--assert", options.assertions,
                 "demand of the summary, e.g. 'update_age_ms_p99[scheme=region] < 100'; may be "
                 "given again (docs/experiments.md)")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--from", options.from,
                 "repeat the experiment of this report folder, which must be as it was written, "
                 "and compare")
      ->check(CLI::ExistingDirectory)
      ->excludes(app.get_option("EXPERIMENT"))
      ->excludes(resume);
  app.add_option("--trace", options.trace,
                 "write where everything truly was into this report folder, for "
                 "docs/analysis/recompute.py (some 10 MB for each run of 100 clients)")
      ->check(CLI::ExistingDirectory)
      ->excludes(app.get_option("EXPERIMENT"))
      ->excludes(app.get_option("--from"))
      ->excludes(resume);
  app.add_flag("--keep-evidence", options.keeps_evidence,
               "keep the evidence of points of curves too, for docs/analysis/recompute.py; without "
               "it, --from with it makes the same again");
  app.add_option("--seeds", options.seeds,
                 "replications of every cell: so many of the experiment's seeds, and the numbers "
                 "after them; with --until-width at most so many")
      ->check(rink::game::number_from(1, 10'000));
  const auto take_width = [&options](const std::string& text) {
    try {
      options.until_width = width_in(text);
    } catch (const ExperimentError& error) {
      throw CLI::ValidationError(error.what());
    }
  };
  app.add_option_function<std::string>(
      "--until-width", take_width,
      "replications until the 95 % interval of every row's payload is at most so wide, such as 5%: "
      "from its middle to either end, of the mean (docs/experiments.md)");
  app.add_option("--programs", options.programs,
                 "folder of rink-serve, rink-bots and rink-peer (default: that of rink-compare)");
  add_saturate_options(app, options.saturate);
  for (const char* flag :
       {"--resume", "--dry-run", "--assert", "--seeds", "--until-width", "--from"})
    app.get_option("--saturate")->excludes(app.get_option(flag));
  app.footer(schemes_and_stages() + footer);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? success : bad_usage;
  }
  if (options.until_width > 0.0 && options.seeds == 0) options.seeds = replications_max;
  heed_signals();
  try {
    if (!options.trace.empty()) return trace(options.trace);
    return compare(options, std::vector<std::string>(argv, argv + argc));
  } catch (const rink::loadgen::BaselineError& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return no_baseline;
  } catch (const rink::loadgen::RelevanceError& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return no_relevance;
  } catch (const ExperimentError& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return bad_usage;
  } catch (const ReportFolderError& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return bad_report_folder;
  } catch (const OutputError& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return output_failed;
  } catch (const std::exception& error) {
    std::cerr << "rink-compare: " << error.what() << "\n";
    return nothing_measured;
  }
}
