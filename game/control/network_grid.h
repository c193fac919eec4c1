// The instants at which a game puts bodies that have changed on a grid of places and speeds.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "game/physics/body.h"
#include "game/physics/change_log.h"
#include "game/physics/world.h"

namespace rink::game {

/// Instant k is k / rate, k from 1 up.
struct GridInstants {
  double rate_hz = 0.0;  ///< 0: there are none

  bool exist() const { return rate_hz > 0.0; }
  double at(std::uint64_t number) const { return static_cast<double>(number) / rate_hz; }
  /// The number of the one that is nearest to `time` [s], and of the last that is not after it.
  std::uint64_t nearest(double time) const {
    return static_cast<std::uint64_t>(std::llround(std::fmax(0.0, time * rate_hz)));
  }
  std::uint64_t last(double time) const {
    const std::uint64_t near = nearest(time);
    return near > 0 && at(near) > time ? near - 1 : near;
  }
  /// The instant that is within roundings of a clock of `time` [s], or else `time` itself.
  double snapped(double time) const {
    if (!exist()) return time;
    const double near = at(nearest(time));
    return std::abs(near - time) < 1e-9 ? near : time;
  }
};

/// Bodies are put on the grid after the motion of an instant and before its face-offs and inputs.
class NetworkGrid {
 public:
  /// `rate_hz` is that of Scene::network_grid.
  explicit NetworkGrid(double rate_hz) : instants_{rate_hz} {}

  const GridInstants& instants() const { return instants_; }
  /// The next one [s]; infinity if there is none.
  double next() const {
    return instants_.exist() ? instants_.at(done_ + 1) : std::numeric_limits<double>::infinity();
  }
  /// `world` has been played up to next().
  void round(physics::World& world);
  /// Bodies that had changed but have no room on the grid, since the last forget().
  std::span<const physics::BodyId> left_off() const { return left_off_; }
  void forget() { left_off_.clear(); }

  /// How many instants are over.
  std::uint64_t done() const { return done_; }
  void restart(std::uint64_t done) { done_ = done; }

 private:
  GridInstants instants_;
  std::uint64_t done_ = 0;
  physics::ChangeCursor cursor_;
  std::vector<physics::BodyId> changed_, left_off_;
};

}  // namespace rink::game
