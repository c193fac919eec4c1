// One peer's part from its first window to the last, though others are lost, leave or join on the
// way.
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

/// The same for all peers but for `number`; of newcomers, `peer_count`, `players` and `halo` say
/// nothing.
struct SessionSettings {
  PeerNumber number = 0, peer_count = 1;  ///< so many begin
  double halo = 1.0;                      ///< where it begins [m]
  bool is_replicated =
      true;  ///< whether each part is kept by another peer, too; otherwise a loss ends all
  std::uint64_t window_count = 1;
  std::function<double(std::uint64_t)> end_of;  ///< window 1, 2, ..., `window_count` + 1 [s]
  std::uint32_t balance_windows =
      0;  ///< after so many windows zones shift toward equal events per peer; 0: they stay
  std::vector<Key> keys{};  ///< that all know from the start, of all bats
  std::optional<GoalRules>
      goals{};  ///< of a field that has some; windows must be shorter than the delay and the retry.
                ///< The session is over with the window in which a side wins.
  std::vector<Player> players{};  ///< of those who begin
  std::uint32_t bat_count = 0;    ///< that can be played
  std::function<std::vector<Seat>(const Player&)> seats_of{};
  WindowHooks
      hooks{};  ///< for what goes on beside the windows; its `when_final` is the session's own
};

/// What a session has to know of all bodies, wherever they are.
struct Whole {
  physics::WorldSpec spec;
  std::uint32_t body_count = 0;
  std::vector<double> puck_radii{};  ///< m, by body, 0 of all that are no pucks; empty where there
                                     ///< are no goals, for nobody else's pucks matter then
  static Whole of(const physics::World& world);
  bool has_puck(std::uint32_t body) const {
    return body < puck_radii.size() && puck_radii[body] > 0.0;
  }
};

struct SessionCounters {
  PeerCounters peer;
  std::uint64_t replica_bytes = 0, recovery_bytes = 0;  ///< sent
  std::uint64_t recoveries = 0;                         ///< that came to an end
  std::uint64_t shifts = 0;                             ///< of zones, toward balance
  std::uint64_t entry_bytes = 0;                        ///< sent to newcomers
};

/// Plays in steps: a step ends a window, or a recovery. Nobody is more than one step ahead of
/// anybody else, since each step needs a message from everyone, so all can go back to the last step
/// that all have. docs/peer-to-peer.md, "Loss of a peer" and "Joining while others play".
class Session {
 public:
  /// `whole` is at its start. It is asked for no more once `when_taken` is called, if that is not
  /// empty, before there is room for the own part: whoever needs memory may give it up there.
  Session(const physics::World& whole, const Cuts& cuts, SessionSettings settings, Mail& mail,
          const std::function<void()>& when_taken = {});
  /// Of a newcomer, who is a candidate and has been told of these members: waits until it is one of
  /// them. Throws SentAway if it does not get that far, until its first window is over.
  Session(const physics::World& whole, SessionSettings settings, Mail& mail,
          std::vector<PeerNumber> members);

  /// Plays a window, or recovers and plays one that was undone: then `window` may be what it was,
  /// or less. Throws Halt, ProtocolError, and what the mail throws.
  void advance();
  /// How many windows are final.
  std::uint64_t window() const { return now_.window; }
  std::uint64_t step() const { return now_.step; }
  bool is_over() const { return has_left_ || is_complete(); }
  /// After it: goals, and pucks that were still to come back.
  const Scoring& scoring() const { return now_.scoring; }

  /// The own bodies go to others with the next window, and with the one after that this peer is no
  /// longer needed. It must be replicated.
  void leave() { wishes_to_leave_ = true; }
  bool has_left() const { return has_left_; }
  /// It went on after a loss after which others may have gone on too, on their own: what it has in
  /// the end is the state of one part.
  bool may_have_split() const { return may_have_split_; }

  /// An own player's key, as Peer::press.
  void press(const Observation& seen, const Press& press);
  Peer& peer() { return *peer_; }
  const Peer& peer() const { return *peer_; }
  /// When all is over: everybody's bodies and, as keys, everybody's log, by peer. It is too late to
  /// leave then; but who had handed over its zone already may still do so on the way (then:
  /// nothing).
  std::vector<Handover> end();

  SessionCounters counters() const;
  /// Who plays on.
  const std::vector<PeerNumber>& members() const { return now_.members; }
  const Division& division() const { return division_; }
  /// Who plays which bats, those who are gone among them; and above all numbers of members.
  const std::vector<Player>& players() const { return now_.players; }
  PeerNumber slots() const { return now_.slots; }
  /// Everybody who was lost, and what was said of the last.
  const std::vector<PeerNumber>& lost() const { return gone_; }
  const std::string& last_loss() const { return last_loss_; }
  /// Somebody is lost, and with the next call of `advance` windows may be undone.
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
  std::vector<PeerNumber> stood_for() const;
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
