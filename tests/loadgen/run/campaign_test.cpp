// Cells run with shell scripts in place of the server and the bots: healthy ones, and ones that
// hang, crash, are deaf to SIGTERM or write nonsense.
#include "loadgen/run/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "game/process/process.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string find_report =
    "while [ $# -gt 0 ]; do [ \"$1\" = --report ] && report=$2; shift; done\n";

class CampaignTest : public testing::Test {
 protected:
  CampaignTest() {
    settings_.serve = folder_ / "serve";
    settings_.bots = folder_ / "bots";
    settings_.directory = folder_;
    settings_.listen_limit_s = 0.5;
    settings_.join_limit_s = 0.8;
    settings_.stop_grace = std::chrono::milliseconds(100);
    healthy_server();
    healthy_bots();
  }

  void script(const std::filesystem::path& path, const std::string& body) {
    std::ofstream(path) << "#!/bin/sh\n" << body;
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
  void server(const std::string& body) { script(settings_.serve, body); }
  void bots(const std::string& body) { script(settings_.bots, body); }
  void healthy_server() {
    server(find_report + "echo listening on 127.0.0.1:4711\nsleep 0.05\ncat >\"$report\" <<'R'\n" +
           canned_server_report(cell_).dump() + "\nR\n");
  }
  void healthy_bots() {
    bots(find_report + "cat >\"$report\" <<'R'\n" + canned_bots_report(cell_).dump() + "\nR\n");
  }

  RunRecord run() {
    const auto record = run_cell(settings_, experiment_, cell_, folder_ / "keys");
    EXPECT_TRUE(record);
    return record.value_or(RunRecord{});
  }

  test::TemporaryFolder folder_{"campaign"};
  RunnerSettings settings_;
  Experiment experiment_ = small_experiment();
  Cell cell_{"client-server", "none", "periodic", 10, 1};
};

TEST_F(CampaignTest, AHealthyCellIsValid) {
  const RunRecord record = run();
  EXPECT_TRUE(record.valid) << record.why_invalid;
  EXPECT_TRUE(record.server_cpu_s && record.bots_cpu_s);
  EXPECT_EQ(record.entities, 1100u);
}

/// Each program works for a while and says what its shell and what that ran used, in two lines of
/// user and system time.
TEST_F(CampaignTest, ProcessorTimesAreThoseOfTheProgramsFromStartToEnd) {
  const auto working = [&](const char* name, int rounds, const std::string& body) {
    return find_report + body + "i=0; while [ $i -lt " + std::to_string(rounds) +
           " ]; do i=$((i+1)); done\ntimes >\"" + (folder_ / name).string() + "\"\n";
  };
  server(working("server.times", 150'000, "echo listening on 127.0.0.1:4711\n") +
         "cat >\"$report\" <<'R'\n" + canned_server_report(cell_).dump() + "\nR\n");
  bots(working("bots.times", 250'000, "") + "cat >\"$report\" <<'R'\n" +
       canned_bots_report(cell_).dump() + "\nR\n");
  settings_.join_limit_s = 20.0;
  const RunRecord record = run();
  const auto told_s = [&](const char* name) {
    std::istringstream words(test::text_of(folder_ / name));
    double sum_s = 0.0;
    for (std::string word; words >> word;) {
      double seconds = 0.0;
      int minutes = 0;
      EXPECT_EQ(std::sscanf(word.c_str(), "%dm%lfs", &minutes, &seconds), 2) << word;
      sum_s += 60.0 * minutes + seconds;
    }
    EXPECT_GT(sum_s, 0.02) << "or the test shows nothing";
    return sum_s;
  };
  EXPECT_NEAR(record.server_cpu_s.value_or(0.0), told_s("server.times"), 0.05)
      << "but for its last words";
  EXPECT_NEAR(record.bots_cpu_s.value_or(0.0), told_s("bots.times"), 0.05);
  EXPECT_EQ(record.nodes.busiest_cpu_s, record.server_cpu_s) << "the node that carries all";
  EXPECT_DOUBLE_EQ(record.nodes.mean_cpu_s.value_or(0.0),
                   (*record.server_cpu_s + *record.bots_cpu_s) / (1 + 10))
      << "of the server and ten clients";
}

TEST_F(CampaignTest, TheProgramsAreGivenTheCellAndTheServersAddress) {
  server("echo \"$@\" >\"" + (folder_ / "serve.arguments").string() + "\"\n" + find_report +
         "echo listening on 127.0.0.1:4711\n");
  bots("echo \"$@\" >\"" + (folder_ / "bots.arguments").string() + "\"\n");
  experiment_.population = Population::per_client;
  cell_.parameters.cell_size = 2.5;
  experiment_.duration_s = experiment_.warm_up_s = 0.25;
  run();
  const std::string serve_text = test::text_of(folder_ / "serve.arguments"),
                    bots_text = test::text_of(folder_ / "bots.arguments");
  EXPECT_THAT(serve_text,
              HasSubstr("--scene crowd --bats 10 --seed 1 --address 127.0.0.1 --port 0 --transport "
                        "tcp --scheme none --cell-size 2.5 --policy periodic "
                        "--rate 30 --duration 0.5 --warm-up 0.25"));
  EXPECT_THAT(
      bots_text,
      AllOf(HasSubstr("--connect 127.0.0.1:4711 --transport tcp --count 10 --seed 1 --plan "),
            HasSubstr("--view 0.05")));
}

TEST_F(CampaignTest, AServerThatEndsBeforeItListensIsQuoted) {
  server("printf 'scene nowhere.toml:\\n\\033no such file\\n' >&2\nexit 2\n");
  EXPECT_THAT(run().why_invalid, AllOf(HasSubstr("ended with status 2 before it listened"),
                                       HasSubstr("saying: scene nowhere.toml: / ?no such file")));
}

TEST_F(CampaignTest, AServerThatNeverListensIsStopped) {
  server("sleep 60\n");
  EXPECT_THAT(run().why_invalid, HasSubstr("did not listen within 0.5 s"));
}

TEST_F(CampaignTest, ACrashIsNamedBySignal) {
  server("echo listening on 127.0.0.1:4711\nsleep 0.05\nkill -SEGV $$\n");
  EXPECT_THAT(run().why_invalid, HasSubstr("the server was ended by signal 11"));
}

TEST_F(CampaignTest, BotsThatHangAndAreDeafToSigtermAreKilled) {
  bots("trap '' TERM\necho $$ >\"" + (folder_ / "pid").string() +
       "\"\nwhile :; do sleep 0.05; done\n");
  EXPECT_THAT(run().why_invalid, HasSubstr("the bots had not ended after 1 s"));
  pid_t id = 0;
  std::ifstream(folder_ / "pid") >> id;
  ASSERT_GT(id, 0);
  EXPECT_EQ(kill(id, 0), -1) << "still there";
}

TEST_F(CampaignTest, FailedBotsAreQuotedAndNotTheServerThatWaitedForThem) {
  settings_.join_limit_s = 0.3;
  server("echo listening on 127.0.0.1:4711\nsleep 60\n");
  bots("echo 'no route' >&2\nexit 5\n");
  EXPECT_EQ(run().why_invalid, "the bots ended with status 5, saying: no route");
}

TEST_F(CampaignTest, AMissingOrBrokenReportIsNamed) {
  bots("exit 0\n");
  EXPECT_EQ(run().why_invalid, "the bots wrote no report");
  bots(find_report + "echo '{' >\"$report\"\n");
  EXPECT_EQ(run().why_invalid, "the bots wrote a report that is not JSON");
}

TEST_F(CampaignTest, AProgramThatIsNotThereCannotBeStarted) {
  settings_.serve = folder_ / "nothing";
  EXPECT_THAT(run().why_invalid, AllOf(HasSubstr("cannot start"), HasSubstr("No such file")));
}

TEST_F(CampaignTest, AllCellsAreAppendedToTheRunsAsTheyRunAndReturnedAsTheyArePlanned) {
  experiment_.schemes = {"none", "region"};
  ResultsDirectory results(folder_ / "out", false);
  std::ostringstream text;
  Progress progress(text, false, 2, 1.0);
  int games = 0;
  const CampaignResult outcome = run_campaign(
      {experiment_, settings_, results, [&games](const Cell&, const auto&) { ++games; }}, progress);
  EXPECT_EQ(games, 1) << "one game, shared by both schemes";
  ASSERT_EQ(outcome.runs.size(), 2u);
  EXPECT_TRUE(outcome.runs[0].valid && outcome.runs[1].valid);
  std::ifstream lines(folder_ / "out/runs.jsonl");
  std::string first, second;
  ASSERT_TRUE(std::getline(lines, first) && std::getline(lines, second));
  EXPECT_EQ(nlohmann::json::parse(first)["scheme"].get<std::string>(),
            running_order(experiment_)[0].scheme);
  EXPECT_EQ(nlohmann::json::parse(second)["scheme"].get<std::string>(),
            running_order(experiment_)[1].scheme);
  EXPECT_EQ(outcome.runs[0].cell, cells_of(experiment_)[0]);
  EXPECT_THAT(text.str(), AllOf(HasSubstr("[1/2]"), HasSubstr("[2/2]"), HasSubstr("0:00 left")));
}

TEST_F(CampaignTest, AnInterruptEndsTheCellAndKeepsWhatWasMeasured) {
  experiment_.schemes = {"none", "region"};
  ResultsDirectory results(folder_ / "out", false);
  std::ostringstream text;
  Progress progress(text, false, 2, 1.0);
  std::atomic<bool> is_interrupted = false;
  settings_.is_interrupted = &is_interrupted;
  const std::string flag = (folder_ / "second").string();
  server("if [ -e " + flag + " ]; then kill -USR1 $PPID; sleep 60; fi\ntouch " + flag + "\n" +
         find_report + "echo listening on 127.0.0.1:4711\ncat >\"$report\" <<'R'\n" +
         canned_server_report(cell_).dump() + "\nR\n");
  static std::atomic<bool>* interrupted_flag = &is_interrupted;
  interrupted_flag = &is_interrupted;
  signal(SIGUSR1, [](int) { interrupted_flag->store(true); });
  const CampaignResult outcome =
      run_campaign({experiment_, settings_, results, [](const Cell&, const auto&) {}}, progress);
  signal(SIGUSR1, SIG_DFL);
  EXPECT_TRUE(outcome.was_interrupted);
  EXPECT_EQ(outcome.runs.size(), 1u);
}

TEST_F(CampaignTest, AFullDiskEndsTheCampaignAndKeepsTheRunInMemory) {
  std::filesystem::create_directory(folder_ / "out");
  std::filesystem::create_symlink("/dev/full", folder_ / "out/runs.jsonl");
  experiment_.schemes = {"none", "region"};
  ResultsDirectory results(folder_ / "out", false);
  std::ostringstream text;
  Progress progress(text, false, 2, 1.0);
  const CampaignResult outcome =
      run_campaign({experiment_, settings_, results, [](const Cell&, const auto&) {}}, progress);
  EXPECT_THAT(outcome.output_failure, AllOf(HasSubstr("runs.jsonl"), HasSubstr("No space left")));
  EXPECT_EQ(outcome.runs.size(), 1u);
}

TEST(Results, ExistingResultsAreNotReplacedUnasked) {
  const test::TemporaryFolder folder("results");
  ResultsDirectory(folder / "a", false).append(RunRecord{});
  try {
    ResultsDirectory(folder / "a", false);
    ADD_FAILURE() << "replaced";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("runs.jsonl"), HasSubstr("--force")));
  }
  ResultsDirectory(folder / "a", true).write("summary.csv", "x");
  EXPECT_EQ(free_directory(folder), folder / "report");
  { ResultsDirectory left_without_a_run(folder / "report", false); }
  EXPECT_EQ(free_directory(folder), folder / "report");
  ResultsDirectory(folder / "report", false).append(RunRecord{});
  EXPECT_EQ(free_directory(folder), folder / "report-2");
  std::filesystem::create_directory(folder / "report-2");  // somebody else's
  EXPECT_EQ(free_directory(folder), folder / "report-3");
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(ResultsDirectory(folder / "file", false), OutputError);
}

TEST(Results, TwoCannotWriteTheSameRunsAtOnce) {
  const test::TemporaryFolder folder("results");
  ResultsDirectory first(folder, false);
  first.append(RunRecord{});
  const auto size = std::filesystem::file_size(folder / "runs.jsonl");
  EXPECT_THROW(ResultsDirectory::resumed(folder, size), OutputError);
  first.append(RunRecord{});
  EXPECT_EQ(std::filesystem::file_size(folder / "runs.jsonl"), 2 * size);
}

TEST(ProgressLine, TimeLeftFollowsTheMeanOfTheFinishedCells) {
  std::ostringstream text;
  Progress progress(text, true, 4, 5.0);
  EXPECT_DOUBLE_EQ(progress.left_s(), 20.0);
  RunRecord record;
  record.valid = true;
  progress.finished(record, 2.0);
  progress.finished(record, 4.0);
  EXPECT_DOUBLE_EQ(progress.left_s(), 6.0);
  progress.starts({"client-server", "grid", "periodic", 30, 7});
  EXPECT_THAT(text.str(),
              AllOf(HasSubstr("[3/4] grid, periodic, 30 clients, seed 7"), HasSubstr("0:06 left")));
}

TEST(ProgressOfUnequalCells, ReckonsWithWhatEachIsExpectedToTake) {
  std::ostringstream text;
  Progress progress(text, false, 3, 1.0);
  progress.expect([](const Cell& cell) { return cell.clients == 100 ? 10.0 : 1.0; }, 12.0);
  RunRecord record;
  record.valid = true;
  record.cell = {"client-server", "grid", "periodic", 10, 1};
  progress.finished(record, 2.0);
  EXPECT_THAT(text.str(), HasSubstr("about 0:22 left"))
      << "twice what the eleven seconds that are left were expected to take";
  record.cell.clients = 100;
  progress.finished(record, 9.0);
  EXPECT_THAT(text.str(), HasSubstr("about 0:01 left"));
}

}  // namespace
}  // namespace rink::loadgen
