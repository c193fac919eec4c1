// What is hard in the scenes that peers share, counted where it occurs: a class that no scene has
// was not tested.
#pragma once

#include <algorithm>
#include <ostream>
#include <set>
#include <vector>

#include "game/peer/assembly.h"

namespace rink::peer::test {

/// Of scenes, unless it says otherwise.
struct SceneClasses {
  std::uint64_t dense = 0;  ///< discs cover 0.6 of the field or more
  double packing_max = 0.0;
  std::uint64_t rows_across_borders = 0;  ///< discs that touch, directly or through others, belong
                                          ///< to three peers or more: cradles, racks
  std::uint64_t ties = 0;                 ///< 64 events or more at one instant
  std::uint64_t bullets = 0,
                bullet_crossings =
                    0;        ///< a body of 50 m/s or more; how often such a one changed its owner
  std::uint64_t unequal = 0;  ///< masses differ 500 times or more
  std::uint64_t drag = 0, friction = 0, rough = 0, goals = 0, keys_at_once = 0;
  std::uint64_t groups_across_borders = 0,
                groups_across_three = 0;  ///< bodies in rest contact or in a jam with those of
                                          ///< others, counted by body and window
  std::uint64_t long_runs = 0;            ///< of 3,000 windows
  std::set<PeerNumber> peer_counts;

  SceneClasses& operator+=(const SceneClasses& o) {
    dense += o.dense, rows_across_borders += o.rows_across_borders, ties += o.ties,
        bullets += o.bullets, bullet_crossings += o.bullet_crossings, unequal += o.unequal;
    drag += o.drag, friction += o.friction, rough += o.rough, goals += o.goals,
        keys_at_once += o.keys_at_once, long_runs += o.long_runs;
    groups_across_borders += o.groups_across_borders, groups_across_three += o.groups_across_three;
    packing_max = std::max(packing_max, o.packing_max);
    peer_counts.insert(o.peer_counts.begin(), o.peer_counts.end());
    return *this;
  }
};

inline std::ostream& operator<<(std::ostream& out, const SceneClasses& c) {
  out << "scenes dense to " << c.packing_max << ": " << c.dense
      << ", with rows over three peers: " << c.rows_across_borders
      << ", 64 events at an instant: " << c.ties << ", bullets: " << c.bullets << " ("
      << c.bullet_crossings << " crossings), masses 500 apart: " << c.unequal
      << ", drag: " << c.drag << ", friction: " << c.friction << ", rough: " << c.rough
      << ", goals: " << c.goals << ", keys at one instant: " << c.keys_at_once
      << ", 3,000 windows: " << c.long_runs
      << "; bodies and windows in groups across a border: " << c.groups_across_borders
      << ", over three peers: " << c.groups_across_three << "; peers:";
  for (const PeerNumber count : c.peer_counts) out << ' ' << count;
  return out;
}

/// Whether discs that touch hang together across three zones of different peers or more.
inline bool has_row_across_borders(const physics::World& world, const Division& division) {
  std::vector<std::uint32_t> leaders(world.body_count());
  const auto leader = [&](std::uint32_t body) {
    while (leaders[body] != body) body = leaders[body];
    return body;
  };
  for (std::uint32_t body = 0; body < leaders.size(); ++body) leaders[body] = body;
  for (std::uint32_t a = 0; a < leaders.size(); ++a)
    for (std::uint32_t b = a + 1; b < leaders.size(); ++b)
      if (world.kind({a}) == physics::BodyKind::puck &&
          world.kind({b}) == physics::BodyKind::puck &&
          (world.position({a}) - world.position({b})).norm() <
              world.radius({a}) + world.radius({b}) + 1e-12)
        leaders[leader(b)] = leader(a);
  std::vector<std::set<PeerNumber>> owners(leaders.size());
  for (std::uint32_t body = 0; body < leaders.size(); ++body)
    owners[leader(body)].insert(division.owner_of(world.position({body})));
  return std::any_of(owners.begin(), owners.end(),
                     [](const auto& of_one) { return of_one.size() >= 3; });
}

/// Of the scene as it begins.
inline SceneClasses classes_of(const physics::World& world, const Division& division,
                               const std::vector<Key>& keys) {
  SceneClasses found;
  double covered = 0.0, mass_min = 1e300, mass_max = 0.0, speed_max = 0.0;
  for (std::uint32_t body = 0; body < world.body_count(); ++body) {
    if (world.kind({body}) != physics::BodyKind::puck) continue;
    covered += 3.141592653589793 * world.radius({body}) * world.radius({body});
    mass_min = std::min(mass_min, world.mass({body})),
    mass_max = std::max(mass_max, world.mass({body}));
    speed_max = std::max(speed_max, world.velocity({body}).norm());
  }
  const physics::WorldSpec& spec = world.spec();
  found.packing_max = covered / (spec.field.length * spec.field.width);
  found.dense = found.packing_max >= 0.6, found.bullets = speed_max >= 50.0,
  found.unequal = mass_max >= 500.0 * mass_min;
  found.drag = spec.puck_drag > 0.0, found.friction = spec.puck_friction > 0.0,
  found.rough = spec.surface_friction.has_value(), found.goals = spec.field.goal_width > 0.0;
  found.rows_across_borders = has_row_across_borders(world, division);
  found.keys_at_once = std::adjacent_find(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
                         return a.time == b.time && a.bat != b.bat;
                       }) != keys.end();
  return found;
}

/// Adds what a window's end shows: `groups` as the peers have them.
inline void note_groups(SceneClasses& found, const Peer& peer, const Division& division) {
  for (const std::uint32_t body : peer.owned()) {
    if (!peer.world().is_held({body})) continue;
    std::set<PeerNumber> owners;
    for (const std::uint32_t companion : peer.share().subdomain().group_of(body))
      owners.insert(division.owner_of(peer.world().position({companion})));
    found.groups_across_borders += owners.size() >= 2,
        found.groups_across_three += owners.size() >= 3;
  }
}

}  // namespace rink::peer::test
