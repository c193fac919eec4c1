// What somebody who plays a hosted match is shown of it.
#include "loadgen/duel/match_bot.h"

#include <gtest/gtest.h>

namespace rink::loadgen {
namespace {

game::Thing thing(std::uint32_t id, physics::BodyKind kind, double x) {
  return {.id = id, .kind = kind, .position = {x, 0.5}};
}

TEST(MatchBot, LooksAtTheNearestPucksAsManyAsItsPlayerWants) {
  game::MatchSight sight;
  sight.things = {thing(0, physics::BodyKind::bat, 1.0), thing(1, physics::BodyKind::puck, 2.0),
                  thing(2, physics::BodyKind::puck, 1.1), thing(3, physics::BodyKind::puck, 0.5),
                  thing(4, physics::BodyKind::puck, 1.9)};
  const auto ids = [&](std::size_t most) {
    std::vector<std::uint32_t> found;
    for (const game::SeenEntity& puck : nearest_pucks(sight, {1.0, 0.5}, most))
      found.push_back(puck.id);
    return found;
  };
  EXPECT_EQ(ids(0), std::vector<std::uint32_t>{});
  EXPECT_EQ(ids(2), (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(ids(9), (std::vector<std::uint32_t>{2, 3, 4, 1}));
}

}  // namespace
}  // namespace rink::loadgen
