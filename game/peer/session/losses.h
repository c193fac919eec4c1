// Which peers of a session are lost, what each has told of that, and who may go on.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/peer/session/loss.h"
#include "game/peer/session/session_state.h"

namespace rink::peer {

class Losses {
 public:
  explicit Losses(PeerNumber own = 0) : own_(own) {}

  /// True if the loss is news. `has_finished`: the peer left in good order, which may be learnt
  /// later.
  bool note(PeerNumber peer, const std::string& what, bool has_finished);
  bool is_gone(PeerNumber peer) const { return State::is_in(gone_, peer); }
  /// The own peer hears nothing more of `peer`; whether that is lost, all decide (`settle`). True
  /// if it is news.
  bool miss(PeerNumber peer, const std::string& what);
  bool misses(PeerNumber peer) const;
  /// `peer` has sent what cannot be, unless this one was told another decision than it: all ask
  /// about it, and compare.
  void doubt(PeerNumber peer, const std::string& what);
  /// Nothing can be said to it or heard of it.
  bool is_away(PeerNumber peer) const { return is_gone(peer) || misses(peer); }
  bool has_missed() const { return !missed_.empty(); }
  /// Sorted, as are those of them that left in good order.
  const std::vector<PeerNumber>& gone() const { return gone_; }
  const std::vector<PeerNumber>& finished() const { return finished_; }
  /// The reason of the last loss.
  const std::string& last() const { return last_; }
  /// For a newcomer at this state: keeps losses of its members alone, and adds those that all know.
  void begin(const State& now);

  /// Why a peer at `now` cannot be told this, as in "sends the loss of peer 3, which never was";
  /// empty if it can.
  static std::string fault_of(const Loss& told, const State& now);
  /// Keeps the last that `from` has told.
  void hear(PeerNumber from, Loss told);
  /// Nothing if it has told nothing yet.
  const std::optional<Loss>& heard(PeerNumber from) const;
  /// True if this, told by `from`, has losses or questions that are not known here.
  bool is_news(PeerNumber from, const Loss& told) const;
  /// True if it knows of the same losses, and has answered the same questions.
  bool agrees(PeerNumber from) const;
  /// What there is to tell at this step.
  Loss told(const State& now) const;
  /// A peer to be given up, and why.
  struct Sentence {
    PeerNumber peer = 0;
    std::string what;
  };
  /// When all agree: a peer goes that more of the others miss than hear; otherwise those that miss
  /// it. One goes, too, that was asked about and is missed by nobody, if `are_doubts_right`. The
  /// questions are answered with that.
  std::vector<Sentence> settle(const State& now, bool are_doubts_right = false);
  /// As if nobody had been doubted.
  void drop_doubts() { doubted_.clear(); }
  void make_room(PeerNumber slots);

  enum class Majority : std::uint8_t { none, doubtful, sure };
  /// Whether those that are left may go on from here. `doubtful`: others may do so, too.
  Majority majority(const State& now) const;

  /// Asserts that lists are sorted, and that who left in good order is lost.
  void check() const;

 private:
  struct Missed {
    PeerNumber peer;
    std::string what;
  };
  struct Votes {
    std::vector<PeerNumber> missing{};
    std::size_t hearing = 0;
  };

  Majority majority_of(std::vector<PeerNumber> voters) const;
  std::vector<PeerNumber> asked() const;
  static Answer answer_in(const Loss& told, PeerNumber peer);
  Answer answer(PeerNumber peer, const State& now) const;
  Answer answer_by(PeerNumber voter, PeerNumber peer, const State& now) const;
  Votes votes_on(PeerNumber peer, const State& now, std::span<const Sentence> sentences) const;
  std::string reason(PeerNumber peer) const;

  PeerNumber own_;
  std::vector<PeerNumber> gone_, finished_;
  std::vector<Missed> missed_, doubted_;
  std::vector<std::optional<Loss>> heard_;  ///< by peer
  std::string last_;
};

}  // namespace rink::peer
