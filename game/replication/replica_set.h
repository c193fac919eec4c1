// What one federate knows of the rink: the entities in its interest as it was last told, and
// nothing else.
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

/// An entity as the last update that its federate received has it.
struct EntityReplica {
  rti::ObjectHandle object;
  Shape shape;
  Input input;
  Position position;  ///< as last told; of those that are told trajectories, where it began
  std::optional<Trajectory> trajectory;  ///< as last told, or begun by the last snapshot; of
                                         ///< entities that are told either
  physics::Motion motion;                ///< the law it stands for
  rti::Stamp stamp;                      ///< of the newest update
  double placed_s = 0.0;                 ///< of what is told positions: the instant of the last
  bool is_predicted = false;  ///< of what is told positions: `motion` leads on from the last
  bool is_placed = false;  ///< it was told where it is since it last left: who discovers an entity,
                           ///< or has it again, may hear that later
  bool in_scope =
      false;  ///< false: it left the federate's interest, the rest is what was true then

  /// Where the federate believes its centre to be at simulated `instant` [s]: on its trajectory if
  /// it was told one, else ahead of where it was last told, or there.
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

  /// From now on entities that are told positions are predicted by the velocity between the last
  /// two. One that went faster than `predicted_speed_max` was put elsewhere, and of two that lie
  /// further apart than `predicted_gap_max` the older says nothing of how it moves.
  void extrapolate() { extrapolates_ = true; }
  static constexpr double predicted_speed_max = 50.0;  ///< m/s
  static constexpr double predicted_gap_max = 1.0;     ///< s

  void discover(rti::ObjectHandle object, rti::ObjectClassHandle object_class);
  void reflect(rti::ObjectHandle object, rti::AttributeSet attributes, rti::Bytes values,
               const rti::Stamp& stamp);
  void set_scope(rti::ObjectHandle object, bool in_scope);
  void remove(rti::ObjectHandle object);

  /// The entity called `object`, or null if the federate never heard of it or it was removed. Valid
  /// until the next discovery or removal.
  const EntityReplica* find(rti::ObjectHandle object) const;
  /// All that were heard of and not removed, in scope or not, in no particular order.
  std::span<const EntityReplica> entities() const { return entities_; }

  const Goals& goals() const { return goals_; }
  const std::optional<Extent>& field() const { return field_; }
  const Drag& drag() const { return drag_; }
  /// Of a hosted match; number 0 before it was heard of.
  const MatchState& match() const { return match_; }
  const std::string& match_scene() const { return match_scene_; }
  double match_tick() const { return match_tick_; }  ///< s; 0 before it was heard of
  bool has_match() const { return has_match_; }
  const rti::Stamp& newest() const {
    return newest_;
  }  ///< the stamp of the newest update of any object
  const ReplicaCounters& counters() const { return counters_; }
  /// Of tables, the set itself not counted.
  std::size_t memory_bytes() const {
    return known_.memory_bytes() + entities_.capacity() * sizeof(EntityReplica);
  }

  /// Asserts that each entity is found where it is kept, and nothing else is taken for one.
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
