// What is put into a world and done to it, so that every engine can be given the same.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "game/physics/body.h"

namespace rink::accuracy {

using physics::Vector2;

/// A stepping engine's longest frame [s]. Pushes and horizons lie on whole frames of it, so that
/// each shorter step, a half of the one before, can hit them too.
inline constexpr double frame = 1.0 / 60.0;

/// From `time` [s] on bat number `bat` accelerates by `acceleration` [m/s^2].
struct Push {
  double time = 0.0;
  std::uint32_t bat = 0;
  Vector2 acceleration{0.0, 0.0};
};

struct Trial {
  std::string name{};   ///< for --scenes
  std::string about{};  ///< in a clause: what is in it
  physics::WorldSpec world = physics::WorldSpec();
  std::vector<physics::PostSpec> posts{};
  std::vector<physics::BatSpec> bats{};
  std::vector<physics::PuckSpec> pucks{};
  std::vector<Push> pushes{};  ///< ordered by time
  double horizon = frame;      ///< when it is over [s]

  std::size_t body_count() const { return posts.size() + bats.size() + pucks.size(); }
  /// Bodies are added in the order posts, bats, pucks; those from here on move.
  std::size_t first_mover() const { return posts.size(); }
  /// Nothing but elastic impacts: energy stays.
  bool is_conservative() const;
};

/// `frames` frames in seconds, as every engine is told: rounded once.
inline double at_frame(int frames) {
  assert(frames >= 0);
  return frames / 60.0;
}

template <class World>
void load(const Trial& trial, World& world) {
  for (const physics::PostSpec& post : trial.posts) world.add(post);
  for (const physics::BatSpec& bat : trial.bats) world.add(bat);
  for (const physics::PuckSpec& puck : trial.pucks) world.add(puck);
}

/// Plays a trial's pushes into a world that holds its bodies.
template <class World>
class Play {
 public:
  Play(const Trial& trial, World& world) : trial_(trial), world_(world) {}

  /// `Time` is the world's own: double, or wider.
  template <class Time>
  void advance(Time until) {
    for (; next_ < trial_.pushes.size() && trial_.pushes[next_].time < until; ++next_) {
      const Push& push = trial_.pushes[next_];
      assert(push.bat < trial_.bats.size());
      assert(next_ == 0 || trial_.pushes[next_ - 1].time <= push.time);  // they are in order
      world_.advance(push.time);
      world_.set_thrust({static_cast<std::uint32_t>(trial_.posts.size()) + push.bat},
                        push.acceleration);
    }
    world_.advance(until);
  }
  /// The thrust that each body is under now, by its number.
  std::vector<Vector2> thrusts() const {
    std::vector<Vector2> thrusts(trial_.body_count(), Vector2(0.0, 0.0));
    for (std::size_t i = 0; i < next_; ++i)
      thrusts[trial_.posts.size() + trial_.pushes[i].bat] = trial_.pushes[i].acceleration;
    return thrusts;
  }

 private:
  const Trial& trial_;
  World& world_;
  std::size_t next_ = 0;
};

}  // namespace rink::accuracy
