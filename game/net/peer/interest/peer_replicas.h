// The replicas of one peer's player, of bodies that the peer neither owns nor has as ghosts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "game/peer/division.h"
#include "game/replication/trajectory.h"
#include "rti/wire/bytes.h"

namespace rink::game {

/// One body of an update message (docs/peer-to-peer.md, "Interest"), cut out of it.
struct BodyUpdate {
  enum class Form : std::uint8_t { left, motion, motion_and_felt, felt };
  std::uint32_t body = 0;
  Form form = Form::left;
  std::uint32_t felt = 0;  ///< keys, of the receiver's own bat
  rti::Bytes motion;       ///< as the policy codes it
};

/// A body by its owner's latest update.
struct Replica {
  peer::PeerNumber source = 0;
  bool is_there = false;
  physics::Motion motion;  ///< its law, or a place that it keeps until the next update
  physics::Vector2 position_at(double instant) const {
    return motion.at(std::max(instant, motion.time)).position;
  }
};

class PeerReplicas {
 public:
  struct Received {
    std::uint32_t body = 0, bytes = 0;
  };
  /// `kinds`: of all bodies, by number.
  PeerReplicas(bool has_trajectories, const Drag& drag, std::vector<physics::BodyKind> kinds)
      : has_trajectories_(has_trajectories), drag_(drag), kinds_(std::move(kinds)) {}

  /// False for a malformed message, of which the readable beginning is applied.
  bool receive(peer::PeerNumber from, rti::Bytes message, double windows_per_s);
  /// Forgets all that came from `source`, which knows that this player looks elsewhere.
  void forget(peer::PeerNumber source);
  void forget_body(std::uint32_t body);
  /// Sets a replica without an update.
  void assume(std::uint32_t body, const Replica& replica) { replicas_[body] = replica; }
  /// Drops forgotten replicas, which can be read until then, between two windows.
  void drop_forgotten();

  /// The replica of a body; one that is not in scope if nothing is known of it.
  const Replica& replica(std::uint32_t body) const;
  /// All replicas by number, with those that are forgotten and not dropped yet; few of a large
  /// world.
  const std::map<std::uint32_t, Replica>& all() const { return replicas_; }
  /// The keys in effect on the player's own bat by its owner's latest update.
  std::uint32_t felt() const { return felt_; }
  /// The updates received since forget_received().
  const std::vector<Received>& received() const { return received_; }
  void forget_received() { received_.clear(); }

 private:
  bool apply(peer::PeerNumber from, const BodyUpdate& update, double time);

  std::map<std::uint32_t, Replica> replicas_;
  bool has_trajectories_;
  Drag drag_;
  std::vector<physics::BodyKind> kinds_;
  std::uint32_t felt_ = 0;
  std::vector<Received> received_;
};

}  // namespace rink::game
