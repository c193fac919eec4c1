// One peer's session from its first window to the last, while others may be lost, leave or join.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/peer/protocol.h"
#include "game/peer/session/loss.h"
#include "game/peer/session/scoring.h"
#include "game/peer/session/session_state.h"

namespace rink::peer {

/// Equal for all peers but for `number`; newcomers ignore `peer_count`, `players` and `halo`.
struct SessionSettings {
  PeerNumber number = 0, peer_count = 1;  ///< the number of first peers
  double halo = 1.0;                      ///< where it begins [m]
  bool is_replicated =
      true;  ///< whether each part is kept by another peer, too; otherwise a loss ends all
  std::uint64_t window_count = 1;
  std::function<double(std::uint64_t)> end_of;  ///< window 1, 2, ..., `window_count` + 1 [s]
  std::uint32_t balance_windows =
      0;  ///< period [windows] in which zones shift toward equal events per peer; 0: they stay
  std::vector<Key> keys{};  ///< that all know from the start, of all bats
  std::optional<GoalRules>
      goals{};  ///< of a field that has some; windows must be shorter than the delay and the retry.
                ///< The session is over with the window in which a side wins.
  std::vector<Player> players{};  ///< of the first peers
  std::uint32_t bat_count = 0;    ///< that can be played
  std::function<std::vector<Seat>(const Player&)> seats_of{};
  WindowHooks hooks{};  ///< for callers; `when_final` is the session's own
};

/// Data about all bodies that a session needs.
struct Whole {
  physics::WorldSpec spec;
  std::uint32_t body_count = 0;
  std::vector<double> puck_radii{};  ///< m, by body, 0 for others than pucks; empty without goals,
                                     ///< when others' pucks do not matter
  static Whole of(const physics::World& world);
  bool has_puck(std::uint32_t body) const {
    return body < puck_radii.size() && puck_radii[body] > 0.0;
  }
};

struct SessionCounters {
  PeerCounters peer;
  std::uint64_t replica_bytes = 0, recovery_bytes = 0;  ///< sent
  std::uint64_t recoveries = 0;                         ///< completed recoveries
  std::uint64_t shifts = 0;                             ///< of zones, toward balance
  std::uint64_t entry_bytes = 0;                        ///< sent to newcomers
};

/// Plays in steps: a step ends a window, or a recovery. No peer is more than one step ahead of
/// another, since each step needs a message from every peer, so all can go back to the last common
/// step. docs/peer-to-peer.md, "Loss of a peer" and "Joining while others play".
class Session {
 public:
  /// `whole` is at its start. `when_taken`, if not empty, is called when `whole` is no longer
  /// needed and before the own part is allocated, so that its memory can be freed.
  Session(const physics::World& whole, const Cuts& cuts, SessionSettings settings, Mail& mail,
          const std::function<void()>& when_taken = {});
  /// For a newcomer that is a candidate beside these members: waits until it is one of them. Throws
  /// SentAway if it is not admitted, until its first window is over.
  Session(const physics::World& whole, SessionSettings settings, Mail& mail,
          std::vector<PeerNumber> members);

  /// Plays a window, or recovers and plays one that was undone: then `window` may be unchanged, or
  /// less. Throws Halt, ProtocolError, and the mail's exceptions.
  void advance();
  /// How many windows are final.
  std::uint64_t window() const { return now_.window; }
  std::uint64_t step() const { return now_.step; }
  bool is_over() const { return has_left_ || is_complete(); }
  /// The goals, and the pucks to put back, after the last window.
  const Scoring& scoring() const { return now_.scoring; }

  /// Leaves: own bodies go to others with the next window, and after the one after that this peer
  /// is not needed. The session must be replicated.
  void leave() { wishes_to_leave_ = true; }
  bool has_left() const { return has_left_; }
  /// True if it continued after a loss after which others may have continued separately: its result
  /// is the state of one part.
  bool may_have_split() const { return may_have_split_; }

  /// Presses an own player's key, as Peer::press.
  void press(const Observation& seen, const Press& press);
  Peer& peer() { return *peer_; }
  const Peer& peer() const { return *peer_; }
  /// Call it after the last window: returns the bodies and, as keys, the logs of all peers, by
  /// peer. It is too late to leave then; but a peer that had handed over its zone may still leave
  /// on the way (then the list is empty).
  std::vector<Handover> end();

