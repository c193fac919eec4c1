// Turns what a game did since the last tick into RTI updates: the only way by which entities leave
// the server.
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

/// What a publisher sent since it was made.
struct PublisherCounters {
  std::uint64_t motions_sent = 0, inputs_sent = 0, regions_moved = 0, entities_skipped = 0;
  std::uint64_t entities_looked_at = 0;  ///< policy or region were asked about
};

/// Registers a game's entities as RTI objects, each with its bounding box as update region, and
/// keeps both up to date. Motion goes out when and as the policy says, the rest when it changes. An
/// entity costs nothing at a tick at which neither its motion nor its keys changed and of which the
/// policy and the region's keeper have said that they need not look at it.
class Publisher {
 public:
  /// `ambassador` must have joined. Publishes the classes and registers the field and the score.
  Publisher(const ObjectModel& model, rti::Ambassador& ambassador, UpdatePolicy& policy,
            const Game& game, const RegionSweep& sweep = {});

  /// Hands everything new to the ambassador: entities that came or went, moved regions, due
  /// motions, felt keys, the score. `felt[k]` is the number of player k's key events that the game
  /// has felt; players beyond its end felt none.
  void publish(const Game& game, std::span<const std::uint32_t> felt, const rti::Stamp& stamp);

  /// From now on what changes of entities and score is said in time-stamp order, wherever its stamp
  /// lies ahead of the ambassador's logical time by its lookahead.
  void keep_order();

  /// Deletes the objects of all entities: another game begins.
  void retire_all();

  /// Entities that the last `publish` registered, with their objects.
  struct Registered {
    rti::ObjectHandle object;
    Entity entity;
  };
  std::span<const Registered> registered() const { return registered_; }

  /// From now on the region of what flies freely is moved only when it takes another flight, and
  /// `flights` lists these: for a filter that knows how things fly on. Bats under thrust, and pucks
  /// that friction brings to rest, fly by another law, so their regions follow them as ever.
  /// Changes nothing where regions are swept.
  void hand_in_flights() { hands_in_flights_ = !sweep_.is_on(); }
  struct FlightRegistration {
    rti::ObjectHandle object;
    im::Flight flight;
  };
  /// That the last `publish` found to be new.
  std::span<const FlightRegistration> flights() const { return flights_; }

  /// The RTI object of `entity`, which must be in the game.
  rti::ObjectHandle object(EntityId entity) const {
    assert(entity.index < published_.size());
    return published_[entity.index].object;
  }

  /// False of the field and the score.
  bool is_entity(rti::ObjectHandle object) const { return object != field_ && object != score_; }

  const PublisherCounters& counters() const { return counters_; }

  /// Asserts that whom the next tick looks at is in order, that whoever is to be woken will be, and
  /// that no two entities have one object.
  void check() const;

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  struct Published {
    rti::ObjectHandle object;
    rti::RegionHandle region;
    Entity entity;
    Position position;  ///< that its region was last moved to
    Input input;
    double wake_s = never;  ///< the earliest of `wakes_` that is its own
    std::optional<std::uint32_t>
        registered_flight;  ///< version of the motion whose flight was handed in
    RegionSweep::Swept swept;
  };

  /// An entity that is to be looked at at the first tick after `time_s`.
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
