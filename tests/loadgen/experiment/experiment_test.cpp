// Experiment files: what they mean, the order of their cells, and complaints that name file, line,
// key and what is allowed.
#include "loadgen/experiment/experiment_file.h"
#include "loadgen/experiment/parameter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "loadgen/experiment/plan_text.h"
#include "tests/loadgen/complaint.h"
#include "tests/places.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string minimal = "name = \"x\"\nscene = \"crowd\"\n";

std::string complaint_about(const std::string& text) {
  return complaint_of([&] { parse_experiment(text, "dir/x.toml", {}); });
}

TEST(ExperimentFile, WhatIsNotSaidHasTheDocumentedDefault) {
  const Experiment read = parse_experiment(minimal, "x.toml", {}), defaults;
  EXPECT_EQ(read.name, "x");
  EXPECT_EQ(read.scene, "crowd");
  EXPECT_EQ(read.schemes, defaults.schemes);
  EXPECT_EQ(read.clients, defaults.clients);
  EXPECT_EQ(read.tick_rates_hz, std::vector<double>{30.0});
  EXPECT_EQ(read.view_fractions, std::vector<double>{0.05});
  EXPECT_EQ(read.population, Population::fixed);
  EXPECT_EQ(read.keys, KeySource::replay);
  EXPECT_EQ(read.text, minimal);
}

TEST(ExperimentFile, ASceneFileIsLookedForBesideTheExperiment) {
  EXPECT_EQ(parse_experiment("name='x'\nscene='my.toml'", "dir/x.toml", {}).scene, "dir/my.toml");
  EXPECT_EQ(parse_experiment("name='x'\nscene='/abs/my.toml'", "dir/x.toml", {}).scene,
            "/abs/my.toml");
  EXPECT_EQ(parse_experiment("name='x'\nscene='match'", "dir/x.toml", {}).scene, "match");
}

TEST(ExperimentFile, TakesExpressionsForSchemesAndSaysWhatIsWrongWithOne) {
  const Experiment read = parse_experiment(
      minimal + "schemes = ['region', 'aura and not sight with dwell(matches=3)']", "x.toml", {});
  ASSERT_EQ(read.schemes.size(), 2u);
  EXPECT_EQ(read.baseline_scheme, "region");
  EXPECT_THAT(name_of(cells_of(read)[1]),
              StartsWith("client-server-aura_and_not_sight_with_dwell[matches=3]-periodic"));
  EXPECT_THAT(complaint_about(minimal + "schemes = ['region', 'aura and not sihgt']"),
              AllOf(StartsWith("dir/x.toml:3: schemes"), HasSubstr("no scheme is called 'sihgt'")));
  EXPECT_THAT(complaint_about(minimal + "schemes = ['grid(cell_size=0)']"),
              HasSubstr("grid: cell_size = 0 is not a number from 0.001"));
  EXPECT_THAT(complaint_about(minimal + "schemes = 7"), HasSubstr("schemes = 7"));
}

