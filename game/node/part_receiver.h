// What other nodes say of their parts after each window: checked, and passed to who shows it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/net/peer/network/greetings.h"
#include "game/node/window_feed.h"
#include "game/peer/division.h"
#include "game/peer/protocol.h"
#include "game/peer/session/part_change.h"
#include "game/peer/validation.h"
#include "game/peer/window/share.h"
#include "game/physics/world.h"

namespace rink::game {

/// Another node tells of a body that is not in its zones.
class FaultyPart : public peer::ProtocolError {
 public:
  FaultyPart(peer::PeerNumber from, const std::string& fault)
      : ProtocolError("peer " + std::to_string(from) + fault), from_(from) {}
  peer::PeerNumber from() const { return from_; }

 private:
  peer::PeerNumber from_;
};

/// Used by the thread that shares the simulation alone.
class PartReceiver {
 public:
  /// `whole` is at its start; `feed` must outlive it.
  PartReceiver(const physics::World& whole, const Terms& terms, peer::PeerNumber own,
               WindowFeed& feed);

  /// False for what no node says: a window that is not the next one, or that this node's messages
  /// have not let it play; or a body or key that cannot be. Throws FaultyPart for a body that is
  /// not in its zones.
  bool receive(peer::PeerNumber from, peer::PartChange change);
  /// This node has played a window, after which these zones hold, and its own part is `share`,
  /// which must outlive it.
  void finish_window(peer::PartChange own, const peer::Division& division,
                     const peer::Share& share);

  /// All go back to the end of that window, after which these zones hold.
  void rewind(std::uint64_t window, const peer::Division& division);
  /// Then: what another says that the lost node `from` had, unless that had told of this window
  /// itself. False for what cannot be.
  bool stand_in(peer::PeerNumber from, peer::PartChange change);

 private:
  bool is_sound(peer::PeerNumber from, const peer::PartChange& change) const;
  std::string fault_of(peer::PeerNumber from, const peer::PartChange& change) const;
  void pass(peer::PeerNumber from, peer::PartChange change);

  peer::PeerNumber own_;
  WindowFeed& feed_;
  peer::Validator validator_;
  double puck_drag_;
  std::vector<physics::BodyKind> kinds_;
  std::vector<std::uint64_t>
      received_;  ///< by node: the last window of which it told, or which was played here
  std::vector<std::optional<peer::PartChange>>
      early_;                               ///< by node: of a window not played here yet
  std::optional<peer::Division> division_;  ///< after the last window
  const peer::Share* share_ = nullptr;      ///< the own part
};

}  // namespace rink::game
