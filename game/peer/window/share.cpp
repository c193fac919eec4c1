// Decides between two windows who owns what, and who has ghosts of it.
#include "game/peer/window/share.h"
#include "im/basics/sorted_set.h"

#include <algorithm>
#include <functional>
#include <tuple>

namespace rink::peer {

std::vector<RestContact> sound_contacts(std::vector<RestContact> rest_contacts,
                                        const physics::Subdomain& there) {
  const auto is_there = [&](physics::Partner p) {
    return p >= physics::partner::field_parts || there.is_there(p);
  };
  std::erase_if(rest_contacts, [&](const RestContact& rest) {
    return !is_there(rest.low) || !is_there(rest.high);
  });
  const auto names = [](const RestContact& rest) {
    return std::tuple(rest.low, rest.high, rest.axis);
  };
  std::stable_sort(rest_contacts.begin(), rest_contacts.end(),
                   [&](const RestContact& a, const RestContact& b) { return names(a) < names(b); });
  rest_contacts.erase(
      std::unique(rest_contacts.begin(), rest_contacts.end(),
                  [&](const RestContact& a, const RestContact& b) { return names(a) == names(b); }),
      rest_contacts.end());
  return rest_contacts;
}

Share::Share(const physics::WorldSpec& spec, std::uint32_t body_count, PeerNumber peer_count)
    : subdomain_(spec, body_count), roles_(body_count), known_(peer_count), coming_(peer_count) {
  assert(peer_count > 0);
}

Vector2 Share::start_place(std::uint32_t body, double start) const {
  assert(body < roles_.body_count());
  if (subdomain_.was_gone(body)) return subdomain_.motion_before(body).position;
  return subdomain_.motion_before(body).at(start).position;
}

Box Share::reach_of(std::uint32_t body) const {
  const auto place = [&](std::uint32_t b) {
    return Box::around(world().position({b}), extent_of(b));
  };
  Box box = place(body);
  if (world().is_held({body}))
    for (const std::uint32_t companion : subdomain_.group_of(body))
      box = box.with(place(companion));
  return box;
}

Box Share::start_reach(std::uint32_t body, double start) const {
  for (const Reach& group : groups_)
    if (group.body == body) return group.box;
  return Box::around(start_place(body, start), extent_of(body));
}

bool Share::knows(PeerNumber peer, std::uint32_t body) const {
  return std::ranges::binary_search(known(peer), body);
}
bool Share::will_have(PeerNumber peer, std::uint32_t body) const {
  return std::ranges::binary_search(coming(peer), body);
}

void Share::put(std::uint32_t body, const BodyState& state) {
  assert(body < roles_.body_count() && !roles_.owns(body));
  note_extent(state), touch(body);
  subdomain_.put(body, state);
}

void Share::correct(std::uint32_t ghost, bool is_unmoved) {
  assert(roles_.has_ghost(ghost));
  if (is_unmoved) touch(ghost), subdomain_.put(ghost, subdomain_.state_before(ghost));
  else drop(ghost);
}

void Share::set_rest_contacts(std::vector<RestContact> rest_contacts) {
  subdomain_.set_rest_contacts(sound_contacts(std::move(rest_contacts), subdomain_));
}

std::vector<RestContact> Share::own_rest_contacts() const {
  std::vector<RestContact> rest_contacts = subdomain_.rest_contacts();
  const auto is_own = [&](physics::Partner p) {
    return p < physics::partner::field_parts && roles_.owns(p);
  };
  std::erase_if(rest_contacts,
                [&](const RestContact& rest) { return !is_own(rest.low) && !is_own(rest.high); });
  return rest_contacts;
}

void Share::find_owner(std::uint32_t body, const Vector2& place, const Box& reach,
                       const Halos& halos, Settlement& settled) {
  const PeerNumber owner = halos.owner_of(place);
  if (owner == halos.number()) {
    if (!roles_.owns(body)) roles_.own(body), settled.came.push_back(body);
    settled.own.push_back(body);
    for (const PeerNumber peer : halos.neighbours()) {
      if (!halos.is_near(peer, reach)) continue;
      std::vector<std::uint32_t>& known = known_[peer];
      known.insert(std::ranges::upper_bound(known, body), body);
    }
    return;
  }
  if (roles_.owns(body)) {
    roles_.disown(body), settled.left.push_back(body);
    subdomain_.set_room(body, 0);
  }
  if (halos.is_near(halos.number(), reach)) roles_.add_ghost(body, owner);
  else drop(body);
}

Settlement Share::settle(std::vector<std::uint32_t> candidates, const Halos& halos) {
  std::erase_if(candidates, [&](std::uint32_t body) { return !subdomain_.is_there(body); });
  make_sorted_set(candidates);
  std::vector<Vector2> places;
  std::vector<Box> reaches;
  for (const std::uint32_t body : candidates) {
    places.push_back(world().position({body}));
    reaches.push_back(world().is_held({body}) ? reach_of(body)
                                              : Box::around(places.back(), extent_of(body)));
  }
  roles_.clear_ghosts();
  groups_.clear();
  for (std::vector<std::uint32_t>& known : known_) known.clear();
  Settlement settled;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    find_owner(candidates[k], places[k], reaches[k], halos, settled);
    if (roles_.owns(candidates[k]) && world().is_held({candidates[k]}))
      groups_.push_back({candidates[k], reaches[k]});
  }
  std::vector<RestContact> rest_contacts = subdomain_.rest_contacts();
  if (!rest_contacts.empty()) set_rest_contacts(std::move(rest_contacts));
  return settled;
}