TEST(ExperimentFile, ComplaintsNameFileLineKeyValueAndWhatIsAllowed) {
  EXPECT_THAT(complaint_about(minimal + "schemes = ['none', 'gird']"),
              AllOf(StartsWith("dir/x.toml:3: schemes"), HasSubstr("gird"), HasSubstr("none"),
                    HasSubstr("grid"), HasSubstr("region")));
  EXPECT_THAT(complaint_about(minimal + "schemes = ['aura', 'grid', ' (aura)']"),
              HasSubstr("schemes: 'aura' and ' (aura)' mean the same"));
  EXPECT_THAT(complaint_about(minimal + "clients = [10,\n0]"),
              AllOf(StartsWith("dir/x.toml:4: clients = 0"), HasSubstr("from 1 to 100000")));
  EXPECT_THAT(complaint_about(minimal + "clients = []"), StartsWith("dir/x.toml:3: clients"));
  EXPECT_THAT(complaint_about(minimal + "clients = [5, 5]"),
              AllOf(StartsWith("dir/x.toml:3: clients = 5"), HasSubstr("once")));
  EXPECT_THAT(complaint_about(minimal + "clients = 'many'"), HasSubstr("whole numbers"));
  EXPECT_THAT(complaint_about(minimal + "clients = 10.5"), HasSubstr("whole numbers"));
  EXPECT_THAT(complaint_about(minimal + "seeds = -1"), StartsWith("dir/x.toml:3: seeds = -1"));
  EXPECT_THAT(complaint_about(minimal + "\n\ntick_rate_hz = 0"),
              AllOf(StartsWith("dir/x.toml:5: tick_rate_hz = 0"), HasSubstr("1 to 1000")));
  EXPECT_THAT(complaint_about(minimal + "duration_s = nan"),
              StartsWith("dir/x.toml:3: duration_s"));
  EXPECT_THAT(complaint_about(minimal + "warm_up_s = 'long'"),
              AllOf(StartsWith("dir/x.toml:3: warm_up_s"), HasSubstr("0 to 600")));
  EXPECT_THAT(complaint_about(minimal + "view_fraction = 1.5"), HasSubstr("above 0 and at most 1"));
  EXPECT_THAT(complaint_about(minimal + "cell_size = -2"), StartsWith("dir/x.toml:3: cell_size"));
  EXPECT_THAT(complaint_about(minimal + "cell_size = 1e-308"),
              StartsWith("dir/x.toml:3: cell_size"));
  EXPECT_THAT(complaint_about(minimal + "population = 'growing'"), HasSubstr("fixed, per_client"));
  EXPECT_THAT(complaint_about(minimal + "keys = true"), HasSubstr("replay, live"));
  EXPECT_THAT(
      complaint_about(minimal + "viewfraction = 0.1"),
      AllOf(StartsWith("dir/x.toml:3: unknown key viewfraction"), HasSubstr("view_fraction")));
  EXPECT_THAT(complaint_about(minimal + "view_fraction = [0.1, 2]"),
              HasSubstr("view_fraction = 2"));
  EXPECT_THAT(complaint_about(minimal + "view_fraction = [0.1, 0.2]\nview_area = 4"),
              AllOf(StartsWith("dir/x.toml:4: view_area = 4"), HasSubstr("single view_fraction")));
  EXPECT_THAT(complaint_about(minimal + "sweep_ticks = -1"), HasSubstr("from 0 to 1000"));
  EXPECT_THAT(complaint_about(minimal + "transport = 'mpi'"),
              HasSubstr("tcp, udp, shm, bundle, virtual"));
  EXPECT_THAT(complaint_about(minimal + "bundles = 2"),
              AllOf(StartsWith("dir/x.toml:3: bundles = 2"), HasSubstr("transport = \"bundle\"")));
  EXPECT_THAT(complaint_about(minimal + "transport = 'bundle'\nbundles = 0"),
              AllOf(StartsWith("dir/x.toml:4: bundles = 0"), HasSubstr("from 1 to 10000")));
  EXPECT_THAT(complaint_about(minimal + "delay_ms = -1"), HasSubstr("0 to 10000"));
  EXPECT_THAT(complaint_about(minimal + "relevance = 'square'"),
              HasSubstr("rectangle, disc, contact, filter"));
  for (const char* seconds : {"0", "10.5", "-1"})
    EXPECT_THAT(complaint_about(minimal + "contact_s = " + seconds),
                HasSubstr("above 0 and at most 10"));
  EXPECT_THAT(complaint_about(minimal + "also_relevant = 'mates'"), HasSubstr("team, always"));
  EXPECT_THAT(complaint_about(minimal + "schemes = 'always or aura'\nalways = ['bat', 'pucks']"),
              AllOf(StartsWith("dir/x.toml:4: always = 'pucks'"), HasSubstr("puck, bat, post")));
  EXPECT_THAT(
      complaint_about(minimal + "always = ['bat', 'puck']"),
      HasSubstr(
          "always = bat, puck changes nothing: neither schemes nor also_relevant name always"));
  EXPECT_THAT(complaint_about(minimal + "players = 'nobody'"),
              AllOf(HasSubstr("random, chaser"), HasSubstr("recorded key log")));
  EXPECT_THAT(complaint_about(minimal + "schemes = ['grid']\nbaseline_scheme = 'none'"),
              AllOf(HasSubstr(":4: baseline_scheme = 'none'"), HasSubstr("is compared: grid")));
  EXPECT_THAT(complaint_about(minimal + "server_cores = 3"), HasSubstr("from 1 to 2"));
  EXPECT_THAT(complaint_about("scene = 'crowd'"),
              AllOf(StartsWith("dir/x.toml: name"), HasSubstr("required")));
  EXPECT_THAT(complaint_about("name = 3\nscene = 'crowd'"), StartsWith("dir/x.toml:1: name = 3"));
  EXPECT_THAT(complaint_about(minimal + "clients = [1,,2]"),
              AllOf(StartsWith("dir/x.toml:3:"), HasSubstr("not TOML")));
}

