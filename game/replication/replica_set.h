// One federate's replicas: the entities in its interest by their latest updates.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "game/replication/attributes.h"
#include "game/replication/object_model.h"
#include "game/replication/trajectory.h"
#include "rti/ambassador.h"
#include "rti/objects/object_map.h"

namespace rink::game {

/// An entity by the last update that its federate received.
struct EntityReplica {
  rti::ObjectHandle object;
  Shape shape;
  Input input;
  Position position;  ///< by the last update; with trajectories, where the last one began
  std::optional<Trajectory> trajectory;  ///< by the last update, or begun by the last snapshot; for
                                         ///< entities updated by either
  physics::Motion motion;                ///< the law of the trajectory
  rti::Stamp stamp;                      ///< of the newest update
  double placed_s = 0.0;                 ///< with positions: the instant of the last one
  bool is_predicted = false;  ///< with positions: `motion` extrapolates from the last one
  bool is_placed = false;  ///< its position came since it last left; on entry the position may come
                           ///< later
  bool in_scope = false;   ///< false: it left the federate's interest, and the rest is outdated

  /// The believed place of its centre at simulated `instant` [s]: on its trajectory if it has one,
  /// else extrapolated from the last position, or there.
  physics::Vector2 position_at(double instant) const {
    if (is_predicted) return motion.at(std::max(instant, motion.time)).position;
    if (!trajectory) return {static_cast<double>(position.x), static_cast<double>(position.y)};
    return trajectory->is_resting() ? motion.position
                                    : motion.at(std::max(instant, motion.time)).position;
  }
};

/// Counts of what came in; malformed values are counted, not applied.
struct ReplicaCounters {
  std::uint64_t updates = 0, entered = 0, left = 0, malformed = 0;
};

/// Applies the RTI's callbacks about objects. Look-ups take constant time; nothing is allocated
/// once all entities are known.
class ReplicaSet {
 public:
  explicit ReplicaSet(const ObjectModel& model)
      : model_(model),
        position_{model.position},
        trajectory_{model.trajectory},
        snapshot_{model.snapshot} {}

  /// Predicts entities that are updated by positions by the velocity between the last two from now
  /// on. One faster than `predicted_speed_max` was moved by the rules, and two positions further
  /// apart than `predicted_gap_max` give no velocity.
  void extrapolate() { extrapolates_ = true; }
  static constexpr double predicted_speed_max = 50.0;  ///< m/s
  static constexpr double predicted_gap_max = 1.0;     ///< s

  void discover(rti::ObjectHandle object, rti::ObjectClassHandle object_class);
  void reflect(rti::ObjectHandle object, rti::AttributeSet attributes, rti::Bytes values,
               const rti::Stamp& stamp);
  /// An entity that was discovered and is computed here: its law from now on.
  struct Computed {
    rti::ObjectHandle object;
    Shape shape;
    Input input;
    physics::Motion motion;
  };
  void show(const Computed& computed, const rti::Stamp& stamp);
  /// All that is shown is as of `stamp`.
  void show_instant(const rti::Stamp& stamp) { newest_ = stamp; }
  void set_scope(rti::ObjectHandle object, bool in_scope);
  void remove(rti::ObjectHandle object);

  /// The entity of `object`, or null if the federate never discovered it or it was removed. Valid
  /// until the next discovery or removal.
  const EntityReplica* find(rti::ObjectHandle object) const;
  /// All discovered entities that were not removed, in scope or not, in no particular order.
  std::span<const EntityReplica> entities() const { return entities_; }

  const Goals& goals() const { return goals_; }
  const std::optional<Extent>& field() const { return field_; }
  const Drag& drag() const { return drag_; }
  /// The state of a hosted match; number 0 before the first update.
  const MatchState& match() const { return match_; }
  const std::string& match_scene() const { return match_scene_; }
  double match_tick() const { return match_tick_; }  ///< s; 0 before the first update
  bool has_match() const { return has_match_; }
  const rti::Stamp& newest() const {
    return newest_;
  }  ///< the stamp of the newest update of any object
  const ReplicaCounters& counters() const { return counters_; }
  /// Memory of tables, without the set itself [bytes].
  std::size_t memory_bytes() const {
    return known_.memory_bytes() + entities_.capacity() * sizeof(EntityReplica);
  }

  /// Asserts that each entity is found at its place, and nothing else.
  void check() const;

 private:
  enum class Kind : std::uint8_t { entity, score, field, match };
  struct Known {
    Kind kind = Kind::entity;
    std::uint32_t slot = 0;  ///< in entities_
  };

  EntityReplica* entity(rti::ObjectHandle object);
  bool reflect_entity(EntityReplica& entity, rti::AttributeSet attributes, rti::Bytes values);
  bool reflect_snapshot(rti::Reader& reader, EntityReplica& entity) const;
  void place(EntityReplica& entity, const Position& position) const;
  bool reflect_field(rti::AttributeSet attributes, rti::Bytes values);
  bool reflect_match(rti::AttributeSet attributes, rti::Bytes values);
  void follow_law(EntityReplica& entity) const;

  const ObjectModel& model_;
  const rti::AttributeSet position_, trajectory_, snapshot_;
  rti::ObjectMap<Known> known_;
  std::vector<EntityReplica> entities_;
  Goals goals_;
  std::optional<Extent> field_;
  MatchState match_;
  std::string match_scene_;
  double match_tick_ = 0.0;
  bool has_match_ = false, extrapolates_ = false;
  Drag drag_;
  rti::Stamp newest_;
  ReplicaCounters counters_;
};

}  // namespace rink::game
