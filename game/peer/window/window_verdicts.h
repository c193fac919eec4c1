// The verdicts of all peers on a window, and what follows from them: the same at every peer.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/window/accusation.h"
#include "game/peer/window/halos.h"
#include "game/peer/window/instants.h"
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

  /// Completes the own verdict, which has the annexes: `agrees` if the run is consistent with all
  /// claims; own paths need a halo of `needed` [m]. `shows_cause`: the annexes show why it does not
  /// agree, so that the halo stays as it is.
  const Verdict& decide(Verdict verdict, bool agrees, double needed, bool shows_cause = false);
  void receive(PeerNumber from, const Verdict& verdict);
  /// When all have come. Sets the halos of the next window, or of the repetition.
  Outcome conclude();
  void begin_window() { attempts_ = 0, asked_.clear(); }
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
  /// After `conclude` returned `repeat`: what the next verdicts must report. If this is not empty,
  /// nobody plays again: the same runs are judged with more to go by.
  const std::vector<AskedInstant>& asked() const { return asked_; }
  /// After `conclude`: the widest reach that any verdict announces [m].
  double reach() const;
  /// How often this window was repeated.
  std::uint32_t attempts() const { return attempts_; }
  /// Where own halos tend to [m].
  double usual_halo() const { return usual_halo_; }

  /// True after so many repetitions that honest peers would agree: then who claims what cannot be
  /// agreed with is to blame; and, a little later, who does not accept.
  bool is_stuck() const;
  void blame_refusing(const Window& window, Accusation& accusation) const;

 private:
  std::uint64_t at_once_bound() const;
  std::uint64_t unlisted(PeerNumber peer) const;
  bool may_be_anywhere() const;
  std::vector<AskedInstant> instants_to_ask() const;
  bool is_settled(const AskedInstant& asked, std::size_t place) const;
  void repeat_unsettled(std::span<const AskedInstant> asked);
  void repeat_with_whole(PeerNumber peer);
  void set_halo(PeerNumber peer);
  void look_at_instants(std::span<const AskedInstant> reported);

  Halos& halos_;
  double halo_min_, halo_max_, usual_halo_;  ///< m
  std::vector<Verdict> verdicts_;            ///< by peer
  std::vector<bool> is_repeating_;           ///< by peer
  std::vector<AskedInstant> asked_;
  std::uint32_t attempts_ = 0;  ///< repetitions of this window
};

}  // namespace rink::peer
