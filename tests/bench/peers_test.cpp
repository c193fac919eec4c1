// Other libraries' worlds are what they claim to be: the same scene, moved by somebody else.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/accuracy/diagram.h"
#include "bench/peers/overlap.h"
#include "bench/peers/peers.h"
#include "game/physics/simulator_choice.h"

namespace rink::peers {
namespace {

using physics::BatSpec;
using physics::PostSpec;
using physics::PuckSpec;
using physics::WorldSpec;

WorldSpec rink_of(double length, double width, double restitution = 1.0) {
  WorldSpec spec;
  spec.field.length = length, spec.field.width = width;
  spec.restitution = physics::RestitutionTable(1, restitution);
  return spec;
}

class Peer : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!is_built_in(GetParam())) GTEST_SKIP() << GetParam() << " is absent";
  }
  std::unique_ptr<physics::Simulator> world(const WorldSpec& spec, double dt) {
    return make_peer(spec, GetParam(), dt);
  }
};

INSTANTIATE_TEST_SUITE_P(Peers, Peer, testing::ValuesIn(peer_names()), [](const auto& peer) {
  return peer.param == "box2d-bullets" ? "box2d_bullets" : peer.param;
});

/// The error of a head-on pair after 1 s at steps of `dt`: the worse of both pucks.
double pair_error(const std::string& peer, double dt) {
  const auto moved = [dt](physics::Simulator& world) {
    (void)dt;
    const physics::BodyId a =
        world.add(PuckSpec{.position = {1.0, 1.0}, .velocity = {1.3, 0.2}, .mass = 2.0});
    const physics::BodyId b =
        world.add(PuckSpec{.position = {1.9, 1.21}, .velocity = {-0.4, 0.0}, .mass = 0.7});
    world.advance(1.0);
    return std::pair(world.position(a), world.position(b));
  };
  const auto exact = physics::make_simulator(rink_of(4.0, 2.0));
  const auto stepped = make_peer(rink_of(4.0, 2.0), peer, dt);
  const auto truth = moved(*exact), seen = moved(*stepped);
  return std::max((truth.first - seen.first).norm(), (truth.second - seen.second).norm());
}

TEST_P(Peer, AgreesWithTheExactEngineOnAFreePairAsStepsShrink) {
  const double coarse = pair_error(GetParam(), 1.0 / 60.0),
               fine = pair_error(GetParam(), 1.0 / 15360.0);
  EXPECT_LT(coarse, 0.1);
  // First order: a step 256 times shorter. Box2D's floats and its slop of 5 mm leave more than
  // that.
  EXPECT_LT(fine, 2e-3);
  EXPECT_LT(fine, 0.2 * coarse + 1e-4);
}

TEST_P(Peer, KeepsItsBodiesWithinTheWallsAndBouncesThemBack) {
  const auto rink = world(rink_of(2.0, 1.0), 1.0 / 240.0);
  const physics::BodyId puck = rink->add(PuckSpec{.position = {1.5, 0.5}, .velocity = {1.0, 0.0}});
  rink->advance(1.0);
  EXPECT_NEAR(rink->velocity(puck).x(), -1.0, 1e-4);
  EXPECT_NEAR(rink->position(puck).x(), 2.0 - 0.04 - (1.0 - 0.46), 0.02);
  EXPECT_EQ(rink->counters().wall_impacts, 1u);
}

TEST_P(Peer, LosesSpeedAsRestitutionAndDragSay) {
  WorldSpec spec = rink_of(4.0, 1.0, 0.5);
  const auto elastic = world(spec, 1.0 / 960.0);
  const physics::BodyId bounced =
      elastic->add(PuckSpec{.position = {3.5, 0.5}, .velocity = {1.0, 0.0}});
  elastic->advance(1.0);
  EXPECT_NEAR(elastic->velocity(bounced).x(), -0.5, 1e-3);
  spec.puck_drag = 0.7;
  const auto dragged = world(spec, 1.0 / 960.0);
  const physics::BodyId slowed =
      dragged->add(PuckSpec{.position = {0.5, 0.5}, .velocity = {1.0, 0.0}});
  dragged->advance(1.0);
  EXPECT_NEAR(dragged->velocity(slowed).x(), std::exp(-0.7), 1e-3);
}

