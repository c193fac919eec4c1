// rink-compare: runs an experiment over real sockets under every scheme and writes a table and a
// report.
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <iostream>
#include <nlohmann/json.hpp>

#include "game/apps/command.h"
#include "game/net/interrupt.h"
#include "game/net/plugins.h"
#include "game/process/process.h"
#include "game/version/version.h"
#include "loadgen/apps/compare_flags.h"
#include "loadgen/apps/left_out.h"
#include "loadgen/experiment/experiment_file.h"
#include "loadgen/experiment/plan_text.h"
#include "loadgen/measure/assertion.h"
#include "loadgen/measure/equal_error.h"
#include "loadgen/measure/growth.h"
#include "loadgen/measure/sequential.h"
#include "loadgen/measure/server_cores.h"
#include "loadgen/measure/tables/discovery_table.h"
#include "loadgen/measure/tables/modes_table.h"
#include "loadgen/measure/tables/nodes_table.h"
#include "loadgen/report/artefact.h"
#include "loadgen/report/dictionary.h"
#include "loadgen/report/sections/saturation_section.h"
#include "loadgen/report/table.h"
#include "loadgen/report/tidy.h"
#include "loadgen/report/traces.h"
#include "loadgen/report/write_report.h"
#include "loadgen/run/campaign.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/open_files.h"
#include "loadgen/run/resume.h"
#include "loadgen/run/run_journal.h"
#include "loadgen/run/saturation/saturate_command.h"