/// Nothing is in contact with the puck, and every peer that has it derives the same state from its
/// owner's.
Settlement Share::put_back(const Handover::Body& scored, const Vector2& place, const Halos& halos) {
  const std::uint32_t body = scored.number;
  assert(body < roles_.body_count() && place.allFinite());
  if (roles_.has_ghost(body)) roles_.remove_ghost(body);
  for (std::vector<std::uint32_t>& known : known_) std::erase(known, body);
  if (!subdomain_.is_there(body)) subdomain_.put(body, scored.state);
  note_extent(scored.state), touch(body);
  std::vector<std::uint32_t> changed;  // with who was in contact with one in play
  if (world().is_in_play({body})) changed = subdomain_.group_of(body);
  subdomain_.place(body, place);
  Settlement settled;
  find_owner(body, place, Box::around(place, extent_of(body)), halos, settled);
  settled.came = settled.own;  // even if it was own before: its state is another
  settled.came.insert(settled.came.end(), changed.begin(), changed.end());
  return settled;
}

void Share::tell(PeerNumber peer, std::span<const std::uint32_t> bodies) {
  assert(std::ranges::all_of(bodies, [this](std::uint32_t body) { return owns(body); }));
  std::vector<std::uint32_t>& known = known_[peer];
  known.insert(known.end(), bodies.begin(), bodies.end());
  std::sort(known.begin(), known.end());
}

void Share::expect(PeerNumber peer, std::vector<std::uint32_t> bodies) {
  assert(peer < coming_.size() && std::ranges::is_sorted(bodies));
  coming_[peer] = std::move(bodies);
}

void Share::make_room(PeerNumber peer_count) {
  assert(peer_count >= known_.size());
  known_.resize(peer_count), coming_.resize(peer_count);
}

void Share::play(std::span<const Key> keys, double until) {
  assert(std::ranges::is_sorted(keys, {}, &Key::time));
  halves_ = halves_before_;
  const auto advance = [this](double to) {
    if (halves_.are_kept()) subdomain_.advance(to, halves_);
    else subdomain_.advance(to);
  };
  for (const Key& key : keys) {
    advance(std::max(key.time, world().now()));
    subdomain_.set_thrust(key.bat, key.thrust);
    halves_.look(world());
  }
  advance(until);
}

void Share::check([[maybe_unused]] PeerNumber number) const {
  roles_.check();
  [[maybe_unused]] const auto is_there = [this](std::uint32_t body) {
    return subdomain_.is_there(body);
  };
  assert(std::ranges::all_of(roles_.owned(), is_there) &&
         std::ranges::all_of(roles_.ghosts(), is_there));
  assert(std::ranges::none_of(
      roles_.ghosts(), [&](std::uint32_t body) { return roles_.has_ghost_of(number, body); }));
  assert(known_[number].empty());
  for ([[maybe_unused]] const std::vector<std::uint32_t>& known : known_) {
    assert(std::ranges::adjacent_find(known, std::greater_equal<>()) == known.end());
    assert(std::ranges::all_of(known, [this](std::uint32_t body) { return owns(body); }));
  }
}

}  // namespace rink::peer
