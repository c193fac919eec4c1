// A match and a crowd that stand still, for pictures of them.
#pragma once

#include "game/view/match_source.h"

namespace rink::view {

inline MatchSight match_sight() {
  MatchSight sight;
  sight.field = {.length = 2.4, .width = 1.2, .goal_width = 0.4};
  sight.goals_to_win = 5;
  sight.phase = Phase::playing;
  sight.left_name = "Red";
  sight.right_name = "Blue";
  using physics::BodyKind;
  sight.things = {{0, BodyKind::post, game::Team::none, {0.6, 0.85}, {0.0, 0.0}, {0.06, 0.06}},
                  {1, BodyKind::post, game::Team::none, {1.8, 0.35}, {0.0, 0.0}, {0.06, 0.06}},
                  {2, BodyKind::bat, game::Team::left, {0.42, 0.52}, {0.3, 0.1}, {0.03, 0.1}},
                  {3, BodyKind::bat, game::Team::right, {2.0, 0.7}, {0.0, 0.0}, {0.03, 0.1}},
                  {4, BodyKind::puck, game::Team::none, {1.35, 0.75}, {2.4, 0.9}, {0.04, 0.04}}};
  return sight;
}

/// A crowd on a lattice.
inline MatchSight crowd_sight() {
  MatchSight sight;
  sight.field = {.length = 20.0, .width = 10.0, .goal_width = 0.6};
  for (std::uint32_t i = 0; i < 1000; ++i)
    sight.things.push_back({i,
                            physics::BodyKind::puck,
                            game::Team::none,
                            {0.25 + 0.39 * (i % 50), 0.3 + 0.48 * (i / 50)},
                            {0.0, 0.0},
                            {0.04, 0.04}});
  for (std::uint32_t i = 0; i < 40; ++i)
    sight.things.push_back({1000 + i,
                            physics::BodyKind::bat,
                            i % 2 == 0 ? game::Team::left : game::Team::right,
                            {1.0 + 2.4 * (i % 8), 1.07 + 1.92 * (i / 8)},
                            {0.0, 0.0},
                            {0.05, 0.15}});
  sight.phase = Phase::playing;
  return sight;
}

}  // namespace rink::view