/// Characters are counted from 1, and one beyond the last is where something is missing.
TEST(ExperimentFile, ARelevanceExpressionThatIsNoneIsRefusedByFileKeyAndPlaceInIt) {
  const auto complaint = [](const std::string& relevant) {
    try {
      parse_experiment(minimal + "relevance = 'filter'\n" + relevant, "dir/x.toml", {});
    } catch (const RelevanceError& error) {
      return std::string(error.what());
    }
    return std::string("no relevance error");
  };
  EXPECT_THAT(complaint("relevant = 'aura and sigth'"),
              AllOf(StartsWith("dir/x.toml:4: relevant = 'aura and sigth'"),
                    HasSubstr("at character 10: no scheme is called 'sigth'")));
  EXPECT_THAT(complaint("relevant = 'aura and (sight'"),
              HasSubstr("at character 16: expected ')' where it ends"));
  EXPECT_THAT(complaint("relevant = 'aura nor sight'"),
              HasSubstr("at character 6: expected 'and', 'or', 'with' or the end at 'nor'"));
  EXPECT_THAT(complaint("relevant = 'team or grid(cell_size=0)'"),
              HasSubstr("at character 9: grid: cell_size = 0 is not a number"));
  EXPECT_THAT(complaint("relevant = 'cone(half_angle=)'"),
              HasSubstr("at character 17: expected a number"));
  EXPECT_THAT(complaint("relevant = ''"),
              HasSubstr("at character 1: expected the name of a scheme"));
  EXPECT_THAT(complaint("relevant = 5"),
              HasSubstr("relevant = 5: no relevance: at character 1: not a text"));
  EXPECT_THAT(complaint(""), HasSubstr("dir/x.toml: relevance = filter: relevant is missing"));
  EXPECT_EQ(complaint("relevant = 'aura and not (sight or cone(half_angle=30)) or team'"),
            "no relevance error");
}

/// What they say depends on more than how things are.
TEST(ExperimentFile, StagesSayNotWhatIsRelevantAtAnInstant) {
  for (const auto& [stage, why] :
       {std::pair{"hysteresis(margin=0.3)", "depends on what was relevant before"},
        {"dwell(matches=3)", "depends on what was relevant before"},
        {"swept(horizon=0.1)", "depends on predicted flights"},
        {"tiers(at=0.5)", "decides how often an entity is updated"},
        {"vfc(at=0.5 matches=3)", "decides how often an entity is updated"},
        {"priority(budget=100)", "decides how often"}}) {
    const std::string complaint = complaint_about(
                          minimal + "relevance = 'filter'\nrelevant = 'team or (aura with " +
                          stage + ")'"),
                      refused = complaint_about(
                          minimal + "relevance = 'filter'\nrelevant = 'aura with " + stage + "'");
    EXPECT_THAT(refused, AllOf(HasSubstr("dir/x.toml:4: relevant"),
                               HasSubstr("at character 11: " +
                                         std::string(stage, std::string(stage).find('('))),
                               HasSubstr(why)))
        << stage;
    EXPECT_THAT(complaint, HasSubstr("relevant")) << stage;
  }
  EXPECT_THAT(
      complaint_about(minimal +
                      "relevance = 'filter'\nrelevant = 'team or (aura with dwell(matches=3))'"),
      HasSubstr("at character 20: dwell depends on"));
}

