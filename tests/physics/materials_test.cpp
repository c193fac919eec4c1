// Which pair of materials decides an impact: every kind of body against every kind of partner, by
// Newton's law along the normal and Walton's along the surfaces, where no two pairs are alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "game/physics/simulator_choice.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

enum Material : MaterialId {
  of_wall,
  of_puck,
  of_other_puck,
  of_bat,
  of_other_bat,
  of_post,
  material_count
};

/// A number of its own for each pair, whichever of the two is named first.
double pair_number(MaterialId a, MaterialId b) {
  const int low = std::min(a, b), high = std::max(a, b);
  return high * (high + 1) / 2 + low;  // 0 to 20
}
double restitution_of(MaterialId a, MaterialId b) { return 0.05 + 0.04 * pair_number(a, b); }
double friction_of(MaterialId a, MaterialId b) { return 0.01 + 0.005 * pair_number(a, b); }
double sticking_of(MaterialId a, MaterialId b) { return 0.95 - 0.04 * pair_number(a, b); }

enum class Surfaces { smooth, sliding, sticking };

/// A field of 4 x 4 m with goals, whose table of materials has no two equal entries.
WorldSpec field_of_many_materials(Surfaces surfaces) {
  WorldSpec spec = rink_of(4, 4);
  spec.field.goal_width = 0.5;
  spec.field.wall = of_wall;
  spec.field.bats_keep_to_half = true;
  spec.restitution = RestitutionTable(material_count);
  SurfaceFriction friction{PairTable(material_count), RestitutionTable(material_count)};
  for (MaterialId a = 0; a < material_count; ++a)
    for (MaterialId b = 0; b <= a; ++b) {
      spec.restitution.set(a, b, restitution_of(a, b));
      const double is_sticking = surfaces == Surfaces::sticking ? 1.0 : 0.0;
      friction.coefficient.set(a, b, friction_of(a, b) + 100.0 * is_sticking);
      friction.tangential_restitution.set(a, b, sticking_of(a, b));
    }
  if (surfaces != Surfaces::smooth) spec.surface_friction = friction;
  return spec;
}

constexpr double disc = 0.0625, spin = -20.0;

PuckSpec disc_of(Material material, const Vector2& position, const Vector2& velocity) {
  PuckSpec puck{.position = position, .velocity = velocity, .radius = disc, .mass = 0.5};
  puck.material = material;
  puck.spin = spin;
  return puck;
}
BatSpec square_of(Material material, const Vector2& position, const Vector2& velocity) {
  BatSpec bat{.position = position, .velocity = velocity, .half_extent = {disc, disc}};
  bat.mass = 2.0;
  bat.material = material;
  bat.half = Half::left;
  return bat;
}

/// One body that flies at a partner. The normal points from the partner to the body.
struct Encounter {
  std::string name;
  Material material, partner_material;
  bool is_bat = false;
  Vector2 place{1.0, 2.5}, normal{-1.0, 0.0};
  enum class Partner { field, post, puck, bat } partner = Partner::field;
  Vector2 partner_place{1.5, 2.5};
};

std::vector<Encounter> all_encounters() {
  using P = Encounter::Partner;
  const Vector2 before(1.0, 2.5), towards(-1.0, 0.0);
  std::vector<Encounter> all;
  for (const bool is_bat : {false, true}) {
    const std::string who = is_bat ? "bat at " : "puck at ";
    const Material own = is_bat ? of_bat : of_puck, puck = is_bat ? of_puck : of_other_puck;
    const Material bat = is_bat ? of_other_bat : of_bat;
    all.push_back({who + "the left wall", own, of_wall, is_bat, {0.5, 3.0}, {1.0, 0.0}});
    if (!is_bat)
      all.push_back({who + "the right wall", own, of_wall, is_bat, {3.5, 3.0}, {-1.0, 0.0}});
    all.push_back({who + "the bottom wall", own, of_wall, is_bat, {1.0, 0.5}, {0.0, 1.0}});
    all.push_back({who + "the top wall", own, of_wall, is_bat, {1.0, 3.5}, {0.0, -1.0}});
    all.push_back({who + "a post", own, of_post, is_bat, before, towards, P::post});
    all.push_back({who + "a puck", own, puck, is_bat, before, towards, P::puck});
    all.push_back({who + "a bat", own, bat, is_bat, before, towards, P::bat});
  }
  all.push_back({"bat at the halfway line", of_bat, of_wall, true, {1.5, 2.5}, {-1.0, 0.0}});
  for (const double end : {0.0, 4.0})
    for (const double side : {-1.0, 1.0}) {
      // The way to the edge of the goal, along the normal itself.
      const Vector2 edge(end, 2.0 + 0.25 * side), normal(end == 0.0 ? 0.6 : -0.6, -0.8 * side);
      const Vector2 start = edge + 0.5 * normal;
      all.push_back({"puck at the edge of a goal", of_puck, of_wall, false, start, normal});
    }
  return all;
}