  SessionCounters counters() const;
  /// Who plays on.
  const std::vector<PeerNumber>& members() const { return now_.members; }
  const Division& division() const { return division_; }
  /// The players and their bats, lost ones included; and a bound above all numbers of members.
  const std::vector<Player>& players() const { return now_.players; }
  PeerNumber slots() const { return now_.slots; }
  /// All lost peers, and the reason of the last loss.
  const std::vector<PeerNumber>& lost() const { return gone_; }
  const std::string& last_loss() const { return last_loss_; }
  /// True if a peer is lost, so that the next call of `advance` may undo windows.
  bool is_recovering() const { return must_recover_; }

 private:
  struct Sent {
    std::uint64_t step;  // with whose claims it went
    Press press;
  };

  // session.cpp
  template <class Make>
  void exchange(Make&& make, const std::function<void()>& meanwhile = {});
  template <class Message>
  Message received(PeerNumber from);
  template <class Message>
  Message checked(PeerNumber from, double now);
  Handover final_handover(PeerNumber from);
  [[noreturn]] void give_up(PeerNumber peer, const std::string& what) const;
  void play_window();
  void play_stretch();
  bool is_complete() const {
    return now_.window == settings_.window_count ||
           (now_.scoring.is_over && now_.time == settings_.end_of(now_.window));
  }
  State after_stretch() const;
  void balance(State& next) const;
  void replica(const State& next, PartChange change);
  std::optional<PeerNumber> replica_of(PeerNumber peer, const State& state) const;
  void keep_first_parts(const physics::World& whole);
  void make_room(PeerNumber slots);
  void adopt(State next);
  [[noreturn]] void halt(const std::string& what) const;

  // session_joining.cpp
  void announce();
  void give_zones(State& next) const;
  void admit(State& next) const;
  std::optional<std::string> objection(const State& next, const Newcomer& newcomer) const;
  void greet(const State& next);
  void enter_late(std::vector<PeerNumber> members);
  bool is_in_time(const State& state) const;
  std::optional<Entry> first_entry(std::vector<PeerNumber> from);
  void receive_same(const Entry& entry);

  // session_goals.cpp
  double stretch_end(const State& state) const;
  void count_goals(State& next) const;
  void face_off(State& next);
  bool put_back(const FaceOff& due);
  std::uint64_t agree_on(FaceOffWord& word);

  // session_recovery.cpp
  void note_gone(PeerNumber peer, const std::string& what, bool has_finished = false);
  void recover();
  void agree();
  bool learns_of_loss(PeerNumber from, std::span<const std::uint8_t> bytes);
  void go_back(PeerNumber as);
  void send_away(const State& state);
  enum class Majority : std::uint8_t { none, doubtful, sure };
  Majority majority_of(std::vector<PeerNumber> voters) const;
  void require_majority();
  std::vector<PeerNumber> stood_for(PeerNumber by) const;
  Handover share(std::span<const PeerNumber> parts, const Division& division, PeerNumber to);
  void rebuild();
  void enter(const State& next, std::span<const Handover> shares);
  void press_again();
  bool is_gone(PeerNumber peer) const { return State::is_in(gone_, peer); }

  SessionSettings settings_;
  Mail& mail_;
  Whole whole_;
  Validator validator_;
  State now_, before_;
  Division division_;
  std::optional<Peer> peer_;
  std::vector<PartReplica>
      replicas_;          // by peer: of those of which this peer keeps a replica, and the own part
  std::vector<Key> log_;  // of an own part of which nobody keeps a replica
  std::vector<Sent> sent_;                   // of the last windows
  std::vector<PeerNumber> gone_, finished_;  // lost, sorted; and of these, who left in good order
  std::vector<std::optional<Loss>> losses_;  // the last that each peer told
  std::string last_loss_;
  std::vector<Handover> parts_;   // everybody's, in the end
  PeerNumber teller_ = 0;         // of a newcomer: whose entry it took
  std::vector<Newcomer> asking_;  // here, of whom nothing was decided yet
  bool must_recover_ = false, wishes_to_leave_ = false, has_left_ = false, is_newcomer_ = false,
       may_have_split_ = false;
  SessionCounters counters_;
};

}  // namespace rink::peer
