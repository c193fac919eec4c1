// The verdicts of all peers on a window, and what follows from them: the same at every peer.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/window/accusation.h"
#include "game/peer/window/halos.h"
#include "game/peer/window/share.h"
#include "game/peer/window/window.h"

namespace rink::peer {

enum class Outcome : std::uint8_t { final, repeat };

/// What a verdict says of a run alone: goals, and events at one instant.
Verdict verdict_on_run(const Share& share, const Halos& halos, const Window& window);

class WindowVerdicts {
 public:
  /// The halos, which it widens and narrows, must outlive it. `halo_max` [m] reaches across the
  /// field.
  WindowVerdicts(Halos& halos, double halo_max);

  /// Completes the own verdict: `agrees` if the run is consistent with all claims; own paths need a
  /// halo of `needed` [m].
  const Verdict& decide(Verdict verdict, bool agrees, double needed);
  void receive(PeerNumber from, const Verdict& verdict);
  /// When all have come. Sets the halos of the next window, or of the repetition.
  Outcome conclude();
  void begin_window() { attempts_ = 0; }
  void make_room(PeerNumber peer_count);

  const Verdict& of(PeerNumber peer) const {
    assert(peer < verdicts_.size());
    return verdicts_[peer];
  }
  const Verdict& own() const { return of(halos_.number()); }
  /// After `conclude` returned `repeat`.
  bool repeats(PeerNumber peer) const {
    assert(peer < is_repeating_.size());
    return is_repeating_[peer];
  }
  /// Where own halos tend to [m].
  double usual_halo() const { return usual_halo_; }

  /// True after so many repetitions that honest peers would agree: then who claims what cannot be
  /// agreed with is to blame; and, a little later, who does not accept.
  bool is_stuck() const;
  void blame_refusing(const Window& window, Accusation& accusation) const;

 private:
  std::uint64_t at_once_bound() const;

  Halos& halos_;
  double halo_min_, halo_max_, usual_halo_;  ///< m
  std::vector<Verdict> verdicts_;            ///< by peer
  std::vector<bool> is_repeating_;           ///< by peer
  std::uint32_t attempts_ = 0;               ///< repetitions of this window
};

}  // namespace rink::peer
