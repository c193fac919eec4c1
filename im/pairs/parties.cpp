// Keeps facts by id and says what news they are.
#include "im/pairs/parties.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::im {

rink_party Parties::nobody(std::uint32_t id) {
  rink_party party{};
  party.id = id;
  party.team = party.owner = RINK_NONE;
  party.age = std::numeric_limits<double>::infinity();
  return party;
}

bool Parties::place(std::uint32_t id, const Region& region) {
  assert(is_valid(region));
  while (id >= parties_.size()) parties_.push_back(nobody(static_cast<std::uint32_t>(size())));
  known_.resize(parties_.size());
  rink_party& party = parties_[id];
  if (known_[id].is_there && region_of(party) == region) return false;
  known_[id].is_there = true;
  party.low_x = region.low_x, party.low_y = region.low_y;
  party.high_x = region.high_x, party.high_y = region.high_y;
  party.x = 0.5 * region.low_x + 0.5 * region.high_x;
  party.y = 0.5 * region.low_y + 0.5 * region.high_y;
  return true;
}

bool Parties::set_role(std::uint32_t id, const Role& role) {
  if (!uses_.roles || !contains(id)) return false;
  rink_party& party = parties_[id];
  const std::uint32_t always = role.is_always_relevant ? 1 : 0;
  if (party.team == role.team && party.owner == role.owner && party.is_always_relevant == always)
    return false;
  party.team = role.team, party.owner = role.owner, party.is_always_relevant = always;
  return true;
}

bool Parties::set_facts(std::uint32_t id, const Facts& facts) {
  assert(std::isfinite(facts.velocity_x) && std::isfinite(facts.velocity_y));
  assert(std::isfinite(facts.heading.x) && std::isfinite(facts.heading.y));
  if (!contains(id)) return false;
  if (std::exchange(known_[id].changed_at, facts.changed_at) != facts.changed_at)
    is_stale_ |= uses_.age;
  if (!uses_.motion) return false;
  rink_party& party = parties_[id];
  const Heading own = facts.heading == Heading{} ? Heading{facts.velocity_x, facts.velocity_y}
                                                 : facts.heading,
                heading = known_[id].has_heading ? Heading{party.heading_x, party.heading_y} : own;
  const auto kind = static_cast<std::uint32_t>(facts.kind);
  if (party.velocity_x == facts.velocity_x && party.velocity_y == facts.velocity_y &&
      party.heading_x == heading.x && party.heading_y == heading.y && party.kind == kind)
    return false;
  party.velocity_x = facts.velocity_x, party.velocity_y = facts.velocity_y;
  party.heading_x = heading.x, party.heading_y = heading.y, party.kind = kind;
  return true;
}

bool Parties::set_heading(std::uint32_t id, const Heading& heading) {
  assert(std::isfinite(heading.x) && std::isfinite(heading.y));
  if (!uses_.motion || !contains(id)) return false;
  rink_party& party = parties_[id];
  known_[id].has_heading = heading != Heading{};
  const Heading now =
      known_[id].has_heading ? heading : Heading{party.velocity_x, party.velocity_y};
  if (party.heading_x == now.x && party.heading_y == now.y) return false;
  party.heading_x = now.x, party.heading_y = now.y;
  return true;
}

void Parties::remove(std::uint32_t id) {
  if (!contains(id)) return;
  parties_[id] = nobody(id);
  known_[id] = {};
}

void Parties::age(double now) {
  for (std::size_t id = 0; id < parties_.size(); ++id)
    parties_[id].age = std::max(0.0, now - known_[id].changed_at);
}

}  // namespace rink::im
