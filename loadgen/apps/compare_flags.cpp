// Defines the flags of rink compare and its help text.
#include "loadgen/apps/compare_flags.h"

#include "game/apps/plugin_flag.h"
#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/sequential.h"
#include "rti/schemes.h"

namespace rink::loadgen {
namespace {

constexpr const char* footer = R"(
The folder then holds runs.jsonl (a line per run), summary.csv (means over seeds with 95 % intervals), comparisons.csv
(ratios to the baseline, paired by seed), tidy.csv (an observation per line; data-dictionary.csv defines each figure),
report.html (reads offline), plots/ (each plot as .svg and its data as .csv), provenance.json, keys/ (the key log of each game) and cells/ (the reports of the processes).

Exit status: 0 all runs valid; 2 bad usage, experiment or scene; 3 some run does not count; 4 no run counts;
             5 results could not be written, or may not be replaced; 6 an --assert failed; 7 the table could not be
             printed (the folder is complete); 8 a baseline that no cell has; 9 intervals are wider than --until-width
             asks for after --seeds replications; 10 the folder of --from lacks a file, has one altered or is of another
             version; 11 the repetition by --from gives other figures; 12 a relevance expression is faulty; 129 the terminal
             closed; 130 interrupted (what was measured is kept).

Example: rink compare gains --out gains --assert 'filter_recall[scheme=region] >= 0.99')";

/// Lists all schemes and stages with their parameters.
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
  return lines("\nSchemes, which and, or, not and parentheses combine:\n",
               rink::im::filter_names()) +
         "  when \"CONDITION\"  anywhere \"CONDITION\", as in when \"distance < 4 and team == "
         "mine\"\n" +
         lines(
             "\nStages, each of which may follow any scheme after with, as in \"aura and not sight "
             "with "
             "hysteresis(margin=0.3)\" (docs/im.md):\n",
             rink::im::stage_names());
}

void add_saturate_options(game::Flags& flags, SaturateOptions& options) {
  const game::Flag wanted = flags.flag(
      "--saturate", options.is_wanted,
      "search the largest number of clients that holds a service level instead (docs/scaling.md)");
  const auto add = [&flags, wanted](const char* flag, auto& value, const char* meaning) {
    return flags.option(flag, value, meaning).needs(wanted);
  };
  add("--on-time", options.level.on_time_fraction_min,
      "with --saturate: least fraction of ticks on time")
      .check(game::number_from(0.0, 1.0))
      .shows_default();
  add("--age-ms", options.level.age_p99_ms_max,
      "with --saturate: the 99th percentile of the update age stays below [ms]")
      .check(game::number_from(0.001, 1e6))
      .shows_default();
  add("--resolution", options.resolution,
      "with --saturate: relative width of the bracket at the end")
      .check(game::number_from(0.001, 10.0))
      .shows_default();
  add("--most", options.most,
      "with --saturate: never more clients than this (default: the experiment's largest number)")
      .check(game::number_from(1, 100'000));
}

}  // namespace

void add_options(game::Flags& flags, CompareOptions& options) {
  flags.option(
      "EXPERIMENT", options.experiment,
      "an experiment file (docs/experiments.md), or the name of an installed one: default, gains, "
      "full, virtual, modes (with and without a server, in virtual time; over sockets: "
      "modes_sockets), nodes (servers that share a simulation), traces (a mobility trace without a "
      "game), published (schemes of the literature) and others listed there");
  flags.option("--out", options.out,
               "folder for the results (default: report, or report-2, ... if taken)");
  flags.flag("--force", options.may_replace,
             "replace existing results; with --resume: continue even if experiment or program have "
             "changed");
  const game::Flag resume = flags.flag("--resume", options.is_resumed,
                                       "continue where an interrupted or killed run of the same "
                                       "experiment stopped (in --out, or the last report)");
  flags
      .flag("--dry-run", options.is_dry_run,
            "print the cells, their order and the time they take, and run nothing")
      .excludes(resume);
  flags
      .option("--assert", options.assertions,
              "condition on the summary, e.g. 'update_age_ms_p99[scheme=region] < 100'; may be "
              "repeated (docs/experiments.md)")
      .repeats();
  flags
      .option("--from", options.from,
              "repeat the experiment of this report folder, which must be unaltered, and compare "
              "the results")
      .check(game::existing_folder())
      .excludes(flags.find("EXPERIMENT"))
      .excludes(resume);
  flags
      .option("--trace", options.trace,
              "write all true positions into this report folder, for "
              "docs/analysis/recompute.py (some 10 MB for each run of 100 clients)")
      .check(game::existing_folder())
      .excludes(flags.find("EXPERIMENT"))
      .excludes(flags.find("--from"))
      .excludes(resume);
  flags.flag("--keep-evidence", options.keeps_traces,
             "keep the evidence of points of curves too, for docs/analysis/recompute.py; --from "
             "with this flag can make it later");
  flags
      .option(
          "--seeds", options.seeds,
          "number of replications of every cell: the experiment's first seeds, then the numbers "
          "after them; with --until-width the most replications")
      .check(game::number_from(1, 10'000));
  flags.option(
      "--until-width",
      [&options](const std::string& text) {
        try {
          options.until_width = width_in(text);
        } catch (const ExperimentError& error) {
          throw game::FlagError("", error.what());
        }
      },
      "add replications until the 95 % interval of every row's payload is at most so wide, such as "
      "5% of the mean from its middle to either end (docs/experiments.md)");
  game::add_plugin_option(flags, options.plugins);
  flags.option("--programs", options.programs,
               "folder of rink-serve, rink-bots and rink-peer (default: that of rink-compare)");
  add_saturate_options(flags, options.saturate);
  for (const char* flag :
       {"--resume", "--dry-run", "--assert", "--seeds", "--until-width", "--from"})
    flags.find("--saturate").excludes(flags.find(flag));
  flags.footer(schemes_and_stages() + footer);
}

}  // namespace rink::loadgen
