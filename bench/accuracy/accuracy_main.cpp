// rink accuracy: run time against error, and who survives what, for Rink's engines and other
// libraries in the same run.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "bench/accuracy/accuracy_report.h"
#include "bench/accuracy/tables.h"
#include "bench/peers/peers.h"
#include "bench/trials/stability_trials.h"
#include "game/apps/command.h"
#include "game/model/listed.h"
#include "game/net/interrupt.h"
#include "game/physics/simulator_choice.h"
#include "game/version/version.h"
#include "loadgen/report/provenance.h"

namespace {

using namespace rink::accuracy;
using rink::game::Check, rink::game::is_interrupted;
namespace fs = std::filesystem;

enum ExitStatus { success = 0, bad_usage = 2, output_failed = 5, interrupted = 130 };

constexpr const char* footer = R"(
Scenes of the diagram: pairs, gas, dense, packed, fast, drag, bats, pressed. Scenes of --stability: fast, dense, collapse, post, wedge, corner, mass-ratio,
cradle, overlap, crowd. The folder then holds report.html (reads offline), points.csv or stability.csv with all that was measured, and plots/ with the
data of each plot. Method, error measure and the settings of the other libraries: docs/accuracy.md.

Exit status: 0 done; 2 bad usage; 5 results could not be written, or are already there; 130 interrupted (what was measured is kept).

Example: rink accuracy --scenes gas,dense --engines exact,chipmunk,box2d --out accuracy)";

struct Options {
  std::string out;
  std::vector<std::string> scenes, engines, integrators;
  bool is_stability = false, is_quick = false, is_full = false;
  double dt = frame;
};

/// What cannot be written; what() names it.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Unlike game::one_of it leaves the names to the flag's meaning.
Check expected_one_of(const std::vector<std::string>& names) {
  return {[names](const std::string& name) -> std::string {
            return std::ranges::find(names, name) != names.end()
                       ? ""
                       : name + ": expected one of " + rink::game::listed(names);
          },
          ""};
}

template <class Trials, class Name>
std::vector<std::string> names_of(const Trials& trials, Name name) {
  std::vector<std::string> names;
  for (const auto& trial : trials) names.push_back(name(trial));
  return names;
}

/// The first of `accuracy`, `accuracy-2`, ... that is not there.
fs::path free_folder() {
  fs::path path = "accuracy";
  for (int number = 2; fs::exists(path); ++number) path = "accuracy-" + std::to_string(number);
  return path;
}

/// Made before anything is measured, so that a long run does not end in a folder that cannot be
/// written.
fs::path made_folder(const std::string& out) {
  const fs::path path = out.empty() ? free_folder() : fs::path(out);
  std::error_code error;
  if (fs::exists(path, error) && !(fs::is_directory(path, error) && fs::is_empty(path, error)))
    throw OutputError(path.string() +
                      ": already there; choose another --out, nothing is ever overwritten");
  fs::create_directories(path / "plots", error);
  if (error) throw OutputError(path.string() + ": cannot be made a folder: " + error.message());
  return path;
}

void write(const fs::path& file, const std::string& content) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << content << std::flush;
  if (!stream)
    throw OutputError(file.string() + ": cannot be written: " +
                      (errno != 0 ? std::strerror(errno) : "unknown reason"));
}

/// One line that is overwritten in place on a terminal, nothing elsewhere.
void show_progress(const std::string& text) {
  if (isatty(STDERR_FILENO) != 0) std::cerr << "\r\033[K" << text << std::flush;
}

bool is_wanted(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::ranges::find(wanted, name) != wanted.end();
}

Effort effort_of(const Options& options) {
  if (options.is_quick) return {.run_max_s = 0.02, .repeats = 3, .limit_s = 5.0};
  if (options.is_full) return {.run_max_s = 2.0, .repeats = 5, .limit_s = 300.0};
  return {};
}

void measure_diagram(const Options& options, Findings& findings) {
  const std::vector<Contender> all = contenders(options.engines, options.integrators);
  for (DiagramTrial& trial : diagram_trials()) {
    if (!is_wanted(options.scenes, trial.trial.name) || is_interrupted) continue;
    const std::vector<Vector2> truth = trial.true_places(trial.trial);
    Panel& panel = findings.panels.emplace_back(Panel{std::move(trial)});
    for (const Contender& contender : all) {
      show_progress(panel.trial.trial.name + ": " + contender.name());
      Series series =
          measure_series(panel.trial, truth, contender, effort_of(options), is_interrupted);
      if (!series.points.empty() || !is_interrupted) panel.series.push_back(std::move(series));
      if (is_interrupted) break;
    }
    show_progress("");
    std::cout << text_of(panel) << std::endl;
  }
  std::cout << panel_legend;
}

