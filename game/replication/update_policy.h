// When an entity's motion is sent, and as what. Each policy is one class; the publisher asks it
// at each tick about whom the answer may have changed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/replication/object_model.h"
#include "game/replication/trajectory.h"
#include "rti/wire/stream.h"

namespace rink::game {

/// Decides, for every entity and tick, whether its motion goes out.
class UpdatePolicy {
 public:
  virtual ~UpdatePolicy() = default;
  /// The attribute of Entity that holds the motion.
  virtual rti::AttributeHandle motion_attribute(const ObjectModel& model) const = 0;
  /// Asked of entities that were written before.
  virtual bool is_due(const Game& game, const Entity& entity) = 0;
  /// Until when [s] the entity is not due, if its motion goes on as it does: infinity if that is
  /// all that can change it, game.now() or less if it is to be asked about at the next tick. Asked
  /// after `is_due` was false, and after `write`.
  virtual double quiet_until(const Game& game, const Entity& entity) const = 0;
  /// Appends that attribute's value as of game.now(), which is sent: the first time for an entity
  /// that is new, later when it is due.
  virtual void write(const Game& game, const Entity& entity, rti::Writer& value) = 0;
  /// What slows bodies down, as receivers are told it to work out where they are between updates.
  virtual Drag sent_drag(const physics::WorldSpec& spec) const {
    return {.pucks = spec.puck_drag, .bats = spec.bat_drag, .puck_friction = spec.puck_friction};
  }
};

/// Default of `UpdatePolicySettings::threshold`.
inline constexpr double threshold_default = 0.005;

struct UpdatePolicySettings {
  double threshold = threshold_default;  ///< of the dead-reckoning policies: how far receivers may
                                         ///< be off before they are told anew [m], above 0
};

/// The policy called `name`, or nothing if there is none. Names: see `update_policy_names`.
std::unique_ptr<UpdatePolicy> make_update_policy(const std::string& name,
                                                 const UpdatePolicySettings& settings = {});

/// True of the policies that take a threshold.
bool takes_threshold(const std::string& policy);

std::vector<std::string> update_policy_names();

}  // namespace rink::game
