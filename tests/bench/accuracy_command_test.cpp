// The command rink accuracy from its arguments to its exit status and files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/command.h"
#include "tests/places.h"

namespace rink::accuracy {
namespace {

using testing::HasSubstr;

class AccuracyCommand : public test::CommandTest {
 protected:
  AccuracyCommand() : CommandTest("accuracy") {}
  int accuracy(const std::string& arguments) { return run("accuracy " + arguments); }
  std::string out() const { return file("out"); }
};

TEST_F(AccuracyCommand, WritesTableFilesAndReport) {
  ASSERT_EQ(accuracy("--quick --scenes pairs,pressed --engines exact --out " + out()), 0) << said_;
  EXPECT_THAT(printed_, HasSubstr("pairs: "));
  EXPECT_THAT(printed_, HasSubstr("exact"));
  const std::string points = content("out/points.csv");
  EXPECT_THAT(points, HasSubstr("scene,engine,integrator,dt_s,"));
  EXPECT_THAT(points, HasSubstr("\npairs,exact,,0,0.5,"));
  EXPECT_EQ(points.find("\ngas,"), std::string::npos);
  const std::string html = content("out/report.html");
  EXPECT_THAT(html, HasSubstr("<svg"));
  EXPECT_THAT(html, HasSubstr("Provenance"));
  for (const char* remote : {"src=", "href=\"http", "@import", "url("})
    EXPECT_EQ(html.find(remote), std::string::npos) << "the page must not need a network";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/plots/pressed.csv"));
}

TEST_F(AccuracyCommand, StabilityWritesWhoSurvived) {
  ASSERT_EQ(accuracy("--stability --quick --scenes cradle,post --engines exact --out " + out()), 0)
      << said_;
  EXPECT_THAT(printed_, HasSubstr("cradle: "));
  EXPECT_THAT(content("out/stability.csv"), HasSubstr("\ncradle,exact,,0,yes,"));
  EXPECT_THAT(content("out/report.html"), HasSubstr("Stability"));
}

TEST_F(AccuracyCommand, NeverOverwrites) {
  std::filesystem::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out/mine") << "kept";
  EXPECT_EQ(accuracy("--quick --scenes pairs --engines exact --out " + out()), 5);
  EXPECT_THAT(said_, HasSubstr("already there"));
  EXPECT_EQ(content("out/mine"), "kept");
  EXPECT_EQ(accuracy("--quick --scenes pairs --engines exact --out " +
                     (folder_ / "out/mine/below").string()),
            5);
}

TEST_F(AccuracyCommand, RefusesWrongNamesWithThoseThatAreRight) {
  EXPECT_EQ(accuracy("--scenes moon --out " + out()), 2);
  EXPECT_THAT(said_, HasSubstr("moon: expected one of pairs, gas, dense"));
  EXPECT_EQ(accuracy("--stability --scenes gas --out " + out()), 2);
  EXPECT_THAT(said_, HasSubstr("gas: expected one of fast, dense"));
  EXPECT_EQ(accuracy("--engines ode --out " + out()), 2);
  EXPECT_THAT(said_, HasSubstr("ode: expected one of exact"));
  EXPECT_EQ(accuracy("--integrators leapfrog --out " + out()), 2);
  EXPECT_THAT(said_, HasSubstr("euler, semi_implicit, verlet, rk4"));
  EXPECT_EQ(accuracy("--quick --full --out " + out()), 2);
  EXPECT_EQ(accuracy("--stability --dt -1 --out " + out()), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  EXPECT_EQ(accuracy("--help"), 0);
  EXPECT_THAT(printed_, HasSubstr("--stability"));
}

TEST_F(AccuracyCommand, KeepsWhatWasMeasuredWhenInterrupted) {
  const std::string shell = "cd " + folder_.path().string() + " && (" + test::binary_folder() +
                            "/bin/rink-accuracy --full --out out >said 2>&1 & pid=$!; sleep 2; "
                            "kill -TERM $pid; wait $pid; echo $? >status)";
  ASSERT_EQ(std::system(shell.c_str()), 0);
  EXPECT_EQ(content("status"), "130\n");
  EXPECT_THAT(content("out/points.csv"), HasSubstr("\npairs,exact,"));
  EXPECT_THAT(content("out/report.html"), HasSubstr("Interrupted"));
}

}  // namespace
}  // namespace rink::accuracy
