// Stopping and waking.
#include "game/physics/bodies/jams.h"

#include <algorithm>
#include <cassert>

#include "game/physics/bodies/journal.h"

namespace rink::physics::inline RINK_PRECISION {

void Jams::read(std::uint32_t body, BodyState& state) const {
  assert(body < table_.numbers.size());
  state.jam = bodies_[body].is(Body::frozen) ? table_.numbers[body] : 0;
}

void Jams::write(std::uint32_t body, const BodyState& state) {
  assert(body < table_.numbers.size());
  std::erase(table_.frozen, body);
  table_.numbers[body] = state.jam;
  if ((state.flags & Body::frozen) != 0) table_.frozen.push_back(body);
}

void Jams::enlist(std::span<const std::uint32_t> members) {
  assert(!members.empty());
  ++table_.count;
  const std::uint32_t lowest = *std::min_element(members.begin(), members.end());
  // Nobody is in two, so that its number in the whole names the jam in every world.
  const std::uint32_t jam =
      observers_.journal != nullptr ? observers_.journal->number_of(lowest) : lowest;
  for (const std::uint32_t body : members) {
    assert(!bodies_[body].is(Body::frozen));
    bodies_.set_flags(body, Body::frozen);
    table_.numbers[body] = jam;
    table_.frozen.push_back(body);
  }
}

void Jams::stop(std::span<const std::uint32_t> members) {
  enlist(members);
  for (const std::uint32_t body : members) {
    bodies_.set_velocity(body, RealVector(0.0, 0.0));
    for (int axis = 0; axis < 2; ++axis) bodies_.set_law(body, axis, 0.0, bodies_.own_drag(body));
  }
}

void Jams::glide(std::span<const std::uint32_t> members, std::span<const RealVector> accelerations,
                 Real end) {
  assert(members.size() == accelerations.size());
  enlist(members);
  for (std::size_t i = 0; i < members.size(); ++i) {
    history_.hop_until(members[i], end);
    for (int axis = 0; axis < 2; ++axis)
      bodies_.set_law(members[i], axis, accelerations[i][axis], bodies_.own_drag(members[i]));
  }
}

void Jams::wake(std::uint32_t body, Real time) {
  if (!bodies_[body].is(Body::frozen)) return;
  const std::uint32_t jam = table_.numbers[body];
  std::vector<std::uint32_t>& frozen = table_.frozen;
  for (std::size_t i = 0; i < frozen.size();) {
    const std::uint32_t member = frozen[i];
    if (table_.numbers[member] != jam) {
      ++i;
      continue;
    }
    bodies_.keep(member);
    frozen[i] = frozen.back();
    frozen.pop_back();
    bodies_.clear_flags(member, Body::frozen);
    if (is_still(bodies_, member)) history_.forget_hops(member);
    history_.hop_until(member, std::min(time, history_.last_hop(member)));
    bodies_.rebase(member, time);
    for (int axis = 0; axis < 2; ++axis)
      bodies_.set_law(member, axis, bodies_.build(member).thrust[axis], bodies_.own_drag(member));
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
