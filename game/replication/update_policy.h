// When an entity's motion is sent. Each policy is one class; the publisher asks it once for each entity and tick.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "game/control/game.h"

namespace rink::game {

/// Decides, for every entity and tick, whether its position goes out.
class UpdatePolicy {
 public:
  virtual ~UpdatePolicy() = default;
  virtual bool is_due(const Game& game, const Entity& entity) = 0;
};

/// The policy called `name`, or nothing if there is none. Names: see `update_policy_names`.
std::unique_ptr<UpdatePolicy> make_update_policy(const std::string& name);

std::vector<std::string> update_policy_names();

}  // namespace rink::game
