// Pressed contact whose normals turn, against Lagrange's equations: a puck that squirts from
// between a bat and a post, and pucks that a third one drives apart.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/scenes.h"
#include "tests/words.h"

namespace rink::physics::test {
namespace {

constexpr double puck_drag = 0.2, bat_drag = 1.0, thrust = 6.0, puck_radius = 0.04;
/// Bodies are placed this far apart, so that rounding starts none of them in overlap [m].
constexpr double crack = 1e-14;

struct State {
  double time;
  Vector2 q, rate;
};

/// Classical Runge-Kutta steps of 10 us for as long as the contact that parts first still pushes;
/// the last steps are halved down to that instant. Halving the step changes the outcomes below by
/// less than 1e-10.
template <class Scene>
State integrate(const Scene& scene, State state) {
  const auto step = [&](const State& s, double dt) {
    const auto moved = [&](double share, const Vector2& rate, const Vector2& second) -> State {
      return {s.time + share * dt, s.q + share * dt * rate, s.rate + share * dt * second};
    };
    const Vector2 a1 = scene.acceleration(s);
    const State s2 = moved(0.5, s.rate, a1);
    const Vector2 a2 = scene.acceleration(s2);
    const State s3 = moved(0.5, s2.rate, a2);
    const Vector2 a3 = scene.acceleration(s3);
    const State s4 = moved(1.0, s3.rate, a3);
    return moved(1.0, (s.rate + 2.0 * s2.rate + 2.0 * s3.rate + s4.rate) / 6.0,
                 (a1 + 2.0 * a2 + 2.0 * a3 + scene.acceleration(s4)) / 6.0);
  };
  for (double dt = 1e-5; dt > 1e-10;) {
    const State next = step(state, dt);
    if (scene.parting_force(next) < 0.0) dt *= 0.5;
    else state = next;
  }
  return state;
}

/// Where the pucks are, and how fast. The last one is before the bat's face.
struct Outcome {
  double time = 0.0;
  std::vector<Vector2> positions, velocities;

  double speed() const {
    double fastest = 0.0;
    for (const Vector2& velocity : velocities) fastest = std::max(fastest, velocity.norm());
    return fastest;
  }
  /// When pucks have parted: the last one stays with the bat along x, M dv/dt = -M a - (M G + m g)
  /// v with the mass of both, and is free along y; the others are free.
  void fly_on(double wait, double bat_mass, double puck_mass) {
    time += wait;
    const WarpedTime free = warp(wait, puck_drag);
    for (std::size_t i = 0; i < positions.size(); ++i)
      positions[i] += velocities[i] * free.s, velocities[i] *= free.e;
    const double mass = bat_mass + puck_mass,
                 drag = (bat_mass * bat_drag + puck_mass * puck_drag) / mass,
                 acceleration = -bat_mass * thrust / mass;
    const WarpedTime pressed = warp(wait, drag);
    const double speed = velocities.back().x() / free.e;
    positions.back().x() += speed * (pressed.s - free.s) + acceleration * pressed.q;
    velocities.back().x() = speed * pressed.e + acceleration * pressed.s;
  }
};

BatSpec driving_bat(double mass, double face_x) {
  BatSpec bat;
  bat.mass = mass;
  bat.half_extent = {0.05, 0.3};
  bat.position = {face_x + 0.05 + crack, 1.0};
  return bat;
}

PuckSpec puck_of(double mass, const Vector2& position) {
  PuckSpec puck;
  puck.radius = puck_radius;
  puck.mass = mass;
  puck.position = position;
  return puck;
}

/// Adds the bat, drives it along -x from rest until `time`, and looks at the pucks.
Outcome drive(World& world, const std::vector<BodyId>& pucks, const BatSpec& bat, double time) {
  world.set_thrust(world.add(bat), {-thrust, 0.0});
  world.advance(time);
  EXPECT_LT(world.max_overlap(), 1e-9);
  EXPECT_LT(world.counters().events(), 2000 + time * 1e4 * world.body_count());
  Outcome seen{time, {}, {}};
  for (const BodyId puck : pucks)
    seen.positions.push_back(world.position(puck)), seen.velocities.push_back(world.velocity(puck));
  return seen;
}

/// A puck of mass m on a post, centres r apart at the angle q from the x axis, before the face of a
/// bat of mass M that the thrust a drives along -x: T = (m + M sin^2 q) r^2 q'^2/2, and the
/// generalised force is M a r sin q - (m g + M G sin^2 q) r^2 q'.
struct Squirt {
  double puck_mass, bat_mass, reach, start;