TEST_P(Peer, BatsMoveUnderThrustAndTheirOwnDragAndNeverTurn) {
  WorldSpec spec = rink_of(4.0, 2.0);
  spec.bat_drag = 1.0;
  const auto rink = world(spec, 1.0 / 960.0);
  const physics::BodyId bat =
      rink->add(BatSpec{.position = {1.0, 1.0}, .half_extent = {0.05, 0.2}, .mass = 3.0});
  const physics::BodyId puck =
      rink->add(PuckSpec{.position = {2.0, 1.15}, .mass = 0.2});  // off the bat's middle
  rink->set_thrust(bat, {2.0, 0.0});
  rink->advance(0.5);
  EXPECT_NEAR(rink->velocity(bat).x(), 2.0 * (1.0 - std::exp(-0.5)), 2e-3);
  rink->advance(1.6);
  EXPECT_GT(rink->velocity(puck).x(), 1.0);
  EXPECT_NEAR(rink->velocity(puck).y(), 0.0, 1e-6);  // the edge stayed upright
  EXPECT_EQ(rink->counters().bat_impacts, 1u);
}

TEST_P(Peer, PostsStayAndRemovedBodiesAreNoLongerInTheWay) {
  const auto rink = world(rink_of(4.0, 1.0), 1.0 / 240.0);
  const physics::BodyId post = rink->add(PostSpec{.position = {2.0, 0.5}, .radius = 0.1});
  const physics::BodyId puck = rink->add(PuckSpec{.position = {1.0, 0.5}, .velocity = {1.0, 0.0}});
  rink->advance(1.0);
  EXPECT_EQ(rink->position(post), Vector2(2.0, 0.5));
  EXPECT_LT(rink->velocity(puck).x(), -0.99);
  EXPECT_FALSE(rink->is_free({2.1, 0.5}, 0.04));
  rink->remove(post);
  EXPECT_TRUE(rink->is_free({2.1, 0.5}, 0.04));
  EXPECT_FALSE(rink->is_in_play(post));
  EXPECT_NEAR(rink->kinetic_energy(), 0.5, 1e-4);
}

TEST_P(Peer, TwoWorldsOfOneKindLiveSideBySideAndAgree) {
  const accuracy::Trial trial = accuracy::gas(50, 0.2);
  const auto first = world(trial.world, 1.0 / 60.0), second = world(trial.world, 1.0 / 60.0);
  accuracy::load(trial, *first), accuracy::load(trial, *second);
  first->advance(0.5);
  for (int k = 1; k <= 30; ++k) second->advance(accuracy::at_frame(k));
  EXPECT_EQ(first->hash(), second->hash());
  EXPECT_NEAR(first->now(), 0.5, 1e-12);
}

TEST(Peers, AnAbsentOneSaysSoAndMakesNoWorld) {
  EXPECT_EQ(make_peer(rink_of(1.0, 1.0), "nobody", 0.01), nullptr);
  EXPECT_FALSE(is_built_in("nobody"));
  EXPECT_EQ(way_to("chipmunk"), "install libchipmunk-dev and configure again");
  EXPECT_NE(way_to("box2d3").find("-DRINK_BOX2D3"), std::string::npos);
}

TEST(Overlap, IsTheDeepestOfDiscsBatsPostsAndWalls) {
  const physics::Field field{.length = 4.0, .width = 2.0};
  const Outline disc{.radius = 0.1, .mass = 1.0},
      bat{.kind = BodyKind::bat, .half_extent = {0.1, 0.3}, .mass = 1.0},
      post{.kind = BodyKind::post, .radius = 0.1};
  const auto deepest = [&](std::vector<Outline> outlines, std::vector<Vector2> places) {
    return deepest_overlap(field, outlines, places);
  };
  EXPECT_EQ(deepest({disc, disc}, {{1.0, 1.0}, {1.25, 1.0}}), 0.0);
  EXPECT_NEAR(deepest({disc, disc, disc}, {{1.0, 1.0}, {1.15, 1.0}, {3.0, 1.0}}), 0.05, 1e-15);
  EXPECT_NEAR(deepest({disc, bat}, {{1.0, 1.0}, {1.17, 1.2}}), 0.03, 1e-15);  // on the bat's edge
  EXPECT_EQ(deepest({disc, bat}, {{1.0, 1.0}, {1.18, 1.38}}),
            0.0);  // past its corner, within its box
  EXPECT_NEAR(deepest({bat, bat}, {{1.0, 1.0}, {1.15, 1.5}}), 0.05, 1e-15);
  EXPECT_NEAR(deepest({disc, post}, {{1.0, 1.0}, {1.0, 1.19}}), 0.01, 1e-15);
  EXPECT_NEAR(deepest({disc}, {{0.04, 1.0}}), 0.06, 1e-15);
  EXPECT_EQ(deepest({post, post}, {{1.0, 1.0}, {1.05, 1.0}}),
            0.0);  // neither moves: the scene's own business
  EXPECT_EQ(deepest({disc, disc}, {{-1.0, 1.0}, {-1.0, 1.0}}), 0.0);  // both have escaped
  EXPECT_EQ(deepest({disc, disc}, {{NAN, 1.0}, {1.0, 1.0}}), 0.0);
}

}  // namespace
}  // namespace rink::peers
