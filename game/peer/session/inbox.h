// What a session receives of other members: messages that can be true, or news of losses.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "game/peer/protocol.h"
#include "game/peer/session/losses.h"
#include "game/peer/session/session_settings.h"
#include "game/peer/session/session_state.h"
#include "game/peer/validation.h"

namespace rink::peer {

/// Throws PeerGone where a member is lost, or sends what cannot be true, so that the session goes
/// back to a common step. `now` is the state of the session.
class Inbox {
 public:
  /// `settings` and `mail` must outlive it. `is_newcomer`: the session is not one of the members
  /// until `enter`, and is sent away where others would halt.
  Inbox(const SessionSettings& settings, Validator validator, Mail& mail, bool is_newcomer);

  template <class Message>
  Message received(PeerNumber from, const State& now) {
    for (;;) {
      const std::vector<std::uint8_t> bytes = mail_.receive(from);
      Message message;
      if (read(bytes, message)) return message;
      // Losses from which this peer has recovered already are ignored.
      if (learns_of_loss(from, bytes, now))
        throw PeerGone(losses_.heard(from)->gone.front(), false, losses_.last());
    }
  }
  /// Also validates it: its states are those of the instant `time` [s]. The own peer checks
  /// messages for it itself.
  template <class Message>
  Message checked(PeerNumber from, const State& now, double time) {
    Message message = received<Message>(from, now);
    if (const std::string fault = validator_.fault_of(message, time); !fault.empty())
      give_up(from, fault);
    return message;
  }
  /// The bodies are not played any more, so their contacts are left out.
  Handover final_handover(PeerNumber from, const State& now);
  /// True if the message, which must be a loss, names a new lost peer.
  bool learns_of_loss(PeerNumber from, std::span<const std::uint8_t> bytes, const State& now);

  /// `peer` is lost, which ends the session if nobody has replicas.
  void note_gone(PeerNumber peer, const std::string& what, bool has_finished = false);
  /// A peer that sends an impossible message counts as lost. `fault` continues "peer 3".
  [[noreturn]] void give_up(PeerNumber peer, const std::string& fault) const;
  [[noreturn]] void halt(const std::string& what) const;

  const Losses& losses() const { return losses_; }
  const Validator& validator() const { return validator_; }
  /// True from a loss on until `recovered`.
  bool must_recover() const { return must_recover_; }
  void recovered() { must_recover_ = false; }
  bool is_newcomer() const { return is_newcomer_; }
  void enter() { is_newcomer_ = false; }
  /// A newcomer gets to know the state.
  void begin(const State& now);
  void make_room(PeerNumber slots) { losses_.make_room(slots); }

 private:
  const SessionSettings& settings_;
  Validator validator_;
  Mail& mail_;
  Losses losses_;
  bool must_recover_ = false, is_newcomer_;
};

}  // namespace rink::peer
