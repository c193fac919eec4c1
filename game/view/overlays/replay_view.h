// A recorded match: a bar to seek in, what the players do, and how fast the pucks are.
#pragma once

#include <optional>
#include <vector>

#include "game/match/replay_match.h"
#include "game/view/match_source.h"
#include "game/view/picture_of.h"
#include "game/view/render/picture.h"
#include "game/view/window/window_event.h"

namespace rink::view {

/// The bar along the lower edge, with a mark for each goal that was seen.
class ReplayBar {
 public:
  static constexpr double left = 0.08, right = 0.92, middle = 0.945, reach = 0.03;

  /// Takes up goals.
  void look(const game::ReplayMatch& replay);
  /// Into the words over the picture.
  void add_to(const game::ReplayMatch& replay, const Palette& palette, Picture& words) const;
  /// The instant [s] to go to where the event asks for one.
  std::optional<double> hear(const WindowEvent& event, const WindowSize& size, double end_s);
  bool is_held() const { return is_held_; }
  void let_go() { is_held_ = false; }

 private:
  struct Goal {
    double time;
    game::Team team;
  };
  std::vector<Goal> goals_;
  game::Score score_;
  double x_ = 0.0, y_ = 0.0, time_ = 0.0;  ///< of the pointer, in parts of the window; of the sight
  bool is_held_ = false;
};

/// Each bat's thrust as bars at the sides that it is pushed to, the whole of it as wide as the
/// bat's shorter half side.
void add_inputs(const game::ReplayMatch& replay, const Palette& palette, Overlay& overlay);

/// The speed of each puck beside it, in a window seen by `choice`.
void add_speeds(const MatchSight& sight, const ViewChoice& choice, double aspect, Picture& words);

}  // namespace rink::view