/// What is left of an impact in which `body` comes at 1 m/s along the normal and 0.25 m/s across
/// it.
void expect_laws_of_the_pair(const Encounter& encounter, Surfaces surfaces, bool is_partner_first) {
  SCOPED_TRACE(encounter.name + (is_partner_first ? ", the partner added first" : ""));
  using P = Encounter::Partner;
  World world(field_of_many_materials(surfaces));
  const Vector2 normal = encounter.normal, tangent(-normal.y(), normal.x());
  const Vector2 before = -normal + 0.25 * tangent;
  // Across, the body starts beside its way, so that it arrives straight before its partner.
  const bool is_edge = normal.x() != 0.0 && normal.y() != 0.0;
  const double wait = encounter.partner != P::field ? 0.5 - 2.0 * disc : is_edge ? 0.5 - disc : 0.0;
  const Vector2 start = encounter.place - 0.25 * wait * tangent;
  BodyId body, partner;
  const auto add_body = [&] {
    if (encounter.is_bat) body = world.add(square_of(encounter.material, start, before));
    else body = world.add(disc_of(encounter.material, start, before));
  };
  const auto add_partner = [&] {
    const Material material = encounter.partner_material;
    const Vector2 place = encounter.partner_place;
    if (encounter.partner == P::post) partner = world.add(PostSpec{place, disc, material});
    if (encounter.partner == P::puck) partner = world.add(disc_of(material, place, {0.0, 0.0}));
    if (encounter.partner == P::bat) partner = world.add(square_of(material, place, {0.0, 0.0}));
  };
  if (is_partner_first) add_partner(), add_body();
  else add_body(), add_partner();
  ASSERT_FALSE(world.advance(0.45));
  ASSERT_EQ(world.counters().impacts(), 1u);

  const bool is_moved = encounter.partner == P::puck || encounter.partner == P::bat;
  const bool rolls = !encounter.is_bat && surfaces != Surfaces::smooth;
  const bool partner_rolls = encounter.partner == P::puck && surfaces != Surfaces::smooth;
  const double yielding = encounter.is_bat ? 0.5 : 2.0;
  const double partner_yielding = encounter.partner == P::puck ? 2.0 : is_moved ? 0.5 : 0.0;
  const MaterialId own = encounter.material, other = encounter.partner_material;
  const double push = (1.0 + restitution_of(own, other)) / (yielding + partner_yielding);
  double rub = 0.0;
  if (surfaces != Surfaces::smooth) {
    const double slip = 0.25 - spin * disc * (rolls + partner_rolls);
    const double rims =
        (rolls ? 3.0 : 1.0) * yielding + (partner_rolls ? 3.0 : 1.0) * partner_yielding;
    const double stick = (1.0 + sticking_of(own, other)) * std::abs(slip) / rims;
    const double slide = friction_of(own, other) * push;
    if (surfaces == Surfaces::sliding) {
      ASSERT_LT(slide, stick);
    }
    rub = -std::copysign(surfaces == Surfaces::sticking ? stick : slide, slip);
  }
  const Vector2 impulse = push * normal + rub * tangent;
  EXPECT_NEAR((world.velocity(body) - (before + yielding * impulse)).norm(), 0.0, 1e-13);
  EXPECT_NEAR(world.spin(body), rolls ? spin - 2.0 * yielding * rub / disc : 0.0, 1e-11);
  if (!is_moved) return;
  EXPECT_NEAR((world.velocity(partner) + partner_yielding * impulse).norm(), 0.0, 1e-13);
  const double partner_spin = partner_rolls ? spin - 2.0 * partner_yielding * rub / disc : 0.0;
  EXPECT_NEAR(world.spin(partner), partner_spin, 1e-11);
}

void expect_laws_of_every_pair(Surfaces surfaces) {
  for (const Encounter& encounter : all_encounters())
    for (const bool is_partner_first : {false, true})
      expect_laws_of_the_pair(encounter, surfaces, is_partner_first);
}

TEST(Materials, OfBothPartnersDecideWhatAnImpactGivesBack) {
  expect_laws_of_every_pair(Surfaces::smooth);
}
TEST(Materials, OfBothPartnersDecideHowTheirSurfacesSlide) {
  expect_laws_of_every_pair(Surfaces::sliding);
}
TEST(Materials, OfBothPartnersDecideHowTheirSurfacesStick) {
  expect_laws_of_every_pair(Surfaces::sticking);
}

