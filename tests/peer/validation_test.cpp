// Liars: every field of what one peer sends another, wrong in each way that the receiver can see,
// is named and not taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "game/peer/session/session.h"
#include "game/peer/validation.h"
#include "game/physics/bodies/body_records.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t nobody = 4'000'000'000;
constexpr double now = 0.2;  // s: how far the scene has come

/// A scene with bats and pucks in the middle of a game, and what an honest peer says of it.
struct Honest {
  SharedScene scene = shared_scene(6, 0.2);
  Validator validator{scene.world};
  std::uint32_t bat = 0, puck = 0;
  Handover handover{.window = 3, .bodies = {}, .rest_contacts = {}, .keys = {}, .observations = {}};

  Honest() {
    scene.world.advance(now);
    for (std::uint32_t body = 0; body < scene.world.body_count(); ++body) {
      if (scene.world.kind({body}) == physics::BodyKind::bat) bat = body;
      if (scene.world.kind({body}) == physics::BodyKind::puck) puck = body;
      handover.bodies.push_back({body, physics::Subdomain::state_in(scene.world, body)});
    }
    // Rest contacts are made up so that every one that a body says it is in is there.
    for (const Handover::Body& body : handover.bodies)
      for (const int axis : {0, 1})
        if (physics::Subdomain::is_held_along(body.state, axis))
          handover.rest_contacts.push_back(
              {.low = physics::partner::wall_left, .high = body.number, .axis = axis, .age = {}});
    handover.rest_contacts.push_back(
        {.low = physics::partner::wall_left, .high = puck, .axis = 0, .age = {}});
    handover.free_flights.push_back(FreeFlightState::of(puck, handover.bodies[puck].state.flight));
    handover.keys.push_back({.time = 0.3, .bat = bat, .thrust = {1.0, 0.0}});
    const Vector2 place(0.3, 0.3);
    handover.observations.push_back(
        {.bat = bat,
         .owner = 1,
         .time = 0.2,
         .position = place,
         .pucks = {{.number = puck, .position = place, .radius = 0.04}}});
  }
  BodyState& state() { return handover.bodies[puck].state; }
};

TEST(Validator, FindsNoFaultInWhatIsHonest) {
  Honest honest;
  ASSERT_NE(honest.bat, honest.puck);
  EXPECT_EQ(honest.validator.fault_of(honest.handover, now), "");
  EXPECT_EQ(honest.validator.fault_of(Claims{.window = 1,
                                             .bodies = {{honest.puck, 1, true}},
                                             .flights = {{0.1, 7, 0.0f, 0.0f, 1.0f, 1.0f}},
                                             .presses = {{honest.bat, {1.0, 0.0}, 1}}},
                                      now),
            "");
  EXPECT_EQ(honest.validator.fault_of(Verdict{.window = 1, .goals = {{0.1, honest.puck, true}}}),
            "");
  Handover::Body scored = honest.handover.bodies[honest.puck];
  const FaceOffWord in_play{.puck = honest.puck, .taken = 3, .body = {scored}};
  EXPECT_THAT(honest.validator.fault_of(in_play, now), HasSubstr("in play"));
  scored.state.flags |= physics::Body::out_of_play;
  const FaceOffWord word{.puck = honest.puck, .taken = 3, .body = {scored}};
  EXPECT_EQ(honest.validator.fault_of(word, now), "");
  const PartChange part{.step = 1,
                        .time = 0.2,
                        .is_whole = true,
                        .bodies = honest.handover.bodies,
                        .gone = {honest.puck},
                        .rest_contacts = honest.handover.rest_contacts,
                        .keys = honest.handover.keys,
                        .log = {}};
  EXPECT_EQ(honest.validator.fault_of(part, now), "");
}

using Lie = std::function<void(Honest&)>;

