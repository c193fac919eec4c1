// Turns a game's changes since the last tick into RTI updates, the only path of entities out of the
// server.
#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "game/control/game.h"
#include "game/physics/movers.h"
#include "game/replication/attributes.h"
#include "game/replication/object_model.h"
#include "game/replication/region_sweep.h"
#include "game/replication/update_policy.h"
#include "rti/ambassador.h"

namespace rink::game {

/// Counts of a publisher since it was made.
struct PublisherCounters {
  std::uint64_t motions_sent = 0, inputs_sent = 0, regions_moved = 0, entities_skipped = 0;
  std::uint64_t entities_looked_at = 0;  ///< checks of policy or region
};

/// Registers a game's entities as RTI objects, each with its bounding box as update region, and
/// keeps both up to date. The policy decides when and how motion is sent; other values are sent
/// when they change. An entity costs nothing at a tick without a change of its motion or keys and
/// without a check that policy or region have scheduled.
class Publisher {
 public:
  /// `ambassador` must have joined. Publishes the classes and registers the field and the score.
  Publisher(const ObjectModel& model, rti::Ambassador& ambassador, UpdatePolicy& policy,
            const Game& game, const RegionSweep& sweep = {});

  /// Passes all changes to the ambassador: new and removed entities, moved regions, due motions,
  /// keys in effect, the score. `felt[k]` is the number of player k's key events in effect; it is 0
  /// beyond the end.
  void publish(const Game& game, std::span<const std::uint32_t> felt, const rti::Stamp& stamp);

  /// Sends changes of entities and score in time-stamp order from now on, if their stamp is ahead
  /// of the ambassador's logical time by its lookahead.
  void keep_order();

  /// Deletes the objects of all entities: another game begins.
  void retire_all();

  /// The game's owner is not told of the entity any more: it is in no federate's scope, whatever
  /// the filter decides, until it is shown.
  void hide(EntityId entity);
  void show(EntityId entity);
  std::size_t hidden_count() const;  ///< by counting

  /// Entities that the last `publish` registered, with their objects.
  struct Registered {
    rti::ObjectHandle object;
    Entity entity;
  };
  std::span<const Registered> registered() const { return registered_; }

  /// Moves regions of freely flying bodies only for new flights from now on, and lists these in
  /// `flights`, for a filter that uses motions. Accelerated bats, and pucks that friction brings to
  /// rest, follow another law, so their regions follow them as before. Without effect if regions
  /// are swept.
  void hand_in_flights() { hands_in_flights_ = !sweep_.is_on(); }
  struct FlightRegistration {
    rti::ObjectHandle object;
    im::Flight flight;
  };
  /// The flights that the last `publish` found new.
  std::span<const FlightRegistration> flights() const { return flights_; }

  /// The RTI object of `entity`, which must be in the game.
  rti::ObjectHandle object(EntityId entity) const {
    assert(entity.index < published_.size());
    return published_[entity.index].object;
  }

  /// Attributes of entities that are updated when something happens to the entity, as opposed to
  /// positions and snapshots, which are updated at every tick.
  rti::AttributeSet event_attributes() const { return {model_.input, model_.trajectory}; }

  /// False of the field and the score.
  bool is_entity(rti::ObjectHandle object) const { return object != field_ && object != score_; }

  const PublisherCounters& counters() const { return counters_; }

  /// Asserts that the next tick's entities are in order, that all scheduled checks are queued, and
  /// that no two entities share an object.
  void check() const;

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  struct Published {
    rti::ObjectHandle object;
    rti::RegionHandle region;
    Entity entity;
    Position position;  ///< to which its region was last moved
    Input input;
    double wake_s = never;  ///< the earliest of its entries in `wakes_`
    std::optional<std::uint32_t>
        registered_flight;  ///< version of the motion whose flight was registered
    RegionSweep::Swept swept;
    bool is_hidden = false;  ///< its region was never committed then, which nothing overlaps
  };

  /// An entity that is checked at the first tick after `time_s`.
  struct Wake {
    double time_s;
    EntityId entity;
    friend bool operator<(const Wake& a, const Wake& b) { return a.time_s > b.time_s; }
  };

  void gather(const Game& game, std::span<const std::uint32_t> felt);
  void add(const Game& game, const Entity& entity, const Input& input, const rti::Stamp& stamp);
  void retire_gone(const Game& game);
  void retire(Published& published);
  void follow(const Game& game, const Entity& entity, Published& published);
  bool fly(const Game& game, const Entity& entity, Published& published);
  /// True if anything was sent.
  bool update(const Game& game, Published& published, const Input& input, const rti::Stamp& stamp);
  double region_holds_until(const Game& game, const Published& published) const;
  void schedule(const Game& game, Published& published);
  void notify(rti::ObjectHandle object, rti::AttributeSet attributes, rti::Bytes values,
              const rti::Stamp& stamp);
  void publish_score(const Game& game, const rti::Stamp& stamp);

  const ObjectModel& model_;
  rti::Ambassador& ambassador_;
  UpdatePolicy& policy_;
  const rti::AttributeHandle motion_;
  RegionSweep sweep_;
  physics::Movers movers_;
  std::vector<Published> published_;       ///< by entity
  std::vector<EntityId> active_, looked_;  ///< to be looked at at the next tick, and at this; by id
  std::vector<Wake> wakes_;                ///< a heap, earliest first
  std::vector<Registered> registered_;
  std::vector<FlightRegistration> flights_;
  std::vector<rti::RegionBounds> moved_;
  std::vector<std::byte> encoded_;
  rti::ObjectHandle field_, score_;
  Goals goals_;
  bool keeps_order_ = false, hands_in_flights_ = false;
  PublisherCounters counters_;
};

}  // namespace rink::game
