// Clients of nodes see what they would see at one server, and nodes carry no more than that needs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "game/model/scene_file.h"
#include "game/players/random_plan.h"
#include "tests/peer_command/lockstep_nodes.h"
#include "tests/places.h"

namespace rink::game {
namespace {

/// Pucks, bats and posts on a field without goals, with room to look elsewhere.
Scene small_arena(std::uint32_t bats = 24) {
  return scaled_to_bats(load_scene(test::source_folder() + "/scenes/arena.toml"), bats);
}

/// What a client is shown: where it looks, and the bodies in its scope with their places.
struct Seen {
  struct Body {
    std::uint32_t number = 0;
    double x = 0.0, y = 0.0;
    friend bool operator==(const Body&, const Body&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Body& body) {
      return out << body.number << " at (" << body.x << ", " << body.y << ")";
    }
  };
  im::Region view;
  std::vector<Body> bodies;  ///< by number
};

Seen seen_by(ClientServer& rink, std::size_t index) {
  const rti::FederateHandle federate = rink.client(index).ambassador().federate();
  Seen seen{.view = rink.client(index).view(), .bodies = {}};
  const Game& game = rink.server().game();
  for (const Entity& entity : game.entities())
    if (rink.execution().is_in_scope(federate, rink.server().publisher().object(entity.id)))
      seen.bodies.push_back(
          {entity.id.index, game.position(entity.id).x(), game.position(entity.id).y()});
  return seen;
}

/// By tick and player.
using Views = std::vector<std::vector<Seen>>;

void press(Client& client, const InputEvent& event) {
  event.kind == InputKind::key_down ? client.press(event.key) : client.release(event.key);
}

Views run_of_nodes(LockstepNodes& nodes, std::uint32_t ticks, const std::vector<InputEvent>& keys) {
  Views run;
  nodes.begin();
  auto next = keys.begin();
  while (nodes.tick_number() < ticks) {
    nodes.tick();
    run.emplace_back();
    for (std::uint32_t k = 0; k < LockstepNodes::count; ++k)
      for (std::size_t player = 0; player < nodes.server(k).client_count(); ++player)
        run.back().push_back(seen_by(nodes.server(k), player));
    for (; next != keys.end() && next->time <= nodes.now(); ++next) {
      const std::size_t of_each = nodes.server(0).client_count();
      press(nodes.server(static_cast<std::uint32_t>(next->player / of_each))
                .client(next->player % of_each),
            *next);
    }
    for (std::uint32_t k = 0; k < LockstepNodes::count; ++k) nodes.server(k).settle();
  }
  return run;
}

/// The players of all nodes at one server, which plays the keys as the nodes have stamped them.
Views run_of_server(ClientServer& rink, const LockstepNodes::Settings& settings) {
  for (std::uint32_t player = 0; player < LockstepNodes::count * settings.players_of_each; ++player)
    rink.add_player(player, settings.view_fraction);
  rink.start();
  Views run;
  for (std::uint32_t tick = 1; tick <= settings.ticks; ++tick) {
    EXPECT_TRUE(rink.simulate(tick * settings.tick_s));
    run.emplace_back();
    for (std::size_t player = 0; player < rink.client_count(); ++player)
      run.back().push_back(seen_by(rink, player));
  }
  return run;
}

class Nodes : public testing::TestWithParam<const char*> {};

TEST_P(Nodes, ShowEachClientWhatItWouldSeeAtOneServer) {
  const LockstepNodes::Settings settings{.scheme = GetParam(), .ticks = 45};
  const Scene scene = small_arena();
  const std::uint32_t players = LockstepNodes::count * settings.players_of_each;
  LockstepNodes nodes(scene, settings);
  const Views at_nodes = run_of_nodes(nodes, settings.ticks,
                                      random_plan(7, players, settings.ticks * settings.tick_s));
  const std::vector<InputEvent> keys = nodes.server(0).server().keys().recorded();
  EXPECT_EQ(keys, nodes.server(1).server().keys().recorded());
  EXPECT_GT(keys.size(), players) << "all play";
  ClientServer one(scene, {.policy = settings.policy, .replay = keys}, settings.scheme);
  const Views at_one = run_of_server(one, settings);

  std::size_t seen = 0, away = 0;
  for (std::uint32_t tick = 0; tick < settings.ticks; ++tick)
    for (std::uint32_t player = 0; player < players; ++player) {
      const Seen &there = at_nodes[tick][player], &here = at_one[tick][player];
      ASSERT_EQ(there.view, here.view) << "tick " << tick << ", player " << player;
      ASSERT_EQ(there.bodies, here.bodies) << "tick " << tick << ", player " << player;
      seen += here.bodies.size();
    }
  for (std::uint32_t k = 0; k < LockstepNodes::count; ++k) {
    const PlayedPart& part = nodes.finish(k);
    EXPECT_EQ(part.hash, one.server().game().hash());
    EXPECT_EQ(part.hash, nodes.server(k).server().game().hash()) << "the last window shows all";
    away += nodes.node(k).telling().goodbyes;
  }
  EXPECT_GT(seen, settings.ticks * players * 5u);
  EXPECT_EQ(away > 0, std::isfinite(nodes.reach().x))
      << "bodies are out of sight where the scheme has bounds";
}
INSTANTIATE_TEST_SUITE_P(Schemes, Nodes,
                         testing::Values("region", "grid", "aura",
                                         "region with hysteresis(margin=0.3)", "region or always",
                                         "none"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::ranges::replace_if(
                               name, [](unsigned char each) { return std::isalnum(each) == 0; },
                               '_');
                           return name;
                         });

/// States of bodies told to another node in a window.
double bodies_told(double view_fraction) {
  const LockstepNodes::Settings settings{
      .ticks = 30, .players_of_each = 1, .view_fraction = view_fraction};
  LockstepNodes nodes(small_arena(60), settings);
  run_of_nodes(nodes, settings.ticks, {});
  std::uint64_t bodies = 0, windows = 0;
  for (std::uint32_t k = 0; k < LockstepNodes::count; ++k) {
    nodes.finish(k);
    bodies += nodes.node(k).telling().bodies, windows += nodes.node(k).telling().windows;
  }
  return static_cast<double>(bodies) / static_cast<double>(windows);
}

TEST(NodesThatTellEachOther, CarryTheFewerBodiesTheLessTheirClientsSee) {
  const double all = bodies_told(1.0), some = bodies_told(0.05);
  RecordProperty("bodies_told_with_full_views", std::to_string(all));
  RecordProperty("bodies_told_with_views_of_5_percent", std::to_string(some));
  std::printf("bodies told in a window: %.1f with full views, %.1f with views of 5 %%\n", all,
              some);
  EXPECT_LT(some, 0.5 * all);
}

}  // namespace
}  // namespace rink::game
