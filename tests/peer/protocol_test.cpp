// The hash that peers have together, and the one by which they tell that their machines agree.
#include <gtest/gtest.h>

#include <initializer_list>

#include "game/peer/protocol.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

TEST(HashOfWhole, IsRefusedWhereABodyIsMissingOrDoubled) {
  const SharedScene scene = shared_scene(2, 1.0);
  Handover all;
  for (std::uint32_t body = 0; body < scene.world.body_count(); ++body)
    all.bodies.push_back({body, physics::Subdomain::state_in(scene.world, body)});
  const auto hash_of = [&](std::initializer_list<Handover> parts) {
    return hash_of_whole(scene.world.spec(), scene.world.body_count(), std::vector(parts));
  };
  EXPECT_EQ(hash_of({all}), scene.world.hash());
  Handover one, others = all;
  one.bodies.push_back(all.bodies.back());
  others.bodies.pop_back();
  EXPECT_EQ(hash_of({one, others}), scene.world.hash());
  EXPECT_FALSE(hash_of({others}));
  EXPECT_FALSE(hash_of({one, all}));
}

TEST(SelfTest, IsTheSameEveryTime) { EXPECT_EQ(self_test_hash(), self_test_hash()); }

}  // namespace
}  // namespace rink::peer::test
