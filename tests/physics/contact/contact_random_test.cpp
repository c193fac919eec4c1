// A thousand rinks under random keys, of any restitution and masses, and as many with friction: no
// hang, and the bounds of pressed contact hold.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/contact/contact_bounds.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

void run_under_random_keys(std::uint64_t seed, double duration, double friction = 0.0) {
  std::mt19937_64 random(seed);
  const double e = seed % 5 == 0   ? 0.0
                   : seed % 5 == 1 ? 1.0
                                   : uniform(random, 0.0, 1.0),
               mass = std::pow(10.0, uniform(random, -1.0, 1.0));
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", restitution " << e << ", bats of "
                                  << mass << " kg, friction " << friction << " m/s^2");
  WorldSpec spec = rink_of(uniform(random, 1.0, 4.0), uniform(random, 0.8, 2.0), e,
                           uniform(random, 0.0, 0.5), uniform(random, 0.0, 2.0));
  spec.puck_friction = friction;
  World world(spec);
  scatter_posts(world, random, static_cast<int>(random() % 4));
  const std::vector<BodyId> bats =
      scatter_bats(world, random, 1 + static_cast<int>(random() % 6), mass);
  // Pucks from 1e-2 to 3e2 times the mass of a bat.
  scatter_pucks(world, random, 5 + static_cast<int>(random() % 36), 1e-2 * mass, 3e2 * mass);
  Watch watch(world, bats);
  for (double time = 0.0; time < duration;) {
    const double held = uniform(random, 0.0, 0.3);
    watch.set_thrust(bats[random() % bats.size()],
                     6.0 * Vector2(static_cast<double>(random() % 3) - 1.0,
                                   static_cast<double>(random() % 3) - 1.0));
    ASSERT_NO_FATAL_FAILURE(watch.run(held));
    time += held;
  }
}

TEST(RandomKeys, FiftyRinksKeepTheBounds) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    ASSERT_NO_FATAL_FAILURE(run_under_random_keys(seed, 1.5));
}

TEST(RandomKeys, FiftyRinksWithFrictionKeepTheBounds) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    ASSERT_NO_FATAL_FAILURE(
        run_under_random_keys(seed, 1.5, 0.05 * std::pow(1.1, static_cast<double>(seed))));
}

TEST(RandomKeysLong, ThousandRinksWithFrictionKeepTheBounds) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed)
    ASSERT_NO_FATAL_FAILURE(
        run_under_random_keys(seed, 5.0, 0.05 * std::pow(1.005, static_cast<double>(seed))));
}

TEST(RandomKeysLong, ThousandRinksKeepTheBounds) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed)
    ASSERT_NO_FATAL_FAILURE(run_under_random_keys(seed, 5.0));
}

}  // namespace
}  // namespace rink::physics::test
