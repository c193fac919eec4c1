// The command rink-compare from its arguments to its exit status and files, with shell scripts in
// place of the server and the bots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "game/process/process.h"
#include "im/filter.h"
#include "im/usage.h"
#include "loadgen/experiment/experiment_file.h"
#include "tests/command.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class CompareCommandTest : public testing::Test {
 protected:
  CompareCommandTest() {
    const Cell cell{"client-server", "@scheme", "periodic", 2, 1};
    const std::string take =
        "while [ $# -gt 0 ]; do case $1 in --report) report=$2;; --scheme) scheme=$2;; esac; "
        "shift; done\n";
    script("rink-serve",
           take + "echo listening on 127.0.0.1:4711\n[ -e " + (folder_ / "fail-").string() +
               "$scheme ] && { echo broken >&2; exit 9; }\n[ -e " + (folder_ / "hang-").string() +
               "$scheme ] && sleep 60\ncat >\"$report\" <<R\n" + canned_server_report(cell).dump() +
               "\nR\n");
    script("rink-bots",
           take + "cat >\"$report\" <<'R'\n" + canned_bots_report(cell).dump() + "\nR\n");
    write("small.toml",
          "name = 'small'\nscene = 'match'\nclients = 2\nschemes = ['none', 'grid']\nduration_s = "
          "0.1\nwarm_up_s = 0\n");
  }

  void write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name) << content;
  }
  void script(const std::string& name, const std::string& body) {
    write(name, "#!/bin/sh\n" + body);
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }
  std::string content(const std::string& name) const { return test::text_of(folder_ / name); }

  std::vector<std::string> arguments(const std::string& experiment) const {
    return {(folder_ / experiment).string(), "--out", (folder_ / "out").string(), "--programs",
            folder_.path().string()};
  }
  std::vector<std::string> with(const std::string& experiment,
                                const std::vector<std::string>& more) const {
    std::vector<std::string> all = arguments(experiment);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// Runs the command to its end; `errors_` is what it said.
  int exit_status_of(const std::vector<std::string>& arguments) {
    game::Process compare(test::binary_folder() + "/bin/rink-compare", arguments, {});
    while (!compare.ending()) compare.attend(std::chrono::milliseconds(20));
    errors_ = compare.stderr_tail();
    return compare.ending()->exit_status;
  }

  test::TemporaryFolder folder_{"compare"};
  std::string errors_;
};

class CompareHelp : public test::CommandTest {
 protected:
  CompareHelp() : CommandTest("compare-help") {}
};

TEST_F(CompareHelp, NamesEverySchemeAndStageWithItsParameters) {
  EXPECT_EQ(run("compare --help"), 0) << said_;
  for (const auto& names : {im::filter_names(), im::stage_names()})
    for (const std::string& name : names)
      EXPECT_THAT(printed_, HasSubstr("  " + im::usage_of(name)));
}

TEST_F(CompareCommandTest, AFolderWithoutEvidenceHasNoTraces) {
  ASSERT_EQ(exit_status_of(arguments("small.toml")), 0) << errors_;
  EXPECT_NE(exit_status_of({"--trace", (folder_ / "out").string()}), 0) << "the stubs left none";
  EXPECT_THAT(errors_, HasSubstr("traces of 0 valid runs that have evidence"));
  EXPECT_NE(exit_status_of({"--trace", (folder_ / "nowhere").string()}), 0);
  EXPECT_THAT(errors_, HasSubstr("nowhere"));
  std::filesystem::remove(folder_ / "out/scene.toml");
  EXPECT_EQ(exit_status_of({"--trace", (folder_ / "out").string()}), 10);
  EXPECT_THAT(errors_, HasSubstr("scene.toml"));
}

TEST_F(CompareCommandTest, AWholeExperimentLeavesAllItsFiles) {
  EXPECT_EQ(exit_status_of(arguments("small.toml")), 0) << errors_;
  const std::string runs = content("out/runs.jsonl");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 1 + 2);
  EXPECT_THAT(runs, StartsWith("{\"schema\":1,\"provenance\":{\"schema\":\"1\",\"taken\""));
  EXPECT_THAT(content("out/summary.csv"),
              HasSubstr("client-server,grid,periodic,2,0,0,1,0.05,0.3,0,0,30,0.005,1,1,0,,1,0,"));
  EXPECT_THAT(content("out/comparisons.csv"), HasSubstr("cannot be told from one replication"));
  EXPECT_THAT(content("out/tidy.csv"),
              HasSubstr("\n,client-server,grid,periodic,2,0,0,1,0.05,0.3,0,0,30,0.005,1,1,0,1,true,"
                        "ticks,1,"));
  for (const char* file :
       {"out/runs.jsonl", "out/summary.csv", "out/comparisons.csv", "out/tidy.csv",
        "out/data-dictionary.csv", "out/report.html", "out/provenance.json"})
    for (const char* fact :
         {"commit", "compiler", "flags", "processor", "cores", "governor", "virtualisation",
          "kernel", "packages", "load", "command", "timer wake-up"})
      EXPECT_THAT(content(file), HasSubstr(fact)) << file;
  EXPECT_THAT(content("out/report.html"), HasSubstr("</html>"));
  EXPECT_THAT(content("out/provenance.json"), HasSubstr("kernel"));
  EXPECT_THAT(content("out/keys/seed1.keys"), HasSubstr("rink-keys 1"));
  EXPECT_EQ(exit_status_of(arguments("small.toml")), 5);
  EXPECT_THAT(errors_, HasSubstr("--force"));
}