TEST(ExperimentFile, WhatBelongsToAnotherKindOfRelevanceIsRefused) {
  EXPECT_THAT(
      complaint_about(minimal + "contact_s = 0.25"),
      HasSubstr("dir/x.toml:3: contact_s = 0.25 changes nothing: relevance is not contact"));
  EXPECT_THAT(
      complaint_about(minimal + "relevance = 'disc'\nrelevant = 'aura'"),
      HasSubstr("dir/x.toml:4: relevant = 'aura' changes nothing: relevance is not filter"));
  const std::string parts =
      "contact_s = 0.2\nrelevant = 'aura'\n[[parts]]\nname = 'a'\nrelevance = "
      "'contact'\n[[parts]]\nname = 'b'\nrelevance = 'filter'\n";
  const Experiment experiment = parse_experiment(minimal + parts, "dir/x.toml", {});
  EXPECT_EQ(experiment.parts[0].contact_s, 0.2);
  EXPECT_EQ(experiment.parts[1].relevant, "aura");
  EXPECT_THAT(complaint_about(minimal + parts + "contact_s = 0.75\n"),
              HasSubstr("parts.contact_s = 0.75 changes nothing"));
  EXPECT_THAT(complaint_about(minimal + "relevant = 'aura'\n[[parts]]\nname = 'a'\n"),
              HasSubstr("dir/x.toml:3: relevant = 'aura' changes nothing"));
}

TEST(ExperimentFile, AFileThatCannotBeReadIsNamed) {
  for (const char* file : {"/nowhere/x.toml", "/"}) {
    try {
      load_experiment(file, {});
      FAIL() << file;
    } catch (const ExperimentError& error) {
      EXPECT_THAT(error.what(), AllOf(StartsWith(file), HasSubstr("cannot be read")));
    }
  }
}

TEST(ExperimentFile, SchemesAreInterleavedAndSeedsAreOutermost) {
  const auto experiment = parse_experiment(
      minimal + "schemes=['none','grid']\nclients=[1,2]\nseeds=[7,8]", "x.toml", {});
  std::vector<std::string> names;
  for (const Cell& cell : cells_of(experiment)) names.push_back(name_of(cell));
  EXPECT_THAT(
      names,
      ElementsAre("client-server-none-periodic-1-seed7", "client-server-grid-periodic-1-seed7",
                  "client-server-none-periodic-2-seed7", "client-server-grid-periodic-2-seed7",
                  "client-server-none-periodic-1-seed8", "client-server-grid-periodic-1-seed8",
                  "client-server-none-periodic-2-seed8", "client-server-grid-periodic-2-seed8"));
}

TEST(ExperimentFile, CellsThatDifferOnlyInWhatTheirSchemeLacksRunOnce) {
  const auto experiment =
      parse_experiment(minimal +
                           "schemes=['none','grid','region']\nview_margin=[0,0.5]\nsweep_ticks=[0,"
                           "2]\ncell_size=[0,1,3]\npucks=[0,70]",
                       "x.toml", {});
  const std::vector<Cell> cells = cells_of(experiment);
  const auto count = [&cells](const std::string& scheme) {
    return std::count_if(cells.begin(), cells.end(),
                         [&](const Cell& cell) { return cell.scheme == scheme; });
  };
  EXPECT_EQ(count("none"), 2);
  EXPECT_EQ(count("grid"), 2 * 2 * 2 * 3);
  EXPECT_EQ(count("region"), 2 * 2 * 2);
  std::set<std::string> names;
  for (const Cell& cell : cells) {
    names.insert(name_of(cell));
    EXPECT_EQ(baseline_of(cell, "none", "periodic").scheme, "none");
    EXPECT_NE(std::find(cells.begin(), cells.end(), baseline_of(cell, "none", "periodic")),
              cells.end())
        << name_of(cell);
  }
  EXPECT_EQ(names.size(), cells.size());
  const Cell& last = *std::find_if(cells.rbegin(), cells.rend(),
                                   [](const Cell& cell) { return cell.scheme == "region"; });
  EXPECT_EQ(name_of(last), "client-server-region-periodic-10-pucks70-margin0.5-sweep2-seed1");
  EXPECT_EQ(variant_of(last), "70 pucks, margin 0.5 m, swept 2 ticks");
}

