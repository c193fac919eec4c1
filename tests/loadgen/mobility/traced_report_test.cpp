// rink compare over a mobility trace: its report is complete, and repeats without the trace's
// folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/command.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

class TracedReport : public test::CommandTest {
 protected:
  TracedReport() : CommandTest("traced-report") {
    std::filesystem::create_directory(folder_ / "data");
    write("data/walk.csv", "id,t,x,y\na,0,0,0\na,9,9,9\nb,0,9,0\nb,9,0,9\nc,0,4,9\nc,2,4,8\n");
    write("walk.toml", "[[population]]\nkind = \"trace\"\nfile = \"data/walk.csv\"\n");
    write(
        "mine.toml",
        "name = 'mine'\nscene = 'walk.toml'\ntransport = 'virtual'\nschemes = ['none', 'region']\n"
        "clients = 2\nview_area = 16\nduration_s = 4\ntick_rate_hz = 20\n");
  }
  void write(const char* name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
};

TEST_F(TracedReport, RepeatsFromItsFolderAlone) {
  ASSERT_EQ(run("compare " + file("mine.toml") + " --out " + file("out")), 0) << said_;
  EXPECT_THAT(printed_, HasSubstr("region"));
  EXPECT_EQ(content("out/trace-walk.csv"), content("data/walk.csv"));
  EXPECT_EQ(run("compare --trace " + file("out")), 0) << said_;
  std::filesystem::remove_all(folder_ / "data");
  EXPECT_EQ(run("compare --from " + file("out") + " --out " + file("again")), 0) << said_;
  EXPECT_THAT(printed_, HasSubstr("2 of 2 runs in virtual time agree in every figure"));
  write("out/trace-walk.csv", "id,t,x,y\n");
  EXPECT_EQ(run("compare --from " + file("out") + " --out " + file("third")), 10);
  EXPECT_THAT(said_, HasSubstr("trace-walk.csv"));
}

TEST_F(TracedReport, AFaultyTraceEndsBeforeAnythingRuns) {
  write("data/walk.csv", "id,t,x,y\na,0,0,0\na,9,9,nan\n");
  EXPECT_EQ(run("compare " + file("mine.toml") + " --out " + file("out")), 2);
  EXPECT_THAT(said_, HasSubstr("data/walk.csv:3: agent a: y = nan"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "report.html"));
}

}  // namespace
}  // namespace rink::loadgen
