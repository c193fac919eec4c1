// Others' claims against the own run: docs/peer-to-peer.md, "The rule".
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/window/accusation.h"
#include "game/peer/window/claim_trace.h"
#include "game/peer/window/halos.h"
#include "game/peer/window/homes.h"
#include "game/peer/window/share.h"

namespace rink::peer {

/// Finds ghosts that were not what their owners say, and whether that may concern an own body.
class ClaimCheck {
 public:
  /// All must outlive it.
  ClaimCheck(const Share& share, const Halos& halos, const Homes& homes, const ClaimTrace& trace,
             Accusation& accusation);

  void receive(PeerNumber from, Claims claims);
  /// The keys in the last claims of a peer, once.
  std::vector<Press> take_presses(PeerNumber from);
  /// True if claims name the window, and the bodies that are expected of each peer.
  bool are_possible(const Window& window);
  /// After `are_possible` was true: checks parts (a) and (b) of the rule, and finds what doubtful
  /// ghosts may have changed here.
  bool agree(const Window& window);
  /// Reports the owner of the first doubtful ghost, if there is one.
  void blame_doubted();

  /// Whether the ghost, after `agree`, ceased to be what its owner says.
  bool is_doubtful(std::uint32_t ghost) const;
  /// Whether what happened to the ghost here may not be all that did: it is doubtful, or was in an
  /// event with one that was. If its owner claims events of it, only the owner's state will do.
  bool is_uncertain(std::uint32_t ghost) const;
  /// The ghosts whose states the owners must send (Verdict::wanted).
  std::vector<std::uint32_t> wanted() const;
  /// Whether what both sides agree on proves that the ghost, at the window's end, is not as its
  /// owner now says. Of a doubtful one nothing is agreed but the claims.
  bool contradicts(std::uint32_t ghost, const BodyState& state) const;
  bool contradicts(const FreeFlightState& flight) const;
  /// Corrects uncertain ghosts in this share, which is the one that it was made for, and forgets
  /// them.
  void correct(Share& share);
  void make_room(PeerNumber peer_count);

 private:
  using Flights = std::span<const ClaimedFlight>;
  double first_difference(std::uint32_t ghost, Flights claimed, const Window& window,
                          std::vector<PathFlight>& beyond) const;
  std::vector<Flights> sort_claims(const Window& window, std::vector<PathFlight>& beyond) const;
  Flights claims_of(std::uint32_t ghost) const;
  bool may_touch_own(const PathFlight& foreign) const;
  bool has_doubtful(const ClaimTrace::Event& event) const;
  void weigh();

  const Share& share_;
  const Halos& halos_;
  const Homes& homes_;
  const ClaimTrace& trace_;
  Accusation& accusation_;
  std::vector<Claims> claims_;    ///< by peer
  std::vector<double> doubts_;    ///< by place of the ghost: when it ceases to be what its owner
                                  ///< says [s]; never, as a rule
  std::vector<bool> is_unmoved_;  ///< its owner says that nothing happened to it
  std::vector<bool> is_tainted_;  ///< by body: it was in an event with a doubtful one, directly or
                                  ///< through others; empty if none was
};

}  // namespace rink::peer
