// Turns a match's sight into a picture: a pure function.
#pragma once

#include "game/view/match_source.h"
#include "game/view/palette.h"
#include "game/view/render/picture.h"

namespace rink::view {

/// The place from which a match is seen.
enum class Viewpoint : std::uint8_t { left_end, right_end, side, above };

/// The player's choice of the view.
struct ViewChoice {
  Viewpoint viewpoint = Viewpoint::side;
  double zoom = 1.0;          ///< from above: 1 shows the whole field, more shows less of it
  Vector2 centre{0.5, 0.5};   ///< from above: the point in the middle, as a part of the field
  bool shows_link = false;    ///< figures of the connection
  double frames_per_s = 0.0;  ///< shown with them
  PaletteKind palette = PaletteKind::standard;
  bool has_effects = true;  ///< what is fast has a streak
};

/// Players of a network match have no names: one is you. Teams without a name are called by their
/// colour.
std::string name_of(const MatchSight& sight, game::Team team, const Palette& palette);

/// `aspect` is width by height of the window.
Camera camera_of(const physics::Field& field, const ViewChoice& choice, double aspect);

/// `overlay` is drawn over the table unchanged.
Picture picture_of(const MatchSight& sight, const Overlay& overlay, const ViewChoice& choice,
                   double aspect);

/// The field's key for a player's key seen from `viewpoint`: forward is away from the player.
game::Key seen_from(Viewpoint viewpoint, game::Key key);

}  // namespace rink::view
