// The command rink results on pages of its own: bench/results.py beside a launcher that does
// nothing; and that README.md quotes docs/results.md.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::house {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char *begin = "<!-- measured by ./rink results -->",
                     *end = "<!-- end of what is measured -->";

class Results : public testing::Test {
 protected:
  Results() {
    std::filesystem::create_directory(folder_ / "bench");
    std::filesystem::copy_file(test::source_folder() + "/bench/results.py",
                               folder_ / "bench/results.py");
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
    const int status =
        std::system(("python3 " + (folder_ / "bench/results.py").string() + " " + arguments + " >" +
                     (folder_ / "out").string() + " 2>" + (folder_ / "err").string())
                        .c_str());
    return WEXITSTATUS(status);
  }
  std::string said() const { return content("err"); }
  /// What this Python expression of bench/results.py is, without the end of line.
  std::string value_of(const std::string& expression) {
    const std::string command = "cd " + (folder_ / "bench").string() +
                                " && python3 -c \"import results; print(results." + expression +
                                ", end='')\" >../value";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return content("value");
  }

  /// A report of the default experiment as far as the head of the page needs it.
  std::string report() {
    write("given/summary.csv", summary());
    write("given/equal_error.csv", equal_errors());
    write("given/runs.jsonl", runs());
    write("given/provenance.json", R"({"commit": "abc", "processor": "a slide rule"})");
    return "```measured\ncp -r given report-results/default\n```\n"
           "```provenance\nreport-results/default\n```\n```crowd\nreport-results/default\n```\n";
  }
  static std::string summary() {
    std::string text =
        "# taken: today\npart,scheme,policy,extrapolate,down_bytes_per_client_per_s_mean,"
        "wire_bytes_per_client_per_s_mean,delivered_recall_mean,displayed_error_mm_rms_mean\n"
        "prompt,none,periodic,0,298000,318000,1,18.7\nprompt,none,periodic,1,298000,318000,1,5.4\n"
        "prompt,region,dead-reckoning-drag,1,3300,6900,0.99999,3.987\n";
    for (const char* row : {"none,periodic,1,298000,320000", "region,periodic,1,21200,24700",
                            "region,snapshot,1,7870,12600", "region,dead-reckoning,1,5670,9310",
                            "region,on-event,1,3200,6790"})
      text += std::string("sockets,") + row + ",0.99999,3.987\n";
    return text;
  }
  std::string equal_errors() const {
    std::string text =
        "scheme,clients,delay_ms,tick_rate_hz,recall_is,recall,displayed_error_mm_rms,policy,rival,"
        "end,wire_end,payload_ratio,payload_ratio_low,payload_ratio_high,payload_difference,"
        "wire_ratio,wire_ratio_low,wire_ratio_high,wire_difference,points_below,points_above\n";
    for (const char* at : {"0,30,own,0.98669", "0,30,asked_for,0.9990000000000001",
                           "50,30,own,0.9588", "50,30,asked_for,0.999"})
      text += std::string("region,32,") + at +
              ",4.35,on-event,dead-reckoning-drag,bracketed,not_left,1.238,1.229,1.262,higher,1.09,"
              "0.99,1.11,no significant difference,6,5\nregion,32," +
              at +
              ",4.35,on-event,snapshot,bracketed,bracketed,2.45,2.4,2.5,higher,1.73,1.7,1.8,"
              "higher," +
              snapshots_below_ + ",5\n";
    return text;
  }
  /// Two seeds, in which the best rival errs 1.1 and sends 1.04 and 1.01 times as much.
  static std::string runs() {
    std::string text = "{\"schema\":1,\"provenance\":{}}\n";
    const auto run = [](const char* policy, int seed, int delay_ms, double error, double payload,
                        double wire, double margin = 0.0) {
      std::ostringstream line;
      line << R"({"policy":")" << policy << R"(","seed":)" << seed << R"(,"delay_ms":)" << delay_ms
           << R"(,"valid":true,"scheme":"region","transport":"virtual","threshold":0.005,)"
           << R"("tick_rate_hz":30,"view_margin":)" << margin << R"(,"displayed_error_mm":{"rms":)"
           << error << R"(},"down_bytes_per_client_per_s":)" << payload
           << R"(,"wire_bytes_per_client_per_s":)" << wire << "}\n";
      return line.str();
    };
    for (const int delay_ms : {0, 50})
      for (const int seed : {1, 2}) {
        text += run("on-event", seed, delay_ms, 4.0 * seed, 2'500.0, 8'000.0);
        text += run("dead-reckoning-drag", seed, delay_ms, 4.4 * seed, 2'600.0, 8'080.0);
        text += run("dead-reckoning-drag", seed, delay_ms, 9.0, 9'000.0, 9'000.0, 0.3);
      }
    return text;
  }
  /// `text` on one line, without the breaks that fold it.
  static std::string unfolded(const std::string& text) {
    return std::regex_replace(text, std::regex("\n +|\n"), " ");
  }

