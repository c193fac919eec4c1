// The server federate: owns the game, stamps and applies its players' keys, and publishes changes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/match/interest_seen.h"
#include "game/net/relevant_kinds.h"
#include "game/net/server/hosted_match.h"
#include "game/net/server/match_board.h"
#include "game/net/server/players/inspections.h"
#include "game/net/server/players/key_intake.h"
#include "game/net/server/players/seats.h"
#include "game/net/server/players/server_turns.h"
#include "game/net/server/shared_play.h"
#include "game/net/server/tick_budget.h"
#include "game/replication/publisher.h"
#include "rti/ambassador.h"

namespace rink::game {

/// Key changes per second and player: fast hands make 30, and a bot that decides 20 times a second,
/// of each of its four keys, never more than 80.
inline constexpr double key_limit_default = 240.0;
/// In hosted matches nobody has to make up for a link that stood still: what comes late there is
/// felt late.
inline constexpr double match_key_limit_default = 120.0;

struct ServerSettings {
  std::string federation = "rink";
  std::string policy = "periodic";
  double threshold =
      threshold_default;          ///< of policies that take one [m], see UpdatePolicySettings
  std::uint32_t sweep_ticks = 0;  ///< see RegionSweep
  double tick_s = 1.0 / 30.0;     ///< time between two ticks [s], for sweeps and for the players of
                                  ///< hosted matches
  bool is_synchronous = false;    ///< players take turns
  bool is_time_managed = false;   ///< states and turns go in time-stamp order (docs/rti.md, "The
                                  ///< game under time management"); not with `hosting` (asserted)
  /// A recorded key log that moves the bats instead of the players' own keys, so that compared runs
  /// play the very same game. Live keys are then received, counted and acknowledged, but not
  /// applied; nor do players' joins and leaves change the game.
  std::optional<std::vector<InputEvent>> replay;
  /// Absent: one game that never stops. There must be no match_objection() to the scene, and no
  /// replay (both asserted).
  std::optional<Hosting> hosting{};
  /// Key changes that a player may send per second, a second's worth of them at once; 0: any. Keys
  /// beyond that are counted and acknowledged, so that the player does not wait for them, but not
  /// applied.
  double key_limit_per_s = key_limit_default;
  /// As many pushes; a hosted match alone takes any.
  double push_limit_per_s = push_limit_default;
  /// Events of the physics that are played in time, per simulated second; 0: any (tick_budget.h).
  std::uint64_t events_per_s = 0;
  std::optional<RelevantKinds> always_relevant{};  ///< absent: relevant_kinds_of(scene)
  /// A saved game of the scene (asserted) from which the server's continues instead of beginning,
  /// with the keys of `replay` after its now(); empty: the scene's beginning. Not with `hosting`
  /// (asserted).
  std::span<const std::uint8_t> state{};
  /// What plays the game together with other servers; null: this server alone. Must outlive the
  /// server. Not with `replay`, `state` or taking turns (asserted).
  SharedPlay* shared = nullptr;
};

struct ServerCounters {
  std::uint64_t federates_lost = 0, inspections_answered = 0;
};

/// The federate that simulates. It reads no clock: `now` returns the simulated instant at which a
/// key arrives, `simulate` takes the instant to reach.
class Server : public rti::FederateAmbassador {
 public:
  /// `now` [s] is called when a player joins, leaves or presses a key; it never decreases. It is
  /// simulated time, or real time from any origin if the server hosts matches.
  Server(const rti::Fom& fom, const Scene& scene, const ServerSettings& settings,
         std::function<double()> now);

  rti::Ambassador& ambassador() { return ambassador_; }
  const Game& game() const { return game_; }

  /// True once the RTI has accepted the server's join.
  bool is_joined() const { return publisher_ != nullptr; }
  /// Registers the start barrier over all federates joined by now.
  void call_to_start();
  /// True once every federate has reached the barrier.
  bool is_started() const { return turns_.is_started(); }
  /// Synchronous mode: true if the next tick may be played; under time management that is when the
  /// RTI has granted a time before which nothing can come any more.
  bool may_step() const;

  /// Hosting only: lets real time pass to `real_s` [s], begins the next match if it is due, and
  /// returns the instant to simulate to.
  double follow_match(double real_s);
  /// Ends the present match as abandoned, so that it is recorded.
  void finish_record();
  /// Null unless the server hosts matches.
  HostedMatch* hosted() { return hosted_ ? &*hosted_ : nullptr; }
  const HostedMatch* hosted() const { return hosted_ ? &*hosted_ : nullptr; }
  /// True once after something was said that should not wait for the next tick.
  bool take_urgent() { return board_ && board_->take_urgent(); }

