// Zones checked for gaps and overlaps.
#include "game/peer/division.h"

#include <cassert>
#include <cmath>
#include <sstream>
#include <utility>

#include "im/basics/checked.h"
#include "im/basics/sorted_set.h"

namespace rink::peer {

namespace {

std::string text_of(const Box& box) {
  std::ostringstream text;
  text << "x " << box.low_x << " to " << box.high_x << " m, y " << box.low_y << " to " << box.high_y
       << " m";
  return text.str();
}

}  // namespace

/// The sides of all zones cut the field into cells; each must lie in one zone.
std::optional<std::string> Division::objection(const physics::Field& field,
                                               std::span<const Zone> zones, PeerNumber peer_count) {
  const Box whole{0.0, 0.0, field.length, field.width};
  std::vector<double> xs{0.0, field.length}, ys{0.0, field.width};
  for (std::size_t i = 0; i < zones.size(); ++i) {
    const Box& box = zones[i].box;
    const std::string name = "zone " + std::to_string(i) + " (" + text_of(box) + ")";
    if (!(box.low_x < box.high_x && box.low_y < box.high_y))
      return name + ": expected sides in order, with room between them";
    if (!whole.holds(box)) return name + ": reaches beyond the field, which is " + text_of(whole);
    if (zones[i].peer >= peer_count)
      return name + ": belongs to peer " + std::to_string(zones[i].peer) + ", expected one below " +
             std::to_string(peer_count);
    xs.push_back(box.low_x), xs.push_back(box.high_x), ys.push_back(box.low_y),
        ys.push_back(box.high_y);
  }
  make_sorted_set(xs), make_sorted_set(ys);
  for (std::size_t i = 0; i + 1 < xs.size(); ++i)
    for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
      const Box cell{xs[i], ys[j], xs[i + 1], ys[j + 1]};
      std::vector<std::size_t> there;
      for (std::size_t k = 0; k < zones.size(); ++k)
        if (zones[k].box.holds(cell)) there.push_back(k);
      if (there.empty()) return "no zone covers " + text_of(cell);
      if (there.size() > 1)
        return "zones " + std::to_string(there[0]) + " and " + std::to_string(there[1]) +
               " overlap at " + text_of(cell);
    }
  return std::nullopt;
}

Division::Division(const physics::Field& field, std::vector<Zone> zones, PeerNumber peer_count)
    : peer_count_(peer_count) {
  assert(!objection(field, zones, peer_count));
  for (PeerNumber peer = 0; peer < peer_count; ++peer) {
    begins_.push_back(zones_.size());
    for (const Zone& zone : zones) {
      if (zone.peer != peer) continue;
      const Box& b = zone.box;
      zones_.push_back({b.low_x <= 0.0 ? -infinity : b.low_x, b.low_y <= 0.0 ? -infinity : b.low_y,
                        b.high_x >= field.length ? infinity : b.high_x,
                        b.high_y >= field.width ? infinity : b.high_y});
    }
  }
  begins_.push_back(zones_.size());
  assert(zones_.size() == zones.size());
  if constexpr (checks_whole_structures) check();
}

void Division::check() const {
  assert(begins_.size() == peer_count_ + std::size_t{1} && begins_.front() == 0);
  assert(std::is_sorted(begins_.begin(), begins_.end()) && begins_.back() == zones_.size());
  for ([[maybe_unused]] const Box& zone : zones_)
    assert(zone.low_x < zone.high_x && zone.low_y < zone.high_y);
}

Division Division::into_strips(const physics::Field& field, PeerNumber peer_count) {
  assert(peer_count > 0 && field.length > 0.0 && field.width > 0.0);
  std::vector<Zone> zones;
  const bool is_long = field.length >= field.width;
  const auto side = [&](PeerNumber k, double whole) {
    return k == peer_count ? whole : whole * k / peer_count;
  };
  for (PeerNumber k = 0; k < peer_count; ++k) {
    if (is_long)
      zones.push_back({{side(k, field.length), 0.0, side(k + 1, field.length), field.width}, k});
    else zones.push_back({{0.0, side(k, field.width), field.length, side(k + 1, field.width)}, k});
  }
  return Division(field, std::move(zones), peer_count);
}

PeerNumber Division::owner_of(const Vector2& place) const {
  for (PeerNumber peer = 0; peer < peer_count_; ++peer)
    for (const Box& zone : zones_of(peer))
      if (zone.low_x <= place.x() && place.x() < zone.high_x && zone.low_y <= place.y() &&
          place.y() < zone.high_y)
        return peer;
  assert(false && "a place that is no number");
  return 0;
}

std::span<const Box> Division::zones_of(PeerNumber peer) const {
  assert(peer < peer_count_);
  return std::span(zones_).subspan(begins_[peer], begins_[peer + 1] - begins_[peer]);
}

bool Division::is_near(PeerNumber peer, const Box& box, double halo) const {
  assert(halo >= 0.0);
  for (const Box& zone : zones_of(peer))
    if (zone.grown(halo).meets(box)) return true;
  return false;
}

bool Division::is_within(PeerNumber peer, const Box& box, double halo) const {
  assert(halo >= 0.0);
  for (const Box& zone : zones_of(peer))
    if (zone.grown(halo).holds(box)) return true;
  return false;
}

}  // namespace rink::peer
