// A small experiment whose cells run under a virtual clock.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "loadgen/run/game_plan.h"
#include "loadgen/run/virtual_run.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {

class VirtualRunTest : public testing::Test {
 protected:
  VirtualRunTest() {
    settings_.directory = folder_;
    settings_.serve = test::binary_folder() + "/bin/rink-serve";
    settings_.bots = test::binary_folder() + "/bin/rink-bots";
    experiment_.name = "small";
    experiment_.scene = "crowd";
    experiment_.transport = TransportKind::virtual_time;
    experiment_.population = Population::per_client;
    experiment_.schemes = {"none", "region"};
    experiment_.clients = {6};
    experiment_.seeds = {3};
    experiment_.tick_rates_hz = {20.0};
    experiment_.warm_up_s = 0.25;
    experiment_.duration_s = 2.0;
  }

  std::filesystem::path key_log(const Cell& cell) const {
    const std::filesystem::path file = folder_ / "log.keys";
    write_game_plan(experiment_, cell, file);
    return file;
  }
  RunRecord run(const Cell& cell) const {
    const auto record = run_virtual_cell(settings_, experiment_, cell, key_log(cell));
    EXPECT_TRUE(record);
    EXPECT_EQ(record.value_or(RunRecord{}).why_invalid, "");
    return record.value_or(RunRecord{});
  }
  nlohmann::json report(const Cell& cell, const char* who) const {
    return nlohmann::json::parse(test::text_of(folder_ / (name_of(cell) + "." + who + ".json")));
  }
  Cell first_cell() const { return cells_of(experiment_).front(); }

  test::TemporaryFolder folder_{"virtual"};
  RunnerSettings settings_;
  Experiment experiment_;
};

}  // namespace rink::loadgen
