// Which peers of a session are lost, what each has told of that, and who may go on.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "game/peer/session/loss.h"
#include "game/peer/session/session_state.h"

namespace rink::peer {

class Losses {
 public:
  /// True if the loss is news. `has_finished`: the peer left in good order, which may be learnt
  /// later.
  bool note(PeerNumber peer, const std::string& what, bool has_finished);
  bool is_gone(PeerNumber peer) const { return State::is_in(gone_, peer); }
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
  /// True if it knows of the same losses.
  bool agrees(PeerNumber from) const { return heard(from) && heard(from)->gone == gone_; }
  /// What there is to tell at this step.
  Loss told(std::uint64_t step) const {
    return {.step = step, .gone = gone_, .finished = finished_};
  }
  void make_room(PeerNumber slots);

  enum class Majority : std::uint8_t { none, doubtful, sure };
  /// Whether those that are left may go on from here. `doubtful`: others may do so, too.
  Majority majority(const State& now) const;

  /// Asserts that lists are sorted, and that who left in good order is lost.
  void check() const;

 private:
  Majority majority_of(std::vector<PeerNumber> voters) const;

  std::vector<PeerNumber> gone_, finished_;
  std::vector<std::optional<Loss>> heard_;  ///< by peer
  std::string last_;
};

}  // namespace rink::peer
