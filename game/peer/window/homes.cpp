// Chooses homes by the halos of others, and finds who leaves them.
#include "game/peer/window/homes.h"

#include <algorithm>
#include <optional>

namespace rink::peer {

namespace {

/// A margin is wider than needed by this factor, so that not every halo changes it.
constexpr double margin_room = 1.25;
/// A body that is not watched stays at home for this many windows without events; then all are
/// checked once. More windows mean more watched bodies.
constexpr double windows_watched = 24.0;

}  // namespace

Homes::Homes(Share& share, const Halos& halos)
    : share_(share),
      halos_(halos),
      homes_(share.roles().body_count(), 0),
      end_homes_(share.roles().body_count(), 0),
      watches_(share.roles().body_count(), Watch::none),
      is_edge_(share.roles().body_count(), 0) {
  assert(halos.own_zones().size() < 255 && "a home is a byte");
}

std::uint8_t Homes::home_of(const Vector2& place, std::uint8_t likely) const {
  assert(likely <= interiors_.size());
  const Box point = Box::around(place, {0.0, 0.0});
  if (likely != 0 && interiors_[likely - 1u].holds(point)) return likely;
  for (std::size_t k = 0; k < interiors_.size(); ++k)
    if (interiors_[k].holds(point)) return static_cast<std::uint8_t>(k + 1);
  return 0;
}

double Homes::least_margin() const {
  return std::max(halos_.widest_other(), halos_.deepest_annex()) + 1.001 * share_.extent_max();
}

bool Homes::are_fit() const {
  const double needed = least_margin();
  return margin_ >= needed && (margin_ <= margin_room * margin_room * needed || margin_ == needed);
}

void Homes::choose(const Window& window) {
  margin_ = margin_room * least_margin();
  assert(are_fit());
  interiors_.clear();
  for (const Box& zone : halos_.own_zones()) interiors_.push_back(zone.grown(-margin_));
  for (const std::uint32_t body : share_.roles().owned()) {
    homes_[body] = home_of(share_.start_place(body, window.start), 0);
    watch(body, Watch::watched);
    watches_[body] = Watch::watched;
  }
  for (const Reach& group : share_.groups()) homes_[group.body] = 0;
  watched_until_ = window.start;
}

void Homes::settle(const Settlement& settled, const Window& window) {
  for (const std::uint32_t body : settled.own) watch(body, Watch::watched), homes_[body] = 0;
  std::erase_if(watched_, [this](std::uint32_t body) {
    if (share_.owns(body)) return false;
    watches_[body] = Watch::none;
    return true;
  });
  if (!are_fit()) return choose(window);
  for (const std::uint32_t body : settled.own)
    if (!share_.world().is_held({body})) homes_[body] = home_of(share_.world().position({body}), 0);
}

void Homes::reopen() {
  margin_ = -1.0;
  outskirts_.clear();
  for (const std::uint32_t body : share_.roles().owned())
    outskirts_.push_back({body, share_.reach_of(body)});
}

void Homes::begin_window() {
  for (const std::uint32_t body : watched_)
    homes_[body] = end_homes_[body], watches_[body] = Watch::watched;
}

void Homes::watch(std::uint32_t body, Watch how) {
  assert(share_.owns(body) && how != Watch::none);
  if (watches_[body] != Watch::none) return;
  watches_[body] = how;
  watched_.push_back(body);
  share_.set_room(body, 0);
}

bool Homes::stays(std::uint8_t home, const Vector2& place, const Vector2& velocity,
                  double since) const {
  assert(home > 0 && home <= interiors_.size());
  const Box& interior = interiors_[home - 1u];
  const Vector2 farthest =
      place + velocity * (watched_until_ - since);  // drag only makes it shorter
  return interior.holds(Box::around(place, {0.0, 0.0})) &&
         interior.holds(Box::around(farthest, {0.0, 0.0}));
}

void Homes::choose_watched(const Window& window) {
  watched_until_ = window.start + windows_watched * (window.end - window.start);
  watched_.clear();
  for (const std::uint32_t body : share_.roles().owned()) {
    const std::uint8_t home = homes_[body];
    watches_[body] = Watch::none;
    const auto flight = home == 0 ? std::nullopt : share_.subdomain().free_flight(body);
    if (!flight || !stays(home, {flight->x, flight->y}, {flight->vx, flight->vy}, flight->time))
      watch(body, Watch::watched);
    else share_.set_room(body, home);
  }
  std::vector<physics::Journal::Room> rooms;
  for (const Box& box : interiors_) rooms.push_back({box.low_x, box.low_y, box.high_x, box.high_y});
  share_.set_rooms(std::move(rooms), watched_until_);
}

void Homes::restore_rooms() {
  for (const std::uint32_t body : share_.take_entered())
    if (share_.owns(body) && watches_[body] == Watch::none) share_.set_room(body, homes_[body]);
}

void Homes::find_edge() {
  for (const std::uint32_t body : edge_) is_edge_[body] = 0;
  edge_.clear(), outskirts_.clear();
  for (const std::uint32_t body : watched_) look_at(body);
  for (const physics::Change& change : share_.subdomain().journal().changes) {
    const std::uint32_t body = change.body;
    if (!share_.owns(body) || is_edge_[body] != 0) continue;
    // A straight flight between two places in a convex interior stays inside; one that bends may
    // not. Where a pile was looked for, paths count wherever they are.
    const bool is_straight = change.motion == physics::Change::straight && !(change.reach > 0.0f);
    if (watches_[body] == Watch::none &&
        !(is_straight &&
          stays(homes_[body], {change.x, change.y}, {change.vx, change.vy}, change.since)))
      watch(body, Watch::late), look_at(body);
    if (!is_straight ||
        !interiors_[homes_[body] - 1u].holds({change.x, change.y, change.x, change.y}))
      note_edge(body);
  }
  std::sort(edge_.begin(), edge_.end());
  assert(std::ranges::adjacent_find(edge_) == edge_.end() &&
         outskirts_.size() <= share_.roles().owned().size());
}

Box Homes::room_of(std::uint32_t body) const {
  assert(homes_[body] > 0 && homes_[body] <= interiors_.size());
  const physics::Field& field = share_.world().spec().field;
  const Box& room = interiors_[homes_[body] - 1u];
  return {std::max(room.low_x, -field.length), std::max(room.low_y, -field.width),
          std::min(room.high_x, 2.0 * field.length), std::min(room.high_y, 2.0 * field.width)};
}

bool Homes::are_met_by(const Box& box) const {
  return std::ranges::any_of(interiors_, [&](const Box& interior) { return interior.meets(box); });
}

void Homes::look_at(std::uint32_t body) {
  const physics::PartWorld& world = share_.world();
  const std::uint8_t home = homes_[body];
  end_homes_[body] =
      world.is_held({body}) ? std::uint8_t{0} : home_of(world.position({body}), home);
  if (home == 0 || end_homes_[body] != home || world.kind({body}) == physics::BodyKind::bat)
    note_edge(body);
  if (end_homes_[body] == 0) outskirts_.push_back({body, share_.reach_of(body)});
}

void Homes::note_edge(std::uint32_t body) {
  if (is_edge_[body] != 0) return;
  is_edge_[body] = 1;
  edge_.push_back(body);
}

void Homes::check() const {
  [[maybe_unused]] const auto is_home = [this](std::uint32_t body) {
    return homes_[body] <= interiors_.size();
  };
  assert(std::ranges::all_of(share_.roles().owned(), is_home));
  assert(watched_.size() ==
         watches_.size() - static_cast<std::size_t>(std::ranges::count(watches_, Watch::none)));
}

}  // namespace rink::peer
