// One impact of a stepped engine, without an engine: what it conserves, what it gives back, and how
// far friction goes.
#include "game/physics/paper/frame_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rink::physics::paper {
namespace {

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Two discs that touch, `normal` from the second to the first, and approach.
struct Encounter {
  FrameBody body, other;
  Vector2 normal{1.0, 0.0};

  explicit Encounter(std::mt19937_64& random) {
    std::uniform_real_distribution<double> number(-3.0, 3.0), size(0.1, 2.0), angle(0.0, 7.0);
    const double a = angle(random);
    normal = {std::cos(a), std::sin(a)};
    for (FrameBody* each : {&body, &other}) {
      each->start.velocity = {number(random), number(random)};
      each->radius = size(random);
      each->mass = size(random);
      each->inverse_mass = 1.0 / each->mass;
      each->spin = number(random);
    }
    other.start.position = {number(random), number(random)};
    body.start.position = other.start.position + (body.radius + other.radius) * normal;
    if (closing() < 0.0) body.start.velocity += 2.0 * closing() * normal;
  }
  double closing() const { return normal.dot(other.start.velocity - body.start.velocity); }
  /// How fast the first disc's rim passes the other's, along the tangent.
  double slip() const {
    const Vector2 tangent(-normal.y(), normal.x());
    return tangent.dot(body.start.velocity - other.start.velocity) -
           (body.spin * body.radius + other.spin * other.radius);
  }
  Vector2 momentum() const {
    return body.mass * body.start.velocity + other.mass * other.start.velocity;
  }
  /// About the origin; a disc's own is that of a uniform one.
  double angular_momentum() const {
    double sum = 0.0;
    for (const FrameBody* each : {&body, &other})
      sum += each->mass * (cross(each->start.position, each->start.velocity) +
                           0.5 * each->radius * each->radius * each->spin);
    return sum;
  }
  double energy() const {
    return body.energy(body.start.velocity) + other.energy(other.start.velocity);
  }
};

WorldSpec spec_of(double restitution) {
  WorldSpec spec;
  spec.restitution = RestitutionTable(1, restitution);
  return spec;
}

TEST(AFrameImpact, ConservesMomentumAndGivesBackThePartOfTheClosingSpeed) {
  std::mt19937_64 random(1);
  for (const double restitution : {0.0, 0.4, 1.0})
    for (int i = 0; i < 200; ++i) {
      Encounter pair(random);
      const Encounter before = pair;
      strike(pair.body, pair.other, pair.normal, spec_of(restitution));
      EXPECT_LT((pair.momentum() - before.momentum()).norm(), 1e-13);
      EXPECT_NEAR(pair.closing(), -restitution * before.closing(), 1e-12);
      EXPECT_LT(pair.closing(), 0.0) << "they part, however little";
      const double reduced = 1.0 / (pair.body.inverse_mass + pair.other.inverse_mass);
      EXPECT_NEAR(
          before.energy() - pair.energy(),
          0.5 * reduced * (1.0 - restitution * restitution) * before.closing() * before.closing(),
          1e-11);
      const Vector2 tangent(-pair.normal.y(), pair.normal.x());
      EXPECT_NEAR(tangent.dot(pair.body.start.velocity - before.body.start.velocity), 0.0, 1e-13);
      EXPECT_EQ(pair.body.spin, before.body.spin) << "smooth discs turn nothing";
    }
}

TEST(AFrameImpact, OnTheFieldMirrorsTheNormalSpeed) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    Encounter pair(random);
    FrameBody wall = immovable(0);
    const Vector2 before = pair.body.start.velocity;
    const double closing = -pair.normal.dot(before);
    strike(pair.body, wall, pair.normal, spec_of(0.6));
    EXPECT_EQ(wall.start.velocity, Vector2(0.0, 0.0));
    if (closing <= 0.0) continue;
    EXPECT_LT((pair.body.start.velocity - (before + 1.6 * closing * pair.normal)).norm(), 1e-13);
  }
}

/// Coulomb's law: rims stick, and give back a part of their slip, or slide at the limit.
TEST(AFrameImpact, RubsUpToCoulombsLimitAndConservesAngularMomentum) {
  std::mt19937_64 random(3);
  int sticking = 0, sliding = 0;
  for (int i = 0; i < 400; ++i) {
    WorldSpec spec = spec_of(0.5);
    const double coefficient = 0.4, given_back = 0.3;
    spec.surface_friction =
        SurfaceFriction{PairTable(1, coefficient), RestitutionTable(1, given_back)};
    Encounter pair(random);
    const Encounter before = pair;
    strike(pair.body, pair.other, pair.normal, spec);
    EXPECT_LT((pair.momentum() - before.momentum()).norm(), 1e-13);
    EXPECT_NEAR(pair.angular_momentum(), before.angular_momentum(), 1e-12);
    EXPECT_NEAR(pair.closing(), -0.5 * before.closing(), 1e-12);
    EXPECT_LE(pair.energy(), before.energy() + 1e-12);
    const Vector2 impulse =
        pair.body.mass * (pair.body.start.velocity - before.body.start.velocity);
    const double along = pair.normal.dot(impulse), across = cross(pair.normal, impulse);
    EXPECT_LE(std::abs(across), coefficient * along + 1e-12);
    EXPECT_LE(across * before.slip(), 0.0) << "against the slip";
    const bool is_sliding = std::abs(across) > coefficient * along - 1e-9;
    if (!is_sliding) EXPECT_NEAR(pair.slip(), -given_back * before.slip(), 1e-12);
    else EXPECT_GE(pair.slip() * before.slip(), -given_back * before.slip() * before.slip() - 1e-9);
    ++(is_sliding ? sliding : sticking);
  }
  EXPECT_GT(sticking, 50);
  EXPECT_GT(sliding, 50);
}

/// Velocities may part where the paths of a frame still close.
TEST(AFrameImpact, KeepsAPressedContactsPathOpen) {
  std::mt19937_64 random(4);
  for (const double closing_path : {0.25, -0.25}) {
    Encounter pair(random);
    pair.body.start.velocity += 2.0 * pair.closing() * pair.normal;  // now they part
    pair.body.chord = -closing_path * pair.normal;
    const Encounter before = pair;
    ASSERT_LT(before.closing(), 0.0);
    strike(pair.body, pair.other, pair.normal, spec_of(1.0));
    EXPECT_NEAR(before.closing() - pair.closing(), std::max(0.0, closing_path), 1e-12);
    EXPECT_LT((pair.momentum() - before.momentum()).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace rink::physics::paper
