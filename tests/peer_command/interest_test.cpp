// What peers tell each other of where their players look, and what they are told: read as written, and never trusted.
#include <gtest/gtest.h>

#include <random>

#include "game/net/peer/player_picture.h"
#include "game/net/peer/sender_interest.h"

namespace rink::game {
namespace {

TEST(Gaze, IsReadAsWrittenAndNamesTheCellsThatTheRegionTouches) {
  std::mt19937_64 random(4);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int k = 0; k < 1000; ++k) {
    const double x = uniform(-5.0, 25.0), y = uniform(-5.0, 15.0), reach = uniform(0.01, 4.0), cell = k % 2 == 0 ? 0.0 : uniform(0.05, 3.0);
    const im::Region region{x - reach, y - reach, x + reach, y + reach};
    const Gaze gaze = gaze_at(region, cell);
    const auto read = gaze_from(bytes_of(gaze));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, gaze);
    if (cell == 0.0) continue;
    const im::Region told = region_of(gaze, cell);
    for (const auto& [here, there] : {std::pair(region.low_x, told.low_x), {region.low_y, told.low_y}, {region.high_x, told.high_x}, {region.high_y, told.high_y}})
      EXPECT_EQ(std::floor(here / cell), std::floor(there / cell));
  }
}

TEST(Gaze, IsRefusedIfNoPlayerCouldHaveIt) {
  EXPECT_TRUE(gaze_from(bytes_of(Gaze{})));
  const std::vector<std::byte> good = bytes_of(gaze_at({1.0, 2.0, 3.0, 4.0}, 0.0));
  for (std::size_t size = 0; size < good.size(); ++size) EXPECT_FALSE(gaze_from(rti::Bytes(good).first(size)));
  std::vector<std::byte> bad = good;
  bad[0] = std::byte{3};
  EXPECT_FALSE(gaze_from(bad)) << "no such form";
  bad = bytes_of(Gaze{Gaze::Form::region, 1.0f, 2.0f, 3.0f, 4.0f});
  std::swap_ranges(bad.begin() + 1, bad.begin() + 5, bad.begin() + 9);
  EXPECT_FALSE(gaze_from(bad)) << "low above high";
  bad = good;
  for (std::size_t k = 1; k < 5; ++k) bad[k] = std::byte{0xff};
  EXPECT_FALSE(gaze_from(bad)) << "not a number";
}

TEST(PlayerPicture, SurvivesWhateverItIsTold) {
  std::mt19937_64 random(5);
  for (const bool has_trajectories : {false, true}) {
    PlayerPicture picture(has_trajectories, {}, std::vector<physics::BodyKind>(50, physics::BodyKind::puck));
    for (int k = 0; k < 20'000; ++k) {
      std::vector<std::byte> bytes(random() % 24);
      for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() & 0x7f);
      picture.hear(1, bytes, 20.0);
      picture.forget_heard();
    }
    picture.drop_forgotten();
    for (const auto& [body, belief] : picture.beliefs()) EXPECT_TRUE(body < 50 && belief.is_there && belief.source == 1);
    picture.forget(1);
    for (const auto& [body, belief] : picture.beliefs()) EXPECT_FALSE(belief.is_there);
    picture.drop_forgotten();
    EXPECT_TRUE(picture.beliefs().empty());
  }
}

}  // namespace
}  // namespace rink::game
