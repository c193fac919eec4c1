// Zones as rectangles in their peers' colours, bodies of others as rings.
#include "game/view/overlays/zones_overlay.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>

namespace rink::view {
namespace {

using game::ZonesSeen;

constexpr std::array<Colour, 6> colours{{{0.80f, 0.30f, 0.20f},
                                         {0.15f, 0.45f, 0.85f},
                                         {0.20f, 0.60f, 0.25f},
                                         {0.70f, 0.55f, 0.05f},
                                         {0.55f, 0.25f, 0.70f},
                                         {0.10f, 0.60f, 0.60f}}};
constexpr Colour ghost{0.95f, 0.50f, 0.02f, 1.0f}, told{0.05f, 0.62f, 0.20f, 1.0f},
    own{0.80f, 0.05f, 0.75f, 1.0f};

/// The part of the field in the halo of a zone.
OverlayRectangle halo_of(const ZonesSeen::Zone& zone, double halo, const physics::Field& field) {
  return {std::max(0.0, zone.low_x - halo),
          std::max(0.0, zone.low_y - halo),
          std::min(field.length, zone.high_x + halo),
          std::min(field.width, zone.high_y + halo),
          clear,
          faded(ghost, 0.6f)};
}

void add_zones(const MatchSight& sight, const ZonesSeen& seen, Overlay& overlay) {
  for (const ZonesSeen::Zone& zone : seen.zones) {
    const Colour& colour = colours[zone.peer % colours.size()];
    overlay.rectangles.push_back({zone.low_x, zone.low_y, zone.high_x, zone.high_y,
                                  faded(colour, zone.peer == seen.own_peer ? 0.16f : 0.06f),
                                  faded(colour, 0.9f)});
  }
  for (const ZonesSeen::Zone& zone : seen.zones)
    if (zone.peer == seen.own_peer && seen.zones.size() > 1)
      overlay.rectangles.push_back(halo_of(zone, seen.halo, sight.field));
}

void add_lines(const ZonesSeen& seen, Overlay& overlay) {
  char words[160];
  std::snprintf(words, sizeof words, "peer %u has %llu bodies and %zu ghosts (orange), halo %.2f m",
                seen.own_peer, static_cast<unsigned long long>(seen.own_count), seen.ghosts.size(),
                seen.halo);
  overlay.lines.emplace_back(words);
  if (!seen.received.empty()) {
    std::snprintf(words, sizeof words, "its player is told of %zu beyond (green)",
                  seen.received.size());
    overlay.lines.emplace_back(words);
  }
  overlay.lines.emplace_back("I hides this");
}

}  // namespace

Overlay zones_overlay(const MatchSight& sight, bool is_shown) {
  Overlay overlay;
  if (!sight.zones) return overlay;
  const ZonesSeen& seen = *sight.zones;
  assert(std::ranges::is_sorted(seen.ghosts) && std::ranges::is_sorted(seen.received));
  if (is_shown) add_zones(sight, seen, overlay);
  for (const Thing& thing : sight.things) {
    const auto ring = [&](const Colour& colour, double room) {
      overlay.discs.push_back(
          {thing.position.x(), thing.position.y(), thing.half_extent.norm() + room, colour, false});
    };
    if (sight.own_thing == thing.id && !sight.own_team) ring(own, 0.06);
    if (is_shown && std::ranges::binary_search(seen.ghosts, thing.id)) ring(ghost, 0.02);
    if (is_shown && std::ranges::binary_search(seen.received, thing.id)) ring(told, 0.02);
  }
  if (is_shown) add_lines(seen, overlay);
  return overlay;
}

}  // namespace rink::view
