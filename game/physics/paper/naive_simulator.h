// The simplest engine there is: step a frame, then let whatever overlaps and closes bounce. Fast
// bodies pass through thin ones.
#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "game/physics/paper/frame_simulator.h"

namespace rink::physics::paper {

/// Static tests only, at the end of each frame. Nobody is rolled back or moved apart.
class NaiveSimulator final : public FrameSimulator {
 public:
  NaiveSimulator(const WorldSpec& spec, Integrator integrator, double dt)
      : FrameSimulator(spec, integrator, dt) {}

 private:
  void begin() override { is_judged_ = false; }
  void turned(std::uint32_t) override {}
  std::optional<Goal> play(double until) override;

  void judge();
  void judge_pair(std::uint32_t a, std::uint32_t b);
  void judge_field(std::uint32_t body);
  void judge_wall(std::uint32_t body, const Vector2& point, const Vector2& normal);
  void bounce(std::uint32_t body, Partner partner, const Vector2& normal);
  bool is_in_goal(const Body& body) const;

  bool is_judged_ = false;  ///< whether the tests of this frame are done
  FrameGrid grid_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
  std::deque<std::uint32_t> goals_;  ///< pucks behind a goal line, still to be told
};

}  // namespace rink::physics::paper
