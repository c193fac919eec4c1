// The paper's policy, positions every tick; delta snapshots; dead reckoning; and the one of exact
// motion, a trajectory when it changes.
#include "game/replication/update_policy.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "game/replication/attributes.h"
#include "game/replication/trajectory.h"

namespace rink::game {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

/// Neither in motion nor under thrust; a scored puck lies where it left play.
bool stays(const Game& game, const Entity& entity) {
  return !game.world().is_in_play(entity.id) || game.world().is_resting(entity.id);
}

class Periodic : public UpdatePolicy {
 public:
  rti::AttributeHandle motion_attribute(const ObjectModel& model) const override {
    return model.position;
  }
  /// Posts never move: their position is part of the state that a federate gets when they enter its
  /// interest.
  bool is_due(const Game&, const Entity& entity) override {
    return entity.kind != physics::BodyKind::post;
  }
  double quiet_until(const Game& game, const Entity& entity) const override {
    return entity.kind == physics::BodyKind::post ? forever : game.now();
  }
  void write(const Game& game, const Entity& entity, rti::Writer& value) override {
    Position position = rounded(game.position(entity.id));
    exchange(value, position);
  }
};

Snapshot snapshot_of(const physics::World& world, physics::BodyId body) {
  Snapshot snapshot{.position = world.position(body)};
  if (!world.is_in_play(body) || world.is_resting(body)) return snapshot;
  const physics::Motion motion = world.motion(body);
  snapshot.velocity = motion.at(std::max(world.now(), motion.time)).velocity;
  return snapshot;
}

/// Sends where every moving body is and how fast, every tick: delta snapshots, for the RTI tells
/// each receiver the difference to what the velocity foretold from a state that it acknowledged.
class Snapshots : public UpdatePolicy {
 public:
  rti::AttributeHandle motion_attribute(const ObjectModel& model) const override {
    return model.snapshot;
  }
  bool is_due(const Game& game, const Entity& entity) override {
    assert(entity.id.index < told_.size());
    return entity.kind != physics::BodyKind::post &&
           snapshot_of(game.world(), entity.id) != told_[entity.id.index];
  }
  double quiet_until(const Game& game, const Entity& entity) const override {
    return stays(game, entity) ? forever : game.now();
  }
  void write(const Game& game, const Entity& entity, rti::Writer& value) override {
    if (told_.size() <= entity.id.index) told_.resize(entity.id.index + 1);
    Snapshot& told = told_[entity.id.index];
    told = snapshot_of(game.world(), entity.id);
    exchange(value, told);
  }

 private:
  std::vector<Snapshot> told_;  ///< by entity
};

/// Sends where a body is, how fast and by which law when the one told last no longer foretells it;
/// between, receivers evaluate the engine's own closed form.
class OnEvent : public UpdatePolicy {
 public:
  rti::AttributeHandle motion_attribute(const ObjectModel& model) const override {
    return model.trajectory;
  }

  bool is_due(const Game& game, const Entity& entity) override {
    if (entity.kind == physics::BodyKind::post) return false;
    assert(entity.id.index < told_.size() && "it was written before");
    Told& told = told_[entity.id.index];
    const std::uint32_t version = game.world().motion_version(entity.id);
    if (version == told.version && game.now() <= told.until_s) return false;
    // An event that changes next to nothing, as those of bodies pressed to each other, need not be
    // told.
    told.version = version;
    told.until_s = holds_until(game.world(), entity.id, told.trajectory);
    return told.until_s < game.now() + worthwhile_s;
  }
  double quiet_until(const Game&, const Entity& entity) const override {
    return entity.kind == physics::BodyKind::post ? forever : told_[entity.id.index].until_s;
  }

  void write(const Game& game, const Entity& entity, rti::Writer& value) override {
    if (told_.size() <= entity.id.index) told_.resize(entity.id.index + 1);
    Told& told = told_[entity.id.index];
    told.version = game.world().motion_version(entity.id);
    told.trajectory = trajectory_of(game.world(), entity.id);
    told.until_s = holds_until(game.world(), entity.id, told.trajectory);
    exchange(value, told.trajectory);
  }

 private:
  static constexpr double worthwhile_s =
      0.1;  ///< one that is to be replaced so soon may as well be replaced now
  struct Told {
    std::uint32_t version = 0;
    double until_s = 0.0;
    Trajectory trajectory;
  };
  std::vector<Told> told_;  ///< by entity
};

/// Sends where a body is and how fast when receivers, who let it go on from what they were told
/// last, are off by more than a threshold (IEEE 1278.1-2012, 4.2.2 and annex E). They know of no
/// thrust; of drag only if the field tells them.
class DeadReckoning : public UpdatePolicy {
 public:
  DeadReckoning(double threshold, bool knows_drag)
      : threshold_(threshold), knows_drag_(knows_drag) {
    assert(threshold > 0.0);
  }
  rti::AttributeHandle motion_attribute(const ObjectModel& model) const override {
    return model.trajectory;
  }
  Drag told_drag(const physics::WorldSpec& spec) const override {
    return knows_drag_ ? UpdatePolicy::told_drag(spec) : Drag{};
  }

  bool is_due(const Game& game, const Entity& entity) override {
    if (entity.kind == physics::BodyKind::post) return false;
    assert(entity.id.index < told_.size() && "it was written before");
    const Told& told = told_[entity.id.index];
    const bool is_resting = told.trajectory.is_resting();
    if (!is_resting && game.now() > told.trajectory.time + trajectory_age_max) return true;
    const physics::Vector2 shown = is_resting
                                       ? told.trajectory.position
                                       : told.law.at(std::max(game.now(), told.law.time)).position;
    return (shown - game.position(entity.id)).norm() > threshold_;
  }
  double quiet_until(const Game& game, const Entity& entity) const override {
    return stays(game, entity) && told_[entity.id.index].trajectory.is_resting() ? forever
                                                                                 : game.now();
  }

  void write(const Game& game, const Entity& entity, rti::Writer& value) override {
    if (told_.size() <= entity.id.index) told_.resize(entity.id.index + 1);
    Told& told = told_[entity.id.index];
    const Resistance own = told_drag(game.world().spec()).of(entity.kind);
    const Snapshot now = snapshot_of(game.world(), entity.id);
    told.trajectory = extrapolation_of(now.position, now.velocity, game.now(), own);
    told.law = motion_of(told.trajectory, own);
    exchange(value, told.trajectory);
  }

 private:
  struct Told {
    Trajectory trajectory;
    physics::Motion law;
  };
  const double threshold_;
  const bool knows_drag_;
  std::vector<Told> told_;  ///< by entity
};

}  // namespace

std::unique_ptr<UpdatePolicy> make_update_policy(const std::string& name,
                                                 const UpdatePolicySettings& settings) {
  if (name == "periodic") return std::make_unique<Periodic>();
  if (name == "snapshot") return std::make_unique<Snapshots>();
  if (name == "dead-reckoning") return std::make_unique<DeadReckoning>(settings.threshold, false);
  if (name == "dead-reckoning-drag")
    return std::make_unique<DeadReckoning>(settings.threshold, true);
  if (name == "on-event") return std::make_unique<OnEvent>();
  return nullptr;
}

std::vector<std::string> update_policy_names() {
  return {"periodic", "snapshot", "dead-reckoning", "dead-reckoning-drag", "on-event"};
}

bool takes_threshold(const std::string& policy) { return policy.starts_with("dead-reckoning"); }

}  // namespace rink::game
