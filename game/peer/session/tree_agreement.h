// A member's side of an agreement by the tree: verdicts of its branch go up, and everybody's come
// down. docs/peer-to-peer.md, "Agreement".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/session/inbox.h"
#include "game/peer/session/session_state.h"
#include "game/peer/verdict_tree.h"

namespace rink::peer {

/// Whoever passes on what cannot be true is given up: nobody honest does. So is a parent that hands
/// down another verdict of the branch than it was sent up.
class TreeAgreement {
 public:
  /// All must outlive it.
  TreeAgreement(const State& now, Peer& peer, Inbox& inbox, Mail& mail);
  /// Returns the decision's bytes, the same at all, when the peer has the verdicts of all and has
  /// passed them on. Throws as Inbox::received.
  std::vector<std::uint8_t> run();

 private:
  VerdictBundle received(std::size_t from, bool is_decision, std::size_t count);
  void collect(std::size_t child);
  void hear_decision(std::size_t parent);

  const State& now_;
  Peer& peer_;
  Inbox& inbox_;
  Mail& mail_;
  VerdictTree tree_;
  std::size_t place_;
  VerdictBundle all_;  ///< by place
};

}  // namespace rink::peer
