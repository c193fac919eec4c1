// One peer's side of a simulation over anything that carries bytes.
#pragma once

#include <cassert>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "game/peer/peer.h"

namespace rink::peer {

struct Candidate;
struct State;

/// A peer's mail to each of the others: messages arrive whole and in order.
class Mail {
 public:
  static constexpr std::size_t shared_max = 127;
  virtual ~Mail() = default;
  /// Without effect if the receiver is gone.
  virtual void send(PeerNumber to, std::vector<std::uint8_t> bytes) = 0;
  /// Waits for the next message of `from`. Throws an exception of the implementation's choice if
  /// there will be none; PeerGone for any peer that is gone without `part`, if peers can continue
  /// without each other.
  virtual std::vector<std::uint8_t> receive(PeerNumber from) = 0;
  /// Waits for the next message of any of these peers, at least one, and returns it with its
  /// sender's number. This default waits for the first peer of the list alone.
  virtual std::pair<PeerNumber, std::vector<std::uint8_t>> receive_any(
      std::span<const PeerNumber> from) {
    assert(!from.empty());
    return {from.front(), receive(from.front())};
  }
  /// The bytes of each of `peer_count` peers, by number, when all call it at the same point of the
  /// protocol with at most `shared_max` bytes: by send and receive, unless the implementation has a
  /// faster way.
  virtual std::vector<std::vector<std::uint8_t>> share(PeerNumber own, PeerNumber peer_count,
                                                       std::vector<std::uint8_t> bytes);
  /// No more messages go to `peer` or come from it. `is_lost`: it is notified if it still exists;
  /// otherwise it leaves itself.
  virtual void part(PeerNumber /*peer*/, bool /*is_lost*/) {}
  /// A peer that was about to leave is needed again, if it still exists.
  virtual void rejoin(PeerNumber /*peer*/) {}

  /// The peers that have asked here to join, at most Admission::asking_max of them, each once;
  /// `refuse` or `expect` tells the decision.
  virtual std::vector<Newcomer> callers() { return {}; }
  /// Refuses the newcomer of this token, which asked here; it may perhaps ask again.
  virtual void refuse(std::uint64_t /*token*/, const std::string& /*reason*/,
                      bool /*may_ask_again*/) {}
  /// A candidate will connect to all. If it asked here it is notified now, with the members of
  /// `state` and the earlier candidates, all of which it must reach.
  virtual void expect(const Candidate& /*candidate*/, bool /*has_asked_here*/,
                      const State& /*state*/) {}
  virtual bool reaches(PeerNumber /*candidate*/) { return false; }
  /// True if a candidate that asked here is gone, or has taken too long.
  virtual bool has_given_up(PeerNumber /*candidate*/) { return false; }
  /// The candidate becomes a member, whose loss matters; or, if `is_in` is false, it is dropped and
  /// may ask again.
  virtual void admit(PeerNumber /*candidate*/, bool /*is_in*/) {}
};

/// There is no more mail from `peer`.
class PeerGone : public std::runtime_error {
 public:
  PeerGone(PeerNumber peer, bool has_finished, const std::string& what)
      : std::runtime_error(what), peer_(peer), has_finished_(has_finished) {}
  PeerNumber peer() const { return peer_; }
  /// True if it sent a farewell.
  bool has_finished() const { return has_finished_; }

 private:
  PeerNumber peer_;
  bool has_finished_;
};

/// The session must stop here: others may continue, or none can.
class Halt : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A newcomer's session ends before it took part: others may continue, and it may ask again.
class SentAway : public Halt {
  using Halt::Halt;
};

/// Another peer sent an impossible message.
class ProtocolError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The purpose of a message of the protocol, for counts.
enum class Subject : std::uint8_t { claims, verdict, handover };

/// Called in a window if not empty: after its first run, which may still be repeated or undone;
/// when all have accepted; and when the others have been sent what they need for the next window,
/// before the commit. `when_sending` announces the purpose of the following messages.
struct WindowHooks {
  std::function<void()> when_played{}, when_final{}, when_told{};
  std::function<void(Subject)> when_sending{};
};

/// Who receives a peer's message of one step, and whose it receives: sorted, without itself. If one
/// peer sends to another, that one receives from it.
struct Addressees {
  std::vector<PeerNumber> to{}, from{};
};
/// Of claims; of handovers after `conclude`: for a repetition, or for the next window.
Addressees claim_addressees(const Peer& peer);
Addressees repeat_addressees(const Peer& peer);
Addressees handover_addressees(const Peer& peer);

/// The steps of a window: `exchange(addressees, make, meanwhile)` exchanges what these peers make
/// for each other, and calls `meanwhile`, if it is not empty, when all is sent; `agree` exchanges
/// verdicts. `hooks.when_final` may set where the `next` window ends.
template <class Exchange, class Agree>
void play_steps(Peer& peer, const double& next, Exchange&& exchange, Agree&& agree,
                const WindowHooks& hooks) {
  const auto sending = [&](Subject about) {
    hooks.when_sending ? hooks.when_sending(about) : void();
  };
  peer.play();
  if (hooks.when_played) hooks.when_played();
  for (;;) {
    sending(Subject::claims);
    exchange(
        claim_addressees(peer), [&](PeerNumber to) { return peer.claims_for(to); }, nullptr);
    peer.judge();
    sending(Subject::verdict);
    agree();
    sending(Subject::handover);
    if (peer.conclude() == Outcome::final) break;
    exchange(
        repeat_addressees(peer), [&](PeerNumber to) { return peer.handover_for(to); }, nullptr);
    if (peer.verdicts().repeats(peer.number())) peer.replay();
  }
  if (hooks.when_final) hooks.when_final();
  exchange(
      handover_addressees(peer), [&](PeerNumber to) { return peer.handover_for(to, next); },
      hooks.when_told);
  peer.commit(next);
}

/// Exchanges the verdicts of all peers, which must all be present: none continues before all have
/// sent theirs, so a collective can carry them (Mail::share). One that is too long for that leaves
/// its place empty and is sent to each.
void agree(Peer& peer, PeerNumber peer_count, Mail& mail);

/// Plays the window that `begin` or the last call has prepared, and prepares the next, which ends
/// at `next` [s]. All peers must do the same. Throws ProtocolError.
void play_window(Peer& peer, PeerNumber peer_count, Mail& mail, double next);

/// At the end of the last window: the states of the peer's own bodies.
Handover own_bodies(const Peer& peer);

/// The hash (World::hash) of the whole of `body_count` bodies, of which each of `parts` has some;
/// nothing unless each body is in one part.
std::optional<std::uint64_t> hash_of_whole(const physics::WorldSpec& spec, std::uint32_t body_count,
                                           std::span<const Handover> parts);

/// The hash of a small world with all kinds of events: builds that differ in it would diverge in a
/// simulation.
std::uint64_t self_test_hash();

}  // namespace rink::peer
