// Each trial has one thing that stepping engines find hard, and no more.
#include "bench/trials/stability_trials.h"

#include "bench/trials/diagram_trials.h"
#include "game/model/random_stream.h"

namespace rink::accuracy {
namespace {

physics::WorldSpec rink_of(double length, double width, double restitution, double bat_drag = 0.0) {
  physics::WorldSpec spec;
  spec.field.length = length, spec.field.width = width;
  spec.restitution = physics::RestitutionTable(1, restitution);
  spec.bat_drag = bat_drag;
  return spec;
}

Trial fast() {
  Trial trial = gas(100, 0.05);
  trial.name = "fast", trial.about = "100 elastic discs of 200 m/s";
  for (physics::PuckSpec& puck : trial.pucks) puck.velocity = 200.0 * puck.velocity.normalized();
  trial.horizon = at_frame(60);
  return trial;
}

Trial dense() {
  Trial trial = gas(1000, 0.7);
  trial.name = "dense", trial.about = "1,000 elastic discs at packing 0.7";
  trial.horizon = at_frame(120);
  return trial;
}

Trial collapse() {
  Trial trial = gas(300, 0.4);
  trial.name = "collapse",
  trial.about = "300 discs at packing 0.4, restitution 0.1: inelastic collapse";
  trial.world.restitution = physics::RestitutionTable(1, 0.1);
  trial.horizon = at_frame(600);
  return trial;
}

/// A bat that pushes a puck into something from the left, for 5 s.
Trial pushed(const char* name, const char* about) {
  Trial trial{.name = name, .about = about, .world = rink_of(2.0, 1.0, 0.5, 1.0)};
  trial.bats.push_back({.position = {0.5, 0.5}, .half_extent = {0.04, 0.1}, .mass = 3.0});
  trial.pushes.push_back({0.0, 0, {10.0, 0.0}});
  trial.horizon = at_frame(300);
  return trial;
}

Trial post() {
  Trial trial = pushed("post", "a bat presses a puck onto a post, a hair off its middle");
  trial.posts.push_back({.position = {1.0, 0.5}, .radius = 0.05});
  trial.pucks.push_back({.position = {0.7, 0.5001}, .mass = 0.2});
  return trial;
}

Trial wedge() {
  Trial trial = pushed("wedge", "a bat squeezes two pucks against a post");
  trial.posts.push_back({.position = {1.0, 0.5}, .radius = 0.05});
  trial.pucks.push_back({.position = {0.7, 0.46}, .mass = 0.2});
  trial.pucks.push_back({.position = {0.7, 0.541}, .mass = 0.2});
  return trial;
}

Trial corner() {
  Trial trial{.name = "corner",
              .about = "two bats press eight pucks into a corner",
              .world = rink_of(1.0, 1.0, 0.3, 1.0)};
  for (int k = 0; k < 8; ++k)
    trial.pucks.push_back(
        {.position = {0.84 - 0.085 * (k % 3) + 0.02 * (k / 3), 0.84 - 0.085 * (k / 3)},
         .mass = 0.2});
  trial.bats.push_back({.position = {0.4, 0.8}, .half_extent = {0.04, 0.15}, .mass = 3.0});
  trial.bats.push_back({.position = {0.8, 0.4}, .half_extent = {0.15, 0.04}, .mass = 3.0});
  trial.pushes = {{0.0, 0, {8.0, 0.0}}, {0.0, 1, {0.0, 8.0}}};
  trial.horizon = at_frame(300);
  return trial;
}

/// Masses 1 and 10^6 in line with a wall: 3,141 impacts (Galperin 2003), a light disc of up to
/// 1,000 m/s in a gap that closes to a millimetre.
Trial mass_ratio() {
  Trial trial{.name = "mass-ratio",
              .about = "a disc of 1 kg between a wall and one of 10^6 kg: 3,141 impacts",
              .world = rink_of(8.0, 1.0, 1.0)};
  trial.pucks.push_back({.position = {1.0, 0.5}, .mass = 1.0});
  trial.pucks.push_back({.position = {2.0, 0.5}, .velocity = {-1.0, 0.0}, .mass = 1e6});
  trial.horizon = at_frame(180);
  return trial;
}

Trial cradle() {
  Trial trial{.name = "cradle",
              .about = "Newton's cradle without gaps, five elastic discs",
              .world = rink_of(4.0, 1.0, 1.0)};
  const double radius = 1.0 / 16.0;  // places and gaps without rounding
  trial.pucks.push_back({.position = {1.0, 0.5}, .velocity = {1.0, 0.0}, .radius = radius});
  for (int k = 0; k < 4; ++k)
    trial.pucks.push_back({.position = {1.5 + 2.0 * radius * k, 0.5}, .radius = radius});
  trial.horizon = at_frame(90);
  return trial;
}

/// Three pairs are one in the other by half to nine tenths of a radius when it begins.
Trial overlap() {
  Trial trial = gas(300, 0.1);
  trial.name = "overlap", trial.about = "300 elastic discs, three of which start inside others";
  trial.world.allow_overlap = true;
  const Vector2 middle(0.5 * trial.world.field.length, 0.5 * trial.world.field.width);
  for (std::size_t k = 0; k < 3; ++k) {
    const physics::PuckSpec& host = trial.pucks[100 * k];
    trial.pucks[100 * k + 50].position = host.position + (1.1 + 0.2 * static_cast<double>(k)) *
                                                             host.radius *
                                                             (middle - host.position).normalized();
  }
  trial.horizon = at_frame(300);
  return trial;
}

Trial crowd() {
  Trial trial;
  for (DiagramTrial& candidate : diagram_trials())
    if (candidate.trial.name == "bats") trial = std::move(candidate.trial);
  trial.name = "crowd",
  trial.about = "200 pucks, 20 bats under keys and 4 posts for 10 s, restitution 0.9";
  trial.horizon = at_frame(600);
  trial.pushes.clear();
  game::RandomStream random(3);
  for (int at = 0; at < 600; at += 6)
    for (std::uint32_t bat = 0; bat < trial.bats.size(); ++bat)
      trial.pushes.push_back({at_frame(at), bat,
                              8.0 * Vector2{static_cast<double>(random.below(3)) - 1.0,
                                            static_cast<double>(random.below(3)) - 1.0}});
  return trial;
}

}  // namespace

std::vector<Trial> stability_trials() {
  return {fast(),   dense(),      collapse(), post(),    wedge(),
          corner(), mass_ratio(), cradle(),   overlap(), crowd()};
}

}  // namespace rink::accuracy
