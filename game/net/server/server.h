// The server federate: owns the game, stamps and applies its players' keys, and publishes what
// happened.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log.h"
#include "game/control/match_flow.h"
#include "game/match/interest_seen.h"
#include "game/net/relevant_kinds.h"
#include "game/replication/publisher.h"
#include "rti/admission/token_bucket.h"
#include "rti/ambassador.h"

namespace rink::game {

/// What a server needs to host matches: one game of the scene after the other, for whoever takes
/// the two seats (docs/play.md, "The match over the network").
struct Hosting {
  FlowTimes times;
  std::string scene_text;  ///< the scene's file: players work out from it what to show, records
                           ///< need no other; at most SceneText::size_max bytes
};

/// Key changes per second and player: fast hands make 30, and a bot that decides 20 times a second,
/// of each of its four keys, never more than 80.
inline constexpr double key_limit_default = 240.0;

struct ServerSettings {
  std::string federation = "rink";
  std::string policy = "periodic";
  double threshold =
      threshold_default;          ///< of policies that take one [m], see UpdatePolicySettings
  std::uint32_t sweep_ticks = 0;  ///< see RegionSweep
  double tick_s = 1.0 / 30.0;     ///< time between two ticks [s], which the sweep needs to know and
                                  ///< the players of hosted matches are told
  bool is_synchronous = false;    ///< players are told that they take turns
  bool is_time_managed = false;   ///< states and turns go in time-stamp order (docs/rti.md, "The
                                  ///< game under time management"); not with `hosting` (asserted)
  /// A recorded key log that moves the bats instead of the players' own keys, so that compared runs
  /// play the very same game. Live keys are then received, counted and acknowledged as ever, but
  /// not applied; nor are players' comings and goings.
  std::optional<std::vector<InputEvent>> replay;
  /// Absent: one game that never stops. There must be no match_objection() to the scene, and no
  /// replay (both asserted).
  std::optional<Hosting> hosting{};
  /// Key changes that a player may send per second, a second's worth of them at once; 0: any. What
  /// is more is counted and acknowledged, so that its player does not wait for it, but not felt.
  double key_limit_per_s = key_limit_default;
  std::optional<RelevantKinds> always_relevant{};  ///< absent: relevant_kinds_of(scene)
  /// A game of the scene that the server's goes on from instead of beginning (a copy of it, made at
  /// once); of `replay` the keys after its now(). Not with `hosting` (asserted).
  const Game* begun = nullptr;
};

struct ServerCounters {
  std::uint64_t keys_received = 0, keys_applied = 0, keys_refused = 0, federates_lost = 0;
  std::uint64_t inspections_answered = 0;
  std::uint64_t keys_over_limit = 0;
  std::uint32_t player_over_limit = 0;  ///< who sent the last of them
  std::uint64_t keys_late = 0;  ///< of hosted matches: arrived after the instant for which they
                                ///< were stamped, by more than 0.1 ms
};

/// The federate that simulates. It reads no clock: `now` tells the simulated instant when a key
/// arrives, `simulate` how far to go.
class Server : public rti::FederateAmbassador {
 public:
  /// `now` [s] is asked once for each arriving key; it never decreases. It is simulated time, or
  /// real time from any origin if the server hosts matches.
  Server(const rti::Fom& fom, const Scene& scene, const ServerSettings& settings,
         std::function<double()> now);

  rti::Ambassador& ambassador() { return ambassador_; }
  const Game& game() const { return game_; }
  /// Simulated time of the matches before this one [s].
  double earlier() const { return earlier_s_; }

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
  /// Synchronous mode: true if the next tick may be played; under time management that is when the
  /// RTI says that nothing can come any more that belongs before it.
  bool may_step() const;

  /// Hosting only: lets real time pass to `real_s` [s], begins the next match if it is time, and
  /// tells how far to simulate.
  double follow_match(double real_s);
  /// Records of the matches that came to their end, or were given up, since they were last taken;
  /// the first players' is first.
  std::vector<KeyLog> take_finished() { return std::exchange(finished_, {}); }
  /// The present match counts as given up, so that there is a record of it.
  void finish_record();
  /// Whether the last record could not be written: players are told.
  void set_unrecorded(bool is_unrecorded) { is_unrecorded_ = is_unrecorded; }
  /// Null unless the server hosts matches.
  const MatchState* match() const { return flow_ ? &flow_->state() : nullptr; }
  /// True once after something was said that should not wait for the next tick.
  bool take_urgent() { return std::exchange(is_urgent_, false); }

  /// Advances the game to `until` [s], applying every key at exactly its stamped time.
  void simulate(double until);
  /// Hands all that changed to the ambassador, stamped.
  void publish(const rti::Stamp& stamp);

