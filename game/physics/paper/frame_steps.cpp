// Steps of one body: to the end of the frame, or to an instant within it.
#include "game/physics/paper/frame_steps.h"

namespace rink::physics::paper {

Phase FrameSteps::phase_at(const FrameBody& body, double time) const {
  if (!body.is_in_play || body.is_stopped || time <= body.start_time || !body.can_move())
    return body.start;
  if (is_begun_ && time == frame_end()) return body.end;
  const Step taken = step(integrator_, body.start.velocity, body.force, time - body.start_time);
  return {body.start.position + taken.displacement, taken.velocity};
}

double FrameSteps::work_until(const FrameBody& body, double time) const {
  if (body.force.thrust == Vector2(0.0, 0.0)) return 0.0;
  return body.mass * body.force.thrust.dot(phase_at(body, time).position - body.start.position);
}

bool FrameSteps::plan(FrameBody& body) const {
  ++body.version;
  body.end = body.start;
  body.chord = Vector2(0.0, 0.0);
  const double left = frame_end() - body.start_time;
  if (!body.is_in_play || body.is_stopped || !body.can_move() || left <= 0.0) return false;
  const Step taken = step(integrator_, body.start.velocity, body.force, left);
  body.end = {body.start.position + taken.displacement, taken.velocity};
  body.chord = taken.displacement / left;
  return true;
}

}  // namespace rink::physics::paper