void measure_stability(const Options& options, Findings& findings) {
  std::vector<Contender> all = contenders(options.engines, options.integrators);
  const double limit_s = options.is_quick ? 3.0 : options.is_full ? 120.0 : 10.0;
  for (Trial& trial : stability_trials()) {
    if (!is_wanted(options.scenes, trial.name) || is_interrupted) continue;
    Ordeal& ordeal = findings.ordeals.emplace_back(Ordeal{std::move(trial)});
    for (const Contender& contender : all) {
      show_progress(ordeal.trial.name + ": " + contender.name());
      Survival survival =
          try_to_survive(ordeal.trial, contender, options.dt, limit_s, is_interrupted);
      if (is_interrupted) break;
      ordeal.survivals.push_back(std::move(survival));
    }
    show_progress("");
    std::cout << text_of(ordeal) << std::endl;
  }
  std::cout << ordeal_legend << "steps of " << options.dt << " s; at most " << limit_s
            << " s of real time each\n";
}

rink::loadgen::Provenance provenance_with_peers(const std::vector<std::string>& command_line) {
  rink::loadgen::Provenance provenance =
      rink::loadgen::provenance_of(command_line, rink::loadgen::wake_up_lateness());
  for (const char* peer : {"chipmunk", "box2d", "box2d3"})
    provenance.facts.emplace_back(peer, rink::peers::version_of(peer));
  return provenance;
}

int run(const Options& options, const std::vector<std::string>& command_line) {
  const fs::path folder = made_folder(options.out);
  Findings findings;
  findings.absences = absences(options.engines);
  if (options.is_stability) measure_stability(options, findings);
  else measure_diagram(options, findings);
  findings.is_interrupted = is_interrupted;
  for (const std::string& absence : findings.absences) std::cout << absence << "\n";
  const rink::loadgen::Provenance provenance = provenance_with_peers(command_line);
  const rink::loadgen::Report report = report_of(findings, provenance);
  for (const rink::loadgen::PlotTable& table : report.tables)
    write(folder / "plots" / (table.name + ".csv"), to_csv(table, provenance));
  if (options.is_stability)
    write(folder / "stability.csv", to_csv(stability_table(findings.ordeals), provenance));
  else write(folder / "points.csv", to_csv(points_table("points", findings.panels), provenance));
  write(folder / "report.html", report.html);
  std::cout << (is_interrupted ? "interrupted; what was measured is in " : "report: ")
            << (folder / "report.html").string() << std::endl;
  return is_interrupted ? interrupted : success;
}

}  // namespace

int main(int count, char** words) {
  rink::game::speak_as("rink accuracy");
  Options options;
  rink::game::Flags flags(
      "Measures run time against error for every engine, integrator and step, with Chipmunk and "
      "Box2D beside them, or who survives what is hard.",
      "rink accuracy");
  flags.version(rink::game::version_line("rink-accuracy"));
  const auto diagram_names =
      names_of(diagram_trials(), [](const DiagramTrial& trial) { return trial.trial.name; });
  const auto stability_names =
      names_of(stability_trials(), [](const Trial& trial) { return trial.name; });
  flags.flag(
      "--stability", options.is_stability,
      "the stability table instead: overlap, escapes, energy error, events, survived or not");
  flags.option("--out", options.out,
               "folder for the report, made if it is not there, refused if it holds anything "
               "(default: accuracy, or the first free of accuracy-2, ...)");
  flags.option("--scenes", options.scenes, "only these, separated by commas (default: all)")
      .delimiter(',');
  flags
      .option("--engines", options.engines,
              "only these, separated by commas: " + rink::game::listed(contender_engines()) +
                  " (default: all)")
      .delimiter(',')
      .check(expected_one_of(contender_engines()));
  flags
      .option("--integrators", options.integrators,
              "of paper and naive, separated by commas: " +
                  rink::game::listed(rink::physics::integrator_names()) + " (default: all)")
      .delimiter(',')
      .check(expected_one_of(rink::physics::integrator_names()));
  const rink::game::Flag quick =
      flags.flag("--quick", options.is_quick, "short runs: half a minute");
  flags.flag("--full", options.is_full, "steps until a run takes 2 s: about twenty minutes")
      .excludes(quick);
  flags
      .option("--dt", options.dt,
              "step of the stepping engines with --stability [s] (default: 1/60)")
      .check(rink::game::number_from(1e-6, 1.0));
  flags.footer(footer);
  const auto expect_scenes = [&] {
    const Check check = expected_one_of(options.is_stability ? stability_names : diagram_names);
    for (const std::string& scene : options.scenes)
      if (const std::string objection = check.objection(scene); !objection.empty())
        throw rink::game::FlagError("--scenes", objection);
  };
  return rink::game::run_command(
      flags, count, words,
      {.run =
           [&] {
             expect_scenes();
             return run(options, std::vector<std::string>(words, words + count));
           },
       .status_of = [](const std::exception& error) -> int {
         return dynamic_cast<const OutputError*>(&error) != nullptr ? output_failed : bad_usage;
       },
       .bad_flags = bad_usage});
}
