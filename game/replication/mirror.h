// What one federate knows of the rink: the entities in its interest as it was last told, and nothing else.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "game/replication/attributes.h"
#include "game/replication/object_model.h"
#include "rti/ambassador.h"

namespace rink::game {

/// An entity as its federate last heard of it.
struct MirroredEntity {
  rti::ObjectHandle object;
  Shape shape;
  Input input;
  Position position;
  rti::Stamp stamp;       ///< of the newest update
  bool in_scope = false;  ///< false: it left the federate's interest, the rest is what was true then
};

/// Counts of what came in; malformed values are counted, not applied.
struct MirrorCounters {
  std::uint64_t updates = 0, entered = 0, left = 0, malformed = 0;
};

/// Applies the RTI's callbacks about objects. Look-ups take constant time; nothing is allocated once all entities are known.
class Mirror {
 public:
  explicit Mirror(const ObjectModel& model) : model_(model), position_{model.position} {}

  void discover(rti::ObjectHandle object, rti::ObjectClassHandle object_class);
  void reflect(rti::ObjectHandle object, rti::AttributeSet attributes, rti::Bytes values, const rti::Stamp& stamp);
  void set_scope(rti::ObjectHandle object, bool in_scope);
  void remove(rti::ObjectHandle object);

  /// The entity called `object`, or null if the federate never heard of it or it was removed. Valid until the next discovery or removal.
  const MirroredEntity* find(rti::ObjectHandle object) const;
  /// All that were heard of and not removed, in scope or not, in no particular order.
  std::span<const MirroredEntity> entities() const { return entities_; }

  const Goals& goals() const { return goals_; }
  const std::optional<Extent>& field() const { return field_; }
  const rti::Stamp& newest() const { return newest_; }  ///< the stamp of the newest update of any object
  const MirrorCounters& counters() const { return counters_; }

 private:
  enum class Kind : std::uint8_t { unknown, entity, score, field };
  struct Known {
    Kind kind = Kind::unknown;
    std::uint32_t slot = 0;  ///< in entities_
  };

  Known* known(rti::ObjectHandle object);
  MirroredEntity* entity(rti::ObjectHandle object);
  bool reflect_entity(MirroredEntity& entity, rti::AttributeSet attributes, rti::Bytes values);

  const ObjectModel& model_;
  const rti::AttributeSet position_;
  std::vector<std::vector<Known>> known_;  ///< by object handle: its block, then its number within it
  std::vector<MirroredEntity> entities_;
  Goals goals_;
  std::optional<Extent> field_;
  rti::Stamp newest_;
  MirrorCounters counters_;
};

}  // namespace rink::game
