// The state of a body, gathered from those who own its parts.
#include "game/physics/bodies/before_images.h"

#include <cassert>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/jams.h"

namespace rink::physics::inline RINK_PRECISION {

BodyState state_of(std::uint32_t body, const Bodies& bodies, const ImpactHistory& history,
                   const Jams& jams) {
  BodyState state;
  bodies.read(body, state);
  history.read(body, state);
  jams.read(body, state);
  return state;
}

void BeforeImages::begin() {
  assert(number_ < 0xfffffffd);  // or marks of an old window would be taken for new ones
  flights_.clear(), states_.clear();
  number_ += 2;
}

void BeforeImages::keep(std::uint32_t body) {
  assert(body < marks_.size());
  if (marks_[body].number <= number_) keep_state(body, state_of(body, bodies_, history_, jams_));
}

void BeforeImages::keep_state(std::uint32_t body, const BodyState& before) {
  assert(body < marks_.size());
  if (marks_[body].number > number_) return;
  keep_flight(body, before.flight);
  marks_[body].number = number_ + 1;
  marks_[body].state = static_cast<std::uint32_t>(states_.size());
  states_.push_back({body, before});
}

BodyState BeforeImages::state(std::uint32_t body) const {
  const Mark& mark = marks_[body];
  assert(mark.number <= number_ || states_[mark.state].body == body);
  assert(mark.number < number_ || flights_[mark.flight].body == body);
  BodyState before =
      mark.number > number_ ? states_[mark.state].state : state_of(body, bodies_, history_, jams_);
  if (mark.number >= number_) before.flight = flights_[mark.flight].flight;
  return before;
}

std::uint8_t BeforeImages::flags(std::uint32_t body) const {
  const Mark& mark = marks_[body];
  assert(mark.number <= number_ || states_[mark.state].body == body);
  return mark.number > number_ ? states_[mark.state].state.flags : bodies_[body].flags;
}

}  // namespace rink::physics::inline RINK_PRECISION
