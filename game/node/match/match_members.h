// The nodes that play a match by rounds: carries each one's words to all, and agrees with those
// that are left where some are lost. docs/peer-to-peer.md, "Nodes".
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/node/match/last_words.h"
#include "game/peer/protocol.h"
#include "game/peer/session/inbox.h"
#include "game/peer/start.h"

namespace rink::game {

/// A round is complete for a node that has the words of all that take part. So nodes are at most a
/// round apart, and nothing is ever undone: those that are left tell each other which words of the
/// lost ones they have, and play on by the same. The thread that plays uses it.
class MatchMembers {
 public:
  using Bytes = std::vector<std::uint8_t>;
  struct Hooks {
    /// As SessionNetwork's; may be empty, as all others.
    std::function<std::optional<Bytes>(peer::PeerNumber)> next_mail{};
    /// What the referee was heard to say; and that another one has heard this of it, which is
    /// false if it cannot be.
    std::function<RefereeWords()> referee_words{};
    std::function<bool(const RefereeWords&)> hear_referee{};
    /// All that are left know who that is.
    std::function<void()> when_recovered{};
    /// From the next round on the node takes part no more.
    std::function<void(peer::PeerNumber)> when_left{};
  };
  /// All must outlive it. `is_surviving`: otherwise a loss ends all, by peer::Halt.
  MatchMembers(peer::Mail& mail, const peer::Start& start, peer::PeerNumber own,
               peer::PeerNumber count, bool is_surviving);
  void follow(Hooks hooks) { hooks_ = std::move(hooks); }

  /// Says the own word of the next round and waits for all others', returned by node; those of
  /// nodes that take part no more are empty. Throws peer::Halt and peer::ProtocolError.
  std::vector<Bytes> exchange(Bytes own);
  /// To be called once the words of the last round have had their effect.
  void finish_round();
  /// To be called while this node waits for something else: whether all are there.
  void look();
  /// A member has said what cannot be, as in "peer 3 says no round": it is given up, or ends all.
  void give_up(peer::PeerNumber peer, const std::string& fault);

  /// Otherwise a loss ends all.
  bool is_surviving() const { return settings_.is_replicated; }
  /// Nothing may be said to others beside this meanwhile.
  bool is_recovering() const { return is_recovering_; }
  /// Of all nodes: as far as this one knows.
  bool is_lost(peer::PeerNumber node) const { return !now_.has(node); }
  /// Whether a word of its for the next round has come.
  bool has_said(peer::PeerNumber node) const { return said_[node] || !waiting_[node].empty(); }
  const std::vector<peer::PeerNumber>& left() const { return now_.members; }
  /// The first node that is left.
  peer::PeerNumber referee() const { return now_.members.front(); }
  peer::PeerNumber number() const { return own_; }
  peer::PeerNumber count() const { return static_cast<peer::PeerNumber>(said_.size()); }
  /// How many were lost, and why the last one was.
  std::size_t lost_count() const { return inbox_.losses().gone().size(); }
  /// Those that the last recovery has found lost.
  const std::vector<peer::PeerNumber>& newly_lost() const { return newly_lost_; }
  const std::string& last_loss() const { return inbox_.losses().last(); }
  /// True if others may play on without these.
  bool may_have_split() const { return may_have_split_; }

 private:
  template <class Attempt>
  void survive(Attempt&& attempt);
  /// `has_left`: by its own word, so that it goes on nowhere.
  void note_gone(const peer::PeerGone& gone, bool has_left);
  /// True if it is news of a loss.
  bool hear(peer::PeerNumber from, Bytes bytes);
  Bytes next_round(peer::PeerNumber from);
  bool takes_part(peer::PeerNumber node) const;
  void recover();
  bool agree();
  LastWords own_last_words();
  void keep_words_of_lost();
  LastWords last_words_of(peer::PeerNumber from);
  void follow_last_words(const std::map<peer::PeerNumber, LastWords>& told);
  std::string fault_of(const LastWords& words) const;
  bool may_be_last(const LastRound& last, const LastWords& words) const;
  void let_go();

  peer::Mail& mail_;
  peer::SessionSettings settings_;
  peer::PeerNumber own_;
  peer::State all_;  ///< at the start: what questions of losses are about
  peer::State now_;  ///< with those that are left
  peer::Inbox inbox_;
  Hooks hooks_;
  std::uint64_t round_ = 0;                 ///< how many are complete
  bool has_said_ = false;                   ///< the own word of the next
  std::vector<std::optional<Bytes>> said_;  ///< by node, of the round that is not complete
  std::vector<Bytes> last_;                 ///< of the last complete round
  std::vector<std::deque<Bytes>> waiting_;  ///< by node, words of rounds that were not read
  std::map<peer::PeerNumber, std::deque<LastWords>> told_;
  std::map<std::pair<std::uint64_t, peer::PeerNumber>, Bytes> of_lost_;  ///< by round and node
  std::map<peer::PeerNumber, std::uint64_t> last_rounds_;  ///< of lost nodes: the first without
  std::vector<peer::PeerNumber> leaving_, newly_lost_;     ///< lost, and not let go yet
  bool is_recovering_ = false, may_have_split_ = false;
};

}  // namespace rink::game
