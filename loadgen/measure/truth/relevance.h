// The definition of true relevance to a player: an area around its bat, and when an entity is in
// it.
#pragma once

#include <optional>
#include <string>

#include "game/net/relevant_kinds.h"
#include "game/physics/body.h"

namespace rink::loadgen {

using physics::Vector2;

/// `square`: an entity whose bounding box touches the closed square of half side `reach` around the
/// bat's true centre. `disc`: one whose centre is at most `reach` from it. `contact`: one that can
/// touch the bat, or a puck that can touch it, within `contact_s`
/// (loadgen/measure/truth/encounters.h). `filter`: one that `expression` lets through, with that
/// square as the subscription (loadgen/measure/truth/filter_relevance.h).
struct RelevanceArea {
  enum class Shape : std::uint8_t { square, disc, contact, filter };
  Shape shape = Shape::square;
  double reach = 1.0;     ///< m, above 0
  bool has_team = false;  ///< bats of the player's side are relevant as well, wherever they are,
  std::optional<game::RelevantKinds> always{};  ///< and so are entities of these kinds
  double contact_s = 0.5;                       ///< of `contact`, above 0
  std::string expression{};  ///< of `filter`: one in which im::fault_in_momentary finds nothing
  game::RelevantKinds always_by_role{};  ///< the kinds that its scheme `always` lets through
};

/// True if `area` makes an entity of that kind and team relevant to a player of `own` team wherever
/// both are.
bool is_relevant_anywhere(const RelevanceArea& area, game::Team own, physics::BodyKind kind,
                          game::Team team);

/// How deep an entity is within the square or disc (asserted) around a bat at `bat` [m]: relevant
/// from 0 on, negative outside.
double depth(const RelevanceArea& area, const Vector2& bat, const Vector2& centre,
             const Vector2& half_extent);

/// The area in words, e.g. "square of 3.16 m around the bat, touched by the entity's box", with the
/// whole side, or the radius.
std::string text_of(const RelevanceArea& area);

}  // namespace rink::loadgen