  std::string snapshots_below_ = "6";
  test::TemporaryFolder folder_{"results"};
};

TEST_F(Results, StandBelowTheirCommands) {
  ASSERT_EQ(run("# Figures\nprose\n```measured\necho forty-two |\n  sed s/forty/fifty/\n```\n" +
                report()),
            0)
      << said();
  EXPECT_THAT(
      content("docs/results.md"),
      AllOf(HasSubstr(
                "# Figures\nprose\n```\n$ echo forty-two | sed s/forty/fifty/\nfifty-two\n```\n"),
            HasSubstr("commit: abc\nprocessor: a slide rule\n"), Not(HasSubstr("as it was"))));
}

TEST_F(Results, OfTheCrowdStandInTheReadmeToo) {
  ASSERT_EQ(run(report()), 0) << said();
  const std::string readme = content("README.md");
  EXPECT_THAT(readme, AllOf(HasSubstr("# Boat\n"), HasSubstr("\nsails\n"), Not(HasSubstr("old")),
                            HasSubstr("shown where they were said to be; in virtual time|298|318|"
                                      "1.0000|18.7|\n"),
                            HasSubstr("|`none`|`periodic`: every position at every tick|298|320|"
                                      "0.9999|3.99|\n"),
                            HasSubstr("|`region`|`dead-reckoning-drag`: clients know the drag; in "
                                      "virtual time|3.30|"
                                      "6.90|0.9999|3.99|\n")));
}

TEST_F(Results, AtEqualErrorSayOfWhatCrowdAndRecallAndHaveAnIntervalEach) {
  ASSERT_EQ(run(report()), 0) << said();
  const std::string words = unfolded(content("docs/results.md")),
                    short_words = unfolded(content("README.md"));
  EXPECT_THAT(short_words,
              HasSubstr("sends so many times its payload: `dead-reckoning-drag` 1.24 [1.23, 1.26] "
                        "without delay, `dead-reckoning-drag` 1.24 [1.23, 1.26] with 50 ms of "
                        "delay ([all](docs/results.md#"));
  EXPECT_THAT(words, HasSubstr("32 clients under `region` in virtual time"));
  for (const char* at :
       {"- no delay, recall 0.9866 without a margin: ", "- no delay, recall 0.9990 by margins: ",
        "- 50 ms of delay, recall 0.9588 without a margin: ",
        "- 50 ms of delay, recall 0.9990 by margins: "})
    EXPECT_THAT(words, HasSubstr(std::string(at) +
                                 "`dead-reckoning-drag` 1.24 [1.23, 1.26] and <1.09 [0.99, "
                                 "1.11] ~, "
                                 "`snapshot` 2.45 [2.40, 2.50] and 1.73 [1.70, 1.80]"));
  EXPECT_THAT(words, AllOf(HasSubstr("~: no significant difference."), HasSubstr("<: at most."),
                           Not(HasSubstr("Fewer than five"))));
}

TEST_F(Results, AtEqualErrorNameRivalsWithFewPoints) {
  snapshots_below_ = "4";
  ASSERT_EQ(run(report()), 0) << said();
  EXPECT_THAT(unfolded(content("docs/results.md")),
              HasSubstr("Fewer than five points on a side of the error: `snapshot`."));
}

TEST_F(Results, SayWhatTheBestRivalSendsAtTheSameRate) {
  ASSERT_EQ(run(report()), 0) << said();
  EXPECT_THAT(unfolded(content("docs/results.md")),
              HasSubstr("At the same 30 Hz `dead-reckoning-drag` with its 5 mm errs 1.10 times as "
                        "far as that and sends 1.04 times the payload and 1.01 times the bytes on "
                        "the wire; with 50 ms of delay 1.10, 1.04 and 1.01 times."));
}

TEST_F(Results, SayHowFarWhatIsForetoldLiesFromWhatHeld) {
  write("saturation.csv",
        "# taken: today\nscheme,held_clients,foretold_clients\nnone,168,\n"
        "grid,800,1204\nregion,951,1096\n");
  ASSERT_EQ(run(report() + "```saturation\nsaturation.csv\n```\n"), 0) << said();
  EXPECT_THAT(unfolded(content("docs/results.md")),
              HasSubstr(value_of("FORETOLD.format(15, 50, 'above')") + " " +
                        value_of("TOO_FEW.format('\\`none\\`')")));
}