namespace {

using namespace rink::loadgen;
using rink::game::complain, rink::game::is_hung_up, rink::game::is_interrupted;

constexpr std::size_t files_besides_clients = 64;

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
  if (experiment.transport == TransportKind::bundle) return experiment.bundles + needed;
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

/// Settings without the folder for the reports. Throws ExperimentError if a program is missing.
RunnerSettings runner_settings(const CompareOptions& options, bool needs_peers, bool needs_dds) {
  RunnerSettings settings;
  const std::filesystem::path programs =
      options.programs.empty() ? own_folder() : std::filesystem::path(options.programs);
  settings.serve = programs / "rink-serve";
  settings.bots = programs / "rink-bots";
  settings.peer = programs / "rink-peer";
  settings.dds = programs / "rink-dds";
  expect_program(settings.serve);
  expect_program(settings.bots);
  if (needs_peers) expect_program(settings.peer);
  if (needs_dds) expect_program(settings.dds);
  settings.is_interrupted = &is_interrupted;
  settings.keeps_traces_of_curves = options.keeps_traces;
  pin_apart(settings, rink::game::allowed_processors());
  return settings;
}

/// Writes the results of all runs; returns why that failed, or an empty text.
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

/// The first `count` of the experiment's own seeds, followed by the numbers after the largest where
/// there are fewer; all own seeds if `count` is 0.
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
CampaignResult run_until_narrow(Experiment& experiment, const CompareOptions& options,
                                const Campaign& campaign, std::vector<RunRecord> kept,
                                std::vector<WideRow>& wide) {
  assert(&campaign.experiment == &experiment && "what is run gains the seeds");
  CampaignResult outcome;
  for (std::uint32_t count = std::min(options.seeds, least_replications); count <= options.seeds;
       ++count) {
    set_seeds(experiment, count);
    Progress progress(std::cerr, isatty(STDERR_FILENO) != 0,
                      cells_of(experiment).size() - kept.size(), expected_cell_s(experiment));
    outcome = run_campaign(campaign, progress, std::move(kept));
    if (outcome.was_interrupted || !outcome.output_failure.empty()) break;
    wide = wider_rows(summarise(outcome.runs, experiment.baseline()), options.until_width,
                      count - std::min(options.seeds, least_replications) + 1);
    if (wide.empty()) break;
    kept = outcome.runs;
  }
  return outcome;
}

CompareStatus status_of(const CampaignResult& outcome, bool do_assertions_hold) {
  if (outcome.was_interrupted) return is_hung_up ? hung_up : interrupted;
  if (!outcome.output_failure.empty()) return output_failed;
  const auto valid = std::count_if(outcome.runs.begin(), outcome.runs.end(),
                                   [](const RunRecord& run) { return run.valid; });
  if (valid == 0) return nothing_measured;
  if (!do_assertions_hold) return assertion_failed;
  if (!std::cout) return reader_gone;
  return static_cast<std::size_t>(valid) < outcome.runs.size() ? some_invalid : success;
}

/// Prints the result of each assertion; true if all hold.
bool judge(const std::vector<Assertion>& assertions, const Experiment& experiment,
           const CampaignResult& outcome) {
  if (outcome.was_interrupted && !assertions.empty())
    complain("interrupted, so no --assert was checked");
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

/// Opens the folder and finds the runs in it that are kept.
Continuation opened_results(const CompareOptions& options, const Experiment& experiment,
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

/// A repetition must not overwrite the folder that it repeats.
void expect_other_folder(const CompareOptions& options) {
  if (options.out.empty()) return;
  if (std::filesystem::weakly_canonical(options.out) ==
      std::filesystem::weakly_canonical(options.from))
    throw ExperimentError("--out " + options.out +
                          " is the folder of --from: expected another one for the repetition");
}

CompareStatus compare(const CompareOptions& options, const std::vector<std::string>& command_line) {
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
  const std::string absent = left_out(experiment);
  std::vector<Assertion> assertions;
  for (const std::string& text : options.assertions) assertions.emplace_back(text, experiment);
  if (options.is_dry_run) {
    std::cout << absent << plan_text(experiment, files_needed(experiment), raise_open_file_limit())
              << std::flush;
    return std::cout ? success : reader_gone;
  }
  if (!options.saturate.is_wanted) expect_enough_files(experiment);
  const std::vector<Cell> cells = cells_of(experiment);
  const auto is_virtual_cell = [&experiment](const Cell& cell) {
    return part_of(experiment, cell.part).transport == TransportKind::virtual_time;
  };
  const bool is_virtual = std::ranges::all_of(cells, is_virtual_cell);
  const auto has_mode = [&cells](const char* mode) {
    return std::ranges::any_of(cells, [mode](const Cell& cell) { return cell.mode == mode; });
  };
  RunnerSettings settings =
      runner_settings(options, has_mode(peer_mode) && !is_virtual, has_mode(dds_mode));
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
  const Campaign campaign{.experiment = experiment,
                          .settings = settings,
                          .results = results,
                          .write_key_log = [&experiment](const Cell& cell, const auto& file) {
                            write_game_plan(part_of(experiment, cell.part), cell, file);
                          }};
  SaturateOptions search = options.saturate;
  if (search.is_wanted) search.allowed_clients = allowed_clients();
  std::vector<Saturation> found;
  std::vector<WideRow> wide;
  CampaignResult outcome =
      search.is_wanted ? run_saturation(campaign, search, std::cerr, found)
      : options.until_width > 0.0
          ? run_until_narrow(experiment, options, campaign, continuation.kept, wide)
          : run_campaign(campaign, progress, continuation.kept);
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
              << absent << std::flush;
    if (!options.saturate.is_wanted)
      std::cout << equal_error_table(equal_errors_of(experiment, outcome.runs))
                << modes_table(shown) << nodes_table(shown) << growth_table(growths_of(shown))
                << cores_table(cores_ratios_of(outcome.runs)) << std::flush;
  }
  if (outcome.was_interrupted) {
    complain("interrupted; kept ", outcome.runs.size(),
             options.saturate.is_wanted ? "" : " of " + std::to_string(cells_of(experiment).size()),
             " runs");
  }
  if (!outcome.output_failure.empty()) complain(outcome.output_failure);
  if (!outcome.runs.empty() && outcome.output_failure.empty())
    std::cout << "report: " << (results.path() / "report.html").string() << "\n" << std::flush;
  const bool do_assertions_hold = judge(assertions, experiment, outcome);
  if (!std::cout)
    complain("the table could not be printed; it is in ",
             (results.path() / "report.html").string());
  for (const WideRow& row : wide)
    complain("--until-width: after ", row.runs, " replications ", row.words);
  CompareStatus status = status_of(outcome, do_assertions_hold);
  if (!options.from.empty() && !outcome.was_interrupted) {
    const Repetition repetition = repetition_of(repeated.runs, outcome.runs);
    std::cerr << commit_words(repeated, options.from);
    (repetition.is_same() ? std::cout : std::cerr)
        << words_for(repetition, options.from) << std::flush;
    if (status == success && !repetition.is_same()) status = not_repeated;
  }
  return status == success && !wide.empty() ? width_not_reached : status;
}

CompareStatus trace(const std::filesystem::path& folder) {
  const std::size_t written = rink::loadgen::write_traces(folder);
  (written > 0 ? std::cout : std::cerr) << "rink-compare: " << folder.string() << ": traces of "
                                        << written << " valid runs that have evidence\n";
  return written > 0 ? success : nothing_measured;
}

template <class Error>
bool is(const std::exception& error) {
  return dynamic_cast<const Error*>(&error) != nullptr;
}

int status_after(const std::exception& error) {
  if (is<BaselineError>(error)) return no_baseline;
  if (is<RelevanceError>(error)) return no_relevance;
  if (is<ExperimentError>(error) || is<rink::game::PluginError>(error)) return bad_usage;
  if (is<ReportFolderError>(error)) return bad_report_folder;
  return is<OutputError>(error) ? output_failed : nothing_measured;
}

}  // namespace

int main(int count, char** words) {
  rink::game::speak_as("rink-compare");
  CompareOptions options;
  rink::game::Flags flags(
      "Runs every mode x scheme x policy x client count x seed of an experiment as a server and "
      "its bots over loopback, and compares them.",
      "rink compare");
  flags.version(rink::game::version_line("rink-compare"));
  add_options(flags, options);
  const auto run = [&]() -> int {
    if (options.until_width > 0.0 && options.seeds == 0) options.seeds = replications_max;
    for (const std::string& file : options.plugins) rink::game::load_plugin(file);
    if (!options.trace.empty()) return trace(options.trace);
    return compare(options, std::vector<std::string>(words, words + count));
  };
  return rink::game::run_command(flags, count, words,
                                 {.run = run, .status_of = status_after, .bad_flags = bad_usage});
}
