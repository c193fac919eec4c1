// One peer's side of a simulation over anything that carries bytes.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "game/peer/peer.h"

namespace rink::peer {

struct Candidate;
struct State;

/// What one peer has to each of the others: bytes go whole and in order.
class Mail {
 public:
  static constexpr std::size_t shared_max = 127;
  virtual ~Mail() = default;
  /// To one who is gone: does nothing.
  virtual void send(PeerNumber to, std::vector<std::uint8_t> bytes) = 0;
  /// The next message of `from`; waits for it. Throws what its maker chooses if there will be none;
  /// PeerGone, of anybody who is gone and has not been parted with, where peers can do without each
  /// other.
  virtual std::vector<std::uint8_t> receive(PeerNumber from) = 0;
  /// What each of `peer_count` says to all, by number, when all call it at the same point of the
  /// protocol with at most `shared_max` bytes: by send and receive, unless whoever carries the mail
  /// has a shorter way.
  virtual std::vector<std::vector<std::uint8_t>> share(PeerNumber own, PeerNumber peer_count,
                                                       std::vector<std::uint8_t> bytes);
  /// Nothing more will be said to `peer`, nor heard of it. `is_lost`: and it shall notice, if it is
  /// still there; otherwise it leaves by itself.
  virtual void part(PeerNumber /*peer*/, bool /*is_lost*/) {}
  /// Who was to leave by itself is needed again, if it is still there.
  virtual void rejoin(PeerNumber /*peer*/) {}

  /// Who has asked here to be let in, at most Admission::asking_max of them, each once; what was
  /// decided is told by `refuse` or `expect`.
  virtual std::vector<Newcomer> callers() { return {}; }
  /// The newcomer of this token, who asked here, is not let in, or may ask again.
  virtual void refuse(std::uint64_t /*token*/, const std::string& /*reason*/,
                      bool /*may_ask_again*/) {}
  /// A candidate will connect to all. If it asked here it is told now, with the members of `state`
  /// and the candidates before it, all of whom it must reach.
  virtual void expect(const Candidate& /*candidate*/, bool /*has_asked_here*/,
                      const State& /*state*/) {}
  virtual bool reaches(PeerNumber /*candidate*/) { return false; }
  /// Whether a candidate who asked here is gone, or has taken too long.
  virtual bool has_given_up(PeerNumber /*candidate*/) { return false; }
  /// It is no candidate any more, but one of those whose loss matters; or, if `is_in` is false,
  /// nobody. Then it may ask again.
  virtual void admit(PeerNumber /*candidate*/, bool /*is_in*/) {}
};

/// There is no more mail from `peer`.
class PeerGone : public std::runtime_error {
 public:
  PeerGone(PeerNumber peer, bool has_finished, const std::string& what)
      : std::runtime_error(what), peer_(peer), has_finished_(has_finished) {}
  PeerNumber peer() const { return peer_; }
  /// It has said that it had no more to say.
  bool has_finished() const { return has_finished_; }

 private:
  PeerNumber peer_;
  bool has_finished_;
};

/// Those who are left must not go on: others may, or nobody can.
class Halt : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Of a newcomer that was not in for long: others may go on, and it may ask again.
class SentAway : public Halt {
  using Halt::Halt;
};

/// Another peer said what cannot be.
class ProtocolError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a message of the protocol is about, for who counts them.
enum class Subject : std::uint8_t { claims, verdict, handover };

/// Called in a window, where they are not empty: after its first run, which may yet be repeated or
/// undone; when all have accepted; and when the others have been sent what they need for the next
/// window, before it is committed. `when_sending`: what is sent from now on is about that.
struct WindowHooks {
  std::function<void()> when_played{}, when_final{}, when_told{};
  std::function<void(Subject)> when_sending{};
};

/// The steps of a window: `exchange(make, meanwhile)` lets everybody hear what everybody makes for
/// each other, and calls `meanwhile`, if it is not empty, when all is sent; `agree` everybody's
/// verdict. `hooks.when_final` may say where the `next` window ends.
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
    exchange([&](PeerNumber to) { return peer.claims_for(to); }, nullptr);
    peer.judge();
    sending(Subject::verdict);
    agree();
    sending(Subject::handover);
    if (peer.conclude() == Outcome::final) break;
    exchange(
        [&](PeerNumber to) { return peer.repeats(to) ? peer.handover_for_repeat(to) : Handover{}; },
        nullptr);
    if (peer.repeats(peer.number())) peer.replay();
  }
  if (hooks.when_final) hooks.when_final();
  exchange([&](PeerNumber to) { return peer.handover_for(to, next); }, hooks.when_told);
  peer.commit(next);
}

/// Everybody's verdict to everybody, who all are there: nobody goes on before all have spoken, so a
/// collective can carry it (Mail::share).
void agree(Peer& peer, PeerNumber peer_count, Mail& mail);

/// Plays the window that `begin` or the last call has prepared, and prepares the next, which ends
/// at `next` [s]. All peers must do the same. Throws ProtocolError.
void play_window(Peer& peer, PeerNumber peer_count, Mail& mail, double next);

/// At the end of everybody's last window: the states of the peer's own bodies.
Handover own_bodies(const Peer& peer);

/// The hash (World::hash) of the whole of `body_count` bodies, of which each of `parts` has some;
/// nothing unless each body is in one of them.
std::optional<std::uint64_t> hash_of_whole(const physics::WorldSpec& spec, std::uint32_t body_count,
                                           std::span<const Handover> parts);

/// The hash of a little world that has a bit of everything: builds that differ in it would part in
/// a simulation.
std::uint64_t self_test_hash();

}  // namespace rink::peer
