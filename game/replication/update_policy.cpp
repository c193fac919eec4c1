// The paper's policy: the position of all that can move, every tick.
#include "game/replication/update_policy.h"

namespace rink::game {
namespace {

class Periodic : public UpdatePolicy {
 public:
  /// Posts never move: their position is part of the state that a federate gets when they enter its interest.
  bool is_due(const Game&, const Entity& entity) override { return entity.kind != physics::BodyKind::post; }
};

}  // namespace

std::unique_ptr<UpdatePolicy> make_update_policy(const std::string& name) {
  if (name == "periodic") return std::make_unique<Periodic>();
  return nullptr;
}

std::vector<std::string> update_policy_names() { return {"periodic"}; }

}  // namespace rink::game
