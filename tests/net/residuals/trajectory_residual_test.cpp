// Trajectories as residuals: the reader has the writer's bits, and what both predict by is near the
// closed form.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <optional>
#include <random>

#include "game/replication/input_codec.h"
#include "game/replication/trajectory_codec.h"
#include "game/replication/trajectory_residual.h"

namespace rink::game::residuals {
namespace {

using physics::Vector2;

double on_grid(double step, double value) { return std::nearbyint(value / step) * step + 0.0; }

/// Random motion of a body, as policies round it.
class Motions {
 public:
  explicit Motions(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  unsigned below(unsigned end) { return static_cast<unsigned>(random_() % end); }
  Vector2 vector(double step, double size) {
    return {on_grid(step, between(-size, size)), on_grid(step, between(-size, size))};
  }
  Shape shape() {
    Shape shape{.kind = 1};
    if (below(4) != 0) shape.drag = static_cast<float>(between(0.0, 4.0));
    if (below(3) == 0) shape.friction = static_cast<float>(between(0.0, 1.0));
    if (below(3) != 0) shape.thrust = 4.9f;
    return shape;
  }
  /// Of a body that moves from an instant at most a tick before `now`.
  Trajectory moving(double now, const Shape& shape) {
    Trajectory t{.time = on_grid(trajectory_time_step, now - between(0.001, 0.05)),
                 .position = vector(trajectory_position_step, 30.0),
                 .velocity = vector(trajectory_velocity_step, 3.0)};
    const auto thrust = static_cast<double>(shape.thrust);
    if (thrust > 0.0 && below(3) == 0) t.acceleration = {below(2) == 0 ? thrust : 0.0, -thrust};
    else if (thrust > 0.0 && below(2) == 0) t.acceleration = push(thrust);
    return t;
  }
  /// A part of the thrust, as a pointer gives it.
  Vector2 push(double thrust) {
    const auto part = [&] {
      const int steps = static_cast<int>(below(2 * Push::whole + 1)) - Push::whole;
      return static_cast<double>(static_cast<float>(thrust * share_of_thrust(steps)));
    };
    const double x = part();
    return {x, part()};
  }
  /// After a hit of a body that followed `former`: near to where that leads.
  Trajectory after(const Trajectory& former, const Shape& shape, double now) {
    Trajectory t = moving(now, shape);
    const Lead lead = lead_of(former, shape, t.time);
    const auto rounded = [&](double value) {
      return on_grid(trajectory_position_step, value + between(-0.002, 0.002));
    };
    t.position = {rounded(lead.position.x()), rounded(lead.position.y())};
    if (below(8) == 0) return {.position = t.position};
    return t;
  }

 private:
  std::mt19937_64 random_;
};

/// By the codec's own functions; the bits it takes, or nothing where it must travel whole.
std::optional<std::size_t> travels(const Trajectory& former, const Shape& shape, double time,
                                   const Trajectory& t, std::vector<std::byte>& read) {
  const TrajectoryCodec codec;
  std::vector<std::byte> before, context, value, bits;
  encode(before, former), encode(context, shape), encode(value, t);
  const rti::ResidualBasis basis{before, context};
  std::size_t size = 0;
  {
    rti::BitWriter writer(bits);
    if (!codec.encode_residual(basis, value, time, writer)) return std::nullopt;
    size = writer.at();
  }
  rti::BitReader reader(bits);
  read.clear();
  EXPECT_TRUE(codec.decode_residual(basis, time, reader, read));
  EXPECT_EQ(reader.at(), size);
  EXPECT_EQ(read, value) << "bit for bit";
  return size;
}

TEST(TrajectoryResidual, ReaderHasTheBitsOfTheWriterOverLongSequences) {
  const unsigned seed = 5;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Motions motions(seed);
  std::vector<std::byte> read;
  std::size_t whole = 0;
  for (int sequence = 0; sequence < 3000; ++sequence) {
    const Shape shape = motions.shape();
    double now = motions.between(0.1, 5000.0);
    Trajectory held = motions.moving(now, shape);
    for (int i = 0; i < 12; ++i) {
      now += motions.between(0.0, i % 4 == 0 ? 12.0 : 0.5);
      const Trajectory next =
          motions.below(9) == 0 ? motions.moving(now, shape) : motions.after(held, shape, now);
      if (!travels(held, shape, now, next, read)) ++whole;
      held = next;
    }
  }
  EXPECT_LT(whole, 40u) << "of 36,000; those with a negative zero";
}

TEST(TrajectoryResidual, HitTakesFortyBitsAndAKeyThirty) {
  Motions motions(6);
  std::vector<std::byte> read;
  const Shape puck{.drag = 0.25f}, bat{.kind = 1, .drag = 3.0f, .thrust = 4.9f};
  double hits = 0.0, keys = 0.0;
  constexpr int count = 2000;
  for (int i = 0; i < count; ++i) {
    const double now = 100.0 + i / 60.0;
    const Trajectory former{.time = 99.5,
                            .position = motions.vector(trajectory_position_step, 10.0),
                            .velocity = motions.vector(trajectory_velocity_step, 1.0)};
    Trajectory hit{.time = on_grid(trajectory_time_step, now - motions.between(0.001, 0.016)),
                   .velocity = motions.vector(trajectory_velocity_step, 1.0)};
    const auto there = [&](const Shape& shape) {
      const Vector2 led = lead_of(former, shape, hit.time).position;
      return Vector2(on_grid(trajectory_position_step, led.x()),
                     on_grid(trajectory_position_step, led.y()));
    };
    hit.position = there(puck);
    hits += static_cast<double>(travels(former, puck, now, hit, read).value());
    Trajectory pressed = hit;
    pressed.position = there(bat);
    const Vector2 kept = lead_of(former, bat, hit.time).velocity;
    pressed.velocity = {on_grid(trajectory_velocity_step, kept.x()),
                        on_grid(trajectory_velocity_step, kept.y())};
    pressed.acceleration = {static_cast<double>(4.9f), 0.0};
    keys += static_cast<double>(travels(former, bat, now, pressed, read).value());
  }
  EXPECT_LT(hits / count, 40.0) << "91 in full";
  EXPECT_LT(keys / count, 24.0) << "115 in full";
}

/// Bodies that hit each other at one instant, after which their momentum is as before.
struct Collision {
  Impact first;
  TrajectoryBasis second;
  Trajectory after;
  Collision(Motions& motions, float first_mass, float second_mass) {
    first.shape = {.drag = 0.25f, .mass = first_mass};
    second.shape = {.kind = 1, .drag = 3.0f, .thrust = 4.9f, .mass = second_mass};
    second.time = motions.between(1.0, 5000.0);
    const double instant =
        on_grid(trajectory_time_step, second.time - motions.between(0.001, 0.016));
    for (Trajectory* former : {&first.former, &second.former})
      *former = {.time = on_grid(trajectory_time_step, instant - motions.between(0.0, 0.9)),
                 .position = motions.vector(trajectory_position_step, 10.0),
                 .velocity = motions.vector(trajectory_velocity_step, 1.0)};
    const Lead led = lead_of(first.former, first.shape, instant),
               lead = lead_of(second.former, second.shape, instant);
    const Vector2 impulse = motions.vector(trajectory_velocity_step, 1.0);
    first.after = moved(instant, led, impulse / static_cast<double>(first_mass));
    after = moved(instant, lead, -impulse / static_cast<double>(second_mass));
    second.impact = &first;
  }
  static Trajectory moved(double instant, const Lead& lead, const Vector2& gain) {
    const auto rounded = [](double step, const Vector2& value) {
      return Vector2(on_grid(step, value.x()), on_grid(step, value.y()));
    };
    return {.time = instant,
            .position = rounded(trajectory_position_step, lead.position),
            .velocity = rounded(trajectory_velocity_step, lead.velocity + gain)};
  }
};

/// The bits that it takes, or nothing if it cannot be a companion.
std::optional<std::size_t> travels(const TrajectoryBasis& basis, const Trajectory& t) {
  std::vector<std::byte> bits;
  std::size_t size = 0;
  {
    rti::BitWriter writer(bits);
    const bool is_written = write_residual(writer, basis, t);
    size = writer.at();
    if (!is_written) {
      EXPECT_EQ(size, 0u);
      return std::nullopt;
    }
  }
  rti::BitReader reader(bits);
  Trajectory read;
  EXPECT_TRUE(read_residual(reader, basis, read));
  EXPECT_EQ(reader.at(), size);
  EXPECT_EQ(read, t);
  return size;
}

TEST(TrajectoryResidual, CompanionTakesAQuarterOfAHitForMomentumIsKept) {
  Motions motions(8);
  double size = 0.0;
  constexpr int count = 3000;
  for (int i = 0; i < count; ++i) {
    const Collision collision(motions, 0.5f, i % 2 == 0 ? 0.5f : 0.8f);
    size += static_cast<double>(travels(collision.second, collision.after).value());
  }
  EXPECT_LT(size / count, 12.0) << "40 alone";
}

TEST(TrajectoryResidual, CompanionSharesInstantAndMomentumOrIsNone) {
  Motions motions(9);
  const auto refuses = [&motions](auto change) {
    Collision collision(motions, 0.5f, 0.5f);
    change(collision);
    return !travels(collision.second, collision.after);
  };
  EXPECT_FALSE(refuses([](Collision&) {}));
  EXPECT_TRUE(refuses([](Collision& each) { each.after.time -= trajectory_time_step; }));
  EXPECT_TRUE(refuses([](Collision& each) { each.after.velocity.x() += 0.25; })) << "a third body";
  EXPECT_TRUE(refuses([](Collision& each) { each.second.shape.mass = 0.0f; })) << "a post";
  EXPECT_TRUE(refuses([](Collision& each) { each.first.shape.mass = 0.0f; }));
  EXPECT_TRUE(refuses([](Collision& each) { each.first.after.time = 1e13; }));
  EXPECT_TRUE(refuses([](Collision& each) { each.after = {.position = each.after.position}; }));
  // What a stranger sends in such a place is refused, too.
  for (int i = 0; i < 2000; ++i) {
    Collision collision(motions, i % 3 == 0 ? 0.0f : 1e-38f, i % 3 == 1 ? 0.0f : 1e38f);
    const bool is_post = i % 3 != 2;
    std::vector<std::byte> noise(12);
    for (std::byte& each : noise) each = static_cast<std::byte>(motions.below(256));
    rti::BitReader reader(noise);
    Trajectory read;
    const bool is_read = read_residual(reader, collision.second, read);
    EXPECT_FALSE(is_read && is_post);
    EXPECT_TRUE(!is_read || (read.position.allFinite() && read.velocity.allFinite()));
  }
}

TEST(TrajectoryResidual, LeadIsTheClosedForm) {
  Motions motions(7);
  for (int i = 0; i < 20000; ++i) {
    const Shape shape = motions.shape();
    const Trajectory t = motions.moving(50.0, shape);
    const double instant = t.time + motions.between(0.0, 12.0);
    const Resistance own{static_cast<double>(shape.drag), static_cast<double>(shape.friction)};
    const physics::Motion exact = motion_of(t, own).at(instant);
    const Lead lead = lead_of(t, shape, instant);
    const double moved = (exact.position - t.position).norm();
    ASSERT_NEAR((lead.position - exact.position).norm(), 0.0, 3e-5 * moved + 1e-6) << i;
    ASSERT_NEAR((lead.velocity - exact.velocity).norm(), 0.0, 1e-4) << i;
  }
}

TEST(TrajectoryResidual, WhatTheFormCannotSayTravelsWhole) {
  std::vector<std::byte> read;
  const Shape shape{.drag = 0.25f, .thrust = 4.0f};
  const Trajectory former{.time = 9.0, .position = {1.0, 2.0}, .velocity = {0.5, 0.5}};
  Trajectory t = former;
  t.time = 10.0;
  EXPECT_TRUE(travels(former, shape, 10.0, t, read));
  const auto refuses = [&](const Trajectory& each) {
    return !travels(former, shape, 10.0, each, read);
  };
  const auto with = [&t](auto change) {
    Trajectory changed = t;
    change(changed);
    return changed;
  };
  EXPECT_TRUE(refuses(with([](Trajectory& each) { each.position.x() = 0.1; }))) << "off the grid";
  EXPECT_TRUE(refuses(with([](Trajectory& each) { each.velocity.y() = -0.0; }))) << "another zero";
  EXPECT_TRUE(refuses(with([](Trajectory& each) { each.time = 11.0; }))) << "of the future";
  EXPECT_TRUE(refuses(with([](Trajectory& each) { each.acceleration.x() = 3.0; })));
  EXPECT_TRUE(refuses(with([](Trajectory& each) { each.drag.x() = 0.5; })));
  EXPECT_TRUE(refuses(with([](Trajectory& each) { each.position.x() = 0x1p40; })));
  EXPECT_FALSE(travels(former, shape, 1e300, t, read)) << "no instant has a place on the grid";
}

TEST(TrajectoryResidual, RandomBitsAreRefusedOrGiveATrajectoryThatAnybodyCanFollow) {
  const unsigned seed = 8;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  Motions motions(seed);
  const TrajectoryCodec trajectories;
  const InputCodec inputs;
  std::vector<std::byte> before, context, input_before, value;
  for (int i = 0; i < 100000; ++i) {
    const Shape shape = motions.shape();
    encode(before, motions.moving(100.0, shape)), encode(context, shape);
    std::vector<std::byte> noise(random() % 24);
    for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
    rti::BitReader bits(noise), again(noise);
    value.clear();
    if (trajectories.decode_residual({before, context}, 100.0 + static_cast<double>(i % 20), bits,
                                     value)) {
      Trajectory t;
      ASSERT_TRUE(decode(value, t));
      ASSERT_TRUE(t.position.allFinite() && t.velocity.allFinite());
    }
    value.clear();
    Input input;
    if (inputs.decode_residual({encode(input_before, Input{7, 3}), {}}, 0.0, again, value)) {
      ASSERT_TRUE(decode(value, input));
      ASSERT_LT(input.held, 16u);
    }
  }
}

TEST(InputResidual, AKeyMoreTakesFourBitsAndNothingIsLost) {
  const InputCodec codec;
  std::vector<std::byte> before, value, bits, read;
  for (const std::uint32_t count : {0u, 1u, 4000u, 0xffffffffu})
    for (std::uint32_t more = 0; more < 5; ++more)
      for (unsigned held = 0; held < 256; ++held) {
        const Input former{count, static_cast<std::uint8_t>(held % 16)},
            now{count + more, static_cast<std::uint8_t>(held / 16)};
        encode(before, former), encode(value, now);
        bits.clear(), read.clear();
        std::size_t size = 0;
        {
          rti::BitWriter writer(bits);
          ASSERT_TRUE(codec.encode_residual({before, {}}, value, 0.0, writer));
          size = writer.at();
        }
        rti::BitReader reader(bits);
        ASSERT_TRUE(codec.decode_residual({before, {}}, 0.0, reader, read));
        ASSERT_EQ(read, value);
        if (std::popcount(held % 16 ^ held / 16) != 1) continue;
        if (more <= 1) {
          ASSERT_EQ(size, more == 1 ? 4u : 5u);
        }
      }
}

}  // namespace
}  // namespace rink::game::residuals
