// What a session is to play, and what it needs to know of all bodies.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "game/peer/protocol.h"
#include "game/peer/session/scoring.h"
#include "game/peer/session/session_state.h"
#include "game/peer/standby/part_replay.h"
#include "game/peer/standby/standby_feed.h"
#include "game/peer/start.h"

namespace rink::peer {

/// For callers of a replicated session who keep more than the session does. All are set, or none:
/// then Session::advance and Session::end return after a recovery, before a window is played.
struct LossHooks {
  /// This peer stands in for `lost`, and had its part at the step to which all go back; `keys` of
  /// live players took effect there in the stretch that led to that step. Called at each attempt.
  std::function<void(PeerNumber lost, const Part& part, std::span<const Key> keys)>
      when_taken_over{};
  /// The own part is another from now on: players who took seats since the start are to be seated
  /// again. Nothing of it was said to others yet.
  std::function<void(Peer&)> when_entered{};
  /// All have gone back to the same step, and go on. `pending` are the keys of live players, on all
  /// bats, that are still to take effect; all others that took none so far are forgotten.
  std::function<void(std::span<const Key> pending)> when_recovered{};

  bool are_set() const { return when_recovered != nullptr; }
};

/// Equal for all peers but for `number`; newcomers ignore `peer_count`, `players` and `halo`.
struct SessionSettings {
  PeerNumber number = 0, peer_count = 1;  ///< the number of first peers
  double halo = 1.0;                      ///< where it begins [m]
  bool is_replicated = true;              ///< whether each part is kept by another peer,
                                          ///< too; otherwise a loss ends all
  StandbyLimits standby{};                ///< of those copies
  std::uint64_t window_count = 1;
  std::function<double(std::uint64_t)> end_of;  ///< window 1, 2, ..., `window_count` + 1 [s]
  std::uint32_t balance_windows = 0;  ///< period [windows] in which zones shift toward equal events
                                      ///< per peer; 0: they stay
  std::vector<Key> keys{};            ///< that all know from the start, of all bats
  std::optional<GoalRules> goals{};  ///< of a field that has some; windows must be shorter than the
                                     ///< delay and the retry. The session is over with the window
                                     ///< in which a side wins.
  std::vector<Player> players{};     ///< of the first peers
  std::uint32_t bat_count = 0;       ///< that can be played
  bool takes_latecomers = false;     ///< bats may be seated that none of `players` has
  bool keeps_to_neighbours = true;   ///< otherwise claims and handovers go to all members, so that
                                     ///< what is sent beside them stays in order with all
  /// From so many members on verdicts go up and down a tree instead of from each to each, where
  /// members keep to neighbours (docs/peer-to-peer.md, "Agreement"). Equal for all.
  std::size_t tree_from = 16;
  bool agrees_by_tree(std::size_t member_count) const {
    return keeps_to_neighbours && member_count >= tree_from && member_count <= members_max;
  }
  std::function<std::vector<Seat>(const Player&)> seats_of{};
  WindowHooks hooks{};  ///< for callers; `when_final` is the session's own
  /// Called, if not empty, when a window, or a stretch of one that is cut, is final, and the next
  /// is prepared: the peer's change is that of the stretch, with the pucks that came back at its
  /// end.
  std::function<void()> when_committed{};
  LossHooks losses{};
  /// If not empty: true if the session is over after this window, won or not, of which all peers
  /// must know before they play it; not of a replicated session, which may undo it.
  std::function<bool(std::uint64_t window)> is_stopped{};
};

/// Data about all bodies that a session needs.
struct Whole {
  physics::WorldSpec spec;
  std::uint32_t body_count = 0;
  std::vector<double> puck_radii{};  ///< m, by body, 0 for others than pucks; empty without
                                     ///< goals, when others' pucks do not matter
  static Whole of(const Start& start);
  bool has_puck(std::uint32_t body) const {
    return body < puck_radii.size() && puck_radii[body] > 0.0;
  }
};

}  // namespace rink::peer
