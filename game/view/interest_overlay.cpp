// Squares around bats, and rings around what is in one of them.
#include "game/view/interest_overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "game/net/view.h"
#include "game/view/picture_of.h"

namespace rink::view {
namespace {

constexpr Colour received{0.10f, 0.72f, 0.25f, 1.0f};

Colour faded(Colour colour, float alpha) {
  colour.alpha = alpha;
  return colour;
}

OverlayRectangle view_of(const Thing& bat, double half_side, bool is_chosen) {
  const Colour colour = is_chosen ? received : colour_of(bat.team);
  return {bat.position.x() - half_side, bat.position.y() - half_side, bat.position.x() + half_side, bat.position.y() + half_side, faded(colour, is_chosen ? 0.20f : 0.0f),
          faded(colour, is_chosen ? 1.0f : 0.22f)};
}

bool is_in(const Thing& thing, const Thing& bat, double half_side) {
  const Vector2 gap = (thing.position - bat.position).cwiseAbs() - thing.half_extent;
  return gap.maxCoeff() <= half_side;
}

/// In order of their ids, which does not change from frame to frame.
std::vector<const Thing*> bats_of(const MatchSight& sight) {
  std::vector<const Thing*> bats;
  for (const Thing& thing : sight.things)
    if (thing.kind == physics::BodyKind::bat) bats.push_back(&thing);
  std::ranges::sort(bats, {}, &Thing::id);
  return bats;
}

}  // namespace

const Thing* chosen_bat(const MatchSight& sight, const InterestChoice& choice) {
  const std::vector<const Thing*> bats = bats_of(sight);
  return bats.empty() ? nullptr : bats[choice.chosen % bats.size()];
}

Overlay interest_overlay(const MatchSight& sight, const InterestChoice& choice) {
  Overlay overlay{.cell_size = choice.cell_size, .rectangles = {}, .discs = {}, .lines = {}};
  const std::vector<const Thing*> bats = bats_of(sight);
  char words[120];
  if (choice.cell_size > 0.0) {
    std::snprintf(words, sizeof words, "cells of %g m", choice.cell_size);
    overlay.lines.push_back(words);
  }
  if (choice.view_fraction <= 0.0 || bats.empty()) return overlay;
  const double half_side = game::view_half_side(0.0, choice.view_fraction, sight.field.length, sight.field.width);
  const Thing& chosen = *bats[choice.chosen % bats.size()];
  for (const Thing* bat : bats)
    if (bat != &chosen) overlay.rectangles.push_back(view_of(*bat, half_side, false));
  overlay.rectangles.push_back(view_of(chosen, half_side, true));
  std::size_t count = 0;
  for (const Thing& thing : sight.things) {
    if (&thing == &chosen || !is_in(thing, chosen, half_side)) continue;
    ++count;
    overlay.discs.push_back({thing.position.x(), thing.position.y(), thing.half_extent.norm() + 0.02, received, false});
  }
  std::snprintf(words, sizeof words, "bat %u of %zu receives %zu of %zu   (Tab: the next)", choice.chosen % static_cast<unsigned>(bats.size()) + 1, bats.size(), count, sight.things.size());
  overlay.lines.push_back(words);
  return overlay;
}

}  // namespace rink::view
