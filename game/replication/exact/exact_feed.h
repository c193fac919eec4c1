// The sender's side of the policy "exact": tells each client that computes what it cannot know.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "game/control/game.h"
#include "game/model/scene.h"
#include "game/replication/exact/exact_messages.h"
#include "game/replication/exact/tick_events.h"
#include "game/replication/object_model.h"
#include "game/replication/publisher.h"
#include "rti/federation_execution.h"

namespace rink::game {

/// Counts since the feed was made, over all clients.
struct ExactCounters {
  std::uint64_t bytes = 0, ticks = 0;  ///< of messages; ticks told to one client each
  std::uint64_t keys = 0, told = 0, entries = 0, exits = 0, returns = 0, hashes = 0;
  std::uint64_t starts = 0;  ///< conversations begun, or begun anew
};

/// Simulates no client: of each group of bodies that a tick's events joined it compares who knows
/// one of them with who knows all. Clients are the federates that subscribe to the attribute
/// `exact`; their scope is the filter's.
class ExactFeed {
 public:
  /// Looks at `game`, which must outlive it, from now on. `scene` is the game's; ticks come every
  /// `tick_s` [s] if they are on time.
  ExactFeed(const Game& game, const Scene& scene, const rti::Fom& fom, double tick_s);

  /// After each advance of the game.
  void look() { events_.look(game_); }

  struct Tick {
    const Publisher& publisher;  ///< which has published the game as it is
    rti::Stamp stamp;
    std::span<const std::uint32_t> felt;  ///< see Publisher::publish
    /// The player whose bat a federate plays.
    std::function<std::optional<std::uint32_t>(rti::FederateHandle)> player_of;
  };
  /// Once a tick, between the execution's match and flush.
  void send(const Tick& tick, rti::FederationExecution& execution);
  const ExactCounters& counters() const { return counters_; }

  /// Asserts that what clients know and by whom bodies are known are one relation.
  void check() const;

 private:
  static constexpr std::uint32_t nobody = 0xffffffff;
  struct Client {
    rti::FederateHandle federate;
    bool needs_start = true;
    bool is_told = false;  ///< by the RTI: its scope is too large for one message
    double time = 0.0;
    std::uint64_t tag = 0;
    std::uint32_t felt = 0;
    std::vector<std::uint32_t> known, bats;  ///< bodies, by number
    std::vector<std::uint32_t> lingering;    ///< known ones out of scope, as they left it
    rti::Bitmap slots;                       ///< of the objects of those in scope
    std::vector<std::size_t> partly_known;   ///< groups of the tick
  };
  struct BodyFacts {
    rti::ObjectHandle object;
    std::uint32_t slot = nobody, exact_class = nobody, player = 0;
    bool is_post = false;
  };

  void learn(const Tick& tick, const rti::FederationExecution& execution);
  std::uint32_t class_of(const Entity& entity);
  void update_clients(rti::FederationExecution& execution);
  void forget(Client& client);
  void compare_groups();
  void compose(std::size_t client, const Tick& tick, rti::FederationExecution& execution);
  void leave_to_rti(Client& client, rti::FederationExecution& execution);
  void find_changes(std::size_t index, const rti::Bitmap& scope);
  void end_lingering(const Client& client);
  ExactExit& exit_of(std::uint32_t rank);
  void add_told(const Client& client);
  void add_keys(const Client& client);
  void apply_changes(std::size_t index);
  ExactState state_of(std::uint32_t body) const;
  std::uint32_t hash_of(const Client& client) const;
  void know(std::size_t client, std::uint32_t body, bool is_known);
  bool knows(std::size_t client, std::uint32_t body) const {
    return (knowing_[body * words_ + client / 64] >> client % 64 & 1) != 0;
  }

  const Game& game_;
  const ObjectModel model_;
  TickEvents events_;
  std::vector<double> thrusts_;  ///< by player [m/s^2]
  ExactStart start_;
  std::uint64_t tick_count_ = 0, hash_period_;
  std::vector<BodyFacts> facts_;             ///< by body
  std::vector<std::uint32_t> body_of_slot_;  ///< `nobody` for objects that are no bodies
  std::vector<std::optional<Client>> clients_;
  std::size_t words_ = 1;                                 ///< of a body's row in `knowing_`
  std::vector<std::uint64_t> knowing_;                    ///< by body: a bit for each client
  ExactTick message_;                                     ///< lent to the client at hand
  std::vector<std::uint32_t> entered_, left_, returned_;  ///< bodies, of the client at hand
  std::vector<Drive> drives_;
  std::vector<std::uint32_t> classes_;
  std::vector<std::byte> bytes_;
  ExactCounters counters_;
};

}  // namespace rink::game
