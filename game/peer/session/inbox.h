// What a session receives of other members: messages that can be true, or news of losses.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "game/peer/protocol.h"
#include "game/peer/session/losses.h"
#include "game/peer/session/marks.h"
#include "game/peer/session/session_settings.h"
#include "game/peer/session/session_state.h"
#include "game/peer/standby/part_record.h"
#include "game/peer/validation.h"
#include "game/peer/window/accusation.h"

namespace rink::peer {

/// Another has told of losses, which are noted: the session goes back to a common step.
class LossTold : public PeerGone {
 public:
  LossTold(PeerNumber from, const std::string& what) : PeerGone(from, false, what) {}
};

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
      if (learns_of_loss(from, bytes, now)) throw LossTold(from, losses_.last());
      count_word(from);
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
  /// Returns when all members have confirmed that they have received the same parts. Throws
  /// ProtocolError if one has received others; LossTold if one is lost before.
  void confirm(const std::vector<Handover>& parts, const State& now);
  /// At the last call of `confirm`: true if this peer has; or if all have that are not lost.
  bool has_confirmed(PeerNumber peer) const {
    return std::ranges::find(confirmed_, peer) != confirmed_.end();
  }
  bool is_confirmed(const State& now) const;
  /// True if the message, which must be a loss, names a new lost peer, or one that is missed.
  bool learns_of_loss(PeerNumber from, std::span<const std::uint8_t> bytes, const State& now);
  /// Tells all members of the losses, unless they were told the same before.
  void tell(const State& now);
  /// One more word of `from` was read in vain while losses are agreed on. Gives it up if it has
  /// said so many since the last recovery that it will never agree: an honest peer has as many
  /// pieces of a snapshot to send, at most, and then few words.
  static constexpr std::uint32_t said_max = 2 * SnapshotPiece::count_max;
  void count_word(PeerNumber from) {
    if (++said_.at(from) > said_max) give_up(from, "speaks of losses without end");
  }
  /// So many recoveries without a loss may a member begin after the last one. Who misses a peer
  /// begins one that ends with a loss, that peer's or its own: more are of one that asks for peers
  /// which answer, and would stop the session for ever.
  static constexpr std::uint32_t alarms_max = 16;
  /// When all agree on losses: true if that is all, false if some are given up now: those whom most
  /// miss, or who accuse others without need; and, by the tree, the ends of a link of which one has
  /// handed down another decision than the other says.
  bool has_settled(const State& now);

  /// `peer` is lost, which ends the session if nobody has replicas.
  void note_gone(PeerNumber peer, const std::string& what, bool has_finished = false);
  /// A peer that sends an impossible message counts as lost. `fault` continues "peer 3". While
  /// faults are deferred it is doubted: who was told another decision sends what is impossible
  /// here.
  [[noreturn]] void give_up(PeerNumber peer, const std::string& fault);
  void give_up_accused(const Accusation& accusation) {
    if (accusation.is_made()) give_up(accusation.peer(), accusation.fault());
  }
  void defer_faults(bool are_deferred) { are_faults_deferred_ = are_deferred; }
  [[noreturn]] void halt(const std::string& what) const;

  const Losses& losses() const { return losses_; }
  const Validator& validator() const { return validator_; }
  /// True from a loss on until `recovered`.
  bool must_recover() const { return must_recover_; }
  void recovered();
  bool is_newcomer() const { return is_newcomer_; }
  void enter() { is_newcomer_ = false; }
  /// A newcomer gets to know the state.
  void begin(const State& now);
  void make_room(PeerNumber slots) {
    losses_.make_room(slots), told_.resize(slots), said_.resize(slots), alarms_.resize(slots);
  }
  /// The state at the step before `now`, which must outlive this, from here on.
  void remember(const State& before) { before_ = &before; }
  /// What all members have said to all in a round, by member.
  void note_round(const State& now, std::span<const std::vector<std::uint8_t>> words) {
    marks_.note_round(now.step, words);
  }

 private:
  void lose(PeerNumber peer, const std::string& what, bool has_finished);
  void count_alarm(PeerNumber from);
  std::vector<Losses::Sentence> parted_links(const State& now) const;
  void await_result(PeerNumber from, std::uint32_t result, const State& now);

  const SessionSettings& settings_;
  Validator validator_;
  Mail& mail_;
  Losses losses_;
  Marks marks_;
  const State* before_ = nullptr;
  std::vector<std::vector<std::uint8_t>> told_;  ///< by peer: of losses, at last
  std::vector<std::uint32_t> said_;              ///< by peer: how many words, while all recover
  std::vector<std::uint32_t> alarms_;  ///< by peer: recoveries that it began since the last loss
  std::size_t gone_before_ = 0;        ///< how many were lost at the last recovery
  std::vector<PeerNumber> confirmed_;  ///< who has the same result
  bool must_recover_ = false, is_newcomer_, are_faults_deferred_ = false;
};

}  // namespace rink::peer
