// Who touches whom at the instant of an impact, directly or through others.
#include <algorithm>
#include <limits>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr std::size_t joint_max = 512;  // bodies
/// Gaps within so many roundings of an offset are none.
constexpr double touch_roundings = 16.0;

}  // namespace

/// An impact that comes alone here would be joint if any of those who touch were hit at this
/// instant, however far away, by somebody whom this world does not have. So it concerns all of
/// them, and the journal says so; nothing else changes.
void Engine::look_at_touching(const Contact& c, Real time) {
  if (spec_.surface_friction || clock_.is_hopeless ||
      !detection_.has_company(c.body, c.partner, time))
    return;
  gather_touching(c, time);
  note_looked_at();
}

void Engine::note_looked_at() {
  if (observers_.journal != nullptr)
    observers_.journal->looked_at.insert(observers_.journal->looked_at.end(), joint_.begin(),
                                         joint_.end());
}

std::uint32_t Engine::place_in_joint(std::uint32_t body, Real time) {
  const auto found = std::find(joint_.begin(), joint_.end(), body);
  if (found != joint_.end()) return static_cast<std::uint32_t>(found - joint_.begin());
  joint_.push_back(body);
  problem_.add_body(bodies_.build(body).mass, bodies_.build(body).inverse_mass,
                    motion_at(bodies_, body, time).velocity, false);
  return static_cast<std::uint32_t>(joint_.size() - 1);
}

void Engine::add_touch(std::uint32_t place, Partner p, const Contact& at_hand, Real time) {
  const std::uint32_t body = joint_[place];
  const Contact c = detection_.contact(body, p, time);
  const bool is_at_hand = (body == at_hand.body && p == at_hand.partner) ||
                          (p == at_hand.body && body == at_hand.partner);
  const Real rounding =
      tolerance_ + std::numeric_limits<Real>::epsilon() * time * problem_.velocities[place].norm();
  if (!is_at_hand && c.gap.distance > touch_roundings * rounding) return;
  std::uint32_t other = fixed_place;
  if (!bodies_.is_fixed(p)) {
    if (joint_.size() >= joint_max && std::find(joint_.begin(), joint_.end(), p) == joint_.end())
      return;
    other = place_in_joint(p, time);
    if (other < place) return;  // known from the other side
  }
  problem_.touches.push_back({place, other, c.gap.normal, detection_.restitution(body, p)});
  partners_.push_back(p);
}

/// All bodies that touch those of `c`, directly or through others, in an order that depends on ids
/// alone. False if no other contact among them closes now.
bool Engine::gather_touching(const Contact& c, Real time) {
  joint_.clear();
  problem_.clear();
  partners_.clear();
  place_in_joint(c.body, time);
  if (!bodies_.is_fixed(c.partner)) place_in_joint(c.partner, time);
  for (std::uint32_t place = 0; place < joint_.size(); ++place)
    detection_.visit_partners(joint_[place], [&](Partner p) { add_touch(place, p, c, time); });
  // Slower than this, the time of an impact is too uncertain to tell whether it belongs to the
  // instant.
  const Real slowest = 2.0 * touch_roundings * tolerance_ / Real(instant);
  const auto closes = [&](std::size_t i) {
    const bool is_at_hand = problem_.touches[i].body == 0 && partners_[i] == c.partner;
    return !is_at_hand && -parting(problem_.touches[i], problem_.velocities) > slowest;
  };
  for (std::size_t i = 0; i < partners_.size(); ++i)
    if (closes(i)) return true;
  return false;
}

}  // namespace rink::physics::inline RINK_PRECISION