/// Each number of a body's state that must be one, or within bounds.
std::vector<Lie> lies_about_numbers() {
  std::vector<Lie> lies;
  const auto each = [&](const std::function<double&(BodyState&)>& field,
                        std::initializer_list<double> wrong) {
    for (const double value : wrong)
      lies.push_back([=](Honest& honest) { field(honest.state()) = value; });
  };
  constexpr double inf = HUGE_VAL;
  each([](BodyState& s) -> double& { return s.flight.x; }, {nan, inf, -inf, 1e300, -1e9});
  each([](BodyState& s) -> double& { return s.flight.y; }, {nan, inf, -inf, 1e300, -1e9});
  each([](BodyState& s) -> double& { return s.flight.vx; }, {nan, inf, -inf, 1e300});
  each([](BodyState& s) -> double& { return s.flight.vy; }, {nan, inf, -inf, 1e300});
  each([](BodyState& s) -> double& { return s.flight.time; },
       {nan, inf, -inf, -1.0, now + 1e-9, 1e300});
  each([](BodyState& s) -> double& { return s.flight.radius; }, {nan, inf, -1.0, 0.0, 10.0});
  each([](BodyState& s) -> double& { return s.mass; }, {nan, inf, 0.0, -1.0, 77.0});
  each([](BodyState& s) -> double& { return s.inverse_mass; }, {nan, inf, -1.0, 77.0});
  each([](BodyState& s) -> double& { return s.half_extent.x(); }, {nan, inf, -1.0, 77.0});
  each([](BodyState& s) -> double& { return s.half_extent.y(); }, {nan, inf, -1.0, 77.0});
  each([](BodyState& s) -> double& { return s.thrust.x(); }, {nan, inf, 1e300, -1e300});
  each([](BodyState& s) -> double& { return s.thrust.y(); }, {nan, inf, 1e300, -1e300});
  each([](BodyState& s) -> double& { return s.acceleration.x(); }, {nan, inf, 1e300, -1e300});
  each([](BodyState& s) -> double& { return s.acceleration.y(); }, {nan, inf, 1e300, -1e300});
  each([](BodyState& s) -> double& { return s.drag.x(); }, {nan, inf, -0.1, 1e300});
  each([](BodyState& s) -> double& { return s.drag.y(); }, {nan, inf, -0.1, 1e300});
  each([](BodyState& s) -> double& { return s.impacts_begin; }, {nan, inf, now + 1e-9});
  each([](BodyState& s) -> double& { return s.last_hop; }, {nan, inf, now + 1e-9});
  each([](BodyState& s) -> double& { return s.repeats_instant; }, {nan, inf, now + 1e-9});
  each([](BodyState& s) -> double& { return s.rest_time; }, {nan});
  each([](BodyState& s) -> double& { return s.slowing.x(); }, {nan, inf, 1e300, -1e300});
  each([](BodyState& s) -> double& { return s.slowing.y(); }, {nan, inf, 1e300, -1e300});
  each([](BodyState& s) -> double& { return s.spin; }, {nan, inf, 1e300, -1e300});
  return lies;
}

std::vector<Lie> lies_about_kinds() {
  return {
      [](Honest& honest) { honest.state().kind = physics::BodyKind::bat; },
      [](Honest& honest) { honest.state().material = 200; },
      [](Honest& honest) { honest.state().half = physics::Half::left; },
      [](Honest& honest) { honest.state().flags |= physics::Body::removed; },
      [](Honest& honest) { honest.state().flags = 4; },
      [](Honest& honest) { honest.state().flags = 64; },
      [](Honest& honest) { honest.state().flags = 128; },
      [](Honest& honest) { honest.state().mouth = 3; },
      [](Honest& honest) { honest.state().flags = 32, honest.state().jam = nobody; },
      [](Honest& honest) { honest.state().flags = 8 | 16; },
      [](Honest& honest) { honest.handover.bodies[0].number = nobody; },
      [](Honest& honest) { honest.handover.bodies[0].number = honest.scene.world.body_count(); },
      [](Honest& honest) {
        std::swap(honest.handover.bodies[honest.bat].number,
                  honest.handover.bodies[honest.puck].number);
      }};
}

