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

/// True of a body that neither moves nor is accelerated; a scored puck stays where it left play.
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

/// Sends place and velocity of every moving body, every tick: delta snapshots, since the RTI sends
/// each receiver the difference to the prediction from an acknowledged state.
class Snapshots : public UpdatePolicy {
 public:
  rti::AttributeHandle motion_attribute(const ObjectModel& model) const override {
    return model.snapshot;
  }
  bool is_due(const Game& game, const Entity& entity) override {
    assert(entity.id.index < last_sent_.size());
    return entity.kind != physics::BodyKind::post &&
           snapshot_of(game.world(), entity.id) != last_sent_[entity.id.index];
  }
  double quiet_until(const Game& game, const Entity& entity) const override {
    return stays(game, entity) ? forever : game.now();
  }
  void write(const Game& game, const Entity& entity, rti::Writer& value) override {
    if (last_sent_.size() <= entity.id.index) last_sent_.resize(entity.id.index + 1);
    Snapshot& last_sent = last_sent_[entity.id.index];
    last_sent = snapshot_of(game.world(), entity.id);
    exchange(value, last_sent);
  }

 private:
  std::vector<Snapshot> last_sent_;  ///< by entity
};

/// Sends a body's place, velocity and law when the last one no longer predicts it; in between,
/// receivers evaluate the engine's own closed form.
class OnEvent : public UpdatePolicy {
 public:
  rti::AttributeHandle motion_attribute(const ObjectModel& model) const override {
    return model.trajectory;
  }

  bool is_due(const Game& game, const Entity& entity) override {
    if (entity.kind == physics::BodyKind::post) return false;
    assert(entity.id.index < last_sent_.size() && "it was written before");
    LastSent& last_sent = last_sent_[entity.id.index];
    const std::uint32_t version = game.world().motion_version(entity.id);
    if (version == last_sent.version && game.now() <= last_sent.sent.until_s) return false;
    last_sent.version = version;
    return last_sent.sent.must_be_renewed(game.world(), entity.id);
  }
  double quiet_until(const Game&, const Entity& entity) const override {
    return entity.kind == physics::BodyKind::post ? forever
                                                  : last_sent_[entity.id.index].sent.until_s;
  }

  void write(const Game& game, const Entity& entity, rti::Writer& value) override {
    if (last_sent_.size() <= entity.id.index) last_sent_.resize(entity.id.index + 1);
    LastSent& last_sent = last_sent_[entity.id.index];
    last_sent.version = game.world().motion_version(entity.id);
    last_sent.sent.renew(game.world(), entity.id);
    exchange(value, last_sent.sent.trajectory);
  }

 private:
  struct LastSent {
    std::uint32_t version = 0;
    SentTrajectory sent;
  };
  std::vector<LastSent> last_sent_;  ///< by entity
};

/// Sends a body's place and velocity when the extrapolation of receivers from the last update is
/// off by more than a threshold (IEEE 1278.1-2012, 4.2.2 and annex E). They know no acceleration,
/// and drag only from the field's object.
class DeadReckoning : public UpdatePolicy {
 public:
  DeadReckoning(double threshold, bool knows_drag)
      : threshold_(threshold), knows_drag_(knows_drag) {
    assert(threshold > 0.0);
  }
  rti::AttributeHandle motion_attribute(const ObjectModel& model) const override {
    return model.trajectory;
  }
  Drag sent_drag(const physics::WorldSpec& spec) const override {
    return knows_drag_ ? UpdatePolicy::sent_drag(spec) : Drag{};
  }

  bool is_due(const Game& game, const Entity& entity) override {
    if (entity.kind == physics::BodyKind::post) return false;
    assert(entity.id.index < last_sent_.size() && "it was written before");
    const LastSent& last_sent = last_sent_[entity.id.index];
    const bool is_resting = last_sent.trajectory.is_resting();
    if (!is_resting && game.now() > last_sent.trajectory.time + trajectory_age_max) return true;
    const physics::Vector2 shown =
        is_resting ? last_sent.trajectory.position
                   : last_sent.law.at(std::max(game.now(), last_sent.law.time)).position;
    return (shown - game.position(entity.id)).norm() > threshold_;
  }
  double quiet_until(const Game& game, const Entity& entity) const override {
    return stays(game, entity) && last_sent_[entity.id.index].trajectory.is_resting() ? forever
                                                                                      : game.now();
  }

  void write(const Game& game, const Entity& entity, rti::Writer& value) override {
    if (last_sent_.size() <= entity.id.index) last_sent_.resize(entity.id.index + 1);
    LastSent& last_sent = last_sent_[entity.id.index];
    const Resistance own = sent_drag(game.world().spec()).of(entity.kind);
    const Snapshot now = snapshot_of(game.world(), entity.id);
    last_sent.trajectory = extrapolation_of(now.position, now.velocity, game.now(), own);
    last_sent.law = motion_of(last_sent.trajectory, own);
    exchange(value, last_sent.trajectory);
  }

 private:
  struct LastSent {
    Trajectory trajectory;
    physics::Motion law;
  };
  const double threshold_;
  const bool knows_drag_;
  std::vector<LastSent> last_sent_;  ///< by entity
};

}  // namespace

std::unique_ptr<UpdatePolicy> make_update_policy(const std::string& name,
                                                 const UpdatePolicySettings& settings) {
  if (name == "periodic") return std::make_unique<Periodic>();
  if (name == "snapshot") return std::make_unique<Snapshots>();
  if (name == "dead-reckoning") return std::make_unique<DeadReckoning>(settings.threshold, false);
  if (name == "dead-reckoning-drag")
    return std::make_unique<DeadReckoning>(settings.threshold, true);
  // Who computes is sent by the host what that takes (exact/exact_feed.h); who does not, all else.
  if (name == "on-event" || name == exact_policy) return std::make_unique<OnEvent>();
  return nullptr;
}

std::vector<std::string> update_policy_names() {
  return {"periodic", "snapshot",  "dead-reckoning", "dead-reckoning-drag",
          "on-event", exact_policy};
}

bool takes_threshold(const std::string& policy) { return policy.starts_with("dead-reckoning"); }

}  // namespace rink::game
