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

/// Reads what a stranger plays, and puts what a mirror holds of it in its order.
class HostedScene {
 public:
  /// Why `text`, which is a stranger's, can't be played; nothing if it can.
  std::optional<std::string> read(const std::string& text);

  /// Null before one was read that can be played.
  const Scene* scene() const { return scene_ ? &*scene_ : nullptr; }
  /// All there is in it: bats, pucks, then posts.
  const std::vector<Thing>& things() const { return things_; }
  /// All that is known as of the newest stamp; nothing while a body is still missing, or of an
  /// instant that no match reaches. `own`: the own bat, if there is one. It must be read.
  std::optional<ReceivedRink> received(const ReplicaSet& replicas, const EntityReplica* own) const;

 private:
  std::size_t add_bats(const ReplicaSet& replicas, ReceivedRink& received) const;
  std::size_t add_pucks(const ReplicaSet& replicas, ReceivedRink& received) const;

  std::optional<Scene> scene_;
  std::vector<Thing> things_;
};

}  // namespace rink::game
