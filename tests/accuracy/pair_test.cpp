// Free pairs and bats under keys against 50-digit constants (truth.csv, which truth.py prints), and
// random pairs against closed forms in 80-bit arithmetic.
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "tests/accuracy/accuracy_scene.h"
#include "tests/places.h"

namespace rink::accuracy {
namespace {

constexpr double position_part = 1e-13;  // of the field's length
constexpr double velocity_part =
    1e-14;  // of the speed, over the cosine of the angle at which round surfaces meet

struct Truth {
  std::string scene, body;
  double until = 0.0, cosine = 1.0;
  std::uint64_t impacts = 0;
  Vector2 position, velocity;
};

std::vector<Truth> read_truth() {
  std::ifstream file(test::source_folder() + "/tests/accuracy/truth.csv");
  std::vector<Truth> all;
  std::string line;
  for (std::getline(file, line); std::getline(file, line);) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    const auto number = [&](std::size_t i) { return std::stod(fields.at(i)); };
    all.push_back({fields.at(0),
                   fields.at(2),
                   number(1),
                   number(4),
                   std::stoull(fields.at(3)),
                   {number(5), number(6)},
                   {number(7), number(8)}});
  }
  return all;
}

std::vector<std::string> names_of(const std::vector<Truth>& truth) {
  std::vector<std::string> names;
  for (const Truth& body : truth)
    if (names.empty() || names.back() != body.scene) names.push_back(body.scene);
  return names;
}

class Exactly : public testing::TestWithParam<std::string> {};

TEST_P(Exactly, EveryBodyIsWhereSixtyDigitArithmeticPutsIt) {
  const Scene scene = scene_named(GetParam());
  Game game(scene);
  double position_error = 0.0, velocity_error = 0.0, speed = 0.0, cosine = 1.0;
  for (const Truth& truth : read_truth()) {
    if (truth.scene != GetParam()) continue;
    game.advance(truth.until);
    const BodyId body = body_named(scene, truth.body);
    EXPECT_EQ(game.world().counters().impacts(), truth.impacts);
    position_error = std::max(position_error, (game.position(body) - truth.position).norm());
    velocity_error = std::max(velocity_error, (game.velocity(body) - truth.velocity).norm());
    speed = std::max(speed, truth.velocity.norm());
    cosine = truth.cosine;
  }
  ASSERT_GT(speed, 0.0);
  expect_at_most("largest error of a position / length of the field",
                 position_error / scene.world.field.length, position_part);
  expect_at_most("largest error of a velocity / fastest body", velocity_error / speed,
                 velocity_part / cosine);
}

INSTANTIATE_TEST_SUITE_P(Scene, Exactly, testing::ValuesIn(names_of(read_truth())),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

using Real = long double;
using Real2 = Eigen::Matrix<Real, 2, 1>;

/// Two discs alone under a shared drag, in 80-bit arithmetic: where they are after `until`, by the
/// warped clock s = (1 - exp(-g t))/g.
struct LonePair {
  Real2 x[2], v[2];
  Real mass[2];
  Real reach, restitution, drag;

  Real warped(Real t) const { return drag == 0 ? t : -std::expm1(-drag * t) / drag; }
  void fly(Real s) {
    for (int i = 0; i < 2; ++i) x[i] += v[i] * s, v[i] *= 1 - drag * s;
  }
  /// The cosine between normal and closing velocity; 1 if the two never meet.
  Real play(Real until) {
    const Real2 d = x[1] - x[0], w = v[1] - v[0];
    const Real b = d.dot(w), miss = d.x() * w.y() - d.y() * w.x(),
               span = std::sqrt(w.squaredNorm()) * reach;
    const Real end = warped(until), s = b < 0 && std::abs(miss) < span
                                            ? (d.squaredNorm() - reach * reach) /
                                                  (-b + std::sqrt((span - miss) * (span + miss)))
                                            : end;
    if (s >= end) return fly(end), Real(1);
    fly(s);
    const Real2 normal = (x[1] - x[0]) / (x[1] - x[0]).norm();
    const Real approach = normal.dot(v[0] - v[1]),
               impulse = (1 + restitution) * approach / (1 / mass[0] + 1 / mass[1]),
               cosine = approach / (v[1] - v[0]).norm();
    v[0] -= impulse / mass[0] * normal, v[1] += impulse / mass[1] * normal;
    // Time since the impact, from the warped clock, which has 1 - drag s left to run.
    const Real left = drag == 0 ? until - s : until + std::log1p(-drag * s) / drag;
    fly(warped(left));
    return cosine;
  }
};

TEST(RandomPairs, MeetAsInExtendedPrecisionWhateverTheirMassesAnglesAndDrag) {
  std::mt19937_64 random(17);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  const Real until = 0.75;
  std::vector<double> position_errors, grazing_errors, velocity_errors;
  std::uint64_t impacts = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    physics::WorldSpec spec;
    spec.field.length = 2.0, spec.field.width = 1.0;
    const double restitution = uniform(0, 1) < 0.5 ? 1.0 : uniform(0.5, 1);
    spec.restitution = physics::RestitutionTable(1, restitution);
    spec.puck_drag = trial % 2 == 0 ? 0.0 : uniform(0.01, 1.0);
    physics::PuckSpec pucks[2];
    const double reach = 0.04 + 0.03,
                 sine = trial % 4 < 2
                            ? uniform(-1, 1)
                            : std::copysign(1.0 - std::pow(10.0, uniform(-6, -1)), uniform(-1, 1));
    pucks[0] = {.position = {uniform(0.6, 0.8), 0.5},
                .velocity = {uniform(0.3, 0.6), uniform(-0.2, 0.2)},
                .radius = 0.04,
                .mass = std::pow(10.0, uniform(-3, 3))};
    pucks[1] = {.position = {uniform(1.1, 1.3), 0.5},
                .velocity = {uniform(-0.6, -0.3), uniform(-0.2, 0.2)},
                .radius = 0.03,
                .mass = std::pow(10.0, uniform(-3, 3))};
    // Moved sideways until the impact parameter is `sine` of the reach.
    const Vector2 d = pucks[1].position - pucks[0].position,
                  w = pucks[1].velocity - pucks[0].velocity;
    pucks[1].position.y() += (d.x() * w.y() - d.y() * w.x() - sine * reach * w.norm()) / w.x();
    World world(spec);
    LonePair pair{{},
                  {},
                  {pucks[0].mass, pucks[1].mass},
                  Real(pucks[0].radius) + Real(pucks[1].radius),
                  restitution,
                  spec.puck_drag};
    BodyId ids[2];
    for (int i = 0; i < 2; ++i) {
      ids[i] = world.add(pucks[i]);
      pair.x[i] = pucks[i].position.cast<Real>(), pair.v[i] = pucks[i].velocity.cast<Real>();
    }
    world.advance(static_cast<double>(until));
    const Real cosine = pair.play(until);
    if (world.counters().wall_impacts > 0) continue;
    impacts += world.counters().disc_impacts;
    for (int i = 0; i < 2; ++i) {
      const double speed = static_cast<double>(std::max(pair.v[0].norm(), pair.v[1].norm()));
      const double error =
          static_cast<double>((world.position(ids[i]).cast<Real>() - pair.x[i]).norm());
      if (std::abs(sine) <= 0.999) position_errors.push_back(error);
      else grazing_errors.push_back(error * static_cast<double>(cosine));
      velocity_errors.push_back(
          static_cast<double>((world.velocity(ids[i]).cast<Real>() - pair.v[i]).norm() * cosine) /
          speed);
    }
  }
  EXPECT_GT(impacts, 10000u);
  expect_at_most("largest error of a position / field's length", largest(position_errors) / 2.0,
                 position_part);
  // Within a thousandth of missing each other the velocity's own limit lets positions stray
  // further.
  expect_at_most("likewise of grazing pairs, times cosine", largest(grazing_errors) / 2.0,
                 position_part);
  expect_at_most("largest relative error of a velocity, times cosine", largest(velocity_errors),
                 velocity_part);
  std::printf("    %-52s %.3g and %.3g\n", "medians of the same", median(position_errors) / 2.0,
              median(velocity_errors));
}

}  // namespace
}  // namespace rink::accuracy
