// A body's way through one frame, without an engine: parabolas under thrust alone, the work that
// thrust does, and bodies that have no way to go.
#include "game/physics/paper/frame_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace rink::physics::paper {
namespace {

constexpr double dt = 1.0 / 64;  // no rounding in multiples of it

FrameBody thrown(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-3.0, 3.0), mass(0.1, 2.0);
  FrameBody body;
  body.start = {{number(random), number(random)}, {number(random), number(random)}};
  body.force.thrust = {number(random), number(random)};
  body.mass = mass(random);
  body.inverse_mass = 1.0 / body.mass;
  return body;
}

/// Where thrust alone takes a body, a time `passed` after its last state.
Phase on_parabola(const FrameBody& body, double passed) {
  const Vector2& thrust = body.force.thrust;
  return {body.start.position + passed * body.start.velocity + 0.5 * passed * passed * thrust,
          body.start.velocity + passed * thrust};
}

void expect_same(const Phase& found, const Phase& expected, const char* what) {
  EXPECT_LT((found.position - expected.position).norm(), 1e-15) << what;
  EXPECT_LT((found.velocity - expected.velocity).norm(), 1e-14) << what;
}

/// Steps of the methods whose order is at least 2 have no error there.
TEST(FrameSteps, FollowParabolasFromAnyInstantOfAnyFrame) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const Integrator integrator : {Integrator::verlet, Integrator::rk4}) {
    FrameSteps steps(integrator, dt);
    for (int frame = 0; frame < 50; ++frame) {
      FrameBody body = thrown(random);
      body.start.position *= 1e-2;  // so that the places' own rounding is small
      body.start_time = (frame + part(random)) * dt;
      const double end = (frame + 1) * dt, left = end - body.start_time;
      ASSERT_EQ(steps.frame_end(), end);
      steps.begin();
      ASSERT_TRUE(steps.plan(body));
      expect_same(body.end, on_parabola(body, left), "at the end of the frame");
      EXPECT_LT((body.chord * left - (body.end.position - body.start.position)).norm(), 1e-15);
      const double passed = part(random) * left;
      expect_same(steps.phase_at(body, body.start_time + passed), on_parabola(body, passed),
                  "within the frame");
      expect_same(steps.phase_at(body, body.start_time), body.start, "at its last state");
      expect_same(steps.phase_at(body, frame * dt), body.start, "before its last state");
      steps.finish();
    }
  }
}

/// The end that was planned is kept, also where a step would give it anew with other roundings.
TEST(FrameSteps, EndWhereTheFrameWasPlannedToEnd) {
  std::mt19937_64 random(2);
  FrameSteps steps(Integrator::semi_implicit, dt);
  FrameBody body = thrown(random);
  const Phase fresh = steps.phase_at(body, dt);
  EXPECT_NE(fresh.position, body.end.position) << "nothing is planned before the frame begins";
  steps.begin();
  ASSERT_TRUE(steps.plan(body));
  EXPECT_EQ(steps.phase_at(body, dt).position, body.end.position);
  body.end.position = {7.0, 8.0};
  EXPECT_EQ(steps.phase_at(body, dt).position, Vector2(7.0, 8.0));
}

/// The work-energy theorem.
TEST(FrameSteps, DoAsMuchWorkByThrustAsEnergyIsGained) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100; ++i) {
    const FrameSteps steps(Integrator::rk4, dt);
    FrameBody body = thrown(random);
    const double time = (i + 1) / 100.0 * dt;
    const double gained =
        body.energy(steps.phase_at(body, time).velocity) - body.energy(body.start.velocity);
    EXPECT_NEAR(steps.work_until(body, time), gained, 5e-14) << "after " << time << " s";
    body.force.thrust = {0.0, 0.0};
    EXPECT_EQ(steps.work_until(body, time), 0.0);
  }
}

TEST(FrameSteps, LeaveWhatCannotMoveWhereItIs) {
  std::mt19937_64 random(4);
  const FrameSteps steps(Integrator::rk4, dt);
  const FrameBody moving = thrown(random);
  std::vector<FrameBody> still(5, moving);
  still[0].is_in_play = false;
  still[1].is_stopped = true;
  still[2].inverse_mass = 0.0;
  still[3].start.velocity = still[3].force.thrust = {0.0, 0.0};
  still[4].start_time = dt;  // nothing of the frame is left
  for (std::size_t i = 0; i < still.size(); ++i) {
    FrameBody& body = still[i];
    body.chord = {9.0, 9.0};
    EXPECT_FALSE(steps.plan(body)) << i;
    EXPECT_EQ(body.version, moving.version + 1) << i << ": its former path counts no more";
    EXPECT_EQ(body.end.position, body.start.position) << i;
    EXPECT_EQ(body.end.velocity, body.start.velocity) << i;
    EXPECT_EQ(body.chord, Vector2(0.0, 0.0)) << i;
    EXPECT_EQ(steps.phase_at(body, dt).position, body.start.position) << i;
  }
}

}  // namespace
}  // namespace rink::physics::paper
