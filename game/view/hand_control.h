// Where a player's hand is: by the pointer, or by a gamepad's stick.
#pragma once

#include <optional>
#include <string>

#include "game/view/match_source.h"
#include "game/view/window/window_event.h"

namespace rink::view {

/// The deflection of a stick beyond its dead zone: 0 within it, 1 at the rim, in its direction.
/// `deflection` is from -1 to 1 along each axis, `dead_zone` from 0 to 0.9.
Vector2 beyond_dead_zone(const Vector2& deflection, double dead_zone);

/// Notes what pointer and stick say. Where the pointer is on the table depends on the camera, which
/// the caller knows.
class HandControl {
 public:
  /// m: so far from its bat a stick at the rim, at sensitivity 1, holds the hand.
  static constexpr double stick_reach = 0.35;
  static constexpr double shown_s = 6.0;  ///< words stay so long

  void hear(const WindowEvent& event);

  /// Where the pointer is in the window [pixels]; nothing before it was seen.
  const std::optional<Vector2>& pointer() const { return pointer_; }
  /// Where a script has put the hand on the table [m].
  const std::optional<Vector2>& on_table() const { return on_table_; }
  /// The place of the hand [m] of the bat at `bat` in a match on `field`, if the pointer is at
  /// `under` of the table; nothing if `settings` want keys, or what they want is not there.
  /// `right` and `up` are the screen's directions on the field.
  struct Table {
    physics::Field field;
    Vector2 bat, under, right, up;
  };
  std::optional<Vector2> place(const Settings& settings, const Table& table) const;

  /// What to tell the player at `now_s` about the chosen control, and whether it is new; empty most
  /// of the time. `why_keys_alone` as MatchSource's.
  struct Words {
    std::string text;
    bool is_new = false;
  };
  Words words(const Settings& settings, const std::string& why_keys_alone, double now_s);

 private:
  std::string trouble(const Settings& settings, const std::string& why_keys_alone) const;

  std::optional<Vector2> pointer_, on_table_;
  Vector2 stick_{0.0, 0.0};
  bool has_gamepad_ = false, had_gamepad_ = false;
  std::string said_;
  double said_s_ = 0.0;
};

}  // namespace rink::view
