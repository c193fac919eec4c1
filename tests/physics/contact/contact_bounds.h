// What holds of every world however hard it is pressed: overlap, events, and energy against the
// work of thrust.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "game/physics/world.h"

namespace rink::physics::test {

/// Drives a world through its bats and checks the bounds of docs/physics.md, "Degenerate contact",
/// at every look.
class Watch {
 public:
  Watch(World& world, std::vector<BodyId> bats)
      : world_(world), bats_(std::move(bats)), energy_max_(world.kinetic_energy()) {
    for (const BodyId bat : bats_) from_.push_back(world.position(bat));
  }

  void set_thrust(BodyId bat, const Vector2& acceleration) {
    count_work();
    world_.set_thrust(bat, acceleration);
  }

  /// Advances by `duration` [s] and looks every `interval` [s], and at the end.
  void run(double duration, double interval = 0.1) {
    for (const double end = world_.now() + duration; world_.now() < end;) {
      const double begin = world_.now();
      const std::uint64_t before = world_.counters().events();
      world_.advance(std::min(end, begin + interval));
      count_work();
      const double energy = world_.kinetic_energy();
      ASSERT_LE(energy, energy_max_ + world_.counters().hop_energy + 1e-9 * (energy + energy_max_))
          << begin;
      ASSERT_LE(world_.max_overlap(), 1e-9) << begin;
      ASSERT_LE(world_.counters().events_at_once_max, 200u) << begin;
      ASSERT_LE(static_cast<double>(world_.counters().events() - before),
                20.0 + 1e4 * interval * world_.body_count())
          << begin;
    }
  }

  /// Physical events that the next `duration` [s] has.
  std::uint64_t events_in(double duration) {
    const std::uint64_t before = world_.counters().events();
    run(duration, duration);
    return world_.counters().events() - before;
  }

 private:
  /// Thrust is constant between two calls, so that its work is the thrust's force times the way.
  void count_work() {
    for (std::size_t i = 0; i < bats_.size(); ++i) {
      const Vector2 here = world_.position(bats_[i]);
      energy_max_ += world_.mass(bats_[i]) * world_.thrust(bats_[i]).dot(here - from_[i]);
      from_[i] = here;
    }
  }

  World& world_;
  std::vector<BodyId> bats_;
  std::vector<Vector2> from_;
  double energy_max_;  // what the bodies had at first, and the work of thrust since [J]
};

}  // namespace rink::physics::test
