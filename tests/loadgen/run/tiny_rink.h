// A rink of one bat and three pucks in which every figure of truth is known by arithmetic.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/net/evidence.h"
#include "game/net/scene_choice.h"
#include "loadgen/measure/truth/bots_evidence.h"
#include "loadgen/measure/truth/relevance.h"
#include "loadgen/measure/truth/truth.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {

/// One bat at rest in the middle of a field without drag; three pucks: one at rest beside it, one
/// that flies by, one far away.
class TinyRink : public testing::Test {
 protected:
  static constexpr double view_half_side = 1.0;
  static constexpr std::uint32_t bat = 0, still = 1, flying = 2,
                                 far = 3;  // bodies in the order of their making

  void SetUp() override {
    scene_file_ = (folder_ / "tiny.toml").string();
    std::ofstream(scene_file_) << R"(
[field]
length = 20.0
width = 20.0
material = "ice"
[materials]
names = ["ice"]
restitution = 1.0
[drag]
pucks = 0.0
bats = 0.0
[[bat]]
position = [10.0, 10.0]
half_extent = [0.1, 0.1]
material = "ice"
[[puck]]
position = [10.5, 10.5]
radius = 0.1
material = "ice"
[[puck]]
position = [8.0, 9.5]
velocity = [1.0, 0.0]
radius = 0.1
material = "ice"
[[puck]]
position = [2.0, 2.0]
radius = 0.1
material = "ice"
)";
    server_.choice.scene = scene_file_;
    server_.clients = 1;
    server_.rate_hz = 10.0;
    server_.until_s = server_.end_s = 4.0;
    for (std::uint32_t body = 0; body < 4; ++body) server_.objects.push_back({100 + body, body});
    game::Game game(game::chosen_scene(server_.choice));
    game.advance(server_.end_s);
    server_.state_hash = game.hash();
    bots_.clients = 1;
    bots_.until_s = 4.0;
    bots_.bots.push_back({100 + bat, {{-1.0, 100 + bat, true}, {-1.0, 100 + still, true}}});
  }

  void decide(double instant_s, const std::vector<std::uint32_t>& bodies) {
    const std::size_t first = server_.in_scope.size();
    for (const std::uint32_t body : bodies) server_.in_scope.push_back(100 + body);
    server_.decisions.push_back({instant_s, 0, first, server_.in_scope.size()});
  }
  TruthFigures judged(const RelevanceArea& area = {RelevanceArea::Shape::square,
                                                   view_half_side}) const {
    return truth_of(server_, bots_, area);
  }

  test::TemporaryFolder folder_{"truth"};
  std::string scene_file_;
  game::ServerEvidence server_;
  BotsEvidence bots_;
};

}  // namespace rink::loadgen
