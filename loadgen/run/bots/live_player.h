// A player behind a client: it sees only its client's replicas, right or stale.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/net/client/client.h"
#include "game/players/attention.h"
#include "game/players/player.h"

namespace rink::loadgen {

/// How the bots of a crowd decide.
struct LivePlayers {
  std::string kind = "random";  ///< "random": by the plan; or one of game::player_kinds()
  game::PlayerRules rules;      ///< of a field of any size: the goals' width is scaled with it
  std::uint64_t seed = 1;
  bool do_decide() const { return kind != "random"; }
};

/// The rules of the game on a field of `extent`, with goals of the same fraction of its width.
game::PlayerRules rules_on(game::PlayerRules rules, const game::Extent& extent);

/// True if a player can play on the field and with the bat that a server describes: sizes that a
/// scene could have [m], and a bat that fits.
bool is_playable(const game::Extent& extent, const game::Shape& bat);

/// Closed loop: its keys depend on the updates that it received, and when.
class LivePlayer {
 public:
  /// Plays bat `number`.
  LivePlayer(const LivePlayers& players, std::uint32_t number)
      : players_(players), number_(number) {}

  /// The keys to hold from the simulated `instant` [s] on, for a client that is playing; call it
  /// every game::decision_period.
  game::KeysHeld decide(const game::Client& client, double instant);

 private:
  /// The last observations of an entity: two positions make a velocity.
  struct Track {
    rti::ObjectHandle object;
    game::Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};
    double stamp_s = -1.0;  ///< of the position; below 0: never seen
  };

  void take_seat(const game::Client& client, const game::EntityReplica& bat);
  void look_about(const game::ReplicaSet& replica_set, const game::Vector2& from);
  static game::SeenEntity seen(const game::EntityReplica& entity, Track& track, double instant);

  const LivePlayers& players_;
  std::uint32_t number_;
  std::unique_ptr<game::Player> player_;
  Track own_;
  std::vector<Track> watched_, watched_before_;
  game::Nearest<rti::ObjectHandle> nearest_;
  std::vector<game::SeenEntity> pucks_;
  std::uint64_t decisions_ = 0;
};

}  // namespace rink::loadgen
