// The player that plays to win: it meets a puck from behind, at the instant and speed that send it
// into the opponents' goal.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "game/physics/flight/motion.h"
#include "game/players/steering.h"

namespace rink::game {

/// How good a chaser is.
struct Skill {
  std::uint32_t delay = 2;  ///< decisions from an observation to the key, at most Hands::delay_max;
                            ///< each takes decision_period
  double aim_error = 0.02;  ///< radius of the disc in which a puck's place is misjudged [m]
  double effort = 1.0;  ///< the part of the decisions at which keys are held at all, above 0 to 1
};

inline constexpr Skill beginner_skill{5, 0.06, 0.7}, club_skill{2, 0.02, 1.0},
    expert_skill{0, 0.0, 1.0};

/// Looks at the nearest pucks, extrapolates them and its bat by the closed forms of their motion
/// (straight under drag, folded at the side walls), and picks the puck, the instant and the speed
/// of the best shot that its acceleration allows. Without one it moves behind the nearest puck,
/// around it if needed, so as not to push it to its own goal; if it can reach none it guards its
/// goal. Where pucks may stay in a half for some time only, it counts the time from when it saw
/// one come, and sees no use in a shot that would not be over the line before.
class Chaser : public Player {
 public:
  Chaser(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed, const Skill& skill);
  KeysHeld decide(const PlayerView& view, double instant) override;
  std::uint32_t pucks_wanted() const override { return 4; }

 private:
  /// Contacts are sought at each of the next 10 decision instants, and at every second one of the
  /// 20 after them.
  static constexpr std::size_t fine_count = 10, coarse_count = 10;

  /// Motion within `ahead` [s]: of the bat from when keys take effect, of a puck from now.
  struct Span {
    double ahead, puck_ahead;
    physics::WarpedTime bat, puck;
  };
  /// The view of a player that attacks towards larger x.
  struct Sight {
    Vector2 bat, bat_velocity;  ///< when the keys of this decision take effect
    Vector2 puck, puck_velocity;
    double radius = 0.0;
    double left_s = 0.0;  ///< until the puck, which is in the own half, goes to the other side [s]
  };
  struct Shot {
    double value = 0.0;
    Vector2 push{0.0, 0.0};  ///< the acceleration that takes the bat there [m/s^2]
  };

  Vector2 turned(const Vector2& place) const {
    return attacks_right_ ? place : Vector2(rules_.field.length - place.x(), place.y());
  }
  Vector2 turned_velocity(const Vector2& velocity) const {
    return attacks_right_ ? velocity : Vector2(-velocity.x(), velocity.y());
  }
  void foresee_bat(const PlayerView& view, Sight& sight) const;
  physics::WarpedTime flight(const Vector2& puck_velocity, const Span& span) const;
  Sight sight_of(const SeenEntity& puck, const Sight& bat) const;
  std::optional<Shot> best_shot(const Sight& sight) const;
  std::optional<Shot> shot_at(const Sight& sight, const Span& span) const;
  double value_of(const Vector2& place, const Vector2& velocity, double radius) const;
  Vector2 place_behind(const Sight& sight) const;
  Vector2 place_to_guard(const Sight& sight) const;
  bool is_within_reach(const Sight& sight) const;
  KeysHeld keys_for(const PlayerView& view);
  void note_stays(const PlayerView& view, double instant);
  double left_s(std::uint32_t puck) const;
  bool is_too_late(const Sight& sight, const Span& span, const Vector2& place, double speed) const;
  KeysHeld keys_to(const Sight& sight, const Vector2& target) const;

  PlayerRules rules_;
  PlayerSeat seat_;
  Skill skill_;
  bool attacks_right_;
  Reach reach_;  ///< turned
  RandomStream random_;
  Hands hands_;
  std::array<Span, fine_count + coarse_count> spans_;
  physics::WarpedTime decision_;  ///< one decision_period, for the bat
  Span delay_;                    ///< the delay, for a puck
  std::uint32_t chased_ = 0;      ///< id of the puck that was chosen last
  bool is_chasing_ = false;
  Vector2 misjudged_{0.0, 0.0};
  struct Stay {
    std::uint32_t puck;
    double since;
  };
  std::vector<Stay> stays_;  ///< in the own half, of pucks that were seen there last
  double instant_ = 0.0;     ///< of this decision [s]
  std::uint32_t decisions_ = 0;
};

}  // namespace rink::game
