// Horizons are short enough that one impact's error has not grown a hundredfold, for after that no
// step is small enough (docs/accuracy.md, "Horizons").
#include "bench/trials/diagram_trials.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "game/model/random_stream.h"
#include "game/model/scene.h"
#include "game/physics/extended/extended_world.h"

namespace rink::accuracy {
namespace {

using Wide = long double;
using WideVector = Eigen::Matrix<Wide, 2, 1>;
using game::RandomStream;
using physics::BatSpec;
using physics::PostSpec;
using physics::PuckSpec;

constexpr std::size_t pair_rows = 6, pressed_count = 16;

void take_bodies(const game::Scene& scene, Trial& trial) {
  for (const game::Post& post : scene.bodies.posts) trial.posts.push_back(post.body);
  for (const game::Bat& bat : scene.bodies.bats) trial.bats.push_back(bat.body);
  for (const game::Puck& puck : scene.bodies.pucks) trial.pucks.push_back(puck.body);
}

/// Two pucks that would touch at `place` after `time`, moved back to the start.
void add_pair(Trial& trial, const Vector2& place, double time, RandomStream& random) {
  const double pi = std::numbers::pi;
  PuckSpec a, b;
  a.radius = random.uniform(0.03, 0.05), b.radius = random.uniform(0.03, 0.05);
  a.mass = random.uniform(0.5, 2.0), b.mass = random.uniform(0.5, 2.0);
  const double heading = random.uniform(0.0, 2.0 * pi),
               turn = std::asin(
                   random.uniform(-0.9, 0.9));  // grazing at up to nine tenths of the reach
  const Vector2 closing = random.uniform(1.0, 2.0) * Vector2(std::cos(heading), std::sin(heading));
  const Vector2 normal(std::cos(heading + turn), std::sin(heading + turn));
  const double drift = random.uniform(0.0, 0.5);
  a.velocity = closing + drift * random.direction(), b.velocity = a.velocity - closing;
  a.position = place - a.velocity * time;
  b.position = place + (a.radius + b.radius) * normal - b.velocity * time;
  trial.pucks.push_back(a), trial.pucks.push_back(b);
}

DiagramTrial pairs() {
  Trial trial{.name = "pairs",
              .about =
                  "36 pairs of discs, each alone in its part of the field: one oblique impact of "
                  "unequal elastic discs"};
  const double cell = 2.5;  // m; nobody gets to where the next pair is
  trial.world.field.length = trial.world.field.width = pair_rows * cell;
  trial.horizon = at_frame(30);
  RandomStream random(1);
  for (std::size_t k = 0; k < pair_rows * pair_rows; ++k)
    add_pair(trial,
             Vector2(static_cast<double>(k % pair_rows) + 0.5,
                     static_cast<double>(k / pair_rows) + 0.5) *
                 cell,
             random.uniform(0.1, 0.4), random);
  return {trial, 1e-3, "closed form", places_of_pairs};
}

DiagramTrial sparse_gas() {
  Trial trial = gas(1000, 0.05);
  trial.name = "gas";
  trial.about = "1,000 elastic discs of 1 m/s at packing 0.05";
  trial.horizon = at_frame(15);
  return {trial, 1e-3, "the exact engine in extended precision", places_in_extended_precision};
}

DiagramTrial dense_gas() {
  Trial trial = gas(1000, 0.5);
  trial.name = "dense";
  trial.about = "1,000 elastic discs of 1 m/s at packing 0.5";
  trial.horizon = at_frame(3);
  return {trial, 1e-3, "the exact engine in extended precision", places_in_extended_precision};
}

/// Here an event engine has most to do, and a stepping one no more than elsewhere.
DiagramTrial packed_gas() {
  Trial trial = gas(1000, 0.7);
  trial.name = "packed";
  trial.about = "1,000 elastic discs of 1 m/s at packing 0.7";
  trial.horizon = at_frame(3);
  return {trial, 1e-3, "the exact engine in extended precision", places_in_extended_precision};
}

/// Fast discs have thirty times the events of slow ones, and a stepper takes no more steps.
DiagramTrial fast_gas() {
  Trial trial = gas(1000, 0.05);
  trial.name = "fast";
  trial.about = "1,000 elastic discs of 30 m/s at packing 0.05";
  for (PuckSpec& puck : trial.pucks) puck.velocity *= 30.0;
  trial.horizon = at_frame(1);
  return {trial, 1e-3, "the exact engine in extended precision", places_in_extended_precision};
}

DiagramTrial drag() {
  Trial trial = gas(1000, 0.1);
  trial.name = "drag";
  trial.about = "1,000 discs at packing 0.1, restitution 0.9, drag 1/s";
  trial.world.puck_drag = 1.0;
  trial.world.restitution = physics::RestitutionTable(1, 0.9);
  trial.horizon = at_frame(15);
  return {trial, 1e-3, "without drag in warped time, in extended precision", places_by_warped_time};
}

/// Every bat gets a new one of nine thrusts each tenth of a second.
void add_pushes(Trial& trial, double thrust, RandomStream& random) {
  for (int at = 0; at_frame(at) < trial.horizon; at += 6)
    for (std::uint32_t bat = 0; bat < trial.bats.size(); ++bat) {
      const double x = static_cast<double>(random.below(3)) - 1.0,
                   y = static_cast<double>(random.below(3)) - 1.0;
      trial.pushes.push_back({at_frame(at), bat, thrust * Vector2(x, y)});
    }
}

DiagramTrial bats() {
  game::Scene scene;
  scene.world.field.length = 8.0, scene.world.field.width = 5.0;
  scene.populations = {{.kind = physics::BodyKind::post,
                        .name = "post",
                        .count = 4,
                        .radius_min = 0.1,
                        .radius_max = 0.1,
                        .team = {}},
                       {.kind = physics::BodyKind::bat,
                        .name = "bat",
                        .count = 20,
                        .half_extent = {0.04, 0.1},
                        .mass = 3.0,
                        .team = {}},
                       {.kind = physics::BodyKind::puck,
                        .name = "puck",
                        .count = 200,
                        .mass = 0.2,
                        .mean_speed = 1.0,
                        .speeds = game::SpeedDistribution::maxwell,
                        .team = {}}};
  game::populate(scene);
  Trial trial{
      .name = "bats",
      .about = "200 pucks, 20 bats under keys and 4 posts, restitution 0.9, drags 0.2/s and 1/s",
      .world = scene.world};
  trial.world.puck_drag = 0.2, trial.world.bat_drag = 1.0;
  trial.world.restitution = physics::RestitutionTable(1, 0.9);
  trial.horizon = at_frame(24);
  take_bodies(scene, trial);
  RandomStream random(2);
  add_pushes(trial, 6.0, random);
  return {trial, 1e-3, "the exact engine in extended precision", places_in_extended_precision};
}

DiagramTrial pressed() {
  Trial trial{.name = "pressed",
              .about = "16 bats that each press a puck onto a wall for 4 s, restitution 0.5"};
  trial.world.field.length = 0.5 * pressed_count, trial.world.field.width = 2.0;
  trial.world.puck_drag = 0.2, trial.world.bat_drag = 1.0;
  trial.world.restitution = physics::RestitutionTable(1, 0.5);
  trial.horizon = at_frame(240);
  for (std::size_t k = 0; k < pressed_count; ++k) {
    const double x = 0.5 * static_cast<double>(k) + 0.25;
    trial.pucks.push_back({.position = {x, 0.1 + 0.01 * static_cast<double>(k)}, .mass = 0.2});
    trial.bats.push_back({.position = {x, 0.5 + 0.02 * static_cast<double>(k)},
                          .half_extent = {0.1, 0.04},
                          .mass = 3.0});
    trial.pushes.push_back({0.0, static_cast<std::uint32_t>(k), {0.0, -6.0}});
  }
  return {trial, 1e-3, "closed form: all at rest against each other", places_of_pressed};
}

/// Both centres of a pair after `horizon`.
std::pair<Vector2, Vector2> places_of_pair(const PuckSpec& a, const PuckSpec& b, Wide horizon) {
  const WideVector offset = b.position.cast<Wide>() - a.position.cast<Wide>(),
                   velocity = b.velocity.cast<Wide>() - a.velocity.cast<Wide>();
  const Wide reach = Wide(a.radius) + Wide(b.radius), closing = -offset.dot(velocity),
             cross = offset.x() * velocity.y() - offset.y() * velocity.x();
  const Wide time = (offset.squaredNorm() - reach * reach) /
                    (closing + std::sqrt(velocity.squaredNorm() * reach * reach - cross * cross));
  assert(closing > 0 && time > 0 && time < horizon);
  const WideVector normal = (offset + velocity * time) / reach;
  const Wide impulse = -2 * velocity.dot(normal) / (1 / Wide(a.mass) + 1 / Wide(b.mass));
  const WideVector kick = impulse * normal * (horizon - time);
  const WideVector end_a =
      a.position.cast<Wide>() + a.velocity.cast<Wide>() * horizon - kick / Wide(a.mass);
  const WideVector end_b =
      b.position.cast<Wide>() + b.velocity.cast<Wide>() * horizon + kick / Wide(b.mass);
  return {end_a.cast<double>(), end_b.cast<double>()};
}

std::vector<Vector2> extended_places(const Trial& trial, long double horizon) {
  physics::ExtendedWorld world(trial.world);
  load(trial, world);
  Play play(trial, world);
  play.advance(horizon);
  std::vector<Vector2> places;
  for (std::size_t i = trial.first_mover(); i < trial.body_count(); ++i)
    places.push_back(world.position({static_cast<std::uint32_t>(i)}).cast<double>());
  return places;
}

}  // namespace

Trial gas(std::uint32_t count, double packing, std::uint64_t seed) {
  const double radius = 0.04,
               side = std::sqrt(count * std::numbers::pi * radius * radius / packing);
  game::Scene scene;
  scene.seed = seed;
  scene.world.field.length = scene.world.field.width = side;
  scene.populations = {{.name = "puck",
                        .count = count,
                        .radius_min = radius,
                        .radius_max = radius,
                        .mean_speed = 1.0,
                        .speeds = game::SpeedDistribution::maxwell,
                        .team = {}}};
  game::populate(scene);
  Trial trial{.name = "gas", .about = "", .world = scene.world};
  take_bodies(scene, trial);
  return trial;
}

bool Trial::is_conservative() const {
  return pushes.empty() && world.puck_drag == 0.0 && world.bat_drag == 0.0 &&
         world.restitution(0, 0) == 1.0;
}

std::vector<Vector2> places_of_pairs(const Trial& trial) {
  std::vector<Vector2> places;
  for (std::size_t k = 0; k + 1 < trial.pucks.size(); k += 2) {
    const auto [a, b] = places_of_pair(trial.pucks[k], trial.pucks[k + 1], trial.horizon);
    places.push_back(a), places.push_back(b);
  }
  return places;
}

std::vector<Vector2> places_of_pressed(const Trial& trial) {
  std::vector<Vector2> places;
  for (std::size_t k = 0; k < trial.bats.size(); ++k)
    places.emplace_back(trial.bats[k].position.x(),
                        2.0 * trial.pucks[k].radius + trial.bats[k].half_extent.y());
  for (const PuckSpec& puck : trial.pucks) places.emplace_back(puck.position.x(), puck.radius);
  return places;
}

std::vector<Vector2> places_in_extended_precision(const Trial& trial) {
  return extended_places(trial, trial.horizon);
}

std::vector<Vector2> places_by_warped_time(const Trial& trial) {
  assert(trial.bats.empty());
  Trial free = trial;
  free.world.puck_drag = 0.0;
  const Wide drag = trial.world.puck_drag;
  return extended_places(free, -std::expm1(-drag * Wide(trial.horizon)) / drag);
}

std::vector<DiagramTrial> diagram_trials() {
  return {pairs(), sparse_gas(), dense_gas(), packed_gas(), fast_gas(), drag(), bats(), pressed()};
}

}  // namespace rink::accuracy
