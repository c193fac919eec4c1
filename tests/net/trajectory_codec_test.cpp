// Trajectories on their way: nothing is lost, whatever they are, and nothing that is no trajectory
// gets through.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "game/replication/attributes.h"
#include "game/replication/input_codec.h"
#include "game/replication/shape_codec.h"
#include "game/replication/trajectory.h"
#include "game/replication/trajectory_codec.h"

namespace rink::game {
namespace {

using physics::Vector2;

/// Codes `sent` at `time`, checks its size, and decodes it at `read_time`.
Trajectory travelled(const Trajectory& sent, double time, double read_time,
                     std::size_t* size = nullptr) {
  const TrajectoryCodec codec;
  std::vector<std::byte> value, coded, read;
  codec.encode(encode(value, sent), time, coded);
  EXPECT_EQ(codec.size(coded), coded.size());
  if (size != nullptr) *size = coded.size();
  for (std::size_t cut = 0; cut < coded.size(); ++cut) {
    const std::optional<std::size_t> found = codec.size(rti::Bytes(coded).first(cut));
    EXPECT_TRUE(!found || *found > cut) << "cut to " << cut << " of " << coded.size();
  }
  EXPECT_TRUE(codec.decode(coded, read_time, read));
  Trajectory received;
  EXPECT_TRUE(decode(read, received));
  return received;
}

double on_grid(double step, double value) { return std::nearbyint(value / step) * step; }
Vector2 on_grid(double step, double x, double y) { return {on_grid(step, x), on_grid(step, y)}; }

TEST(TrajectoryCodec, RoundedMotionOnAFieldTakesTenBytesAndRestFive) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(0.0, 60.0), v(-1.9, 1.9), t(0.0, 5000.0);
  for (int i = 0; i < 2000; ++i) {
    const double time = t(random);
    Trajectory moving{.time = std::floor(time / trajectory_time_step) * trajectory_time_step,
                      .position = on_grid(trajectory_position_step, x(random), x(random)),
                      .velocity = on_grid(trajectory_velocity_step, v(random), v(random))};
    std::size_t size = 0;
    ASSERT_EQ(travelled(moving, time, time + trajectory_age_max, &size), moving);
    ASSERT_EQ(size, 10u);
    const Trajectory resting{.position = moving.position};
    ASSERT_EQ(travelled(resting, time, time + 1e6, &size), resting)
        << "rest has no time, so it is never too old";
    ASSERT_EQ(size, 5u);
  }
}

TEST(TrajectoryCodec, LosesNothingOfAnyFiniteTrajectory) {
  const unsigned seed = 2;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto any = [&] {
    const std::array<double, 12> edges{0.0,  -0.0,           1.0,   -1.0,   2.0,   -2.0,
                                       63.0, -1.0 - 0x1p-11, 256.0, 4096.0, 1e300, 5e-324};
    if (random() % 3 == 0) return edges[random() % edges.size()];
    const double magnitude = std::ldexp(1.0, static_cast<int>(random() % 40) - 20) *
                             static_cast<double>(static_cast<std::int64_t>(random())) * 0x1p-63;
    return random() % 2 == 0 ? magnitude : on_grid(0x1p-11, magnitude);
  };
  for (int i = 0; i < 20000; ++i) {
    Trajectory sent{.time = on_grid(trajectory_time_step, std::abs(any())),
                    .position = {any(), any()},
                    .velocity = {any(), any()}};
    if (random() % 2 == 0) sent.acceleration = {any(), any()};
    if (random() % 4 == 0)
      sent.acceleration = {single_precision(sent.acceleration.x()),
                           single_precision(sent.acceleration.y())};
    if (!sent.acceleration.allFinite()) sent.acceleration = {0.0, 0.0};
    if (random() % 3 == 0) sent.drag.x() = std::abs(any());
    if (random() % 3 == 0) sent.drag.y() = std::abs(any());
    ASSERT_EQ(travelled(sent, sent.time + 0.01, sent.time + trajectory_age_max), sent);
  }
}

TEST(TrajectoryCodec, AccelerationAndUnusualDragAreAddedOnlyWhereThereAreAny) {
  std::size_t size = 0;
  Trajectory t{.time = 2.0, .position = {1.0, 1.0}, .velocity = {0.5, 0.25}};
  t.velocity.x() = 8.0;
  EXPECT_EQ(travelled(t, 2.0, 2.0, &size), t);
  EXPECT_EQ(size, 14u);
  t.acceleration = {0.0, 4.0};
  EXPECT_EQ(travelled(t, 2.0, 2.0, &size), t);
  EXPECT_EQ(size, 22u);
  t.velocity.x() = 0.5;
  EXPECT_EQ(travelled(t, 2.0, 2.0, &size), t);
  EXPECT_EQ(size, 13u) << "a thrust along one axis, which half a float can say";
  t.acceleration = {-4.0, 4.0};
  EXPECT_EQ(travelled(t, 2.0, 2.0, &size), t);
  EXPECT_EQ(size, 13u);
  t.acceleration = {-single_precision(9.81), 0.0};
  EXPECT_EQ(travelled(t, 2.0, 2.0, &size), t);
  EXPECT_EQ(size, 15u);
  t.acceleration = {4.0, 3.0};
  EXPECT_EQ(travelled(t, 2.0, 2.0, &size), t);
  EXPECT_EQ(size, 22u);
  t.drag.x() = 0.125;
  EXPECT_EQ(travelled(t, 2.0, 2.0, &size), t);
  EXPECT_EQ(size, 30u);
  t.position.x() = 1e-9;
  EXPECT_EQ(travelled(t, 2.0, 2.0, &size), t);
  EXPECT_EQ(size, 73u);
}

TEST(ShapeCodec, LosesNothingAndIsShortForNumbersOfFewDecimals) {
  const unsigned seed = 4;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const ShapeCodec codec;
  std::vector<std::byte> value, coded, read;
  const auto travels = [&](const Shape& shape) {
    encode(value, shape);
    coded.clear(), read.clear();
    codec.encode(value, 0.0, coded);
    EXPECT_EQ(codec.size(coded), coded.size());
    EXPECT_TRUE(codec.decode(coded, 0.0, read));
    EXPECT_EQ(read, value) << "bit for bit";
    for (std::size_t size = 0; size < coded.size(); ++size)
      EXPECT_EQ(codec.size(rti::Bytes(coded).first(size)), std::nullopt) << size;
    return coded.size();
  };
  const Shape puck{.half_length = 0.03f, .half_width = 0.03f, .drag = 0.25f, .mass = 0.2f};
  EXPECT_EQ(travels(puck), 12u);
  Shape bat = puck;
  bat.kind = 1;
  bat.thrust = 4.9f;
  bat.mass = 0.5f;
  EXPECT_EQ(travels(bat), 14u);
  EXPECT_EQ(travels({.half_length = -0.0f}), 12u) << "another zero";
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&random] {
      float number = 0.0f;
      const auto bits = static_cast<std::uint32_t>(random() >> 1) & 0x7fffffffu;
      std::memcpy(&number, &bits, sizeof number);
      if (random() % 2 == 0) number = static_cast<float>(random() % 100000) / 1e4f;
      return std::isfinite(number) ? number : 0.5f;
    };
    travels({static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), any(), any(),
             any(), any(), any()});
  }
}