TEST_F(CompareCommandTest, SomeOrAllRunsThatDoNotCountHaveStatusesOfTheirOwn) {
  write("fail-grid", "");
  EXPECT_EQ(exit_status_of(arguments("small.toml")), 3);
  EXPECT_THAT(content("out/report.html"), HasSubstr("saying: broken"));
  write("fail-none", "");
  auto again = arguments("small.toml");
  again.push_back("--force");
  EXPECT_EQ(exit_status_of(again), 4);
}

TEST_F(CompareCommandTest, BadInputEndsBeforeAnythingRuns) {
  EXPECT_EQ(exit_status_of(arguments("nowhere.toml")), 2);
  EXPECT_THAT(errors_, HasSubstr("nowhere.toml: no such file"));
  write("bad.toml", "name = 'bad'\nscene = 'match'\nclients = 0\n");
  EXPECT_EQ(exit_status_of(arguments("bad.toml")), 2);
  EXPECT_THAT(errors_, HasSubstr("bad.toml:3: clients = 0"));
  write("crowded.toml", "name = 'crowded'\nscene = 'match'\nclients = [1, 3]\n");
  EXPECT_EQ(exit_status_of(arguments("crowded.toml")), 2);
  EXPECT_THAT(errors_, HasSubstr("has 2 bats"));
  EXPECT_EQ(exit_status_of({"--bogus"}), 2);
}

TEST_F(CompareCommandTest, AnInterruptKeepsWhatWasMeasured) {
  const std::string hanging =
      "hang-" + running_order(load_experiment(folder_ / "small.toml", {})).back().scheme;
  write(hanging, "");
  game::Process compare(test::binary_folder() + "/bin/rink-compare", arguments("small.toml"), {});
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (content("out/runs.jsonl").empty() && std::chrono::steady_clock::now() < limit)
    compare.attend(std::chrono::milliseconds(20));
  compare.stop(std::chrono::seconds(20));
  EXPECT_EQ(compare.ending()->exit_status, 130) << compare.ending()->text();
  EXPECT_THAT(content("out/report.html"), HasSubstr("1 of 2 cells run, 1 valid"));

  std::filesystem::remove(folder_ / hanging);
  const std::string first = content("out/runs.jsonl");
  std::ofstream(folder_ / "out/runs.jsonl", std::ios::app)
      << "{\"mode\": \"client-ser";  // as kill -9 would leave it
  EXPECT_EQ(exit_status_of(with("small.toml", {"--resume"})), 0) << errors_;
  EXPECT_THAT(errors_, HasSubstr("going on, 1 of 2 cells are done"));
  EXPECT_THAT(errors_, HasSubstr("torn"));
  const std::string runs = content("out/runs.jsonl");
  EXPECT_THAT(runs, StartsWith(first));
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 1 + 2);
  EXPECT_THAT(content("out/report.html"), HasSubstr("2 of 2 cells run, 2 valid"));
}

TEST_F(CompareCommandTest, RunsOfAnotherExperimentAreGoneOnWithOnlyIfForced) {
  EXPECT_EQ(exit_status_of(arguments("small.toml")), 0) << errors_;
  write("small.toml", content("small.toml") + "seeds = [1, 2]\n");
  EXPECT_EQ(exit_status_of(with("small.toml", {"--resume"})), 5);
  EXPECT_THAT(errors_, HasSubstr("of another experiment"));
  EXPECT_THAT(errors_, HasSubstr("--resume --force"));
  EXPECT_EQ(exit_status_of(with("small.toml", {"--resume", "--force"})), 0) << errors_;
  EXPECT_THAT(content("out/report.html"), HasSubstr("4 of 4 cells run, 4 valid"));
  write("out/runs.jsonl", "no journal\n");
  EXPECT_EQ(exit_status_of(with("small.toml", {"--resume"})), 5);
  EXPECT_THAT(errors_, HasSubstr("runs.jsonl:1: not JSON"));
}

