// The interface of a match for windows, its picture at one instant and its players' actions: the
// same for local, networked and recorded matches.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/match_flow.h"
#include "game/match/interest_seen.h"
#include "game/match/zones_seen.h"
#include "game/model/key.h"

namespace rink::game {

/// A body at its place to be drawn.
struct Thing {
  std::uint32_t id = 0;
  physics::BodyKind kind = physics::BodyKind::puck;
  Team team = Team::none;
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  Vector2 half_extent{0.0, 0.0};                   ///< m; both the radius for discs
  double spin = 0.0;                               ///< of a puck [rad/s]; 0 where it is not known
};

/// A sound to play.
struct Noise {
  enum class Kind : std::uint8_t {
    puck_on_wall,
    puck_on_bat,
    puck_on_post,
    puck_on_puck,
    count,
    face_off,
    goal,
    win
  };
  Kind kind = Kind::puck_on_wall;
  double strength = 1.0;                   ///< 0 to 1
  double place = 0.5;                      ///< along the field, 0 to 1
  Vector2 at{0.0, 0.0}, change{0.0, 0.0};  ///< of an impact: the puck's centre [m], and how its
                                           ///< velocity changed [m/s]
};

/// Figures of the connection; shown on request.
struct LinkFigures {
  double ping_ms = 0.0, jitter_ms = 0.0,
         loss = 0.0;  ///< `loss` is a fraction: of questions that had no answer within a second
  std::uint64_t tick = 0;            ///< ticks received
  double payload_bytes_per_s = 0.0;  ///< received, over the last second
  double lead_ms = 0.0;  ///< how far the own bat is shown ahead of the other (docs/play.md)
  std::uint64_t corrections = 0;  ///< of the own bat, that could be seen
  double last_correction_mm = 0.0;
};

/// All that is seen and heard after one call of advance().
struct MatchSight {
  double time = 0.0;  ///< simulated [s]
  physics::Field field;
  std::vector<Thing> things;
  Score score;
  std::optional<std::uint32_t> goals_to_win;
  std::string left_name = "left", right_name = "right";
  MatchPhase phase = MatchPhase::waiting;
  double remaining_s = 0.0;    ///< of countdown and away
  std::optional<Team> scorer;  ///< of the goal whose face-off is still to come
  double since_goal_s = 0.0;   ///< real seconds since then
  std::optional<Team>
      holder{};               ///< on whose side the puck is in the last seconds of its time there
  double possession_s = 0.0;  ///< until it goes to the other side [s]
  std::optional<Team> served{};  ///< the side that such a puck was just served to
  std::optional<Team> winner;
  std::optional<Team> own_team;  ///< of the player of this window, if it is one's own: the field is
                                 ///< seen from that end
  std::optional<std::uint32_t> own_thing;  ///< the id of the player's bat in a crowd
  bool can_rematch = true;                 ///< once it is over
  bool wants_rematch = false, other_wants_rematch = false;
  std::optional<double> interrupted_s{};  ///< for how long the host has said nothing [s], if it is
                                          ///< too long to play on
  std::string notice;                     ///< one line for the player, or nothing
  std::vector<Noise> noises;              ///< since the last advance
  std::optional<LinkFigures> link;        ///< of a match over a network
  std::optional<InterestSeen> interest;   ///< of a crowd that is inspected
  std::optional<ZonesSeen> zones;         ///< of a game that peers share
};

/// A running match. Knows no clock: `now_s` is real time [s] from any origin and never falls.
class MatchSource {
 public:
  virtual ~MatchSource() = default;

  /// Plays on to real time `now_s`; afterwards sight() is of that instant.
  virtual void advance(double now_s) = 0;
  virtual const MatchSight& sight() const = 0;

  /// The number of persons that play at this keyboard: 0 for watchers, 1 or 2. Person k's keys are
  /// passed to press() as hand k.
  virtual std::uint32_t hand_count() const = 0;
  /// Directions are those of the field: `right` is towards larger x. Takes effect at the instant of
  /// the next advance().
  virtual void press(std::uint32_t hand, Key key, bool is_down) = 0;
  /// Person `hand`'s pointer or stick is at `place` on the field [m] from the next advance() on,
  /// and a spring pulls the bat there (hand_spring.h); nothing: it is let go. Where the match takes
  /// keys alone it has no effect.
  virtual void reach(std::uint32_t, const std::optional<Vector2>&) {}
  /// Why it has none; empty where it has.
  virtual std::string why_keys_alone() const { return "Here bats are moved by keys alone"; }

  /// Pauses or resumes the match, if this player may.
  virtual void pause(bool is_wanted) = 0;
  /// Asks for another match once this one is over; it starts when all players have asked.
  virtual void rematch() = 0;

  /// A watcher of a crowd asks for interest management's decisions about this thing, or for none in
  /// particular; repeated as long as they are wanted.
  virtual void inspect(std::uint32_t) {}
};

}  // namespace rink::game
