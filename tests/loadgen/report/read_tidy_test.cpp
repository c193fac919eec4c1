// The script that draws a report with pandas and matplotlib, run on a fresh one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/command.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ReadTidyTest : public test::CommandTest {
 protected:
  ReadTidyTest() : CommandTest("compare") {}

  void SetUp() override {
    // Debian's packages are those of its own Python, which may not be the first in the path.
    for (const char* command : {"python3", "/usr/bin/python3"})
      if (std::system(
              (command + std::string(" -c 'import matplotlib, pandas, tomllib' >/dev/null 2>&1"))
                  .c_str()) == 0)
        return compare(command);
    GTEST_SKIP() << "there is no python3 with pandas and matplotlib";
  }

  void compare(const std::string& python) {
    python_ = python;
    std::ofstream(file("small.toml"))
        << "name = 'small'\nscene = 'arena'\npopulation = 'per_client'\nview_area = 4.0\n"
           "clients = 4\npolicies = ['periodic', 'on-event']\ntransport = 'virtual'\n"
           "duration_s = 0.5\nwarm_up_s = 0.2\n"
           "[[parts]]\nname = 'few'\nschemes = 'region'\n"
           "[[parts]]\nname = 'plain'\nschemes = ['none', 'region']\nclients = [4, 6]\n"
           "[[parts]]\nname = 'points'\ncurves = true\nschemes = 'region'\n"
           "tick_rate_hz = [30, 15, 20]\nview_margin = [0, 0.1, 0.3]\nseeds = [1, 2]\n";
    ASSERT_EQ(run("compare " + file("small.toml") + " --out " + file("out")), 0) << said_;
  }

  /// The exit status of read_tidy.py, which draws into `picture.svg`; what it prints is in
  /// `printed_`.
  int read_tidy(const std::string& arguments = "") {
    const std::string script = test::source_folder() + "/docs/analysis/read_tidy.py";
    const int status =
        std::system((python_ + " " + script + " " + file("out") + " --out " + file("picture.svg") +
                     " " + arguments + " >" + file("printed") + " 2>&1")
                        .c_str());
    printed_ = content("printed");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// The labels of the legend: each text of the picture is beside its outlines as a comment.
  std::vector<std::string> labels() const {
    const std::string picture = content("picture.svg");
    static const std::regex label("<!-- ((none|region), [a-z(][^>]*) -->");
    std::vector<std::string> all;
    for (std::sregex_iterator found(picture.begin(), picture.end(), label), end; found != end;
         ++found)
      all.push_back((*found)[1]);
    return all;
  }

  std::string python_;
};

// The legend had a line for each of hundreds of points of curves, and covered the axes.
TEST_F(ReadTidyTest, DrawsTheLargestPartThatIsNoCurveWithOneLabelForEachSchemeAndPolicy) {
  ASSERT_EQ(read_tidy(), 0) << printed_;
  EXPECT_THAT(labels(), testing::UnorderedElementsAre("none, periodic", "none, on-event",
                                                      "region, periodic", "region, on-event"));
  EXPECT_THAT(content("picture.svg"), HasSubstr("<!-- part plain, a mark for each clients -->"));
  EXPECT_THAT(printed_,
              AllOf(HasSubstr("part plain; by --part also few, points (points of curves)\n"),
                    Not(HasSubstr("0.3"))));
}

TEST_F(ReadTidyTest, DrawsAnyPartThatIsAskedForAndNamesThoseThereAre) {
  ASSERT_EQ(read_tidy("--part points"), 0) << printed_;
  EXPECT_THAT(labels(), testing::UnorderedElementsAre("region, periodic", "region, on-event"));
  EXPECT_EQ(read_tidy("--part late"), 1);
  EXPECT_THAT(
      printed_,
      HasSubstr("tidy.csv: no part with valid runs is called late; there are few, plain, points"));
}

}  // namespace
}  // namespace rink::loadgen
