// Experiment files: what they mean, the order of their cells, and complaints that name file, line, key and what is allowed.
#include "loadgen/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string minimal = "name = \"x\"\nscene = \"crowd\"\n";

std::string complaint_about(const std::string& text) {
  try {
    parse_experiment(text, "dir/x.toml", {});
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(ExperimentFile, WhatIsNotSaidHasTheDocumentedDefault) {
  const Experiment read = parse_experiment(minimal, "x.toml", {}), defaults;
  EXPECT_EQ(read.name, "x");
  EXPECT_EQ(read.scene, "crowd");
  EXPECT_EQ(read.schemes, defaults.schemes);
  EXPECT_EQ(read.clients, defaults.clients);
  EXPECT_EQ(read.tick_rate_hz, 30.0);
  EXPECT_EQ(read.view_fraction, 0.05);
  EXPECT_EQ(read.population, Population::fixed);
  EXPECT_EQ(read.keys, KeySource::replay);
  EXPECT_EQ(read.text, minimal);
}

TEST(ExperimentFile, ASceneFileIsLookedForBesideTheExperiment) {
  EXPECT_EQ(parse_experiment("name='x'\nscene='my.toml'", "dir/x.toml", {}).scene, "dir/my.toml");
  EXPECT_EQ(parse_experiment("name='x'\nscene='/abs/my.toml'", "dir/x.toml", {}).scene, "/abs/my.toml");
  EXPECT_EQ(parse_experiment("name='x'\nscene='match'", "dir/x.toml", {}).scene, "match");
}

TEST(ExperimentFile, ComplaintsNameFileLineKeyValueAndWhatIsAllowed) {
  EXPECT_THAT(complaint_about(minimal + "schemes = ['none', 'gird']"),
              AllOf(StartsWith("dir/x.toml:3: schemes"), HasSubstr("gird"), HasSubstr("none, grid, region")));
  EXPECT_THAT(complaint_about(minimal + "clients = [10,\n0]"), AllOf(StartsWith("dir/x.toml:4: clients = 0"), HasSubstr("from 1 to 100000")));
  EXPECT_THAT(complaint_about(minimal + "clients = []"), StartsWith("dir/x.toml:3: clients"));
  EXPECT_THAT(complaint_about(minimal + "clients = [5, 5]"), AllOf(StartsWith("dir/x.toml:3: clients = 5"), HasSubstr("once")));
  EXPECT_THAT(complaint_about(minimal + "clients = 'many'"), HasSubstr("whole numbers"));
  EXPECT_THAT(complaint_about(minimal + "clients = 10.5"), HasSubstr("whole numbers"));
  EXPECT_THAT(complaint_about(minimal + "seeds = -1"), StartsWith("dir/x.toml:3: seeds = -1"));
  EXPECT_THAT(complaint_about(minimal + "\n\ntick_rate_hz = 0"), AllOf(StartsWith("dir/x.toml:5: tick_rate_hz = 0"), HasSubstr("1 to 1000")));
  EXPECT_THAT(complaint_about(minimal + "duration_s = nan"), StartsWith("dir/x.toml:3: duration_s"));
  EXPECT_THAT(complaint_about(minimal + "warm_up_s = 'long'"), AllOf(StartsWith("dir/x.toml:3: warm_up_s"), HasSubstr("0 to 600")));
  EXPECT_THAT(complaint_about(minimal + "view_fraction = 1.5"), HasSubstr("above 0 and at most 1"));
  EXPECT_THAT(complaint_about(minimal + "cell_size = -2"), StartsWith("dir/x.toml:3: cell_size"));
  EXPECT_THAT(complaint_about(minimal + "population = 'growing'"), HasSubstr("fixed, per_client"));
  EXPECT_THAT(complaint_about(minimal + "keys = true"), HasSubstr("replay, live"));
  EXPECT_THAT(complaint_about(minimal + "viewfraction = 0.1"), AllOf(StartsWith("dir/x.toml:3: unknown key viewfraction"), HasSubstr("view_fraction")));
  EXPECT_THAT(complaint_about("scene = 'crowd'"), AllOf(StartsWith("dir/x.toml: name"), HasSubstr("required")));
  EXPECT_THAT(complaint_about("name = 3\nscene = 'crowd'"), StartsWith("dir/x.toml:1: name = 3"));
  EXPECT_THAT(complaint_about(minimal + "clients = [1,,2]"), AllOf(StartsWith("dir/x.toml:3:"), HasSubstr("not TOML")));
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
  const auto experiment = parse_experiment(minimal + "schemes=['none','grid']\nclients=[1,2]\nseeds=[7,8]", "x.toml", {});
  std::vector<std::string> names;
  for (const Cell& cell : cells_of(experiment)) names.push_back(name_of(cell));
  EXPECT_THAT(names, ElementsAre("client-server-none-periodic-1-seed7", "client-server-grid-periodic-1-seed7", "client-server-none-periodic-2-seed7",
                                 "client-server-grid-periodic-2-seed7", "client-server-none-periodic-1-seed8", "client-server-grid-periodic-1-seed8",
                                 "client-server-none-periodic-2-seed8", "client-server-grid-periodic-2-seed8"));
}

TEST(ExperimentFile, TheInstalledExperimentsAreSoundAndTheDefaultIsShort) {
  const std::filesystem::path folder = std::filesystem::path(RINK_SOURCE_DIR) / "scenes/experiments";
  const Experiment standard = load_experiment(folder / "default.toml", {});
  const double each_s = standard.duration_s + standard.warm_up_s + 1.0;  // start, join and end take about a second
  EXPECT_LE(each_s * static_cast<double>(cells_of(standard).size()), 75.0);
  EXPECT_GE(standard.clients.size(), 3u);
  const Experiment full = load_experiment(folder / "full.toml", {});
  EXPECT_EQ(full.population, Population::per_client);
  EXPECT_GE(*std::max_element(full.clients.begin(), full.clients.end()), 500u);
}

}  // namespace
}  // namespace rink::loadgen
