// Past and predicted places of everything on a rink, at instants a few milliseconds apart.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "game/physics/body.h"

namespace rink::game {

using physics::Vector2;

struct ShownBody {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  double time = 0.0;  ///< the simulated instant that is shown of it [s]
};

/// All places at one instant: bats, then pucks.
struct RinkSample {
  double time = 0.0;
  std::vector<Vector2> positions, velocities;
};

/// Samples in order of time, between which bodies are on chords.
class RinkTrack {
 public:
  bool is_empty() const { return samples_.empty(); }
  double end() const;  ///< time of the last sample [s]
  void add(RinkSample sample);
  /// Drops samples at `time` and later, which were predicted.
  void drop_from(double time);
  /// Drops samples that are not needed for `time` and later.
  void forget_before(double time);
  /// Before the first and after the last sample, the place there.
  ShownBody at(std::size_t body, double time) const;
  void check(std::size_t body_count) const;

 private:
  std::deque<RinkSample> samples_;
};

}  // namespace rink::game
