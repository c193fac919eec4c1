// The server federate: owns the game, stamps and applies its players' keys, and publishes what happened.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/replication/publisher.h"
#include "rti/ambassador.h"

namespace rink::game {

struct ServerSettings {
  std::string federation = "rink";
  std::string policy = "periodic";
  std::uint32_t sweep_ticks = 0;  ///< see RegionSweep
  double tick_s = 1.0 / 30.0;     ///< simulated time between two ticks [s]; only the sweep needs to know
  /// A recorded key log that moves the bats instead of the players' own keys, so that compared runs play the very same game.
  /// Live keys are then received, counted and acknowledged as ever, but not applied; nor are players' comings and goings.
  std::optional<std::vector<InputEvent>> replay;
};

struct ServerCounters {
  std::uint64_t keys_received = 0, keys_applied = 0, keys_refused = 0, federates_lost = 0;
};

/// The federate that simulates. It reads no clock: `now` tells the simulated instant when a key arrives, `simulate` how far to go.
class Server : public rti::FederateAmbassador {
 public:
  /// `now` [s] is asked once for each arriving key; it never decreases.
  Server(const rti::Fom& fom, const Scene& scene, const ServerSettings& settings, std::function<double()> now);

  rti::Ambassador& ambassador() { return ambassador_; }
  const Game& game() const { return game_; }

  /// True from when the RTI has let the server in.
  bool is_joined() const { return publisher_ != nullptr; }
  /// Players that have a bat at present.
  std::uint32_t player_count() const { return player_count_; }
  /// Registers the start barrier over all federates joined by now.
  void call_to_start();
  /// True once every federate has reached the barrier.
  bool is_started() const { return is_started_; }
  /// Synchronous mode: true if every player has said `Update` since the last call of `simulate`.
  bool all_turns_done() const { return player_count_ > 0 && turns_done_ == player_count_; }

  /// Advances the game to `until` [s], applying every key at exactly its stamped time.
  void simulate(double until);
  /// Hands all that changed to the ambassador, stamped.
  void publish(const rti::Stamp& stamp);

  /// The RTI object of an entity of the game.
  rti::ObjectHandle object(EntityId entity) const { return publisher_->object(entity); }
  /// The federate that plays `player`, if any does.
  std::optional<rti::FederateHandle> federate_of(std::uint32_t player) const;
  /// Every input applied so far, as stamped: a log that replays to the same state hash.
  const std::vector<InputEvent>& record() const { return record_; }
  const ServerCounters& counters() const { return counters_; }
  const std::string& trouble() const { return trouble_; }  ///< why the RTI refused or left us; empty while all is well

 private:
  struct Seat {
    std::uint32_t player = 0;
    bool is_offered = false;  ///< the player has been told
    bool is_turn_done = false;
  };
  struct Pending {
    double time;
    std::uint32_t player;
  };

  void joined(rti::FederateHandle federate) override;
  void join_refused(rti::Refusal refusal, std::string_view why) override;
  void connection_lost(std::string_view why) override;
  void federation_synchronized(std::string_view label) override;
  void announce_synchronization_point(std::string_view label) override;
  void federate_joined(rti::FederateHandle federate, std::string_view name, std::string_view type) override;
  void federate_resigned(rti::FederateHandle federate, std::string_view name, std::string_view type, rti::ResignReason reason) override;
  void receive_interaction(rti::InteractionClassHandle interaction, rti::Bytes parameters, rti::FederateHandle sender, const rti::Stamp& stamp) override;

  std::optional<std::uint32_t> free_seat(std::string_view federate_name) const;
  void offer_seat(rti::FederateHandle federate, const SeatOffer& offer);
  void offer_seats();
  void receive_key(Seat& seat, rti::Bytes parameters, bool is_down);
  void submit(const InputEvent& event);
  Seat* seat_of(rti::FederateHandle federate);

  ObjectModel model_;
  std::function<double()> now_;
  Game game_;
  bool is_replay_;
  std::unique_ptr<UpdatePolicy> policy_;
  RegionSweep sweep_;
  rti::Ambassador ambassador_;
  std::unique_ptr<Publisher> publisher_;
  std::vector<std::optional<Seat>> seats_;  ///< by federate
  std::vector<bool> is_taken_;              ///< by player
  std::vector<Pending> pending_;            ///< keys received, not yet felt
  std::vector<std::uint32_t> felt_;         ///< by player
  std::vector<InputEvent> record_;
  std::uint32_t player_count_ = 0, turns_done_ = 0;
  bool is_started_ = false;
  std::string trouble_;
  ServerCounters counters_;
};

}  // namespace rink::game
