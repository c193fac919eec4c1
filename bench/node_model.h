// What a window costs each of many nodes, from what it costs a few: messages, bytes and processor
// time by the geometry of their zones. docs/peer-to-peer.md, "Cost".
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/session/session_settings.h"
#include "game/peer/verdict_tree.h"

namespace rink::bench::node_model {

/// Headers of a message of its own: frame, TCP, IPv4; an acknowledgement for two.
inline constexpr double headers = 13.0 + 40.0 + 20.0;  // B

/// What a few nodes were measured to need.
struct Costs {
  double bodies_per_m2 = 0.0, radius = 0.0;  ///< spread evenly; m
  double halo = 0.0, reach = 0.0;  ///< means of all nodes; from where zones are neighbours [m]
  double repeating = 0.0;          ///< part of the windows that a node does not accept at once
  double border_bytes = 0.0;       ///< per border body and window: claims and hand-over
  double message_bytes = 0.0;      ///< of a claim or hand-over without bodies, on average
  double verdict_bytes = 0.0;      ///< of a verdict in a bundle
  double record_bytes = 0.0;       ///< per own body and ghost, and window, for the standby
  double window_s = 0.0, message_s = 0.0, body_s = 0.0,
         ghost_s = 0.0;  ///< processor time per window, message sent, own body and ghost
};

/// Of one node in a window.
struct Need {
  double bodies = 0.0, ghosts = 0.0;  ///< own; of others
  double border = 0.0;                ///< own ones that others have, once for each of these
  double neighbours = 0.0;
  double messages = 0.0, bytes = 0.0;  ///< sent, without headers
  double received = 0.0, received_messages = 0.0;
  double processor_s = 0.0;
  double link_bytes() const { return bytes + received + headers * (messages + received_messages); }
};

inline peer::Box within(const peer::Box& box, const physics::Field& field) {
  return {std::max(box.low_x, 0.0), std::max(box.low_y, 0.0), std::min(box.high_x, field.length),
          std::min(box.high_y, field.width)};
}

/// Area of a place that two boxes share [m^2].
inline double shared_area(const peer::Box& a, const peer::Box& b) {
  const double along_x = std::min(a.high_x, b.high_x) - std::max(a.low_x, b.low_x),
               along_y = std::min(a.high_y, b.high_y) - std::max(a.low_y, b.low_y);
  return std::max(along_x, 0.0) * std::max(along_y, 0.0);
}

/// Rounds of claims and verdicts in a window: each node that does not accept adds one for all.
inline double rounds_of(const Costs& costs, std::size_t nodes) {
  return 2.0 - std::pow(1.0 - costs.repeating, static_cast<double>(nodes));
}

/// Adds what verdicts take in one round, by the tree or from each to each.
inline void add_agreement(std::vector<Need>& needs, const Costs& costs, double rounds,
                          std::size_t tree_from) {
  const std::size_t count = needs.size();
  const double head = count < tree_from ? 6.0 : 7.0;  // B: with the checksum
  const auto send = [&](std::size_t from, std::size_t to, std::size_t verdicts) {
    const double bytes = head + costs.verdict_bytes * static_cast<double>(verdicts);
    needs[from].messages += rounds, needs[from].bytes += rounds * bytes;
    needs[to].received_messages += rounds, needs[to].received += rounds * bytes;
  };
  if (count < tree_from) {
    for (std::size_t from = 0; from < count; ++from)
      for (std::size_t to = 0; to < count; ++to)
        if (to != from) send(from, to, 1);
    return;
  }
  const peer::VerdictTree tree(count);
  for (std::size_t place = 1; place < count; ++place) {
    send(place, tree.parent(place), tree.branch(place).size());
    send(tree.parent(place), place, count);
  }
}

/// Of each node; `tree_from` as of SessionSettings.
inline std::vector<Need> needs_of(const peer::Division& division, const physics::Field& field,
                                  const Costs& costs,
                                  std::size_t tree_from = peer::SessionSettings{}.tree_from) {
  const std::size_t count = division.peer_count();
  assert(count > 1 && costs.bodies_per_m2 > 0.0);
  const double rounds = rounds_of(costs, count);
  std::vector<peer::Box> zones;
  for (std::size_t node = 0; node < count; ++node)
    zones.push_back(within(division.zones_of(static_cast<peer::PeerNumber>(node)).front(), field));
  std::vector<Need> needs(count);
  for (std::size_t node = 0; node < count; ++node) {
    Need& need = needs[node];
    need.bodies = costs.bodies_per_m2 * shared_area(zones[node], zones[node]);
    for (std::size_t other = 0; other < count; ++other) {
      if (other == node) continue;
      const double seen = costs.halo + costs.radius, far = std::max(costs.halo, costs.reach);
      const double bodies =
          costs.bodies_per_m2 * shared_area(zones[node], zones[other].grown(seen));
      need.border += bodies, needs[other].ghosts += bodies;
      if (shared_area(zones[node].grown(far), zones[other].grown(far)) == 0.0) continue;
      const double messages = rounds + 1.0,
                   bytes = costs.border_bytes * bodies + costs.message_bytes * messages;
      need.neighbours += 1.0;
      need.messages += messages, need.bytes += bytes;
      needs[other].received_messages += messages, needs[other].received += bytes;
    }
  }
  add_agreement(needs, costs, rounds, tree_from);
  for (std::size_t node = 0; node < count; ++node) {
    Need& need = needs[node];
    const double record = costs.record_bytes * (need.bodies + need.ghosts);
    Need& standby = needs[(node + 1) % count];
    need.messages += 1.0, need.bytes += record;
    standby.received_messages += 1.0, standby.received += record;
  }
  for (Need& need : needs)
    need.processor_s = costs.window_s + costs.message_s * need.messages +
                       costs.body_s * need.bodies + costs.ghost_s * need.ghosts;
  return needs;
}

/// One-way delays that a window waits for: claims, agreement, hand-over.
inline double delays_of(std::size_t nodes, std::size_t tree_from) {
  return 2.0 +
         (nodes < tree_from ? 1.0 : 2.0 * static_cast<double>(peer::VerdictTree(nodes).depth()));
}

}  // namespace rink::bench::node_model
