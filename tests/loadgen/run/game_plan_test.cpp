// What is found out about a game when its keys are written, before any run of it begins.
#include "loadgen/run/game_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "game/net/server/serve_requirements.h"
#include "loadgen/experiment/experiment_file.h"
#include "tests/loadgen/complaint.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

/// Of a game with so many pucks, two bats and no posts.
std::string complaint_about(std::size_t pucks, const std::string& keys) {
  const test::TemporaryFolder folder("game-plan");
  std::ofstream(folder / "wide.toml")
      << "name = 'wide'\n[field]\nlength = 1000.0\nwidth = 1000.0\n"
         "[[population]]\nname = 'bat'\nkind = 'bat'\ncount = 2\nhalf_extent = [0.05, 0.15]\n"
         "mass = 5.0\nthrust = 4.9\n"
         "[[population]]\nname = 'puck'\nkind = 'puck'\nradius = 0.04\nmass = 0.1\n"
         "mean_speed = 1.0\ncount = "
      << pucks << "\n";
  return complaint_of([&] {
    const Experiment experiment = parse_experiment(
        "name = 'x'\nscene = 'wide.toml'\nplayers = 'random'\nclients = 2\n" + keys,
        folder / "x.toml", {});
    write_game_plan(experiment, cells_of(experiment).front(), folder / "some.keys");
  });
}

TEST(GamePlan, RefusesMoreBodiesThanAServerCanPublish) {
  EXPECT_EQ(complaint_about(game::served_bodies_max - 2, "modes = 'client-server'"),
            "no complaint");
  EXPECT_THAT(complaint_about(game::served_bodies_max - 1, "modes = 'client-server'"),
              testing::AllOf(HasSubstr("experiment x: scene "),
                             HasSubstr("wide.toml has 131073 bodies; a server can publish at most "
                                       "131072, in virtual time 262144")));
  const std::string in_virtual_time = "modes = 'client-server'\ntransport = 'virtual'";
  EXPECT_THAT(complaint_about(rti::region_max - 1, in_virtual_time),
              HasSubstr("has 262145 bodies; a server can publish at most 262144"));
  EXPECT_EQ(complaint_about(game::served_bodies_max, "modes = 'peer-to-peer'"), "no complaint");
}

}  // namespace
}  // namespace rink::loadgen