  Vector2 acceleration(const State& s) const {
    const double sine = std::sin(s.q[0]), cosine = std::cos(s.q[0]), rate = s.rate[0];
    const double inertia = puck_mass + bat_mass * sine * sine,
                 drag = puck_mass * puck_drag + bat_mass * bat_drag * sine * sine;
    return {
        (bat_mass * thrust * sine / reach - bat_mass * sine * cosine * rate * rate - drag * rate) /
            inertia,
        0.0};
  }
  /// The post's: along its normal the puck's acceleration is -r q'^2, and drag acts across it.
  double parting_force(const State& s) const {
    const double sine = std::sin(s.q[0]), cosine = std::cos(s.q[0]), rate = s.rate[0];
    const double bat_velocity = -reach * sine * rate,
                 bat_acceleration = -reach * (sine * acceleration(s)[0] + cosine * rate * rate);
    const double bat_force = bat_mass * (bat_acceleration + thrust + bat_drag * bat_velocity);
    return bat_force * cosine - puck_mass * reach * rate * rate;
  }
  Outcome truth() const {
    const State end = integrate(*this, {0.0, {start, 0.0}, {0.0, 0.0}});
    const Vector2 normal(std::cos(end.q[0]), std::sin(end.q[0])), along(-normal.y(), normal.x());
    Outcome outcome{end.time, {Vector2(1.0, 1.0) + reach * normal}, {reach * end.rate[0] * along}};
    outcome.fly_on(0.01, bat_mass, puck_mass);
    return outcome;
  }
  Outcome seen(const WorldSpec& spec, double until) const {
    World world(spec);
    PostSpec post;
    post.position = {1.0, 1.0};
    post.radius = reach - puck_radius;
    world.add(post);
    const PuckSpec puck = puck_of(
        puck_mass, post.position + (reach + crack) * Vector2(std::cos(start), std::sin(start)));
    const BodyId pressed = world.add(puck);
    return drive(world, {pressed}, driving_bat(bat_mass, puck.position.x() + puck_radius), until);
  }
};

/// Two pucks of mass m side by side against the wall x = 0, driven apart by a third of mass n
/// between them and a bat of mass M behind it. l is the distance of touching centres, q the angle
/// between the line of centres and the x axis: T = (2 m cos^2 q + (M + n) sin^2 q) l^2 q'^2/2.
struct WedgeAtWall {
  double puck_mass, driver_mass, bat_mass;
  double length = 2.0 * puck_radius;

  Vector2 acceleration(const State& s) const {
    const double sine = std::sin(s.q[0]), cosine = std::cos(s.q[0]), rate = s.rate[0],
                 driven = bat_mass + driver_mass;
    const double inertia = 2.0 * puck_mass * cosine * cosine + driven * sine * sine;
    const double drag = 2.0 * puck_mass * puck_drag * cosine * cosine +
                        (driver_mass * puck_drag + bat_mass * bat_drag) * sine * sine;
    return {(bat_mass * thrust * sine / length -
             sine * cosine * (driven - 2.0 * puck_mass) * rate * rate - drag * rate) /
                inertia,
            0.0};
  }
  /// On a puck at the wall: m (y'' + g y') = F sin q.
  double parting_force(const State& s) const {
    const double sine = std::sin(s.q[0]), cosine = std::cos(s.q[0]), rate = s.rate[0],
                 second = acceleration(s)[0];
    return puck_mass * length * (cosine * second - sine * rate * rate + puck_drag * cosine * rate) /
           sine;
  }
  Outcome truth() const {
    const State end = integrate(*this, {0.0, {std::asin(0.5), 0.0}, {0.0, 0.0}});
    const double sine = length * std::sin(end.q[0]), cosine = length * std::cos(end.q[0]),
                 rate = end.rate[0];
    Outcome outcome{
        end.time,
        {{puck_radius, 1.0 + sine}, {puck_radius, 1.0 - sine}, {puck_radius + cosine, 1.0}},
        {{0.0, cosine * rate}, {0.0, -cosine * rate}, {-sine * rate, 0.0}}};
    outcome.fly_on(0.01, bat_mass, driver_mass);
    return outcome;
  }
  Outcome seen(const WorldSpec& spec, double until) const {
    World world(spec);
    const BodyId above = world.add(puck_of(puck_mass, {puck_radius, 1.0 + puck_radius + crack})),
                 below = world.add(puck_of(puck_mass, {puck_radius, 1.0 - puck_radius - crack}));
    const PuckSpec driver =
        puck_of(driver_mass, {puck_radius + std::sqrt(3.0) * puck_radius + crack, 1.0});
    const BodyId between = world.add(driver);
    return drive(world, {above, below, between},
                 driving_bat(bat_mass, driver.position.x() + puck_radius), until);
  }
};

/// The same without the wall: x of the third puck and q are free. T = (M + n) x'^2/2 + m ((x' + l
/// sin q q')^2 + (l cos q q')^2).
struct FreeWedge {
  double puck_mass, driver_mass, bat_mass;
  double length = 2.0 * puck_radius;

