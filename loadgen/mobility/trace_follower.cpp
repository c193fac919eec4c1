// Gives the body of each agent the motion of its leg.
#include "loadgen/mobility/trace_follower.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "game/physics/subdomain.h"

namespace rink::loadgen {

TraceFollower::TraceFollower(MobilityTrace trace)
    : trace_(std::move(trace)), is_there_(trace_.agents.size(), true) {
  for (std::uint32_t agent = 0; agent < agent_count(); ++agent)
    due_.push_back({-std::numeric_limits<double>::infinity(), agent});
  std::make_heap(due_.begin(), due_.end());
}

void TraceFollower::show(double until_s, game::Game& game) {
  assert(game.player_count() == agent_count() && until_s >= game.now());
  came_.clear(), left_.clear(), shown_.clear();
  while (!due_.empty() && due_.front().time_s <= until_s) {
    const std::uint32_t agent = due_.front().agent;
    std::pop_heap(due_.begin(), due_.end());
    due_.pop_back();
    follow(agent, until_s, game);
  }
  std::ranges::sort(came_);
  std::ranges::sort(left_);
  game.show(until_s, shown_, {}, {});
}

/// A leg that began before the game does is shown from its beginning on.
void TraceFollower::follow(std::uint32_t agent, double until_s, const game::Game& game) {
  const Leg leg = leg_at(trace_.agents[agent], until_s);
  assert(leg.until_s > until_s);
  const double since_s = std::max(leg.since_s, 0.0);
  const Vector2 place = leg.is_there && leg.since_s < 0.0
                            ? Vector2(leg.place - leg.velocity * leg.since_s)
                            : leg.place;
  const game::EntityId id = game.bat(agent).value();
  physics::BodyState state = physics::Subdomain::state_in(game.world(), id.index);
  state.flight.x = place.x(), state.flight.y = place.y();
  state.flight.vx = leg.velocity.x(), state.flight.vy = leg.velocity.y();
  state.flight.time = since_s;
  shown_.push_back({id, state});
  if (leg.is_there != is_there_[agent]) (leg.is_there ? came_ : left_).push_back(agent);
  is_there_[agent] = leg.is_there;
  if (leg.until_s < std::numeric_limits<double>::infinity()) {
    due_.push_back({leg.until_s, agent});
    std::push_heap(due_.begin(), due_.end());
  }
}

}  // namespace rink::loadgen