  /// What `publish` made known the last time: entities with their new objects, and players with
  /// their federates. For who tells the RTI's filter (acquaint.h).
  struct Seated {
    rti::FederateHandle federate;
    std::uint32_t player = 0;
  };
  std::span<const Publisher::Registered> registered() const { return publisher_->registered(); }
  std::span<const Seated> seated() const { return seated_; }
  std::span<const Publisher::Flown> flights() const { return publisher_->flights(); }
  /// From now on `flights` lists what flies otherwise than before, and regions are moved for it
  /// alone; to be called before the server has joined.
  void hand_in_flights() { hands_in_flights_ = true; }
  /// Where the players' keys push them: calls `visit(federate, direction)` for each that has a bat,
  /// (0, 0) where no key is held.
  template <class Visit>
  void for_each_heading(Visit visit) const {
    for (std::uint32_t federate = 0; federate < seats_.size(); ++federate)
      if (seats_[federate] && seats_[federate]->is_offered)
        visit(rti::FederateHandle{federate}, direction(game_.keys_held(seats_[federate]->player)));
  }
  /// Whether what is of `kind` is relevant to everybody, for the scheme `always`.
  bool is_always_relevant(physics::BodyKind kind) const { return always_relevant_.has(kind); }

  /// The RTI object of an entity of the game.
  rti::ObjectHandle object(EntityId entity) const { return publisher_->object(entity); }
  /// The federate that plays `player`, if any does.
  std::optional<rti::FederateHandle> federate_of(std::uint32_t player) const;
  /// The bat that `federate` plays; no handle if it plays none, or its bat is not there yet.
  rti::ObjectHandle bat_of(rti::FederateHandle federate) const;
  bool is_entity(rti::ObjectHandle object) const { return publisher_->is_entity(object); }

  /// Who asked what interest management decided of which object, since it was last taken
  /// (interest_report.h). Players are not answered: they are to see what their filter lets them.
  struct Inspecting {
    rti::FederateHandle federate;
    rti::ObjectHandle object;
  };
  std::vector<Inspecting> take_inspections() { return std::exchange(inspections_, {}); }
  void tell_interest(rti::FederateHandle federate, InterestSeen seen);

  /// Every input applied so far, as stamped: a log that replays to the same state hash.
  const std::vector<InputEvent>& record() const { return record_; }
  /// What was said of entities; it must have joined.
  const PublisherCounters& published() const { return publisher_->counters(); }
  const ServerCounters& counters() const { return counters_; }
  const std::string& trouble() const {
    return trouble_;
  }  ///< why the RTI refused or left us; empty while all is well

 private:
  struct Seat {
    std::uint32_t player = 0;
    bool is_offered = false;  ///< the player has been told
    bool is_turn_done = false;
    KeysHeld held;               ///< once all that was submitted is felt
    double last_key_s = 0.0;     ///< the simulated instant of the last one
    rti::TokenBucket allowance;  ///< of key changes
  };
  struct Pending {
    double time;
    std::uint32_t player;
  };

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
  void keep_time();
  void ask_for_turns();
  void tell_pace(std::optional<rti::FederateHandle> federate, double now);
  std::optional<std::uint32_t> free_seat(std::string_view federate_name) const;
  void offer_seat(rti::FederateHandle federate, const SeatOffer& offer);
  void offer_seats();
  void receive_key(Seat& seat, rti::Bytes parameters, bool is_down, double wanted_s);
  void receive_wish(Seat& seat, rti::InteractionClassHandle interaction, rti::Bytes parameters);
  void answer(rti::FederateHandle sender, std::uint64_t number);
  void note_inspection(rti::FederateHandle sender, rti::Bytes parameters);
  void publish_match(const rti::Stamp& stamp);
  void announce_match();
  void begin_match();
  void release_keys(Seat& seat);
  bool are_keys_felt() const;
  double simulated_now() const { return simulated_at_clock(now_()); }
  double simulated_at_clock(double now) const;
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
  std::vector<bool>
      is_leaving_;  ///< by player: the bat is to go at an instant that has not been played yet
  std::vector<Pending> pending_;     ///< keys received, not yet felt
  std::vector<std::uint32_t> felt_;  ///< by player
  std::vector<InputEvent> record_;
  std::vector<Inspecting> inspections_;  ///< at most one of each federate
  std::vector<Seated> seated_;
  RelevantKinds always_relevant_;
  std::uint32_t player_count_ = 0, turns_done_ = 0;
  double key_limit_per_s_;
  bool is_synchronous_, is_time_managed_;
  bool hands_in_flights_ = false;
  bool is_called_ = false, is_started_ = false;  ///< the players, to the start
  std::string trouble_;
  ServerCounters counters_;

  // Of a server that hosts matches.
  std::optional<Hosting> hosting_;
  std::optional<Scene> scene_;
  std::optional<MatchFlow> flow_;
  std::optional<MatchState> published_match_;
  rti::ObjectHandle match_;
  double earlier_s_ = 0.0;
  std::uint32_t match_number_ = 0;
  std::vector<KeyLog> finished_;
  double tick_s_;
  bool has_stepped_ =
      false;  ///< since players were last told so, in synchronous mode without time management
  bool is_recorded_ = false;    ///< the present match
  bool is_unrecorded_ = false;  ///< what was played last could not be written
  bool is_urgent_ = false;
};

}  // namespace rink::game
