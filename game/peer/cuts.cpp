// Builds, changes and balances trees of cuts.
#include "game/peer/cuts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "im/basics/checked.h"

namespace rink::peer {

std::pair<Box, Box> Cuts::parts_of(const Box& box, bool is_along_x, double side) {
  Box below = box, above = box;
  (is_along_x ? below.high_x : below.high_y) = side;
  (is_along_x ? above.low_x : above.low_y) = side;
  return {below, above};
}

Cuts Cuts::by_count(const physics::Field& field, std::vector<Vector2> places,
                    PeerNumber peer_count) {
  assert(peer_count > 0 && field.length > 0.0 && field.width > 0.0);
  Cuts cuts(field);
  cuts.root_ = cuts.cut({0.0, 0.0, field.length, field.width}, places, 0, peer_count);
  assert(cuts.nodes_.size() == 2 * std::size_t{peer_count} - 1);
  cuts.list_peers();
  if constexpr (checks_whole_structures) cuts.check();
  return cuts;
}

void Cuts::check() const {
  assert(root_ < nodes_.size());
  assert(checked_count(root_, {0.0, 0.0, field_.length, field_.width}) == nodes_.size());
  [[maybe_unused]] const std::vector<PeerNumber> all = peers_below(root_);
  assert(std::ranges::adjacent_find(peers_, std::greater_equal<>()) == peers_.end());
  assert(std::ranges::is_permutation(peers_, all));
}

/// The number of nodes in that part, each of which is checked.
std::size_t Cuts::checked_count(std::size_t node, const Box& box) const {
  const Node& here = nodes_[node];
  if (is_leaf(node)) return 1;
  assert(here.low < nodes_.size() && here.high < nodes_.size() && here.low != here.high);
  assert((here.is_along_x ? box.low_x : box.low_y) <= here.side &&
         here.side <= (here.is_along_x ? box.high_x : box.high_y));
  const auto [below, above] = parts_of(box, here.is_along_x, here.side);
  return 1 + checked_count(here.low, below) + checked_count(here.high, above);
}

/// Cuts a part of the field, with the places in it, for `peer_count` peers from `first` on.
std::size_t Cuts::cut(const Box& box, std::span<Vector2> places, PeerNumber first,
                      PeerNumber peer_count) {
  assert(peer_count > 0);
  const std::size_t node = nodes_.size();
  nodes_.push_back({.low = node, .peer = first});
  if (peer_count == 1) return node;
  const bool is_long = box.high_x - box.low_x >= box.high_y - box.low_y;
  const double low = is_long ? box.low_x : box.low_y, high = is_long ? box.high_x : box.high_y;
  const auto along = [is_long](const Vector2& place) { return is_long ? place.x() : place.y(); };
  std::sort(places.begin(), places.end(), [](const Vector2& a, const Vector2& b) {
    return std::tuple(a.x(), a.y()) < std::tuple(b.x(), b.y());
  });
  std::stable_sort(places.begin(), places.end(),
                   [&](const Vector2& a, const Vector2& b) { return along(a) < along(b); });
  const PeerNumber lower = peer_count / 2;
  const std::size_t count = places.size() * lower / peer_count;
  double side = count == 0 ? low : 0.5 * (along(places[count - 1]) + along(places[count]));
  // Places that coincide, or are too few, are divided by area.
  if (!(side > low && side < high)) side = low + (high - low) * lower / peer_count;
  assert(side > low && side < high);
  const auto second = static_cast<std::size_t>(
      std::partition_point(places.begin(), places.end(),
                           [&](const Vector2& place) { return along(place) < side; }) -
      places.begin());
  const auto [below, above] = parts_of(box, is_long, side);
  const std::size_t below_node = cut(below, places.first(second), first, lower),
                    above_node =
                        cut(above, places.subspan(second), first + lower, peer_count - lower);
  nodes_[node] = {
      .low = below_node, .high = above_node, .is_along_x = is_long, .side = side, .peer = 0};
  return node;
}

void Cuts::lay_out(std::size_t node, const Box& box, std::vector<Zone>& zones) const {
  const Node& here = nodes_[node];
  if (is_leaf(node)) return zones.push_back({box, here.peer});
  const auto [below, above] = parts_of(box, here.is_along_x, here.side);
  lay_out(here.low, below, zones);
  lay_out(here.high, above, zones);
}

Division Cuts::division(PeerNumber peer_count) const {
  std::vector<Zone> zones;
  lay_out(root_, {0.0, 0.0, field_.length, field_.width}, zones);
  return Division(field_, std::move(zones), peer_count);
}

std::vector<PeerNumber> Cuts::peers_below(std::size_t node) const {
  if (is_leaf(node)) return {nodes_[node].peer};
  std::vector<PeerNumber> peers = peers_below(nodes_[node].low);
  const std::vector<PeerNumber> others = peers_below(nodes_[node].high);
  peers.insert(peers.end(), others.begin(), others.end());
  return peers;
}

void Cuts::list_peers() {
  peers_ = peers_below(root_);
  std::sort(peers_.begin(), peers_.end());
}

bool Cuts::has(PeerNumber peer) const { return std::ranges::binary_search(peers_, peer); }

/// The leaf of `peer`, and its box.
const Cuts::Node* Cuts::find(std::size_t node, const Box& box, PeerNumber peer, Box& found) const {
  const Node& here = nodes_[node];
  if (is_leaf(node)) return found = box, here.peer == peer ? &here : nullptr;
  const auto [below, above] = parts_of(box, here.is_along_x, here.side);
  const Node* leaf = find(here.low, below, peer, found);
  return leaf ? leaf : find(here.high, above, peer, found);
}

double Cuts::area_of(PeerNumber peer) const {
  Box box{};
  return find(root_, {0.0, 0.0, field_.length, field_.width}, peer, box)
             ? (box.high_x - box.low_x) * (box.high_y - box.low_y)
             : 0.0;
}

/// Copies a part to the end of `nodes`, without the leaf of `left_out`.
std::size_t Cuts::copied(std::size_t node, PeerNumber left_out, std::vector<Node>& nodes) const {
  const auto is_out = [&](std::size_t part) {
    return is_leaf(part) && nodes_[part].peer == left_out;
  };
  if (!is_leaf(node) && is_out(nodes_[node].low)) return copied(nodes_[node].high, left_out, nodes);
  if (!is_leaf(node) && is_out(nodes_[node].high)) return copied(nodes_[node].low, left_out, nodes);
  const std::size_t copy = nodes.size();
  nodes.push_back(nodes_[node]);
  if (is_leaf(node)) return nodes[copy].low = copy;
  const std::size_t low = copied(nodes_[node].low, left_out, nodes),
                    high = copied(nodes_[node].high, left_out, nodes);
  nodes[copy].low = low, nodes[copy].high = high;
  return copy;
}

Cuts Cuts::without(PeerNumber peer) const {
  assert(has(peer) && !is_leaf(root_));
  Cuts cuts(field_);
  cuts.root_ = copied(root_, peer, cuts.nodes_);
  cuts.list_peers();
  assert(!cuts.has(peer) && cuts.nodes_.size() + 2 == nodes_.size());
  if constexpr (checks_whole_structures) cuts.check();
  return cuts;
}

Cuts Cuts::with(PeerNumber newcomer, PeerNumber of) const {
  assert(!has(newcomer) && has(of));
  Cuts cuts = *this;
  Box box{};
  assert(nodes_.size() == 2 * peers().size() - 1);
  const auto node = static_cast<std::size_t>(
      find(root_, {0.0, 0.0, field_.length, field_.width}, of, box) - nodes_.data());
  const bool is_long = box.high_x - box.low_x >= box.high_y - box.low_y;
  const double side = is_long ? 0.5 * (box.low_x + box.high_x) : 0.5 * (box.low_y + box.high_y);
  for (const PeerNumber peer : {of, newcomer})
    cuts.nodes_.push_back({.low = cuts.nodes_.size(), .peer = peer});
  cuts.nodes_[node] = {.low = nodes_.size(),
                       .high = nodes_.size() + 1,
                       .is_along_x = is_long,
                       .side = side,
                       .peer = 0};
  cuts.list_peers();
  if constexpr (checks_whole_structures) cuts.check();
  return cuts;
}

std::optional<Cuts> Cuts::balanced(std::span<const double> loads, double tolerance) const {
  assert(tolerance >= 1.0 && peers().back() < loads.size());
  assert(std::ranges::all_of(loads, [](double l) { return std::isfinite(l) && l >= 0.0; }));
  Cuts cuts = *this;
  const Box whole{0.0, 0.0, field_.length, field_.width};
  return cuts.shift(root_, whole, whole, loads, tolerance) ? std::optional(std::move(cuts))
                                                           : std::nullopt;
}

/// Shifts the cuts of a part that was `from` and becomes `to`, in proportion unless the loads are
/// uneven. Returns whether any part was out of balance.
bool Cuts::shift(std::size_t node, const Box& from, const Box& to, std::span<const double> loads,
                 double tolerance) {
  if (is_leaf(node)) return false;
  Node& here = nodes_[node];
  const auto [below_from, above_from] = parts_of(from, here.is_along_x, here.side);
  const auto low_of = [&](const Box& box) { return here.is_along_x ? box.low_x : box.low_y; };
  const auto high_of = [&](const Box& box) { return here.is_along_x ? box.high_x : box.high_y; };
  const auto load_of = [&](const std::vector<PeerNumber>& peers) {
    double load = 0.0;
    assert(!peers.empty());
    for (const PeerNumber peer : peers) load += loads[peer];
    return load;
  };
  const std::vector<PeerNumber> below = peers_below(here.low), above = peers_below(here.high);
  const double p = static_cast<double>(below.size()), q = static_cast<double>(above.size()),
               low_load = load_of(below), high_load = load_of(above);
  const double low = low_of(to), extent = high_of(to) - low, share = p / (p + q);
  double part = (here.side - low_of(from)) / (high_of(from) - low_of(from));
  const bool is_uneven =
      std::max(low_load / p, high_load / q) > tolerance * (low_load + high_load) / (p + q);
  if (is_uneven) {
    constexpr double damping = 0.5, least = 0.1;
    const double surplus = low_load * (1.0 - share) - high_load * share;  // of the lower part
    part += damping *
            (surplus > 0.0 ? -surplus / low_load * part : -surplus / high_load * (1.0 - part));
    part = std::clamp(part, least * share, 1.0 - least * (1.0 - share));
  }
  // If nothing moves, no bit changes.
  const bool is_moved = is_uneven || low_of(from) != low_of(to) || high_of(from) != high_of(to);
  if (is_moved) here.side = low + part * extent;
  const auto [below_to, above_to] = parts_of(to, here.is_along_x, here.side);
  const bool is_below_uneven = shift(here.low, below_from, below_to, loads, tolerance),
             is_above_uneven = shift(here.high, above_from, above_to, loads, tolerance);
  return is_uneven || is_below_uneven || is_above_uneven;
}

}  // namespace rink::peer
