// Decides when and in which form an entity's motion is sent. Each policy is one class; the
// publisher asks it at each tick about entities whose answer may have changed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/replication/object_model.h"
#include "game/replication/trajectory.h"
#include "rti/wire/stream.h"

namespace rink::game {

/// Decides, for every entity and tick, whether its motion is sent.
class UpdatePolicy {
 public:
  virtual ~UpdatePolicy() = default;
  /// The attribute of Entity that holds the motion.
  virtual rti::AttributeHandle motion_attribute(const ObjectModel& model) const = 0;
  /// Called for entities that were written before.
  virtual bool is_due(const Game& game, const Entity& entity) = 0;
  /// The time [s] until which the entity is not due while its motion does not change: infinite if
  /// only that can make it due, game.now() or less if it must be checked at the next tick. Called
  /// after `is_due` was false, and after `write`.
  virtual double quiet_until(const Game& game, const Entity& entity) const = 0;
  /// Appends that attribute's value as of game.now(), which is sent: first for a new entity, later
  /// when it is due.
  virtual void write(const Game& game, const Entity& entity, rti::Writer& value) = 0;
  /// The drag that receivers are sent for their extrapolation.
  virtual Drag sent_drag(const physics::WorldSpec& spec) const { return Drag::of(spec); }
};

/// Default of `UpdatePolicySettings::threshold`.
inline constexpr double threshold_default = 0.005;

struct UpdatePolicySettings {
  double threshold = threshold_default;  ///< of the dead-reckoning policies: the error of receivers
                                         ///< at which an update is sent [m], above 0
};

/// The policy called `name`, or nothing if there is none. Names: see `update_policy_names`.
std::unique_ptr<UpdatePolicy> make_update_policy(const std::string& name,
                                                 const UpdatePolicySettings& settings = {});

/// True of the policies that take a threshold.
bool takes_threshold(const std::string& policy);

std::vector<std::string> update_policy_names();

/// Of the policy under which clients that can compute what they know.
inline constexpr const char* exact_policy = "exact";

}  // namespace rink::game
