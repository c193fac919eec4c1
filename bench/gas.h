// A gas of equal pucks, and what the benchmarks that play it share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "game/physics/world.h"
#include "tests/physics/collision_library/collision_library_cases.h"

namespace rink::bench::gas_scene {

/// The same scenes everywhere.
struct Seeded : rink::physics::collision::reference::Seeded {
  using rink::physics::collision::reference::Seeded::Seeded;
  /// Isotropic, mean 1 m/s.
  rink::physics::Vector2 velocity() {
    const double angle = uniform(0.0, 2.0 * std::numbers::pi),
                 speed = std::sqrt(-std::log1p(-uniform(0.0, 0.999))) * 2.0 /
                         std::sqrt(std::numbers::pi);
    return rink::physics::Vector2(std::cos(angle), std::sin(angle)) * speed;
  }
};

inline constexpr double radius = 0.04;  // m

inline double side_of(int count, double packing) {
  return std::sqrt(count * std::numbers::pi * radius * radius / packing);
}

/// Collisions per disc and second at mean speed 1 by Enskog's theory, for choosing how long to run.
inline double collision_rate(double packing) {
  const double density = packing / (std::numbers::pi * radius * radius),
               crowding = (1.0 - 7.0 / 16.0 * packing) / std::pow(1.0 - packing, 2);
  return std::sqrt(2.0) * 2.0 * radius * density * crowding;
}

/// One iteration [s]: 2,000 impacts or so, but long enough that it may be divided into windows.
inline double step_of(int count, double packing) {
  return std::max(4000.0 / count, 1.0) / collision_rate(packing);
}

/// `count` pucks on a square lattice that fills a square field at `packing`.
inline std::vector<rink::physics::PuckSpec> gas_pucks(int count, double packing) {
  Seeded seeded{1};
  const double side = side_of(count, packing);
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<rink::physics::PuckSpec> pucks(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    rink::physics::PuckSpec& puck = pucks[static_cast<std::size_t>(k)];
    puck.position = rink::physics::Vector2(k % columns + 0.5, k / columns + 0.5) * (side / columns);
    puck.velocity = seeded.velocity();
  }
  return pucks;
}

/// At time 0. `spec` but for the field.
inline rink::physics::World gas_at_start(
    int count, double packing, rink::physics::WorldSpec spec = rink::physics::WorldSpec()) {
  spec.field.length = spec.field.width = side_of(count, packing);
  rink::physics::World world(spec);
  for (const rink::physics::PuckSpec& puck : gas_pucks(count, packing)) world.add(puck);
  return world;
}

/// After four collisions of each puck.
inline rink::physics::World gas(int count, double packing,
                                rink::physics::WorldSpec spec = rink::physics::WorldSpec()) {
  rink::physics::World world = gas_at_start(count, packing, std::move(spec));
  world.advance(4.0 / collision_rate(packing));
  return world;
}

/// The last world that was asked for, kept between the runs in which a benchmark finds its number
/// of iterations: to make one of a million bodies takes seconds.
template <class Key, class Value, class Make>
Value& kept(const Key& key, Make&& make) {
  static std::unique_ptr<std::pair<Key, Value>> last;
  if (!last || last->first != key) {
    last.reset();
    last = std::make_unique<std::pair<Key, Value>>(key, make());
  }
  return last->second;
}

}  // namespace rink::bench::gas_scene
