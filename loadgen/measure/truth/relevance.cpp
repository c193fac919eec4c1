// Depth is signed, so that the instant of an entry can be found between two looks.
#include "loadgen/measure/truth/relevance.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "loadgen/measure/formatted.h"

namespace rink::loadgen {

double depth(const RelevanceArea& area, const Vector2& bat, const Vector2& centre,
             const Vector2& half_extent) {
  assert(area.shape == RelevanceArea::Shape::square || area.shape == RelevanceArea::Shape::disc);
  const Vector2 offset = centre - bat;
  if (area.shape == RelevanceArea::Shape::disc) return area.reach - offset.norm();
  return std::min(area.reach + half_extent.x() - std::abs(offset.x()),
                  area.reach + half_extent.y() - std::abs(offset.y()));
}

bool is_relevant_anywhere(const RelevanceArea& area, game::Team own, physics::BodyKind kind,
                          game::Team team) {
  return (area.has_team && kind == physics::BodyKind::bat && team == own &&
          own != game::Team::none) ||
         (area.always && area.always->has(kind));
}

std::string text_of(const RelevanceArea& area) {
  using Shape = RelevanceArea::Shape;
  const std::string square = formatted("square of %.3g m around the bat", 2.0 * area.reach);
  std::string words =
      area.shape == Shape::disc
          ? formatted("disc of radius %.3g m around the bat, holding the entity's centre",
                      area.reach)
      : area.shape == Shape::contact
          ? formatted("whoever can touch the bat within %.3g s, or a puck that can", area.contact_s)
      : area.shape == Shape::filter
          ? "whoever '" + area.expression + "' lets through, of a " + square
          : square + ", touched by the entity's box";
  if (area.has_team) words += ", or a bat of the player's team";
  if (!area.always) return words;
  std::string kinds;
  for (std::size_t kind = 0; kind < game::relevant_kind_names.size(); ++kind)
    if (area.always->has(static_cast<physics::BodyKind>(kind)))
      kinds += (kinds.empty() ? "" : " or ") + game::relevant_kind_names[kind];
  return words + ", or any " + kinds;
}

}  // namespace rink::loadgen
