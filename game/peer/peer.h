// One of the peers that share a simulation: it owns the bodies in its zones, plays them window by
// window among ghosts of their neighbours, and proves each window right.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/messages.h"
#include "game/peer/standby/part_log.h"
#include "game/peer/validation.h"
#include "game/peer/window/annexes.h"
#include "game/peer/window/claim_check.h"
#include "game/peer/window/claim_trace.h"
#include "game/peer/window/handovers.h"
#include "game/peer/window/live_players.h"
#include "game/peer/window/part_changes.h"
#include "game/peer/window/window_verdicts.h"

namespace rink::peer {

/// Counts of a peer since it was made.
struct PeerCounters {
  std::uint64_t windows = 0, repeats = 0;          ///< final windows, and repetitions
  std::uint64_t own_events = 0, ghost_events = 0;  ///< in final windows: events with own bodies,
                                                   ///< and without
  std::uint64_t hand_overs = 0;                    ///< bodies that left for another owner
  std::uint64_t held_max = 0;  ///< the most bodies at a window's start, own ones and ghosts; of
                               ///< several peers, the busiest one's
  std::uint64_t ghost_windows = 0;   ///< ghosts held, summed over the windows
  std::uint64_t border_windows = 0;  ///< own bodies that another peer has as ghosts, summed over
                                     ///< the windows, each counted once per such peer
  std::uint64_t arrival_bytes = 0, claim_bytes = 0, verdict_bytes = 0;  ///< sent

  PeerCounters& operator+=(const PeerCounters& other);
};

/// The protocol in its order (docs/peer-to-peer.md). All call `play`; then each makes claims for
/// neighbour, receives those of its neighbours, judges, and receives all verdicts; `conclude` then
/// returns the same to all. `final`: each makes a handover for each neighbour and watcher, receives
/// theirs, and commits. `repeat`: each makes a handover for those that repeat, these receive them
/// and call `replay`, and all continue with claims. Knows no network and no clock.
///
/// Each subject has a class of its own; what is here is the order in which they act.
class Peer {
 public:
  /// `halo` [m] is the first width of the halo.
  Peer(const physics::WorldSpec& spec, const Division& division, PeerNumber number,
       std::uint32_t body_count, double halo);

  /// Call it at the start, before the first window, for every body of the whole: takes own bodies
  /// and those in the halo.
  void consider(std::uint32_t body, const BodyState& state);
  /// Replaces `consider` to begin at a later window: its number and start [s], and parts of the
  /// whole, with all own bodies, those in the halo, and those in rest contact with them.
  void enter(std::uint32_t window, double start, std::span<const Handover> parts);
  /// Call it next; the first window ends at `until` [s].
  void begin(double until);

  /// Between windows: sets which peers play on. The others have no zones, and nothing is expected
  /// of them.
  void set_present(PeerNumber peer, bool is_present) { halos_.set_present(peer, is_present); }
  /// Goes into the next verdicts, until changed: whether the peer wishes to leave, and news of
  /// newcomers.
  void announce(bool leaves, Admission admission) {
    leaves_ = leaves, admission_ = std::move(admission);
  }
  /// After `conclude` returned final, before the handovers: changes the zones from the window's end
  /// on, perhaps for more peers, which are not present yet. Equal at all peers.
  void divide(const Division& division);
  /// Makes `change` list the changes of each commit; the first one, after `begin`, lists all.
  void keep_changes() { changes_.begin(); }
  /// The change of the own part since the last window, or all of it if `is_whole`; its step is left
  /// out.
  PartChange change(bool is_whole) const { return changes_.change(share_, keys_, is_whole); }
  /// What a standby must know of the own part.
  PartLog& part_log() { return part_log_; }
  /// After a commit: puts a scored puck, with its owner's state, back in play at `place`, which is
  /// free at all peers.
  void put_back(const Handover::Body& scored, const Vector2& place);

  /// Adds a key of an own bat before the first window.
  void press_first(const Key& key) { keys_.add(key); }
  LivePlayers& players() { return players_; }
  const LivePlayers& players() const { return players_; }
  /// The observations for own players, since the last commit.
  const std::vector<Observation>& observations() const { return players_.observations(); }
  /// The end of the next window [s].
  double end() const { return window_.end; }
  /// Keys of live players that took effect on own bats in the last window, in order.
  const std::vector<Key>& log() const { return keys_.log(); }

  /// As Share::follow().
  friend void follow(Peer& peer, const physics::Halves& halves) { peer.share_.follow(halves); }
  void play();
  Claims claims_for(PeerNumber peer);
  /// Checks all messages by `validator` from now on. An invalid one is dropped, and its sender is
  /// reported.
  void validate_by(Validator validator) { validator_ = std::move(validator); }
  /// As Halos::keep_to_neighbours: claims and handovers go to neighbours, and come from them.
  void keep_to_neighbours(bool is_late) { halos_.keep_to_neighbours(is_late); }
  void receive(PeerNumber from, Claims claims);
  /// As LivePlayers::receive_early; also of own players, and at any time.
  void receive(PeerNumber from, std::span<const Press> presses);
  const Verdict& judge();
  /// Why another peer's verdict cannot be on the run just played, or cannot be true; empty if it
  /// can.
  std::string fault_of(const Verdict& verdict) const;
  void receive(PeerNumber from, const Verdict& verdict);
  Outcome conclude();
  const WindowVerdicts& verdicts() const { return verdicts_; }

  /// For a repetition; or for the next window, which ends at `until` [s].
  Handover handover_for(PeerNumber peer);
  Handover handover_for(PeerNumber peer, double until);
  void receive(PeerNumber from, Handover handover);
  void replay();
  void commit(double until);
  /// After a commit, and before anything is played: shortens the prepared window to this end [s].
  void end_at(double until);

  PeerNumber number() const { return halos_.number(); }
  /// Own bodies and ghosts; between the handovers and the commit also what others will have.
  const Share& share() const { return share_; }
  double now() const { return world().now(); }
  const std::vector<std::uint32_t>& owned() const { return share_.roles().owned(); }
  const std::vector<std::uint32_t>& ghosts() const { return share_.roles().ghosts(); }
  /// A place where the body certainly was: at the end of the judged window, or at its start if it
  /// is a ghost whose owner claims another path. After a commit, its present place.
  Vector2 known_place(std::uint32_t body) const;
  const physics::PartWorld& world() const { return share_.world(); }
  const Halos& halos() const { return halos_; }
  const PeerCounters& counters() const { return counters_; }
  /// The reason why another peer's message cannot be true, naming the peer.
  const Accusation& accusation() const { return accusation_; }

  /// At a window's start: asserts that every body has one role, and that others' ghosts of own
  /// bodies are own bodies.
  void check() const;

 private:
  void settle(std::vector<std::uint32_t> candidates);

  /// Bodies and contacts that were taken, until the first window begins.
  struct Entered {
    std::vector<std::uint32_t> bodies;
    std::vector<RestContact> rest_contacts;
  };

  // Each is built from some of those above it.
  Window window_;
  Halos halos_;
  Share share_;
  Homes homes_;
  ClaimTrace trace_;
  Accusation accusation_;
  ClaimCheck check_;
  Annexes annexes_;
  WindowVerdicts verdicts_;
  TimedKeys keys_;
  LivePlayers players_;
  Handovers handovers_;
  PartChanges changes_;
  PartLog part_log_;
  std::optional<Validator> validator_;
  double told_ = 0.0;  ///< of the states that are handed over next [s]
  Entered entered_;
  bool leaves_ = false;
  Admission admission_;
  PeerCounters counters_;
};

}  // namespace rink::peer
