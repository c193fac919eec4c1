// Long chains of impacts whose outcome is known exactly: the masses that count the digits of pi,
// Newton's cradle, and billiards unfolded into a straight line.
#include <cmath>

#include "tests/accuracy/accuracy_scene.h"

namespace rink::accuracy {
namespace {

/// Galperin (2003): a wall, mass 1 at rest and mass 100^n that comes towards both meet
/// floor(pi/arctan(10^-n)) times in all, the first n + 1 digits of pi.
constexpr std::uint64_t pi_digits[] = {3, 31, 314, 3141, 31415, 314159, 3141592, 31415926};

void expect_digits_of_pi(int n) {
  const Scene scene = scene_named("pi-chain-" + std::to_string(n));
  Game game(scene);
  const double energy = game.world().kinetic_energy();
  game.advance(15.0);  // the last impact comes by 0.1 s + 0.42 m/(fraction of pi 10^n lost in
                       // rounding down)/(1 m/s), at most 4 s; the far wall is 18 s away
  EXPECT_EQ(game.world().counters().impacts(), pi_digits[n]);
  EXPECT_EQ(game.world().counters().hops, 0u);
  EXPECT_EQ(game.world().counters().rests, 0u);
  const double light = game.velocity({0}).x(), heavy = game.velocity({1}).x();
  EXPECT_GE(light, -1e-9 * std::abs(heavy)) << "the light puck would meet the wall again";
  EXPECT_LE(light, heavy) << "the light puck would catch the heavy one";
  // The impulse per closing speed is one rounded constant of the pair, off by up to 2^-53, and each
  // impact changes the energy by up to four times that, always the same way.
  const double drift = 4.0 * 0x1p-53 * static_cast<double>(pi_digits[n]) + 1e-15;
  expect_at_most("relative change of the energy",
                 std::abs(game.world().kinetic_energy() / energy - 1.0), drift);
}

TEST(MassesInAChain, CountTheFirstSevenDigitsOfPi) {
  for (int n = 0; n <= (is_sanitized ? 5 : 6); ++n) expect_digits_of_pi(n);
}

TEST(LongChain, CountsTheFirstEightDigitsOfPi) { expect_digits_of_pi(7); }

class Cradle : public testing::TestWithParam<std::string> {};

/// Each puck stops where it meets the next; the last goes on for the time that is left. `direction`
/// is 1 or -1.
void expect_velocity_handed_on(const Scene& scene, double direction) {
  Game game(scene);
  const auto& pucks = scene.bodies.pucks;
  const double reach = 2.0 * pucks[0].body.radius, until = 0.5,
               flown = until - (std::abs(pucks[4].body.position.x() - pucks[0].body.position.x()) -
                                4.0 * reach);
  game.advance(until);
  EXPECT_EQ(game.world().counters().impacts(), 4u);
  double error = 0.0, speed_error = 0.0;
  for (std::uint32_t k = 0; k < 5; ++k) {
    const double x = k < 4 ? pucks[k + 1].body.position.x() - direction * reach
                           : pucks[4].body.position.x() + direction * flown;
    error = std::max(error, std::abs(game.position({k}).x() - x));
    speed_error =
        std::max(speed_error, std::abs(game.velocity({k}).x() - (k == 4 ? direction : 0.0)));
    EXPECT_EQ(game.velocity({k}).y(), 0.0);
  }
  expect_at_most("largest error of a position / length of the field",
                 error / scene.world.field.length, 1e-13);
  expect_at_most("largest error of a velocity / incoming speed", speed_error, 1e-14);
}

/// Five equal pucks in a row, the first coming with 1 m/s (Newton 1687): each impact hands the
/// velocity on, so the last leaves with it and the others lie still.
TEST_P(Cradle, HandsTheVelocityToTheLastPuck) {
  expect_velocity_handed_on(scene_named("cradle-gap-" + GetParam()), 1.0);
}

TEST_P(Cradle, DoesSoFromTheOtherSide) {
  Scene scene = scene_named("cradle-gap-" + GetParam());
  for (auto& puck : scene.bodies.pucks)
    puck.body.position.x() = scene.world.field.length - puck.body.position.x(),
    puck.body.velocity *= -1.0;
  expect_velocity_handed_on(scene, -1.0);
}

INSTANTIATE_TEST_SUITE_P(Gap, Cradle, testing::Values("1e-3", "1e-6", "1e-9", "1e-12", "0"),
                         [](const auto& gap) {
                           std::string name = "of_" + gap.param + "_m";
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// The place that a straight path of unfolded mirror images stands for: within [low, high].
long double folded(long double x, long double low, long double high) {
  const long double width = high - low;
  long double y = std::fmod(x - low, 2 * width);
  if (y < 0) y += 2 * width;
  return low + (y <= width ? y : 2 * width - y);
}

/// Time has 53 bits, so an impact at time t may happen t 2^-53 off its instant, and the reflected
/// path is then up to |v| t 2^-52 off. Summed over the bounces that is at most |v| T 2^-52 n/2.
/// (Bounces of one wall's rhythm are rounded alike, so the sum grows with n rather than with its
/// root.)
TEST(Billiard, FollowsItsUnfoldedPathForAMillionBounces) {
  const Scene scene = scene_named("billiard");
  Game game(scene);
  const physics::PuckSpec& puck = scene.bodies.pucks[0].body;
  const double r = puck.radius, length = scene.world.field.length, width = scene.world.field.width;
  const double bounces_per_s = std::abs(puck.velocity.x()) / (length - 2 * r) +
                               std::abs(puck.velocity.y()) / (width - 2 * r),
               until = 1e6 / bounces_per_s;
  game.advance(until);
  const auto crossed = [&](double x, double v, double side) {
    const long double far = v > 0 ? x - r + static_cast<long double>(v) * until
                                  : side - r - x - static_cast<long double>(v) * until;
    return static_cast<std::uint64_t>(far / (side - 2 * static_cast<long double>(r)));
  };
  EXPECT_EQ(game.world().counters().wall_impacts,
            crossed(puck.position.x(), puck.velocity.x(), length) +
                crossed(puck.position.y(), puck.velocity.y(), width));
  EXPECT_EQ(std::abs(game.velocity({0}).x()), std::abs(puck.velocity.x()));
  EXPECT_EQ(std::abs(game.velocity({0}).y()), std::abs(puck.velocity.y()));
  const long double x =
      folded(puck.position.x() + static_cast<long double>(puck.velocity.x()) * until, r,
             length - static_cast<long double>(r));
  const long double y =
      folded(puck.position.y() + static_cast<long double>(puck.velocity.y()) * until, r,
             width - static_cast<long double>(r));
  const double error =
      static_cast<double>(std::hypot(static_cast<long double>(game.position({0}).x()) - x,
                                     static_cast<long double>(game.position({0}).y()) - y));
  expect_at_most("error of the position [m]", error,
                 0.5 * 1e6 * puck.velocity.norm() * until * 0x1p-52);
}

}  // namespace
}  // namespace rink::accuracy
