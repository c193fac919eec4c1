// Seeded scenes that the physics tests share.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "game/physics/world.h"

namespace rink::physics::test {

/// Uniform in [low, high); the same on every standard library.
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

inline WorldSpec rink_of(double length, double width, double restitution = 1.0,
                         double puck_drag = 0.0, double bat_drag = 0.0) {
  WorldSpec spec;
  spec.field.length = length;
  spec.field.width = width;
  spec.restitution = RestitutionTable(1, restitution);
  spec.puck_drag = puck_drag;
  spec.bat_drag = bat_drag;
  return spec;
}

/// `count` pucks of radius 0.04 at free random places, speeds up to 2 m/s.
inline std::vector<BodyId> scatter_pucks(World& world, std::mt19937_64& random, int count,
                                         double mass_low = 1.0, double mass_high = 1.0) {
  std::vector<BodyId> pucks;
  for (int tries = 0; static_cast<int>(pucks.size()) < count && tries < 1000 * count; ++tries) {
    PuckSpec puck;
    puck.position = {uniform(random, 0.04, world.spec().field.length - 0.04),
                     uniform(random, 0.04, world.spec().field.width - 0.04)};
    const double angle = uniform(random, 0.0, 6.283185307179586), speed = uniform(random, 0.0, 2.0);
    puck.velocity = {speed * std::cos(angle), speed * std::sin(angle)};
    puck.mass = mass_low * std::pow(mass_high / mass_low, uniform(random, 0.0, 1.0));
    if (world.is_free(puck.position, puck.radius)) pucks.push_back(world.add(puck));
  }
  return pucks;
}

inline std::vector<BodyId> scatter_bats(World& world, std::mt19937_64& random, int count,
                                        double mass = 3.0) {
  std::vector<BodyId> bats;
  for (int tries = 0; static_cast<int>(bats.size()) < count && tries < 1000 * count; ++tries) {
    BatSpec bat;
    bat.half_extent = {uniform(random, 0.03, 0.06), uniform(random, 0.06, 0.12)};
    bat.position = {uniform(random, 0.12, world.spec().field.length - 0.12),
                    uniform(random, 0.12, world.spec().field.width - 0.12)};
    bat.mass = mass;
    if (world.is_free(bat.position, bat.half_extent)) bats.push_back(world.add(bat));
  }
  return bats;
}

inline std::vector<BodyId> scatter_posts(World& world, std::mt19937_64& random, int count) {
  std::vector<BodyId> posts;
  for (int tries = 0; static_cast<int>(posts.size()) < count && tries < 1000 * count; ++tries) {
    PostSpec post;
    post.radius = uniform(random, 0.02, 0.1);
    post.position = {uniform(random, 0.1, world.spec().field.length - 0.1),
                     uniform(random, 0.1, world.spec().field.width - 0.1)};
    if (world.is_free(post.position, post.radius)) posts.push_back(world.add(post));
  }
  return posts;
}

/// Holds random keys: thrust of 6 m/s^2 along none, one or both axes, drawn anew for one bat at a
/// time.
struct RandomKeys {
  std::mt19937_64 random;
  double interval;
  double next = 0.0;
  std::uint64_t pressed = 0;

  /// Advances to `until`, changing keys at their exact times; goals are put back when `place_back`
  /// is free.
  template <class AtKey>
  void play(World& world, const std::vector<BodyId>& bats, double until, AtKey&& at_key) {
    while (next <= until) {
      advance(world, next);
      const BodyId bat = bats[random() % bats.size()];
      const double x = static_cast<double>(random() % 3) - 1.0,
                   y = static_cast<double>(random() % 3) - 1.0;
      world.set_thrust(bat, {6.0 * x, 6.0 * y});
      ++pressed;
      at_key();
      next += uniform(random, 0.0, 2.0 * interval);
    }
    advance(world, until);
  }
  void play(World& world, const std::vector<BodyId>& bats, double until) {
    play(world, bats, until, [] {});
  }
  static void advance(World& world, double until) {
    while (world.advance(until)) {
    }
  }
};

}  // namespace rink::physics::test