  /// Advances the game to `until` [s], applying every key at exactly its stamped time, or less far
  /// where the budget is spent. Returns the time reached [s].
  double simulate(double until);
  TickBudget& budget() { return budget_; }
  const TickBudget& budget() const { return budget_; }
  /// Publishes all changes with the stamp; false, and nothing, if a tick was cut short that has to
  /// be played to its end first.
  bool publish(const rti::Stamp& stamp);
  /// Publishes flights from now on, and moves regions only for new ones; call it before the server
  /// has joined.
  void hand_in_flights() { hands_in_flights_ = true; }

  /// The seats; the bat of a player that was sent its seat is in play.
  const Seats& seats() const { return seats_; }
  /// Every input applied so far, as stamped: a log that replays to the same state hash.
  const KeyIntake& keys() const { return keys_; }
  /// The publisher of entities; the server must have joined.
  const Publisher& publisher() const { return *publisher_; }
  /// True if bodies of `kind` are relevant to all, for the scheme `always`.
  bool is_always_relevant(physics::BodyKind kind) const { return always_relevant_.has(kind); }
  /// The bat that `federate` plays; an empty handle if it plays none, or its bat is not in play
  /// yet.
  rti::ObjectHandle bat_of(rti::FederateHandle federate) const;

  /// Watchers' questions about interest management (interest_report.h). Players get no answers:
  /// they may see only what their filter lets through.
  Inspections& inspections() { return inspections_; }
  void send_interest(rti::FederateHandle federate, InterestSeen seen);

  const ServerCounters& counters() const { return counters_; }
  /// The reason why the RTI refused or dropped the server; empty if it did not.
  const std::string& error() const { return error_; }

 private:
  void joined(rti::FederateHandle federate) override;
  void join_refused(rti::Refusal refusal, std::string_view why) override;
  void connection_lost(std::string_view why) override;
  void federation_synchronized(std::string_view label,
                               std::span<const rti::FederateHandle> failed) override;
  void announce_synchronization_point(std::string_view label, rti::Bytes tag) override;
  void synchronization_point_registration_failed(std::string_view label,
                                                 rti::SynchronizationFailure failure) override;
  void federate_joined(rti::FederateHandle federate, std::string_view name,
                       std::string_view type) override;
  void federate_resigned(rti::FederateHandle federate, std::string_view name, std::string_view type,
                         rti::ResignReason reason) override;
  void receive_interaction(rti::InteractionClassHandle interaction, rti::Bytes parameters,
                           rti::FederateHandle sender, const rti::Stamp& stamp) override;
  void time_regulation_enabled(rti::LogicalTime time) override;

  void ask_for_turns();
  void send_pace(std::optional<rti::FederateHandle> federate, double now);
  void seat_player(rti::FederateHandle federate, std::optional<std::uint32_t> player);
  void offer_seat(rti::FederateHandle federate, const SeatOffer& offer);
  bool offer_seat(rti::FederateHandle federate, std::uint32_t player);
  void receive_input(std::uint32_t player, rti::InteractionClassHandle interaction,
                     rti::Bytes parameters, double wanted_s);
  double simulated_at_clock(double now) const;
  void submit(const InputEvent& event) {
    assert(shared_ == nullptr || event.kind != InputKind::push);
    if (shared_ == nullptr) keys_.record(game_.submit(event));
    else shared_->press(event.player, event.key, event.kind == InputKind::key_down, event.time);
  }

  ObjectModel model_;
  std::function<double()> now_;
  Game game_;
  bool is_replay_;
  SharedPlay* shared_;
  std::unique_ptr<UpdatePolicy> policy_;
  RegionSweep sweep_;
  rti::Ambassador ambassador_;
  std::unique_ptr<Publisher> publisher_;
  Seats seats_;
  KeyIntake keys_;
  ServerTurns turns_;
  TickBudget budget_;
  std::optional<HostedMatch> hosted_;
  std::optional<MatchBoard> board_;  ///< of a hosted match, once the server has joined
  Inspections inspections_;
  RelevantKinds always_relevant_;
  bool hands_in_flights_ = false;
  std::string error_;
  ServerCounters counters_;
};

}  // namespace rink::game
