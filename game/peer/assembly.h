// All peers of a simulation in one process, in lockstep: for tests, and to measure the cost of a
// division without a network.
#pragma once

#include <cassert>
#include <deque>
#include <optional>
#include <string>

#include "game/peer/protocol.h"

namespace rink::peer {

/// Messages pass as the bytes that a network would carry.
class Assembly {
 public:
  /// Divides `whole`, which is at its start (time 0, before any event); `window` [s] is the length
  /// of every window. `keeps_to_neighbours`: as of Halos.
  Assembly(const physics::World& whole, const Division& division, double halo, double window,
           bool keeps_to_neighbours = true);

  /// Before the first window: when keys change.
  void press(const Key& key);
  /// Changes the zones from the end of the next window on; `division` is for the same number of
  /// peers.
  void divide(const Division& division) {
    assert(division.peer_count() == peers_.size());
    next_division_ = division;
  }
  /// Plays one window, repeated as often as it takes.
  void advance();

  double now() const { return window_ * static_cast<double>(count_); }
  std::deque<Peer>& peers() { return peers_; }
  /// The state of the body at its owner, which is searched.
  BodyState state(std::uint32_t body) const {
    assert(body < owners_.size() && owners_[body] < peers_.size());
    return peers_[owners_[body]].share().state(body);
  }
  /// The number of bodies without exactly one owner.
  std::uint32_t misowned() const { return misowned_; }
  /// The first accusation of any peer; empty if there is none.
  std::string accusation() const;

  /// What all peers have sent so far, verdicts left out.
  struct Sent {
    std::uint64_t messages = 0, bytes = 0;
  };
  const Sent& sent() const { return sent_; }

 private:
  template <class Make>
  void exchange(Addressees (*addressees_of)(const Peer&), Make&& make);
  void exchange_verdicts();
  void note_owners();

  std::deque<Peer> peers_;
  std::vector<PeerNumber> owners_;
  double window_;
  std::optional<Division> next_division_;
  std::uint64_t count_ = 0;
  std::uint32_t misowned_ = 0;
  bool has_begun_ = false;
  Sent sent_;
};

}  // namespace rink::peer
