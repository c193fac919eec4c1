// Players whose bats move from owner to owner: what they see, and the keys that they press.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/window/accusation.h"
#include "game/peer/window/halos.h"
#include "game/peer/window/share.h"
#include "game/peer/window/timed_keys.h"
#include "game/peer/window/window.h"

namespace rink::peer {

/// A bat of a live player of `peer`, which observes the `puck_count` nearest pucks at `phase`,
/// `phase` + `period`, ... [s], or at every window's end if `period` is 0.
struct Seat {
  std::uint32_t bat = 0;
  PeerNumber peer = 0;
  double period = 0.05, phase = 0.0;
  std::uint32_t puck_count = 0;
  /// True if an observation is due in the window from `begin` [s], not included, to `end`.
  bool is_due(double begin, double end) const;
};

class LivePlayers {
 public:
  static constexpr double ahead_max = 1.0;  ///< s

  /// All must outlive it.
  LivePlayers(const Share& share, const Halos& halos, Accusation& accusation);

  /// Between windows, equal at all peers: sets the player of the bat. One player for each.
  void seat(const Seat& seat);
  /// The same for a bat that may have a player already, whom this one replaces.
  void move_seat(const Seat& seat);
  /// After a commit and before the claims of the next window: sends an own player's key to `owner`,
  /// which the newest observation of the bat names. The owner stamps it with the end of that window
  /// or, if later, with its own instant, at most `ahead_max` later; the instants of a player's keys
  /// must not fall.
  void press(PeerNumber owner, const Press& press);
  /// The keys that wait for this owner's claims, which they leave with; and those for owners that
  /// are no neighbours, which leave with the verdict.
  std::vector<Press> take_presses(PeerNumber owner);
  std::vector<Press> take_strange_presses();
  /// Stamps the keys that `from` presses on own bats in the window that ends at `end` [s].
  void stamp(PeerNumber from, std::span<const Press> presses, double end, TimedKeys& keys);
  /// A key of one of its players, which that peer sends ahead of its claims to the owner of the bat
  /// in the window that is prepared or played. If it proves to be of another bat or player it is
  /// dropped: the bat may have been given to another player.
  void receive_early(PeerNumber from, const Press& press) { early_.push_back({from, press}); }
  /// Before the window from `start` [s] is played: of those, keys of bats that no other peer has
  /// are felt from there on. Nobody else needs to know of them.
  void stamp_unseen(double start, TimedKeys& keys);
  /// All others are stamped as if they had come with the claims of the window that ends at `end`
  /// [s]. The bat of some may be on its way here: they wait for one more window.
  void stamp_early(double end, TimedKeys& keys);

  /// The observations of own bats whose players, at that peer, are due at the window's end; or of
  /// all of its bats that are own ones.
  std::vector<Observation> due_for(PeerNumber player, const Window& window) const;
  std::vector<Observation> all_for(PeerNumber player) const;
  /// Peers that are no neighbours and for which observations are due, sorted.
  std::vector<PeerNumber> strangers_due(const Window& window) const;
  /// The observations for own players, since the last commit: from here at first, then from others.
  const std::vector<Observation>& observations() const { return observations_; }
  void observe(const Window& window) { observations_ = due_for(halos_.number(), window); }
  void receive(PeerNumber from, std::vector<Observation> observations);
  void make_room(PeerNumber peer_count);

 private:
  struct Early {
    PeerNumber from;
    Press press;
    bool is_late = false;  ///< its bat was not there yet in the window before
  };
  bool is_unseen(std::uint32_t bat) const;
  Observation observation_of(const Seat& seat) const;
  bool plays(PeerNumber peer, std::uint32_t bat) const;

  const Share& share_;
  const Halos& halos_;
  Accusation& accusation_;
  std::vector<Seat> seats_;
  std::vector<Observation> observations_;
  std::vector<std::vector<Press>> presses_;  ///< by owner: to go with the next claims
  std::vector<Early> early_;                 ///< as they came
};

}  // namespace rink::peer
