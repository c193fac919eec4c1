// The frames in which a stepped engine's time passes, and a body's way through one of them.
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>

#include "game/physics/paper/frame_body.h"

namespace rink::physics::paper {

/// Frame k lasts from k dt to (k + 1) dt. What is asked within a frame is answered by a shorter
/// step from the body's last state.
class FrameSteps {
 public:
  FrameSteps(Integrator integrator, double dt) : integrator_(integrator), dt_(dt) {
    assert(std::isfinite(dt) && dt > 0.0);
  }

  double frame_end() const { return static_cast<double>(frame_ + 1) * dt_; }
  bool is_begun() const { return is_begun_; }
  void begin() {
    assert(!is_begun_);
    is_begun_ = true;
  }
  void finish() {
    assert(is_begun_);
    is_begun_ = false;
    ++frame_;
  }

  /// Where `body` is at `time`, which lies within the frame.
  Phase phase_at(const FrameBody& body, double time) const;
  /// Of its thrust along the way from its last state to where it is at `time` [J].
  double work_until(const FrameBody& body, double time) const;
  /// Steps `body` from its last state to the end of the frame. False if there is no way to go.
  bool plan(FrameBody& body) const;

 private:
  Integrator integrator_;
  double dt_;
  std::uint64_t frame_ = 0;
  bool is_begun_ = false;
};

}  // namespace rink::physics::paper
