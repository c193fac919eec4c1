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
#include "game/peer/session/agreement.h"
#include "game/peer/session/inbox.h"
#include "game/peer/session/session_settings.h"
#include "game/peer/session/session_state.h"
#include "game/peer/session/standby.h"
#include "game/peer/start.h"

namespace rink::peer {

struct SessionCounters {
  PeerCounters peer;
  std::uint64_t replica_bytes = 0, recovery_bytes = 0;  ///< sent
  std::uint64_t replica_snapshots = 0;                  ///< due because a replay was long
  std::uint64_t recoveries = 0;                         ///< completed recoveries
  std::uint64_t shifts = 0;                             ///< of zones, toward balance
  std::uint64_t entry_bytes = 0;                        ///< sent to newcomers
};

/// Plays in steps: a step ends a window, or a recovery. No peer is more than one step ahead of
/// another, since each step needs a message from every peer, so all can go back to the last common
/// step. docs/peer-to-peer.md, "Loss of a peer" and "Joining while others play".
class Session {
 public:
  /// `when_taken`, if not empty, is called when `start` is no longer needed and before the own part
  /// is allocated, so that its memory can be freed.
  Session(const Start& start, const Cuts& cuts, SessionSettings settings, Mail& mail,
          const std::function<void()>& when_taken = {});
  /// For a newcomer that is a candidate beside these members: waits until it is one of them. Throws
  /// SentAway if it is not admitted, until its first window is over.
  Session(const Start& start, SessionSettings settings, Mail& mail,
          std::vector<PeerNumber> members);

  /// Plays a window, or recovers and plays one that was undone: then `window` may be unchanged, or
  /// less. With LossHooks it returns between the two. Throws Halt, ProtocolError, and the mail's
  /// exceptions.
  void advance();
  /// How many windows are final.
  std::uint64_t window() const { return now_.window; }
  std::uint64_t step() const { return now_.step; }
  bool is_over() const {
    return has_left_ || agreement_.is_complete(now_) ||
           (settings_.is_stopped && settings_.is_stopped(now_.window));
  }
  /// The goals, and the pucks to put back, after the last window.
  const Scoring& scoring() const { return now_.scoring; }

  /// Leaves: own bodies go to others with the next window, and after the one after that this peer
  /// is not needed. The session must be replicated.
  void leave() { wishes_to_leave_ = true; }
  bool has_left() const { return has_left_; }
  /// True if it continued after a loss after which others may have continued separately: its result
  /// is the state of one part.
  bool may_have_split() const { return may_have_split_; }

  /// Presses an own player's key, as LivePlayers::press. Of one that goes to the bat's owner ahead
  /// of the claims (Peer::receive) it only notes that it may have to be pressed again.
  void press(const Observation& seen, const Press& press);
  void press(const Press& press);
  Peer& peer() { return *peer_; }
  const Peer& peer() const { return *peer_; }
  /// Call it after the last window: returns the bodies and, as keys, the logs of all peers, by
  /// peer. It is too late to leave then; but a peer that had handed over its zone may still leave
  /// on the way (then the list is empty). With LossHooks it is empty, too, where a loss has undone
  /// the last window, which is to be played again.
  std::vector<Handover> end();

  SessionCounters counters() const;
  /// Who plays on.
  const std::vector<PeerNumber>& members() const { return now_.members; }
  const Division& division() const { return division_; }
  /// The players and their bats, lost ones included; and a bound above all numbers of members.
  const std::vector<Player>& players() const { return now_.players; }
  PeerNumber slots() const { return now_.slots; }
  /// All lost peers, and the reason of the last loss.
  const std::vector<PeerNumber>& lost() const { return inbox_.losses().gone(); }
  const std::string& last_loss() const { return inbox_.losses().last(); }
  /// True if a peer is lost, so that the next call of `advance` may undo windows.
  bool is_recovering() const { return inbox_.must_recover(); }

 private:
  struct Sent {
    std::uint64_t step;  // with whose claims it went
    Press press;
  };

  // session.cpp
  template <class Make>
  void exchange(const Addressees& addressees, Make&& make,
                const std::function<void()>& meanwhile = {});
  void play_window();
  void play_stretch();
  void log_stretch(const State& next);
  void adopt(State next);
  std::vector<Handover> last_parts();

  // session_joining.cpp
  void announce();
  void greet(const State& next);
  void enter_late(std::vector<PeerNumber> members);
  std::optional<std::pair<PeerNumber, Entry>> first_entry(std::vector<PeerNumber> from);
  void receive_same(const Entry& entry, PeerNumber teller);

  // session_goals.cpp
  void face_off(State& next);
  bool put_back(const FaceOff& due);
  std::uint64_t agree_on(FaceOffWord& word, std::uint64_t known_free);

  // session_recovery.cpp
  void recover();
  bool agree();
  void go_back(PeerNumber as);
  void send_away(const State& state);
  void rebuild();
  void enter(const State& next, std::span<const Handover> shares);
  void press_again();

  SessionSettings settings_;
  Mail& mail_;
  Whole whole_;
  Agreement agreement_;
  State now_, before_;
  Division division_;
  std::optional<Peer> peer_;
  Inbox inbox_;
  Standby standby_;
  std::vector<Key> log_;          // of an own part of which nobody keeps a replica
  std::vector<Sent> sent_;        // of the last windows
  std::vector<Newcomer> asking_;  // here, of whom nothing was decided yet
  bool wishes_to_leave_ = false, has_left_ = false, may_have_split_ = false;
  SessionCounters counters_;
};

}  // namespace rink::peer