/// Two pucks that lose nothing take a shorter way through the engine. It is theirs by their pair,
/// not by either one's own material.
TEST(Materials, ThatLoseNothingAmongThemselvesLoseWithOneAnother) {
  for (const double with_each_other : {0.5, 1.0}) {
    WorldSpec spec = rink_of(4, 4);
    spec.restitution = RestitutionTable(2, with_each_other == 1.0 ? 0.5 : 1.0);
    spec.restitution.set(0, 1, with_each_other);
    World world(spec);
    // The line of centres is (0.8, 0.6) of 2 radii when they meet.
    const Vector2 normal(0.8, 0.6);
    const BodyId a = world.add(
        PuckSpec{.position = {1.0, 1.0}, .velocity = {1.0, 0.0}, .radius = disc, .material = 0});
    const Vector2 place = Vector2(1.5, 1.0) + 2.0 * disc * normal;
    world.add(PuckSpec{.position = place, .radius = disc, .material = 1});
    world.advance(0.6);
    EXPECT_EQ(world.counters().disc_impacts, 1u);
    const Vector2 expected = Vector2(1.0, 0.0) - 0.5 * (1.0 + with_each_other) * 0.8 * normal;
    EXPECT_NEAR((world.velocity(a) - expected).norm(), 0.0, 1e-13);
  }
}

/// One ball hits two at once, either at 30 degrees to its way: u' = -e u for both, where
/// u' = u + G p and G = (2, 1/2; 1/2, 2).
TEST(Materials, OfEachContactCountInAnImpactOfThreeAtOnce) {
  constexpr double radius = 0.03125, first = 0.25, second = 0.75;
  WorldSpec spec = rink_of(4, 2);
  spec.restitution = RestitutionTable(3, 0.0);
  spec.restitution.set(0, 1, first);
  spec.restitution.set(0, 2, second);
  World world(spec);
  const auto add = [&](const Vector2& position, const Vector2& velocity, MaterialId material) {
    PuckSpec puck{.position = position, .velocity = velocity, .radius = radius};
    puck.material = material;
    return world.add(puck);
  };
  const BodyId cue = add({0.5, 1.0}, {1.0, 0.0}, 0);
  const BodyId above = add({1.0, 1.0 + radius}, {0.0, 0.0}, 1);
  const BodyId below = add({1.0, 1.0 - radius}, {0.0, 0.0}, 2);
  world.advance(0.75);
  ASSERT_EQ(world.counters().joint_impacts, 1u);
  const double closing = std::sqrt(0.75), a = (1.0 + first) * closing, b = (1.0 + second) * closing;
  const double p = (2.0 * a - 0.5 * b) / 3.75, q = (2.0 * b - 0.5 * a) / 3.75;
  const Vector2 up(closing, 0.5), down(closing, -0.5);
  EXPECT_NEAR((world.velocity(above) - p * up).norm(), 0.0, 1e-13);
  EXPECT_NEAR((world.velocity(below) - q * down).norm(), 0.0, 1e-13);
  EXPECT_NEAR((world.velocity(cue) - (Vector2(1.0, 0.0) - p * up - q * down)).norm(), 0.0, 1e-13);
}

/// The engines that step take the pair's restitution as well; what an impact leaves does not depend
/// on the frame in which it is found.
TEST(Materials, OfBothPartnersCountInTheEnginesThatStepToo) {
  const WorldSpec spec = field_of_many_materials(Surfaces::smooth);
  constexpr double frame = 1.0 / 256.0;
  for (const std::string engine : {"exact", "paper", "naive"}) {
    const auto speed_after_impact = [&](Material own, double speed, const auto& add_partner) {
      const auto simulator = make_simulator(spec, {.engine = engine, .dt = frame});
      const BodyId body = simulator->add(disc_of(own, {1.0, 3.0}, {speed, 0.0}));
      add_partner(*simulator);
      for (int step = 1; step <= 256; ++step) simulator->advance(step * frame);
      EXPECT_EQ(simulator->counters().impacts(), 1u);
      return simulator->velocity(body).x();
    };
    for (const Material own : {of_puck, of_other_puck}) {
      SCOPED_TRACE(testing::Message() << engine << ", material " << int{own});
      const auto nobody = [](Simulator&) {};
      const auto post = [](Simulator& simulator) {
        simulator.add(PostSpec{{1.5, 3.0}, disc, of_post});
      };
      const auto bat = [](Simulator& simulator) {
        simulator.add(square_of(of_bat, {1.5, 3.0}, {0.0, 0.0}));
      };
      EXPECT_NEAR(speed_after_impact(own, -1.0, nobody), restitution_of(own, of_wall), 1e-13);
      EXPECT_NEAR(speed_after_impact(own, 1.0, post), -restitution_of(own, of_post), 1e-13);
      const double push = (1.0 + restitution_of(own, of_bat)) / (2.0 + 0.5);
      EXPECT_NEAR(speed_after_impact(own, 1.0, bat), 1.0 - 2.0 * push, 1e-13);
    }
  }
}

}  // namespace
}  // namespace rink::physics::test