std::vector<Lie> lies_beside_bodies() {
  return {[](Honest& honest) { honest.handover.rest_contacts.back().low = nobody; },
          [](Honest& honest) { honest.handover.rest_contacts.back().high = nobody; },
          [](Honest& honest) {
            honest.handover.rest_contacts.back().high = physics::partner::wall_top;
          },
          [](Honest& honest) { honest.handover.rest_contacts.back().low = physics::partner::stop; },
          [](Honest& honest) {
            honest.handover.rest_contacts.back().low = honest.handover.rest_contacts.back().high;
          },
          [](Honest& honest) { honest.handover.rest_contacts.back().pull_time = nan; },
          [](Honest& honest) { honest.handover.rest_contacts.back().turn_time = nan; },
          [](Honest& honest) { honest.handover.rest_contacts.back().force = nan; },
          [](Honest& honest) { honest.handover.rest_contacts.back().force = -1e300; },
          [](Honest& honest) { honest.handover.rest_contacts.back().age.time = nan; },
          [](Honest& honest) { honest.handover.free_flights[0].number = nobody; },
          [](Honest& honest) { honest.handover.free_flights[0].position.x() = nan; },
          [](Honest& honest) { honest.handover.free_flights[0].velocity.y() = HUGE_VAL; },
          [](Honest& honest) { honest.handover.free_flights[0].time = nan; },
          [](Honest& honest) { honest.handover.free_flights[0].time = now + 1e-9; },
          // A fast one that hit nobody for so long is not where it says.
          [](Honest& honest) {
            honest.handover.free_flights[0].velocity = {1e6, 0.0},
            honest.handover.free_flights[0].time = 0.1;
          },
          [](Honest& honest) { honest.state().flight.vx = 1e6, honest.state().flight.time = 0.1; },
          [](Honest& honest) { honest.handover.keys[0].bat = nobody; },
          [](Honest& honest) { honest.handover.keys[0].bat = honest.puck; },
          [](Honest& honest) { honest.handover.keys[0].thrust.x() = nan; },
          [](Honest& honest) { honest.handover.keys[0].thrust.y() = 1e300; },
          [](Honest& honest) { honest.handover.keys[0].time = nan; },
          [](Honest& honest) { honest.handover.observations[0].bat = nobody; },
          [](Honest& honest) { honest.handover.observations[0].position.x() = nan; },
          [](Honest& honest) { honest.handover.observations[0].velocity.x() = nan; },
          [](Honest& honest) { honest.handover.observations[0].time = nan; },
          [](Honest& honest) { honest.handover.observations[0].pucks[0].number = nobody; },
          [](Honest& honest) { honest.handover.observations[0].pucks[0].radius = -1.0; }};
}

void expect_seen(const std::vector<Lie>& lies) {
  for (std::size_t k = 0; k < lies.size(); ++k) {
    Honest honest;
    lies[k](honest);
    EXPECT_NE(honest.validator.fault_of(honest.handover, now), "") << "lie " << k;
  }
}

TEST(Validator, SeesEachNumberOfABodyThatCannotBe) { expect_seen(lies_about_numbers()); }
TEST(Validator, SeesEachConstantOfABodyThatIsNotTheScenes) { expect_seen(lies_about_kinds()); }
TEST(Validator, SeesContactsFlightsKeysAndGlimpsesThatCannotBe) {
  expect_seen(lies_beside_bodies());
}

TEST(Validator, SeesClaimsVerdictsPartsAndFaceOffsThatCannotBe) {
  Honest honest;
  const Validator& validator = honest.validator;
  EXPECT_THAT(
      validator.fault_of(
          Claims{.window = 1, .bodies = {{nobody, 0, false}}, .flights = {}, .presses = {}}, now),
      HasSubstr("4000000000"));
  for (const ClaimedFlight& flight : {ClaimedFlight{nan, 0, 0.0f, 0.0f, 1.0f, 1.0f},
                                      ClaimedFlight{0.1, 0, std::nanf(""), 0.0f, 1.0f, 1.0f},
                                      ClaimedFlight{0.1, 0, 0.0f, 2.0f, 1.0f, 1.0f},
                                      ClaimedFlight{now + 0.01, 0, 0.0f, 0.0f, 1.0f, 1.0f},
                                      ClaimedFlight{-1.0, 0, 0.0f, 0.0f, 1.0f, 1.0f}})
    EXPECT_NE(validator.fault_of(Claims{.window = 1,
                                        .bodies = {{honest.puck, 1, true}},
                                        .flights = {flight},
                                        .presses = {}},
                                 now),
              "");
  for (const std::uint32_t bat : {nobody, honest.puck})
    EXPECT_NE(
        validator.fault_of(
            Claims{.window = 1, .bodies = {}, .flights = {}, .presses = {{bat, {1.0, 0.0}, 1}}},
            now),
        "");
  EXPECT_NE(
      validator.fault_of(
          Claims{
              .window = 1, .bodies = {}, .flights = {}, .presses = {{honest.bat, {1e300, 0.0}, 1}}},
          now),
      "");
  for (const std::uint32_t puck : {nobody, honest.bat})
    EXPECT_NE(validator.fault_of(Verdict{.window = 1, .goals = {{0.1, puck, true}}}), "");
  EXPECT_EQ(validator.fault_of(Verdict{.window = 1, .wanted = {honest.puck}}), "");
  EXPECT_EQ(validator.fault_of(Verdict{.window = 1, .wanted = {honest.puck, nobody}}),
            "asks for body " + std::to_string(nobody) + " which does not exist");
  EXPECT_NE(validator.fault_of(FaceOffWord{.puck = nobody, .taken = 0, .body = {}}, now), "");
  Handover::Body lie = honest.handover.bodies[honest.puck];
  lie.state.flight.vx = nan;
  EXPECT_NE(validator.fault_of(FaceOffWord{.puck = honest.puck, .taken = 0, .body = {lie}}, now),
            "");
  PartChange part{.step = 1,
                  .time = 0.2,
                  .is_whole = true,
                  .bodies = {lie},
                  .gone = {},
                  .rest_contacts = {},
                  .keys = {},
                  .log = {}};
  EXPECT_NE(validator.fault_of(part, now), "");
  part.bodies.clear(), part.gone = {nobody};
  EXPECT_NE(validator.fault_of(part, now), "");
  part.gone.clear();
  for (const double wrong : {nan, now + 0.01}) {
    part.time = wrong, part.bodies.clear();
    EXPECT_NE(validator.fault_of(part, now), "");
  }
  part.time = now;
  EXPECT_EQ(validator.fault_of(part, now), "");
  lie.state.flight.vx = 0.0, lie.state.flags = 8, part.bodies = {lie}, part.rest_contacts.clear();
  EXPECT_THAT(validator.fault_of(part, now), HasSubstr("in a rest contact that it does not send"));
  for (const double wrong : {nan, -0.1, now + 0.01})
    EXPECT_NE(validator.fault_of_log({{.time = wrong, .bat = honest.bat}}, now), "");
  for (const double right : {0.0, now})
    EXPECT_EQ(validator.fault_of_log({{.time = right, .bat = honest.bat}}, now), "");
}

