// Seeded populations: equal from equal seeds, never overlapping, as dense as discs can be, and
// scaled at constant density.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "game/control/game.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

/// `count` pucks of radius 0.04 m in a field of 4 m x 2 m.
std::string pucks(int count, const std::string& more = "") {
  return "[[population]]\nkind = \"puck\"\ncount = " + std::to_string(count) + "\nradius = 0.04\n" +
         more;
}

void expect_no_overlap(const Scene& scene) {
  const std::vector<Puck>& all = scene.bodies.pucks;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_GE((all[i].body.position - all[j].body.position).norm(),
                all[i].body.radius + all[j].body.radius)
          << i << " and " << j;
  EXPECT_EQ(Game(scene).world().max_overlap(), 0.0);
}

TEST(Population, IsTheSameFromTheSameSeedAndAnotherFromAnother) {
  const Scene scene = preset("crowd");
  EXPECT_EQ(fingerprint(scene), fingerprint(preset("crowd")));
  EXPECT_EQ(fingerprint(scene), fingerprint(with_seed(with_seed(scene, 99), scene.seed)));
  EXPECT_NE(fingerprint(scene), fingerprint(with_seed(scene, 99)));
}

TEST(Population, NeverOverlapsAtAnyPackingUpToNineTenths) {
  for (const double packing : {0.05, 0.3, 0.45, 0.7, 0.85}) {
    SCOPED_TRACE(packing);
    const int count = static_cast<int>(packing * 8.0 / (std::numbers::pi * 0.04 * 0.04));
    const Scene scene = small_scene(pucks(count));
    ASSERT_EQ(scene.bodies.pucks.size(), static_cast<std::size_t>(count));
    expect_no_overlap(scene);
  }
}

TEST(Population, FillsTheRoomThatBatsAndPostsLeave) {
  const Scene scene = small_scene(
      "[[population]]\nkind = \"bat\"\ncount = 6\nhalf_extent = [0.1, 0.2]\n[[population]]\nkind = "
      "\"post\"\ncount = 5\nradius = [0.05, 0.1]\n" +
      pucks(800));
  EXPECT_EQ(scene.bodies.pucks.size(), 800u);
  EXPECT_EQ(Game(scene).world().max_overlap(), 0.0);
  for (const Post& post : scene.bodies.posts)
    EXPECT_TRUE(post.body.radius >= 0.05 && post.body.radius <= 0.1);
}

TEST(Population, IsCountedByDensityToo) {
  EXPECT_EQ(small_scene("[[population]]\nkind = \"puck\"\ndensity = 12.5\n").bodies.pucks.size(),
            100u);
}

/// Mean and mean square of the speeds of 1,000 pucks of mean speed 2 m/s.
std::pair<double, double> speed_moments(const std::string& speeds) {
  double sum = 0.0, squares = 0.0;
  const Scene scene = small_scene(
      "[[population]]\nkind = \"puck\"\ncount = 1000\nradius = 0.02\nmean_speed = 2.0\nspeeds = "
      "\"" +
      speeds + "\"\n");
  for (const Puck& puck : scene.bodies.pucks)
    sum += puck.body.velocity.norm(), squares += puck.body.velocity.squaredNorm();
  return {sum / 1000.0, squares / 1000.0};
}

TEST(Population, HasTheSpeedsOfItsDistribution) {
  const auto [fixed, fixed_square] = speed_moments("fixed");
  EXPECT_NEAR(fixed, 2.0, 1e-12);
  EXPECT_NEAR(fixed_square, 4.0, 1e-12);
  // Five standard errors of 1,000 samples: uniform on [0, 4] has variance 4/3, Rayleigh of mean 2
  // has variance 4 (4/pi - 1).
  const auto [uniform, uniform_square] = speed_moments("uniform");
  EXPECT_NEAR(uniform, 2.0, 5.0 * std::sqrt(4.0 / 3.0 / 1000.0));
  EXPECT_NEAR(uniform_square, 16.0 / 3.0, 0.8);
  const auto [maxwell, maxwell_square] = speed_moments("maxwell");
  EXPECT_NEAR(maxwell, 2.0, 5.0 * std::sqrt(4.0 * (4.0 / std::numbers::pi - 1.0) / 1000.0));
  EXPECT_NEAR(maxwell_square, 16.0 / std::numbers::pi,
              5.0 * 16.0 / std::numbers::pi / std::sqrt(1000.0));
}

TEST(ScaledScenes, KeepWhatWasPlacedByHandAtTheSamePartOfTheField) {
  const Scene scene = parse_scene(
      scene_text("crowd") + "\n[[post]]\nname = \"own\"\nposition = [3.0, 2.0]\nradius = 0.1\n",
      "more.toml");
  const Scene scaled = scaled_to_bats(scene, 400);
  const double factor = scaled.world.field.length / scene.world.field.length;
  EXPECT_NEAR(factor, 2.0, 1e-12) << "four times as many";
  const auto own = [](const Post& post) { return post.name == "own"; };
  ASSERT_EQ(std::ranges::count_if(scaled.bodies.posts, own), 1);
  EXPECT_NEAR(
      (std::ranges::find_if(scaled.bodies.posts, own)->body.position - factor * Vector2(3.0, 2.0))
          .norm(),
      0.0, 1e-12);
}

TEST(Population, KeepsDensityAndShapeWhenTheCrowdIsScaled) {
  const Scene crowd = preset("crowd");
  for (const std::uint32_t bats : {1u, 10u, 37u, 250u}) {
    SCOPED_TRACE(bats);
    const Scene scaled = scaled_to_bats(crowd, bats);
    const physics::Field &was = crowd.world.field, &is = scaled.world.field;
    EXPECT_EQ(scaled.bodies.bats.size(), bats);
    EXPECT_EQ(scaled.bodies.pucks.size(), 10u * bats);
    EXPECT_NEAR(static_cast<double>(scaled.bodies.posts.size()), 0.2 * bats, 0.5);
    EXPECT_NEAR(is.length * is.width / bats, was.length * was.width / 100.0, 1e-12);
    EXPECT_NEAR(is.length / is.width, was.length / was.width, 1e-12);
  }
  EXPECT_EQ(fingerprint(scaled_to_bats(crowd, 100)), fingerprint(crowd));
}

TEST(Population, RefusesToScaleWhatHasNoCrowd) {
  EXPECT_THROW(scaled_to_bats(preset("match"), 10), SceneError);
  EXPECT_THROW(scaled_to_bats(preset("crowd"), 0), SceneError);
}

}  // namespace
}  // namespace rink::game