TEST(ExperimentFile, OneAtATimeEachParameterIsSweptAlone) {
  const auto experiment =
      parse_experiment(minimal +
                           "schemes=['none','grid','region']\ndesign='one_at_a_time'\ncell_size=[1,"
                           "2,4]\nview_margin=[0.25,0.5]\ntick_rate_hz=[20,10,60]\nclients=[5,6]",
                       "x.toml", {});
  const std::vector<Cell> cells = cells_of(experiment);
  const auto count = [&cells](const std::string& scheme) {
    return std::count_if(cells.begin(), cells.end(),
                         [&](const Cell& cell) { return cell.scheme == scheme; });
  };
  EXPECT_EQ(count("none"), 1 + 2 + 1) << "the standard, two rates, more clients";
  EXPECT_EQ(count("grid"), 1 + 2 + 1 + 2 + 1);
  EXPECT_EQ(count("region"), 1 + 1 + 2 + 1);
  for (const Cell& cell : cells) {
    const Cell baseline = baseline_of(cell, "none", "periodic");
    EXPECT_NE(std::find(cells.begin(), cells.end(), baseline), cells.end()) << name_of(cell);
    EXPECT_EQ(baseline.parameters.tick_rate_hz, cell.parameters.tick_rate_hz);
  }
  EXPECT_EQ(std::count_if(cells.begin(), cells.end(),
                          [](const Cell& cell) {
                            return cell.parameters.tick_rate_hz == 60.0 &&
                                   name_of(cell).find("-rate60-") != std::string::npos;
                          }),
            3);
}

TEST(ExperimentFile, OneAtATimeBatsAndPucksAreSweptAloneToo) {
  const auto experiment =
      parse_experiment(minimal +
                           "schemes=['grid']\nbaseline_scheme='grid'\ndesign='one_at_a_time'\ntick_"
                           "rate_hz=[20,10]\nbats=[20,40,80]\npucks=[100,200]",
                       "x.toml", {});
  EXPECT_EQ(cells_of(experiment).size(), 1u + 1u + 2u + 1u)
      << "the standard, a rate, two crowds, more pucks";
}

TEST(ExperimentFile, EveryParameterMayBeAListAndNonsenseInItIsNamedWithItsLine) {
  for (const ParameterKind& kind : parameter_kinds()) {
    const std::string key = kind.key, good = kind.is_switch  ? "[true, false]"
                                             : kind.is_whole ? "[1, 2]"
                                                             : "[0.5, 1]";
    const std::string beside = key == "nodes" ? "\nkeys = 'live'\n" : "";
    if (key != "tick_rate_hz") {
      EXPECT_EQ(
          swept_parameters(parse_experiment(minimal + key + " = " + good + beside, "x.toml", {}))
              .size(),
          1u)
          << key;
    }
    for (const char* bad : {"[1, -1]", "[]", "[1, 1]", "'many'", "[1, nan]", "[1, inf]", "[1, [2]]",
                            kind.is_switch ? "1" : "true"})
      EXPECT_THAT(complaint_about(minimal + "\n" + key + " = " + bad),
                  StartsWith("dir/x.toml:4: " + key + " = "))
          << bad;
    if (kind.is_whole && !kind.is_switch) {
      EXPECT_THAT(complaint_about(minimal + key + " = 1.5"), HasSubstr("whole"));
    }
  }
}

TEST(ExperimentFile, RatiosReferToNoFilterOrElseToTheFirstScheme) {
  EXPECT_EQ(parse_experiment(minimal, "x.toml", {}).baseline_scheme, "none");
  EXPECT_EQ(
      parse_experiment(minimal + "schemes = ['grid', 'region']", "x.toml", {}).baseline_scheme,
      "grid");
  EXPECT_EQ(parse_experiment(minimal + "schemes = ['grid', 'region']\nbaseline_scheme = 'region'",
                             "x.toml", {})
                .baseline_scheme,
            "region");
  EXPECT_THAT(
      complaint_about(
          minimal +
          "schemes = ['grid', 'region']\nbaseline_scheme = 'region'\nbaseline = {scheme = 'grid'}"),
      HasSubstr("baseline_scheme and baseline.scheme name a baseline twice"));
}

