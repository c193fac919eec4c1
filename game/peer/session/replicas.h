// The parts of other peers that one keeps, so that it can stand in for them, and its own.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/session/losses.h"
#include "game/peer/session/session_state.h"
#include "game/peer/standby/standby_copy.h"
#include "game/peer/start.h"
#include "game/peer/validation.h"

namespace rink::peer {

class Replicas {
 public:
  explicit Replicas(PeerNumber number) : number_(number) {}

  /// Who keeps the part of `peer`: the next one in the ring of those with zones.
  static std::optional<PeerNumber> keeper_of(PeerNumber peer, const State& state);
  bool keeps(PeerNumber peer, const State& state) const {
    return keeper_of(peer, state) == number_;
  }
  /// All peers know the start, `now` then, and how far all look: `halo` [m].
  void begin(const Start& start, const State& now, double halo, const Validator& scene);
  void make_room(PeerNumber slots);

  StandbyCopy& of(PeerNumber peer) {
    assert(peer < replicas_.size());
    return replicas_[peer];
  }
  const StandbyCopy& of(PeerNumber peer) const {
    assert(peer < replicas_.size());
    return replicas_[peer];
  }
  /// Goes back to one of the last two steps; parts that have neither are dropped.
  void rewind(std::uint64_t step);
  std::vector<Key> log(PeerNumber peer) const;
  /// The copies that nobody counts on any more are given up.
  void drop_others(const State& now, const State& next);

  /// The lost peer, if there is one, whose part nobody keeps any more.
  static std::optional<PeerNumber> first_unkept(const State& now, const Losses& losses);
  /// `by`, and the lost peers that it stands in for.
  static std::vector<PeerNumber> parts_of(PeerNumber by, const State& now, const Losses& losses);
  /// All that `to`, which looks `halo` [m] far, may need of these parts: bodies in its zones or the
  /// halo, and those that may act at a distance.
  static Handover share(std::span<const Part> parts, const Division& division, PeerNumber to,
                        double halo);

 private:
  PeerNumber number_;
  std::vector<StandbyCopy> replicas_;  ///< by peer
};

}  // namespace rink::peer
