// The axis of output rates in experiments: its cells, their names, what is refused, and that turns
// cost age and save bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "loadgen/experiment/experiment_file.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/process_arguments.h"
#include "loadgen/run/virtual_run.h"
#include "tests/loadgen/complaint.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string of_crowd = "name = 'x'\nscene = 'crowd'\n";

std::string complaint_on_rates(const std::string& text) {
  return complaint_of([&] { parse_experiment(of_crowd + text, "dir/x.toml", {}); });
}

TEST(ExperimentOutputRate, IsAnAxisWhoseCellsAreNamedByIt) {
  const Experiment experiment =
      parse_experiment(of_crowd +
                           "tick_rate_hz = 60\noutput_rate_hz = [0, 20, 7.5]\nschemes = 'region'\n"
                           "baseline = {output_rate_hz = 0}\n",
                       "dir/x.toml", {});
  std::vector<std::string> names;
  for (const Cell& cell : cells_of(experiment)) {
    names.push_back(name_of(cell));
    EXPECT_EQ(baseline_of(cell, experiment.baseline()).parameters.output_rate_hz, 0.0);
  }
  EXPECT_THAT(names, testing::ElementsAre("client-server-region-periodic-10-rate60-seed1",
                                          "client-server-region-periodic-10-rate60-told20-seed1",
                                          "client-server-region-periodic-10-rate60-told7.5-seed1"));
  EXPECT_EQ(variant_of(cells_of(experiment)[1]), "60 Hz, told at 20 Hz");
}

TEST(ExperimentOutputRate, OutsideTheRangeIsRefusedByFileLineAndKey) {
  for (const char* number : {"-1", "0.05", "1001", "'often'", "nan", "inf"})
    EXPECT_THAT(complaint_on_rates("output_rate_hz = " + std::string(number)),
                testing::AllOf(StartsWith("dir/x.toml:3: output_rate_hz = "),
                               HasSubstr("numbers from 0.1 to 1000, or 0")))
        << number;
}

TEST(ExperimentOutputRate, RefusesWhatNoClientCanBeTold) {
  EXPECT_EQ(complaint_on_rates("tick_rate_hz = 60\noutput_rate_hz = 60"), "no complaint");
  EXPECT_EQ(complaint_on_rates("tick_rate_hz = 60\noutput_rate_hz = 25"), "no complaint")
      << "rates need not divide the ticks";
  EXPECT_EQ(
      complaint_on_rates("tick_rate_hz = [60, 20]\noutput_rate_hz = [0, 30]"),
      "dir/x.toml: output_rate_hz = 30 is more than tick_rate_hz = 20: expected as many ticks "
      "a second at least, or 0, by which each is told");
  EXPECT_THAT(complaint_on_rates("keys = 'live'\nnodes = 2\noutput_rate_hz = 10"),
              HasSubstr("dir/x.toml: output_rate_hz = 10 is of one server: expected nodes = 1"));
  EXPECT_THAT(complaint_on_rates("[[parts]]\nname = 'a'\noutput_rate_hz = 90"),
              HasSubstr("output_rate_hz = 90 is more than tick_rate_hz = 30"));
}

RunRecord run_at(double output_rate_hz, const std::filesystem::path& folder) {
  const Experiment experiment = parse_experiment(
      of_crowd +
          "schemes = 'region'\npolicies = 'periodic'\nclients = 12\ntransport = 'virtual'\n" +
          "tick_rate_hz = 60\nduration_s = 1\nwarm_up_s = 0.5\noutput_rate_hz = " +
          std::to_string(output_rate_hz),
      "dir/x.toml", {});
  const Cell cell = cells_of(experiment).front();
  RunnerSettings settings;
  settings.directory = folder;
  const std::filesystem::path log = folder / "some.keys";
  write_game_plan(experiment, cell, log);
  return run_virtual_cell(settings, experiment, cell, log).value();
}

/// Of positions that are sent at every tick, a third of the turns sends a third of the updates, and
/// only of the newest tick: fewer bytes, and a client shows what is up to two ticks older.
TEST(ExperimentOutputRate, ThePayloadFallsAndTheGameStaysTheSame) {
  const test::TemporaryFolder folder("output-rates");
  const RunRecord all = run_at(0.0, folder), third = run_at(20.0, folder);
  ASSERT_TRUE(all.valid) << all.why_invalid;
  ASSERT_TRUE(third.valid) << third.why_invalid;
  EXPECT_EQ(all.state_hash, third.state_hash);
  EXPECT_EQ(all.ticks, third.ticks);
  EXPECT_LT(*third.down_bytes_per_client_per_s, 0.5 * *all.down_bytes_per_client_per_s);
  EXPECT_GT(*third.truth.displayed_error_mm.rms, *all.truth.displayed_error_mm.rms);
}

}  // namespace
}  // namespace rink::loadgen
