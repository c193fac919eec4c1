// Finds own bodies deep in their zones, where no other peer's halo reaches: they are not claimed,
// and hardly any is checked.
#include <algorithm>
#include <cassert>
#include <limits>

#include "game/peer/peer.h"

namespace rink::peer {

namespace {

/// A margin is wider than needed by this factor, so that not every halo changes it.
constexpr double margin_room = 1.25;
/// A body that is not watched stays at home for this many windows without events; then all are
/// checked once. More windows mean more watched bodies.
constexpr double windows_watched = 24.0;

}  // namespace

std::uint8_t Peer::home_of(const Vector2& place, std::uint8_t likely) const {
  assert(likely <= interiors_.size());
  const Box point = Box::around(place, {0.0, 0.0});
  if (likely != 0 && interiors_[likely - 1u].rest_contacts(point)) return likely;
  for (std::size_t k = 0; k < interiors_.size(); ++k)
    if (interiors_[k].rest_contacts(point)) return static_cast<std::uint8_t>(k + 1);
  return 0;
}

double Peer::least_margin() const {
  double halo = 0.0;
  for (PeerNumber peer = 0; peer < division_.peer_count(); ++peer)
    if (peer != number_ && is_present_[peer]) halo = std::max(halo, halos_[peer]);
  return halo + 1.001 * extent_max_;
}

bool Peer::is_margin_fit() const {
  const double needed = least_margin();
  return margin_ >= needed && (margin_ <= margin_room * margin_room * needed || margin_ == needed);
}

/// Chooses the margin, and so the bodies at home. Until the next window all are watched, and a run
/// that was played must be repeated.
void Peer::choose_margin() {
  margin_ = margin_room * least_margin();
  assert(is_margin_fit());
  interiors_.clear();
  for (const Box& zone : division_.zones_of(number_)) interiors_.push_back(zone.grown(-margin_));
  for (const std::uint32_t body : owned_) {
    homes_[body] = home_of(start_place(body), 0);
    watch(body, watched);
    is_watched_[body] = watched;
  }
  for (const Reach& group : groups_) homes_[group.body] = 0;
  watched_until_ = start_;
}

void Peer::watch(std::uint32_t body, Watch how) {
  assert(roles_[body] == own && how != not_watched);
  if (is_watched_[body] != not_watched) return;
  is_watched_[body] = how;
  watched_.push_back(body);
  subdomain_.set_room(body, 0);
}

bool Peer::stays(std::uint8_t home, const Vector2& place, const Vector2& velocity,
                 double since) const {
  assert(home > 0 && home <= interiors_.size());
  const Box& interior = interiors_[home - 1u];
  const Vector2 farthest =
      place + velocity * (watched_until_ - since);  // drag only makes it shorter
  return interior.rest_contacts(Box::around(place, {0.0, 0.0})) &&
         interior.rest_contacts(Box::around(farthest, {0.0, 0.0}));
}

/// At a window's start: watches all that might leave their homes before `watched_until_` without
/// events.
void Peer::choose_watched() {
  watched_until_ = start_ + windows_watched * (end_ - start_);
  watched_.clear();
  for (const std::uint32_t body : owned_) {
    const std::uint8_t home = homes_[body];
    is_watched_[body] = not_watched;
    const auto flight = home == 0 ? std::nullopt : subdomain_.free_flight(body);
    if (!flight || !stays(home, {flight->x, flight->y}, {flight->vx, flight->vy}, flight->time))
      watch(body, watched);
    else subdomain_.set_room(body, home);
  }
  std::vector<physics::Journal::Room> rooms;
  for (const Box& box : interiors_) rooms.push_back({box.low_x, box.low_y, box.high_x, box.high_y});
  subdomain_.set_rooms(std::move(rooms), watched_until_);
}

/// Finds own bodies that were not at home from the window's start to its end, and those that are
/// not at its end.
void Peer::find_edge() {
  for (const std::uint32_t body : edge_) is_edge_[body] = 0;
  edge_.clear(), outskirts_.clear();
  for (const std::uint32_t body : watched_) look_at(body);
  for (const physics::Change& change : subdomain_.journal().changes) {
    const std::uint32_t body = change.body;
    if (roles_[body] != own || is_edge_[body] != 0) continue;
    // A straight flight between two places in a convex interior stays inside; one that bends may
    // not.
    const bool is_straight = change.motion == physics::Change::straight;
    if (is_watched_[body] == not_watched &&
        !(is_straight &&
          stays(homes_[body], {change.x, change.y}, {change.vx, change.vy}, change.since)))
      watch(body, late), look_at(body);
    if (!is_straight ||
        !interiors_[homes_[body] - 1u].rest_contacts({change.x, change.y, change.x, change.y}))
      note_edge(body);
  }
  std::sort(edge_.begin(), edge_.end());
  assert(std::ranges::adjacent_find(edge_) == edge_.end() && outskirts_.size() <= owned_.size());
}

/// The interior without its infinite sides, which have no distance.
Box Peer::room_at_home(std::uint32_t body) const {
  assert(homes_[body] > 0 && homes_[body] <= interiors_.size());
  const physics::Field& field = subdomain_.world().spec().field;
  const Box& room = interiors_[homes_[body] - 1u];
  return {std::max(room.low_x, -field.length), std::max(room.low_y, -field.width),
          std::min(room.high_x, 2.0 * field.length), std::min(room.high_y, 2.0 * field.width)};
}

void Peer::look_at(std::uint32_t body) {
  const physics::World& world = subdomain_.world();
  const std::uint8_t home = homes_[body];
  end_homes_[body] =
      world.is_held({body}) ? std::uint8_t{0} : home_of(world.position({body}), home);
  if (home == 0 || end_homes_[body] != home || world.kind({body}) == physics::BodyKind::bat)
    note_edge(body);
  if (end_homes_[body] == 0) outskirts_.push_back({body, reach_of(body)});
}

void Peer::note_edge(std::uint32_t body) {
  if (is_edge_[body] != 0) return;
  is_edge_[body] = 1;
  edge_.push_back(body);
}

}  // namespace rink::peer
