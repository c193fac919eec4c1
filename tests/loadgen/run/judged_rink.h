// A small rink on which one player's run is judged, with what server and bots say of it.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/net/bots_trace.h"
#include "game/net/scene_choice.h"
#include "game/net/server_trace.h"
#include "loadgen/measure/truth/truth.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {

class JudgedRink : public testing::Test {
 protected:
  struct Puck {
    const char *position, *velocity = "0.0, 0.0";
  };
  struct Layout {
    const char* field;  ///< keys of its own
    const char* bat_drag = "0.0";
    const char* more = "";            ///< sections
    std::vector<const char*> bats{};  ///< their positions
    std::vector<Puck> pucks{};
  };

  /// The scene; objects are called 100 and on, in the order of the bodies.
  void lay(const Layout& layout) {
    server_.choice.scene = (folder_ / "rink.toml").string();
    std::ofstream scene(server_.choice.scene);
    scene << "[field]\n"
          << layout.field
          << "material = \"ice\"\n[materials]\nnames = [\"ice\"]\nrestitution = 1.0\n"
          << "[drag]\npucks = 0.0\nbats = " << layout.bat_drag << "\n"
          << layout.more;
    for (const char* bat : layout.bats)
      scene << "[[bat]]\nposition = [" << bat
            << "]\nhalf_extent = [0.1, 0.1]\nmaterial = \"ice\"\n";
    for (const Puck& puck : layout.pucks)
      scene << "[[puck]]\nposition = [" << puck.position << "]\nvelocity = [" << puck.velocity
            << "]\nradius = 0.1\nmaterial = \"ice\"\n";
    server_.clients = bots_.clients = 1;
    server_.rate_hz = 10.0;
    const auto count = static_cast<std::uint32_t>(layout.bats.size() + layout.pucks.size());
    for (std::uint32_t body = 0; body < count; ++body)
      server_.objects.push_back({100 + body, body});
  }
  /// Up to here it is measured and played.
  void end_at(double end_s) { server_.until_s = server_.end_s = bots_.until_s = end_s; }
  /// The game as it ends, under the keys that the server has; it knows its hash from now on.
  void play() {
    game::Game game(game::chosen_scene(server_.choice));
    for (const game::InputEvent& key : server_.keys) game.submit(key);
    game.advance(server_.end_s);
    server_.state_hash = game.hash();
  }
  /// Then the filter had `bodies` in the player's scope.
  void decide(double instant_s, const std::vector<std::uint32_t>& bodies) {
    const std::size_t first = server_.in_scope.size();
    for (const std::uint32_t body : bodies) server_.in_scope.push_back(100 + body);
    server_.decisions.push_back({instant_s, 0, first, server_.in_scope.size()});
  }
  /// From before the beginning on the player knew of `bodies`, of which the first is its bat.
  void know(const std::vector<std::uint32_t>& bodies) {
    game::BotsTrace::Bot& bot = bots_.bots.emplace_back();
    bot.object = 100 + bodies.front();
    for (const std::uint32_t body : bodies) bot.changes.push_back({-1.0, 100 + body, true});
  }

  test::TemporaryFolder folder_{"truth"};
  game::ServerTrace server_;
  game::BotsTrace bots_;
};

}  // namespace rink::loadgen
