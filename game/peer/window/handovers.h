// What peers hand over to each other between two windows, or before one is repeated.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/window/accusation.h"
#include "game/peer/window/claim_check.h"
#include "game/peer/window/claim_trace.h"
#include "game/peer/window/halos.h"
#include "game/peer/window/homes.h"
#include "game/peer/window/share.h"
#include "game/peer/window/timed_keys.h"
#include "game/peer/window/window.h"

namespace rink::peer {

class Handovers {
 public:
  /// All must outlive it.
  Handovers(Share& share, const Halos& halos, const TimedKeys& keys, Accusation& accusation);

  /// Own bodies that `peer` repeats the window with, and has not had so far.
  Handover for_repeat(PeerNumber peer, const Window& window);
  /// For `for_next`: the ghosts of which `peer` needs the states (Verdict::wanted).
  void note_wanted(PeerNumber peer, std::vector<std::uint32_t> bodies);
  /// For the next window, which ends at `until` [s]: what `peer` will own, and what will be in its
  /// halo. What it has already is left out unless it changed and is wanted.
  Handover for_next(PeerNumber peer, const Window& window, double until, const Homes& homes,
                    const ClaimTrace& trace);

  void receive(PeerNumber from, Handover handover);
  /// Before uncertain ghosts are corrected: bodies that had only free impacts get the rest of their
  /// states. Names owners whose states contradict their claims.
  void complete(const ClaimCheck& check);
  /// Puts the bodies that `from` has handed over, and returns its handover without bodies, keys and
  /// contacts of others.
  Handover enter(PeerNumber from);
  void make_room(PeerNumber peer_count);

 private:
  void complete(Handover& handover, PeerNumber from, const ClaimCheck& check);
  void check_states(PeerNumber from, const ClaimCheck& check);
  bool may_hand_over(PeerNumber from, std::uint32_t body) const;
  void report(PeerNumber from, std::uint32_t body);
  /// With the numbers of the bodies that come, sorted.
  bool brings(PeerNumber from, std::span<const std::uint32_t> brought, std::uint32_t body) const;
  void drop_keys(PeerNumber from, std::span<const std::uint32_t> brought, Handover& handover);
  void drop_contacts(PeerNumber from, std::span<const std::uint32_t> brought, Handover& handover);

  Share& share_;
  const Halos& halos_;
  const TimedKeys& keys_;
  Accusation& accusation_;
  std::vector<Handover> received_;                  ///< by peer
  std::vector<std::vector<std::uint32_t>> wanted_;  ///< by peer, sorted
};

}  // namespace rink::peer