TEST_F(Results, NameTheFlagsOfTheProgramsThatAreTimed) {
  report();
  write("points.csv",
        "# compiler: GCC 12, asserts off\n# flags: -O3 -DNDEBUG\n# box2d: 2.4.1\n"
        "# box2d3: absent\na,b\n");
  const std::string page =
      "```measured\ncp -r given report-results/default\n```\n"
      "```provenance\nreport-results/default points.csv\n```\n"
      "```crowd\nreport-results/default\n```\n";
  ASSERT_EQ(run(page), 0) << said();
  EXPECT_THAT(content("docs/results.md"),
              HasSubstr("accuracy and bench: GCC 12, asserts off, -O3 -DNDEBUG\n"
                        "other engines: box2d 2.4.1, box2d3 absent\n"));
}

/// The commands of a page as printed: from each "$ " to the first line that does not go on.
std::vector<std::string> printed_commands(const std::string& page) {
  std::vector<std::string> commands;
  std::istringstream lines(page);
  bool goes_on = false;
  for (std::string line; std::getline(lines, line);) {
    if (goes_on) commands.back() += "\n" + line;
    else if (line.starts_with("$ ")) commands.push_back(line.substr(2));
    else continue;
    goes_on = line.ends_with('\\');
  }
  return commands;
}

TEST_F(Results, CommandsRunAsTheyArePrinted) {
  const std::string command =
      "printf '[%s]\\n' 'one argument  of so many words that a line which holds no more than a "
      "hundred and eighteen letters cannot hold it' two \"three and  a 'quoted' \\\" word\" four\\ "
      "words 'five (six\\|seven)' eight nine ten eleven twelve thirteen fourteen fifteen sixteen";
  ASSERT_EQ(run("```measured\n" + command + "\n```\n" + report()), 0) << said();
  const std::string page = content("docs/results.md");
  const std::vector<std::string> printed = printed_commands(page);
  ASSERT_EQ(printed.size(), 2u);
  EXPECT_THAT(printed.front(), HasSubstr(" \\\n")) << "it is long enough to be broken";
  write("as_printed.sh", printed.front() + "\n");
  const std::string shell =
      "bash " + (folder_ / "as_printed.sh").string() + " >" + (folder_ / "again").string();
  ASSERT_EQ(std::system(shell.c_str()), 0);
  EXPECT_THAT(content("again"), HasSubstr("[five (six\\|seven)]\n"));
  EXPECT_THAT(page, HasSubstr(printed.front() + "\n" + content("again") + "```\n"));
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
  return from == std::string::npos || to == std::string::npos ? std::string()
                                                              : text.substr(from, to - from);
}

TEST(Readme, QuotesThePageOfResultsAlone) {
  const std::string readme = test::text_of(test::source_folder() + "/README.md"),
                    page = test::text_of(test::source_folder() + "/docs/results.md");
  EXPECT_GT(between(page).size(), 500u);
  std::istringstream quoted(between(readme));
  std::size_t rows = 0, figures = 0;
  const std::regex figure(R"(\d+\.\d+ \[\d+\.\d+, \d+\.\d+\])");
  for (std::string line; std::getline(quoted, line);) {
    if (line.starts_with("|")) {
      EXPECT_THAT(page, HasSubstr("\n" + line + "\n")) << "./rink results writes both";
      ++rows;
    }
    for (std::sregex_iterator each(line.begin(), line.end(), figure), last; each != last; ++each) {
      EXPECT_THAT(page, HasSubstr(each->str()));
      ++figures;
    }
  }
  EXPECT_EQ(rows, 9u);
  EXPECT_EQ(figures, 2u);
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
    if (is_prose) {
      EXPECT_THAT(page, HasSubstr(line + "\n"));
    }
  }
}

TEST(PageOfResults, PrintsTheCommandsOfItsTemplateAndBreaksNoneWithinQuotes) {
  const std::string page = test::text_of(test::source_folder() + "/docs/results.md");
  std::vector<std::string> wanted, printed;
  std::istringstream lines(test::text_of(test::source_folder() + "/bench/results.md"));
  bool is_command = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```measured")) wanted.emplace_back();
    else if (is_command && line != "```")
      wanted.back() += (wanted.back().empty() ? "" : " ") + line;
    is_command = line.starts_with("```measured") || (is_command && line != "```");
  }
  for (const std::string& command : printed_commands(page)) {
    for (std::size_t at = command.find('\n'); at < command.size(); at = command.find('\n', at + 1))
      EXPECT_EQ(std::ranges::count(command.substr(0, at), '\'') % 2, 0) << command;
    printed.push_back(std::regex_replace(command, std::regex(" \\\\\n +"), " "));
  }
  EXPECT_EQ(printed, wanted);
}

}  // namespace
}  // namespace rink::house