TEST(Validator, SeesLossesThatNobodyTells) {
  const Honest honest;
  EXPECT_EQ(honest.validator.fault_of(Loss{.step = 1, .gone = {0, 2}, .finished = {2}}), "");
  for (const std::vector<PeerNumber>& gone :
       {std::vector<PeerNumber>{2, 0}, {1, 1}, {numbers_max}}) {
    EXPECT_NE(honest.validator.fault_of(Loss{.step = 1, .gone = gone}), "");
    EXPECT_NE(honest.validator.fault_of(Loss{.step = 1, .gone = {}, .finished = gone}), "");
  }
}

/// Two halves of a gas up to where the right one's peer hands over what is near the border.
struct HandOver {
  SharedScene scene = shared_scene(0, 1.0);
  Division division = Division::into_strips(scene.world.spec().field, 2);
  Peer left{scene.world.spec(), division, 0, scene.world.body_count(), 0.3},
      right{scene.world.spec(), division, 1, scene.world.body_count(), 0.3};
  Handover handover;

  HandOver() {
    for (Peer* peer : {&left, &right}) {
      peer->validate_by(Validator(scene.world));
      for (std::uint32_t body = 0; body < scene.world.body_count(); ++body)
        peer->consider(body, physics::Subdomain::state_in(scene.world, body));
      peer->begin(0.01);
      peer->play();
    }
    left.receive(1, right.claims_for(0)), right.receive(0, left.claims_for(1));
    left.receive(1, right.judge()), right.receive(0, left.judge());
    EXPECT_EQ(left.conclude(), Outcome::final);
    EXPECT_EQ(right.conclude(), Outcome::final);
    handover = right.handover_for(0, 0.02);
    handover.bodies.push_back({right.owned().front(), right.share().state(right.owned().front())});
  }
  /// The left peer hears it, names the right one, takes nothing of it, and can go on.
  void expect_named(const char* fault) {
    left.receive(1, handover);
    EXPECT_THAT(left.accusation().text(), StartsWith("peer 1 "));
    EXPECT_THAT(left.accusation().text(), HasSubstr(fault));
    left.commit(0.02);
    left.play();
    for (const std::uint32_t body : left.owned())
      EXPECT_TRUE(std::isfinite(left.share().state(body).flight.vx));
  }
};

TEST(Peer, NamesWhoHandsOverARestContactOfBodiesThatDoNotExist) {
  HandOver scene;
  scene.handover.rest_contacts.push_back({.low = nobody, .high = nobody + 1, .axis = 0, .age = {}});
  scene.expect_named("rest contact of body 4000000000");
}

TEST(Peer, NamesWhoHandsOverAVelocityThatIsNoNumber) {
  HandOver scene;
  scene.handover.bodies.back().state.flight.vx = nan;
  scene.expect_named("at no place, speed or time");
}

TEST(Peer, NamesWhoHandsOverABodyHeavierThanTheScenes) {
  HandOver scene;
  scene.handover.bodies.back().state.mass *= 2.0;
  scene.expect_named("that the scene does not give it");
}

}  // namespace
}  // namespace rink::peer::test
