// Comparisons over DDS: small sessions beside Rink's, judged by the same truth, and what is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "loadgen/dds/dds_absence.h"
#include "tests/command.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class DdsComparison : public test::CommandTest {
 protected:
  DdsComparison() : CommandTest("dds-comparison") {}
  void SetUp() override {
    if (dds_absence != nullptr) GTEST_SKIP() << dds_absence;
  }

  /// The runs of an experiment, by `mode scheme`.
  std::map<std::string, nlohmann::json> compared(const std::string& experiment) {
    std::ofstream(file("small.toml")) << experiment;
    EXPECT_EQ(run("compare " + file("small.toml") + " --out " + file("out")), 0) << said_;
    std::map<std::string, nlohmann::json> runs;
    std::ifstream lines(folder_ / "out" / "runs.jsonl");
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line);
      if (json.contains("mode"))
        runs[json["mode"].get<std::string>() + " " + json["scheme"].get<std::string>()] = json;
    }
    return runs;
  }
  nlohmann::json report(const std::string& name) const {
    return nlohmann::json::parse(test::text_of(folder_ / "out" / "cells" / name));
  }
};

/// Positions travel as float: of a field of 20 m each coordinate errs by at most 2^-20 m, but where
/// a sample is taken before all of a tick has come.
TEST_F(DdsComparison, PlaysTheGameThatRinkPlaysAndIsJudgedByTheSameTruth) {
  const auto runs = compared(
      "name = 'small'\nscene = 'crowd'\nmodes = ['client-server', 'dds']\n"
      "schemes = ['none', 'grid', 'region']\ncell_size = 2.5\nclients = 3\npucks = 200\n"
      "duration_s = 1.5\nwarm_up_s = 0.5\n");
  ASSERT_EQ(runs.size(), 5u) << "DDS has no regions";
  for (const auto& [name, run] : runs) {
    EXPECT_TRUE(run["valid"].get<bool>()) << name << ": " << run["why_invalid"];
    EXPECT_EQ(run["state_hash"], runs.begin()->second["state_hash"]) << name;
    EXPECT_TRUE(run["truth_trouble"].is_null()) << name << ": " << run["truth_trouble"];
    EXPECT_GT(run["delivered_recall"].get<double>(), 0.99) << name;
    EXPECT_GT(run["update_age_samples"].get<int>(), 100) << name;
  }
  const nlohmann::json &all = runs.at("dds none"), &cells = runs.at("dds grid");
  for (const nlohmann::json* run : {&all, &cells})
    EXPECT_LT((*run)["position_error_mm"]["p50"].get<double>(), 1e3 * std::sqrt(2.0) / 1048576.0);
  EXPECT_EQ(all["filter_recall"], 1.0);
  EXPECT_GT(cells["filter_recall"].get<double>(), 0.995);
  EXPECT_LT(2.0 * cells["down_bytes_per_client_per_s"].get<double>(),
            all["down_bytes_per_client_per_s"].get<double>());
}

TEST_F(DdsComparison, CountsAtBothEndsTheSameBytes) {
  compared(
      "name = 'small'\nscene = 'crowd'\nmodes = 'dds'\nschemes = 'grid'\ncell_size = 2.5\n"
      "clients = 2\npucks = 100\nduration_s = 1\n");
  const std::string name = "dds-grid-periodic-2-pucks100-cell2.5-seed1";
  const auto server = report(name + ".server.json"), bots = report(name + ".bots.json");
  // The bots may leave before the last tick comes, and what they say then is not heard.
  const double tick = server["bytes_sent"].get<double>() / server["ticks"].get<double>();
  for (const auto& [from, to] : {std::pair(server, bots), std::pair(bots, server)})
    EXPECT_NEAR(from["total_bytes_sent"].get<double>(), to["total_bytes_received"].get<double>(),
                2.0 * tick + 4000.0);
  EXPECT_GT(server["gathering_discovery_bytes"].get<double>(), 1000.0);
  EXPECT_EQ(server["keys_received"].get<int>(), bots["keys_sent"].get<int>());
}

/// A network namespace of one's own has nothing else on its loopback interface.
TEST_F(DdsComparison, CountsWhatTheKernelCounts) {
  std::ofstream(file("small.toml"))
      << "name = 'small'\nscene = 'crowd'\nmodes = 'dds'\nschemes = 'none'\nclients = 2\n"
         "pucks = 100\nduration_s = 1\n";
  const std::string alone = "unshare -rn sh -c 'ip link set lo up && exec \"$0\" \"$@\"' ";
  if (std::system((alone + "true 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "no network namespace of one's own may be made here (unshare -rn)";
  ASSERT_EQ(std::system((alone + test::binary_folder() + "/bin/rink-compare " + file("small.toml") +
                         " --out " + file("out") + " >" + file("printed") + " 2>&1")
                            .c_str()),
            0)
      << content("printed");
  const auto server = report("dds-none-periodic-2-pucks100-seed1.server.json");
  // IPv4 and UDP once for each message, since loopback carries each in one packet.
  const double messages =
                   server["writes_sent"].get<double>() + server["writes_received"].get<double>(),
               counted = server["bytes_sent"].get<double>() +
                         server["bytes_received"].get<double>() + 28.0 * messages;
  EXPECT_NEAR(counted / server["loopback_bytes"].get<double>(), 1.0, 0.001);
}

class DdsExperiments : public test::CommandTest {
 protected:
  DdsExperiments() : CommandTest("dds-experiments") {}
  std::string refusal_of(const std::string& more) {
    std::ofstream(file("x.toml")) << "name = 'x'\nscene = 'crowd'\nmodes = 'dds'\n" << more;
    EXPECT_EQ(run("compare " + file("x.toml") + " --dry-run"), 2) << more;
    return said_;
  }
};

TEST_F(DdsExperiments, AreRefusedWhereDdsLacksSomething) {
  EXPECT_THAT(refusal_of("transport = 'virtual'"), HasSubstr("expected transport = \"tcp\""));
  EXPECT_THAT(refusal_of("policies = 'on-event'"), HasSubstr("expected periodic"));
  EXPECT_THAT(refusal_of("schemes = 'region'"), HasSubstr("expected none or grid"));
  EXPECT_THAT(refusal_of("keys = 'live'"), HasSubstr("needs keys = \"replay\""));
  EXPECT_THAT(refusal_of("sweep_ticks = 2"), HasSubstr("sweeps no regions"));
  EXPECT_THAT(refusal_of("output_rate_hz = 5"), HasSubstr("sends at each tick"));
}

TEST_F(DdsExperiments, SayPlainlyThatTheirRowsAreAbsentWhereTheLibraryIs) {
  if (dds_absence == nullptr) GTEST_SKIP() << "this build has Cyclone DDS";
  EXPECT_EQ(run("compare engines --dry-run"), 0) << said_;
  EXPECT_THAT(printed_, AllOf(HasSubstr("rows of the mode dds are absent"),
                              HasSubstr("cyclonedds-dev"), testing::Not(HasSubstr("dds-grid"))));
}

}  // namespace
}  // namespace rink::loadgen
