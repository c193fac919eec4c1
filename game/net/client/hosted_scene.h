// The scene of a match that is played elsewhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "game/match/match_source.h"
#include "game/match/predicted_world.h"
#include "game/model/scene.h"
#include "game/replication/replica_set.h"

namespace rink::game {

/// Reads the scene of an untrusted host, and sorts replicas into the scene's order.
class HostedScene {
 public:
  /// The reason why `text`, which is not trusted, cannot be played; nothing if it can.
  std::optional<std::string> read(const std::string& text);

  /// Null before a playable scene was read.
  const Scene* scene() const { return scene_ ? &*scene_ : nullptr; }
  /// All its things: bats, pucks, then posts.
  const std::vector<Thing>& things() const { return things_; }
  /// The state at the newest stamp; nothing while a body is missing or nowhere, or for an instant
  /// that no match reaches. `own`: the own bat, if there is one. It must be read.
  std::optional<ReceivedRink> received(const ReplicaSet& replicas, const EntityReplica* own) const;

 private:
  std::size_t add_bats(const ReplicaSet& replicas, ReceivedRink& received) const;
  std::size_t add_pucks(const ReplicaSet& replicas, ReceivedRink& received) const;

  std::optional<Scene> scene_;
  std::vector<Thing> things_;
};

}  // namespace rink::game
