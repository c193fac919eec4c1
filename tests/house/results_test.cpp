// The command rink results on pages of its own: bench/results.py beside a launcher that does nothing; and that README.md quotes docs/results.md.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::house {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char *begin = "<!-- measured by ./rink results -->", *end = "<!-- end of what is measured -->";

class Results : public testing::Test {
 protected:
  Results() {
    std::filesystem::create_directory(folder_ / "bench");
    std::filesystem::copy_file(test::source_folder() + "/bench/results.py", folder_ / "bench/results.py");
    write("rink", "#!/bin/sh\necho 'rink 1.2.3 (commit abc)'\n");
    std::filesystem::permissions(folder_ / "rink", std::filesystem::perms::owner_all);
    write("README.md", std::string("# Boat\n") + begin + "\nold\n" + end + "\nsails\n");
    write("docs/results.md", "as it was\n");
  }
  void write(const std::string& file, const std::string& text) {
    std::filesystem::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  std::string content(const std::string& file) const { return test::text_of(folder_ / file); }
  int run(const std::string& template_text, const std::string& arguments = "") {
    write("bench/results.md", template_text);
    const int status = std::system(("python3 " + (folder_ / "bench/results.py").string() + " " + arguments + " >" + (folder_ / "out").string() + " 2>" + (folder_ / "err").string()).c_str());
    return WEXITSTATUS(status);
  }
  std::string said() const { return content("err"); }

  /// A report of the default experiment as far as the head of the page needs it.
  std::string report() {
    std::string summary = "# taken: today\npart,scheme,policy,down_bytes_per_client_per_s_mean,wire_bytes_per_client_per_s_mean,delivered_recall_mean,displayed_error_mm_rms_mean\n";
    for (const char* row : {"none,periodic,298000,320000", "region,periodic,21200,24700", "region,snapshot,7870,12600", "region,dead-reckoning,5670,9310", "region,on-event,3200,6790"})
      summary += std::string("sockets,") + row + ",0.9999,3.987\n";
    std::string errors = "delay_ms,recall_is,policy,rival,payload_ratio,payload_ratio_low,payload_ratio_high,wire_ratio,wire_ratio_low,wire_ratio_high\n";
    for (const char* delay : {"0", "50"})
      errors += std::string(delay) + ",own,on-event,snapshot,2.45,,,1.73,,\n" + delay + ",own,on-event,dead-reckoning-drag,1.238,1.229,1.262,1.09,1.06,1.11\n";
    write("given/summary.csv", summary);
    write("given/equal_error.csv", errors);
    write("given/provenance.json", R"({"commit": "abc", "processor": "a slide rule"})");
    return "```measured\ncp -r given report-results/default\n```\n```provenance\nreport-results/default\n```\n```crowd\nreport-results/default\n```\n";
  }

  test::TemporaryFolder folder_{"results"};
};

TEST_F(Results, StandBelowTheirCommands) {
  ASSERT_EQ(run("# Figures\nprose\n```measured\necho forty-two |\n  sed s/forty/fifty/\n```\n" + report()), 0) << said();
  EXPECT_THAT(content("docs/results.md"), AllOf(HasSubstr("# Figures\nprose\n```\n$ echo forty-two | sed s/forty/fifty/\nfifty-two\n```\n"), HasSubstr("commit: abc\nprocessor: a slide rule\n"), Not(HasSubstr("as it was"))));
}

TEST_F(Results, OfTheCrowdStandInTheReadmeToo) {
  ASSERT_EQ(run(report()), 0) << said();
  const std::string readme = content("README.md");
  EXPECT_THAT(readme, AllOf(HasSubstr("# Boat\n"), HasSubstr("\nsails\n"), Not(HasSubstr("old")), HasSubstr("| `none` | `periodic`: every position at every tick | 298 | 320 | 1.000 | 3.99 |\n"),
                            HasSubstr("| `region` | `on-event`: a trajectory when it changes | 3.20 | 6.79 | 1.000 | 3.99 |\n")));
  std::string words = readme;
  std::ranges::replace(words, '\n', ' ');
  EXPECT_THAT(words, HasSubstr("the best rival of `on-event`, `dead-reckoning-drag`, sends 1.24 [1.23, 1.26] times its payload and 1.09 [1.06, 1.11] times its bytes on the wire; `snapshot` 2.45 and 1.73 times."));
}

TEST_F(Results, AreNotWrittenIfACommandFails) {
  EXPECT_EQ(run("```measured\necho too deep >&2; exit 7\n```\n"), 3);
  EXPECT_THAT(said(), HasSubstr("'echo too deep >&2; exit 7' ended with status 7: too deep"));
  EXPECT_EQ(content("docs/results.md"), "as it was\n");
}

TEST_F(Results, MayHaveAStatusThatThePageExpects) {
  EXPECT_EQ(run("```measured or 3\necho shallow; exit 3\n```\n" + report()), 0) << said();
  EXPECT_EQ(run("```measured or 3\nexit 4\n```\n"), 3);
}

TEST_F(Results, FillAtMostThreeThousandWords) {
  const std::string page = "```measured\nseq 2990\n```\n";
  EXPECT_EQ(run(page + report()), 4);
  EXPECT_THAT(said(), HasSubstr("words, more than 3000"));
  EXPECT_EQ(content("docs/results.md"), "as it was\n");
}

TEST_F(Results, AreTakenUpWhereTheyWereInterrupted) {
  const std::string page = "```measured\necho once >>times; echo first\n```\n" + report();
  EXPECT_EQ(run(page + "```measured\nkill -INT $$\n```\n"), 130) << said();
  EXPECT_EQ(run(page + "```measured\necho second\n```\n", "--resume"), 0) << said();
  EXPECT_EQ(content("times"), "once\n");
  EXPECT_THAT(content("docs/results.md"), AllOf(HasSubstr("first"), HasSubstr("second")));
}

TEST_F(Results, OfAnotherCommitAreNotMixed) {
  ASSERT_EQ(run(report()), 0) << said();
  write("rink", "#!/bin/sh\necho 'rink 1.2.3 (commit def)'\n");
  EXPECT_EQ(run(report(), "--resume"), 2);
  EXPECT_THAT(said(), HasSubstr("(commit abc), this is rink 1.2.3 (commit def)"));
}

TEST_F(Results, LeaveAFolderOfSomebodyElseAlone) {
  write("report-results/diary.txt", "dear diary");
  EXPECT_EQ(run(report()), 2);
  EXPECT_EQ(content("report-results/diary.txt"), "dear diary");
}

TEST_F(Results, CommandsAreListedWithoutBeingRun) {
  EXPECT_EQ(run("```measured\ntouch here\n```\n", "--list"), 0);
  EXPECT_EQ(content("out"), "touch here\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "here"));
}

std::string between(const std::string& text) {
  const std::size_t from = text.find(begin), to = text.find(end);
  return from == std::string::npos || to == std::string::npos ? std::string() : text.substr(from, to - from);
}

TEST(Readme, QuotesThePageOfResultsAlone) {
  const std::string readme = test::text_of(test::source_folder() + "/README.md"), page = test::text_of(test::source_folder() + "/docs/results.md");
  EXPECT_GT(between(page).size(), 500u);
  EXPECT_EQ(between(readme), between(page)) << "./rink results writes both";
}

TEST(PageOfResults, HoldsWhatItsTemplateAsksForWithinThreeThousandWords) {
  const std::string page = test::text_of(test::source_folder() + "/docs/results.md");
  std::istringstream words(page);
  std::size_t count = 0;
  for (std::string word; words >> word;) ++count;
  EXPECT_LE(count, 3'000u);
  std::istringstream lines(test::text_of(test::source_folder() + "/bench/results.md"));
  bool is_fenced = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) is_fenced = !is_fenced;
    const bool is_prose = !is_fenced && !line.starts_with("```");
    if (is_prose) { EXPECT_THAT(page, HasSubstr(line + "\n")); }
  }
}

}  // namespace
}  // namespace rink::house