  Vector2 acceleration(const State& s) const {
    const double sine = std::sin(s.q[1]), cosine = std::cos(s.q[1]), speed = s.rate[0],
                 rate = s.rate[1], driven = bat_mass + driver_mass;
    // q: l q'' + sin q x'' = -g (sin q x' + l q'), put into the equation of x.
    const double turning = -puck_drag * (sine * speed + length * rate);
    const double force = -bat_mass * thrust -
                         (bat_mass * bat_drag + driver_mass * puck_drag) * speed -
                         2.0 * puck_mass * puck_drag * (speed + length * sine * rate);
    const double x = (force - 2.0 * puck_mass * (sine * turning + length * cosine * rate * rate)) /
                     (driven + 2.0 * puck_mass * cosine * cosine);
    return {x, (turning - sine * x) / length};
  }
  double parting_force(const State& s) const {
    const double cosine = std::cos(s.q[1]);
    return -puck_mass * (cosine * acceleration(s)[0] + length * s.rate[1] * s.rate[1] +
                         puck_drag * cosine * s.rate[0]);
  }
  static constexpr double start_x = 2.0;
  Outcome truth() const {
    const State end = integrate(*this, {0.0, {start_x, std::asin(0.5)}, {0.0, 0.0}});
    const double sine = length * std::sin(end.q[1]), cosine = length * std::cos(end.q[1]),
                 x = end.q[0], speed = end.rate[0], rate = end.rate[1];
    const Vector2 above(speed + sine * rate, cosine * rate);
    Outcome outcome{end.time,
                    {{x - cosine, 1.0 + sine}, {x - cosine, 1.0 - sine}, {x, 1.0}},
                    {above, {above.x(), -above.y()}, {speed, 0.0}}};
    outcome.fly_on(0.01, bat_mass, driver_mass);
    return outcome;
  }
  Outcome seen(const WorldSpec& spec, double until) const {
    World world(spec);
    const double x = start_x - std::sqrt(3.0) * puck_radius - crack;
    const BodyId above = world.add(puck_of(puck_mass, {x, 1.0 + puck_radius + crack})),
                 below = world.add(puck_of(puck_mass, {x, 1.0 - puck_radius - crack}));
    const BodyId between = world.add(puck_of(driver_mass, {start_x, 1.0}));
    return drive(world, {above, below, between}, driving_bat(bat_mass, start_x + puck_radius),
                 until);
  }
};

/// The largest error of a velocity relative to the fastest puck's, and of a way relative to the
/// longest, 10 ms after the pucks have parted.
template <class Scene>
double error_of(const Scene& scene, double restitution, double contact_time) {
  WorldSpec spec = rink_of(4, 2, restitution, puck_drag, bat_drag);
  spec.contact_time = contact_time;
  const Outcome truth = scene.truth(), start = scene.seen(spec, 0.0),
                seen = scene.seen(spec, truth.time);
  double way = 0.0, error = 0.0;
  for (std::size_t i = 0; i < truth.positions.size(); ++i)
    way = std::max(way, (truth.positions[i] - start.positions[i]).norm());
  for (std::size_t i = 0; i < truth.positions.size(); ++i)
    error = std::max({error, (seen.velocities[i] - truth.velocities[i]).norm() / truth.speed(),
                      (seen.positions[i] - truth.positions[i]).norm() / way});
  return error;
}

constexpr double masses[] = {0.02, 0.5, 10.0}, angles[] = {0.02, 0.1, 0.3, 0.8};

void expect_near_truth(double mass, double driver_mass, double angle, double restitution,
                       double contact_time, double tolerance) {
  SCOPED_TRACE(testing::Message() << "restitution " << restitution << ", pucks of " << mass
                                  << " kg, driven by " << driver_mass << " kg, at " << angle
                                  << " rad");
  EXPECT_LT(error_of(Squirt{mass, 3.0, 0.14, angle}, restitution, contact_time), tolerance);
  EXPECT_LT(error_of(WedgeAtWall{mass, driver_mass, 3.0}, restitution, contact_time), tolerance);
  EXPECT_LT(error_of(FreeWedge{mass, driver_mass, 3.0}, restitution, contact_time), tolerance);
}

void expect_all_near_truth(double restitution, double contact_time, double tolerance) {
  for (const double mass : masses)
    for (std::size_t i = 0; i < 3; ++i)
      expect_near_truth(mass, masses[i], angles[i], restitution, contact_time, tolerance);
}

class AgainstLagrange : public testing::TestWithParam<double> {};

TEST_P(AgainstLagrange, SquirtsAndWedgesAreRightWithinTwoPercent) {
  expect_all_near_truth(GetParam(), 5e-4, 0.02);
}
TEST_P(AgainstLagrange, AFifthOfTheTimeScaleIsRightWithinHalfAPercent) {
  expect_near_truth(0.5, 0.5, 0.3, GetParam(), 1e-4, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Restitution, AgainstLagrange, testing::Values(0.0, 0.5, 0.9, 1.0),
                         [](const auto& restitution) {
                           return "of_" + rink::test::words(restitution.param);
                         });

/// Where impacts lose nothing, a light puck before the bat goes on bouncing on it at a few mm/s,
/// faster than what comes to rest at this time scale.
TEST(AgainstLagrangeLong, AFifthOfTheTimeScaleIsRightWithinHalfAPercentForAllMasses) {
  for (const double restitution : {0.0, 0.3, 0.5, 0.9})
    expect_all_near_truth(restitution, 1e-4, 0.005);
  expect_all_near_truth(1.0, 1e-4, 0.01);
}

}  // namespace
}  // namespace rink::physics::test
