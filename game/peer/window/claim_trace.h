// What happened in a window near other peers, as claims say it: docs/peer-to-peer.md, "The rule".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/window/homes.h"
#include "game/peer/window/share.h"
#include "game/peer/window/window.h"

namespace rink::peer {

/// Bodies further apart than this do not affect each other at an instant [m], unless by a pile
/// (physics::Change::reach): twice the widest gap in the engine's clusters, and all roundings.
inline constexpr double touch_margin = 4e-5;
/// Events within this time of each other count as simultaneous [s]: twice the engine's instant.
inline constexpr double time_margin = 2e-9;

/// A stretch of a body's path; `state` as in ClaimedFlight. The box is wider by as far as the event
/// at `begin` looked for a pile.
struct PathFlight {
  double begin, end;
  std::uint64_t state;
  Box box;
};

/// Events of ghosts and of own bodies at the edge, the paths of the latter, and counts of all
/// events: of the last run.
class ClaimTrace {
 public:
  /// A body's event in the `change`th change of the journal; `state` as in ClaimedFlight.
  struct Step {
    std::uint32_t body, change;
    std::uint64_t state;
  };
  /// Changes of one event in the journal.
  struct Event {
    std::size_t begin, end;
  };

  /// Both must outlive it.
  ClaimTrace(const Share& share, const Homes& homes) : share_(share), homes_(homes) {}

  /// After a run, and `Homes::find_edge`.
  void follow(const Window& window);
  /// What of it concerns `peer`.
  Claims claims_for(PeerNumber peer, const Window& window, const Halos& halos) const;

  /// The number of the body with which one has come to this flight by a free impact, if `state` is
  /// what ClaimedFlight says of that; otherwise an arbitrary number. `mouth` is its BodyState's.
  static std::uint64_t partner_in(std::uint64_t state, const FreeFlightState& flight,
                                  std::uint8_t mouth);

  /// By time, of a ghost or of a body at the edge.
  std::span<const Step> steps_of(std::uint32_t body) const;
  double time_of(const Step& step) const;
  physics::Motion motion_after(const Step& step) const;
  /// Events of own bodies and ghosts together.
  const std::vector<Event>& mixed() const { return mixed_; }
  /// How many events had own bodies, and how many had none.
  std::uint64_t own_events() const { return own_events_; }
  std::uint64_t ghost_events() const { return ghost_events_; }
  /// True if a body on that foreign path may touch an own one at the edge.
  bool may_touch(const PathFlight& foreign) const;
  /// The halo around these zones that contains all own paths, so that no unknown body outside it
  /// can touch them [m].
  double needed_halo(std::span<const Box> zones) const;
  /// How far own bodies reach from their places, with those that touch them, or beyond `halo` at
  /// the run's end [m]; 0 if no farther than all peers count with.
  float reach_for_strangers(const Halos& halos) const;

 private:
  /// The flights from `begin` to `end`, the first being that at the window's start.
  struct Path {
    std::uint32_t body;
    std::size_t begin, end;
  };

  double reach_of(const Step& step) const;
  void find_steps();
  void enter(const Event& event);
  void lay_out_paths(const Window& window);
  void lay_out_path(std::uint32_t body, const Window& window);

  const Share& share_;
  const Homes& homes_;
  std::vector<Step> steps_;  ///< by body
  std::vector<Event> mixed_;
  std::vector<Path> paths_;  ///< of bodies at the edge
  std::vector<PathFlight> flights_;
  Box hull_{};  ///< holds all of these
  std::uint64_t own_events_ = 0, ghost_events_ = 0;
};

}  // namespace rink::peer
