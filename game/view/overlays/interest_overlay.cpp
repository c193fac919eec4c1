// Draws regions as frames and things as rings, coloured by their relation to the inspected thing.
#include "game/view/overlays/interest_overlay.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <vector>

#include "game/view/picture_of.h"

namespace rink::view {
namespace {

using game::InterestSeen;

constexpr Colour heard{0.05f, 0.62f, 0.20f, 1.0f}, hearing{0.95f, 0.50f, 0.02f, 1.0f},
    asked_of{0.80f, 0.05f, 0.75f, 1.0f};
constexpr float faint = 0.30f;

OverlayDisc ring(const Thing& thing, const Colour& colour, double room) {
  return {thing.position.x(), thing.position.y(), thing.half_extent.norm() + room, colour, false};
}

OverlayRectangle frame(const InterestSeen::View& view, const Colour& fill, const Colour& outline) {
  return {static_cast<double>(view.low_x),
          static_cast<double>(view.low_y),
          static_cast<double>(view.high_x),
          static_cast<double>(view.high_y),
          fill,
          outline};
}

/// In order of their ids, which does not change from frame to frame.
std::vector<const Thing*> bats_of(const MatchSight& sight) {
  std::vector<const Thing*> bats;
  for (const Thing& thing : sight.things)
    if (thing.kind == physics::BodyKind::bat) bats.push_back(&thing);
  std::ranges::sort(bats, {}, &Thing::id);
  return bats;
}

/// Adds every region; those of players that receive the thing, and that of its own player, above
/// the others.
void add_views(const InterestSeen& seen, Overlay& overlay) {
  const auto add = [&](const auto& is_wanted, const Colour& fill, const Colour& outline) {
    for (const InterestSeen::View& view : seen.views)
      if (is_wanted(view)) overlay.rectangles.push_back(frame(view, fill, outline));
  };
  const auto is_own = [&](const InterestSeen::View& view) { return view.bat == seen.asked; };
  add([&](const InterestSeen::View& view) { return !view.hears && !is_own(view); }, clear,
      {0.25f, 0.30f, 0.42f, faint});
  add([&](const InterestSeen::View& view) { return view.hears && !is_own(view); }, clear,
      faded(hearing, 0.85f));
  add(is_own, faded(heard, 0.14f), heard);
}

void add_rings(const MatchSight& sight, const InterestSeen& seen, Overlay& overlay) {
  const auto hears = [&](const Thing& thing) {
    return thing.kind == physics::BodyKind::bat &&
           std::ranges::any_of(seen.views, [&](const InterestSeen::View& view) {
             return view.hears && view.bat == thing.id;
           });
  };
  for (const Thing& thing : sight.things) {
    if (thing.id == seen.asked) overlay.discs.push_back(ring(thing, asked_of, 0.08));
    else if (std::ranges::binary_search(seen.heard, thing.id))
      overlay.discs.push_back(ring(thing, heard, 0.02));
    if (thing.id != seen.asked && hears(thing)) overlay.discs.push_back(ring(thing, hearing, 0.08));
  }
}

/// Counts are complete, while the lists may be cut to a message's size. Players are counted by
/// their regions, since some bats have none.
void add_lines(const MatchSight& sight, const InterestSeen& seen, const Thing& asked,
               Overlay& overlay) {
  char words[160];
  const auto line = [&] { overlay.lines.emplace_back(words); };
  if (seen.cell_size > 0.0f)
    std::snprintf(words, sizeof words, "grid: cells of %.3g m, regions of %u players",
                  static_cast<double>(seen.cell_size), seen.view_count);
  else std::snprintf(words, sizeof words, "regions of %u players", seen.view_count);
  line();
  const bool is_bat = asked.kind == physics::BodyKind::bat;
  std::snprintf(words, sizeof words, "%s %u (purple): %u of %u players hear of it (orange)",
                is_bat                                  ? "bat"
                : asked.kind == physics::BodyKind::puck ? "puck"
                                                        : "post",
                asked.id, seen.hearer_count, seen.view_count);
  line();
  if (!is_bat) return;
  const bool are_all_shown = seen.views.size() == seen.view_count;
  if (are_all_shown &&
      std::ranges::find(seen.views, asked.id, &InterestSeen::View::bat) == seen.views.end()) {
    overlay.lines.emplace_back("nobody plays it");
    return;
  }
  std::snprintf(words, sizeof words, "its player hears of %u of %zu bodies (green)",
                seen.heard_count, sight.things.size());
  line();
}

}  // namespace

const Thing* asked_thing(const MatchSight& sight, const InterestChoice& choice) {
  if (choice.picked) {
    const auto found = std::ranges::find(sight.things, *choice.picked, &Thing::id);
    if (found != sight.things.end()) return &*found;
  }
  const std::vector<const Thing*> bats = bats_of(sight);
  return bats.empty() ? nullptr : bats[choice.chosen % bats.size()];
}

std::optional<std::uint32_t> thing_at(const MatchSight& sight, const Vector2& place, double reach) {
  assert(reach >= 0.0);
  std::optional<std::uint32_t> found;
  for (const Thing& thing : sight.things) {
    const double gap =
        ((thing.position - place).cwiseAbs() - thing.half_extent).cwiseMax(0.0).norm();
    if (gap > reach) continue;
    reach = gap;
    found = thing.id;
  }
  return found;
}

Overlay interest_overlay(const MatchSight& sight, const InterestChoice& choice) {
  Overlay overlay;
  if (!choice.is_shown || !sight.interest) return overlay;
  const InterestSeen& seen = *sight.interest;
  overlay.cell_size = static_cast<double>(seen.cell_size);
  add_views(seen, overlay);
  add_rings(sight, seen, overlay);
  const auto asked = std::ranges::find(sight.things, seen.asked, &Thing::id);
  if (asked != sight.things.end()) add_lines(sight, seen, *asked, overlay);
  overlay.legend = {{asked_of, "the body that is asked of"},
                    {hearing, "players that are sent it"},
                    {heard, "its player's region, and what that player is sent"},
                    {{0.25f, 0.30f, 0.42f, 1.0f}, "regions of the others"}};
  if (overlay.cell_size > 0.0) overlay.legend.push_back({overlay.cell_colour, "cells of the grid"});
  overlay.lines.emplace_back("Tab or a click asks of another, I hides this");
  return overlay;
}

}  // namespace rink::view