TEST(ExperimentFile, TheInstalledExperimentsAreSoundAndTheDefaultIsShort) {
  const std::filesystem::path folder =
      std::filesystem::path(test::source_folder()) / "scenes/experiments";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    EXPECT_FALSE(cells_of(load_experiment(entry.path(), {})).empty()) << entry.path();
  const auto expected_s = [](const Experiment& experiment) {
    return expected_cell_s(experiment) * static_cast<double>(cells_of(experiment).size());
  };
  const Experiment standard = load_experiment(folder / "default.toml", {}),
                   full = load_experiment(folder / "full.toml", {}),
                   gains = load_experiment(folder / "gains.toml", {});
  EXPECT_LE(expected_s(standard), 270.0)
      << "of one after the other; those in virtual time run beside each other";
  std::set<std::uint32_t> clients;
  for (const Cell& cell : cells_of(standard)) clients.insert(cell.clients);
  EXPECT_GE(clients.size(), 3u);
  EXPECT_GE(standard.seeds.size(), 3u) << "so that intervals mean something";
  const std::vector<std::string> policies{"periodic", "snapshot", "dead-reckoning",
                                          "dead-reckoning-drag", "on-event"};
  for (const Experiment& experiment : {standard, full, gains})
    EXPECT_EQ(experiment.policies, policies) << experiment.name;
  EXPECT_LE(expected_s(full), 2400.0);
  EXPECT_GE(*std::max_element(full.clients.begin(), full.clients.end()), 500u);
  EXPECT_LE(expected_s(gains), 420.0);
  EXPECT_EQ(cells_of(gains).size(), 2u * 6u * 5u) << "five policies and the paper's";
}

TEST(ExperimentFile, TheDefaultHasEveryPolicyOverSocketsAndNoneWithFewPointsOfItsCurve) {
  const auto file =
      std::filesystem::path(test::source_folder()) / "scenes/experiments/default.toml";
  std::map<std::pair<double, std::string>, std::set<std::pair<double, double>>> settings;
  std::set<std::pair<std::string, std::string>> over_sockets;
  const Experiment standard = load_experiment(file, {});
  for (const Cell& cell : cells_of(standard)) {
    const Experiment& part = part_of(standard, cell.part);
    if (part.is_of_curves)
      settings[{part.delay_ms, cell.policy}].emplace(cell.parameters.tick_rate_hz,
                                                     cell.parameters.threshold);
    if (cell.part == "sockets") over_sockets.emplace(cell.scheme, cell.policy);
  }
  EXPECT_EQ(over_sockets.size(), 3u * 4u) << "the fifth, which knows drag, in virtual time";
  EXPECT_EQ(settings.size(), 2u * 5u) << "without delay and late";
  for (const auto& [of, own] : settings) {
    if (of.second == "on-event") continue;
    EXPECT_GE(own.size(), 10u) << of.second << " needs five on either side of the error compared";
  }
}

TEST(Experiment, OneNumberAtATimeGivesACrossThroughTheFirstValues) {
  Experiment experiment;
  experiment.schemes = {"none", "region"};
  experiment.clients = {50, 25, 100};
  experiment.pucks = {1'000, 500};
  experiment.bats = {100, 200, 400, 800};
  EXPECT_EQ(cells_of(experiment).size(), 2u * 3u * 2u * 4u);
  experiment.design = Design::one_at_a_time;
  const std::vector<Cell> cells = cells_of(experiment);
  EXPECT_EQ(cells.size(), 2u * (1u + 2u + 1u + 3u));
  for (const Cell& cell : cells)
    EXPECT_LE((cell.clients != 50) + (cell.pucks != 1'000) + (cell.bats != 100), 1);
}

}  // namespace
}  // namespace rink::loadgen