/// Reports of two clients hold whatever is asked of 99 % of the ticks and of ages above 10 ms.
TEST_F(CompareCommandTest, ASearchForSaturationHasItsOwnOptionsAndFiles) {
  EXPECT_EQ(exit_status_of(with("small.toml", {"--saturate", "--most", "2", "--resolution", "0.5",
                                               "--on-time", "1", "--age-ms", "11"})),
            0)
      << errors_;
  EXPECT_THAT(errors_, HasSubstr("2 clients hold: 100 % of ticks on time"));
  const nlohmann::json found = nlohmann::json::parse(content("out/saturation.json"));
  EXPECT_THAT(found.dump(),
              testing::AllOf(HasSubstr("\"held_clients\":2"), HasSubstr("11.0"), HasSubstr("0.5")));
  EXPECT_THAT(content("out/saturation.csv"), HasSubstr("client-server,grid,periodic,"));
  EXPECT_THAT(content("out/report.html"), HasSubstr("at least 2"));
  exit_status_of(with("small.toml", {"--force", "--saturate", "--most", "2", "--age-ms", "9"}));
  EXPECT_THAT(errors_, HasSubstr("age: p99 10 ms"));
}

TEST_F(CompareCommandTest, OptionsOfTheSearchNeedTheSearchAndExcludeWhatItCannotDo) {
  for (const char* option : {"--on-time", "--age-ms", "--resolution", "--most"}) {
    EXPECT_EQ(exit_status_of(with("small.toml", {option, "1"})), 2) << option;
    EXPECT_THAT(errors_, testing::AllOf(HasSubstr(option), HasSubstr("--saturate")));
    EXPECT_EQ(exit_status_of(with("small.toml", {"--saturate", option, "-1"})), 2) << option;
  }
  EXPECT_EQ(exit_status_of(with("small.toml", {"--saturate", "--dry-run"})), 2);
  EXPECT_EQ(exit_status_of(with("small.toml", {"--saturate", "--resume"})), 2);
  EXPECT_EQ(exit_status_of(with("small.toml", {"--saturate", "--assert", "filter_recall > 0"})), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CompareCommandTest, ADryRunTouchesNothing) {
  EXPECT_EQ(exit_status_of(with("small.toml", {"--dry-run"})), 0) << errors_;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CompareCommandTest, AFailedAssertionHasAStatusOfItsOwnAndSaysTheValues) {
  EXPECT_EQ(exit_status_of(with("small.toml", {"--assert", "down_bytes_per_client_per_s > 1",
                                               "--assert", "update_age_ms_p99[scheme=grid] < 5"})),
            6);
  EXPECT_THAT(errors_, HasSubstr("FAILED: update_age_ms_p99[scheme=grid] < 5"));
  EXPECT_THAT(errors_, HasSubstr("update_age_ms_p99 of client-server-grid-periodic-2 = "));
  EXPECT_THAT(content("out/report.html"), HasSubstr("</html>"));
  EXPECT_EQ(exit_status_of(with("small.toml", {"--force", "--assert", "filter_recall == 1"})), 6);
  EXPECT_THAT(errors_, HasSubstr("undefined"));
  EXPECT_EQ(exit_status_of(with("small.toml", {"--force", "--assert", "update_age_ms_p99 < 50"})),
            0)
      << errors_;
}

TEST_F(CompareCommandTest, AnAssertionThatNamesWhatIsNotThereEndsBeforeAnythingRuns) {
  EXPECT_EQ(exit_status_of(with("small.toml", {"--assert", "update_age[scheme=grid] < 5"})), 2);
  EXPECT_THAT(errors_, HasSubstr("no figure is called update_age"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CompareCommandTest, AFolderThatMayNotBeWrittenIsNamed) {
  const auto status = [this](const std::string& out) {
    return exit_status_of(
        {(folder_ / "small.toml").string(), "--out", out, "--programs", folder_.path().string()});
  };
  EXPECT_EQ(status("/proc/nowhere"), 5);
  EXPECT_THAT(errors_, HasSubstr("/proc/nowhere"));
  std::filesystem::create_directory(folder_ / "full");
  std::filesystem::create_symlink("/dev/full", folder_ / "full/runs.jsonl");
  EXPECT_EQ(status((folder_ / "full").string()), 5);
  EXPECT_THAT(errors_, HasSubstr("No space left"));
  EXPECT_THAT(content("full/report.html"), HasSubstr("1 of 2 cells run, 1 valid"))
      << "what was measured is kept";
}

}  // namespace
}  // namespace rink::loadgen
