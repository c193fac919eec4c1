// What all peers of a session agree on with a window's verdicts: members, zones, goals and
// newcomers of the next step. Pure: the same state and verdicts give the same at every peer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "game/peer/session/session_settings.h"
#include "game/peer/session/session_state.h"
#include "game/peer/window/accusation.h"
#include "game/peer/window/window_verdicts.h"

namespace rink::peer {

class Agreement {
 public:
  /// Both must outlive it.
  Agreement(const SessionSettings& settings, const Whole& whole)
      : settings_(settings), whole_(whole) {}

  /// The state at `time` [s], where the stretch from `now` on has ended with these verdicts. New
  /// members get a zone, those that want to leave hand theirs over, and those without a zone in
  /// this stretch are dropped. Whoever counts a goal that cannot be, or of a puck that by `roles`
  /// is another's, is reported; then the state is of no use.
  State next(const State& now, const WindowVerdicts& verdicts, const Roles& roles, double time,
             Accusation& accusation) const;
  /// The end of the next stretch [s]: a window is cut where a puck comes back. `state` is that at
  /// the start of the stretch, where due pucks come back.
  double stretch_end(const State& state) const;
  /// True after the last window, or after that in which a side has won.
  bool is_complete(const State& state) const;
  /// True if the member `teller` can let the own peer enter with this state, as far as that shows.
  bool may_be_entry(const State& state, PeerNumber teller) const;
  /// The reason why a newcomer cannot be a candidate at the step that leads to `next`.
  std::optional<std::string> objection(const State& next, const Newcomer& newcomer) const;

 private:
  bool is_in_time(const State& state) const;
  /// A step that is being decided.
  struct Step {
    const State& now;
    const WindowVerdicts& verdicts;
    State& next;
  };
  void count_goals(const Step& step, const Roles& roles, Accusation& accusation) const;
  static void give_zones(const Step& step);
  static void let_go(const Step& step);
  void admit(const Step& step) const;
  void add_candidates(const Step& step) const;
  void balance(const Step& step) const;

  const SessionSettings& settings_;
  const Whole& whole_;
};

}  // namespace rink::peer