TEST(ShapeCodec, RandomBytesAreRefusedOrGiveAShape) {
  std::mt19937_64 random(5);
  const ShapeCodec codec;
  std::vector<std::byte> value;
  for (int i = 0; i < 100000; ++i) {
    std::vector<std::byte> noise(random() % 26);
    for (std::byte& byte : noise)
      byte = static_cast<std::byte>(random() % 3 == 0 ? 1 : random() & 0x7f);
    value.clear();
    Shape shape;
    const bool is_shape = codec.decode(noise, 0.0, value);
    ASSERT_EQ(is_shape, decode(value, shape));
    ASSERT_EQ(is_shape, !value.empty());
  }
}

TEST(InputCodec, LosesNothingAndGrowsWithTheCount) {
  const InputCodec codec;
  for (const std::uint32_t count : {0u, 7u, 8u, 1023u, 1024u, 131071u, 131072u, 0xffffffffu}) {
    for (std::uint8_t held = 0; held < 16; ++held) {
      std::vector<std::byte> value, coded, read;
      codec.encode(encode(value, Input{count, held}), 0.0, coded);
      ASSERT_EQ(codec.size(coded), coded.size());
      ASSERT_EQ(
          coded.size(),
          (static_cast<std::size_t>(std::bit_width(std::uint64_t{count} << 4 | held | 1)) + 6) / 7)
          << "seven bits a byte";
      ASSERT_FALSE(codec.size(rti::Bytes(coded).first(coded.size() - 1)));
      ASSERT_TRUE(codec.decode(coded, 0.0, read));
      ASSERT_EQ(read, value);
    }
  }
  std::vector<std::byte> read;
  EXPECT_FALSE(codec.decode(std::vector<std::byte>(6, std::byte{0x7f}), 0.0, read))
      << "more than one number";
  const std::vector<std::byte> endless(8, std::byte{0xff});
  EXPECT_FALSE(codec.size(endless));
}

TEST(TrajectoryCodec, RandomBytesAreRefusedOrGiveATrajectoryThatAnybodyCanFollow) {
  const unsigned seed = 3;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const TrajectoryCodec codec;
  std::vector<std::byte> value;
  for (int i = 0; i < 200000; ++i) {
    std::vector<std::byte> noise(random() % 80);
    for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
    const std::optional<std::size_t> size = codec.size(noise);
    if (!size || *size > noise.size()) continue;
    value.clear();
    if (!codec.decode(rti::Bytes(noise).first(*size), 1e4 * static_cast<double>(random() % 1000),
                      value))
      continue;
    Trajectory t;
    ASSERT_TRUE(decode(value, t));
    ASSERT_TRUE(t.position.allFinite() && t.velocity.allFinite() && t.acceleration.allFinite() &&
                std::isfinite(t.time));
  }
}

}  // namespace
}  // namespace rink::game
