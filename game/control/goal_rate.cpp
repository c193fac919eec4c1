// Plays the games and sums up.
#include "game/control/goal_rate.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/control/playing.h"
#include "game/model/random_stream.h"
#include "game/model/state_hash.h"

namespace rink::game {
namespace {

Scene start_of(Scene scene, std::uint64_t seed) {
  scene.rules.goals_to_win.reset();
  scene.seed = seed;
  constexpr std::uint32_t stream =
      0x7061'6365;  // apart from the players', which are numbered from 0
  RandomStream random(seed, stream);
  for (Puck& puck : scene.bodies.pucks)
    puck.body.velocity = random.direction() * puck.body.velocity.norm();
  return scene;
}

struct Played {
  std::uint32_t left = 0, right = 0;
  std::uint64_t serves = 0;
  double longest_wait_s = 0.0;
  std::uint64_t hash = 0;
};

Played played(const Scene& scene, const GoalRatePlan& plan, std::uint64_t seed) {
  Playing playing(start_of(scene, seed), plan.players, seed, plan.seconds);
  Played sum;
  constexpr double stride_s = 0.05;
  Score score;
  for (double now = 0.0, goal_s = 0.0; now < plan.seconds;) {
    now = std::min(plan.seconds, now + stride_s);
    playing.advance(now);
    sum.longest_wait_s = std::max(sum.longest_wait_s, now - goal_s);
    if (playing.game().score() != score) score = playing.game().score(), goal_s = now;
  }
  sum.serves = playing.serve_count();
  sum.left = playing.game().score().left, sum.right = playing.game().score().right;
  sum.hash = playing.game().hash();
  return sum;
}

}  // namespace

GoalRate goal_rate(const Scene& scene, const GoalRatePlan& plan) {
  assert(plan.games > 0 && plan.seconds > 0.0);
  const double minutes = plan.seconds / 60.0;
  GoalRate rate;
  StateHash hash;
  double sum = 0.0, squares = 0.0;
  for (; rate.games < plan.games; ++rate.games) {
    if (rate.games > 0 && plan.is_interrupted && plan.is_interrupted()) break;
    const Played one = played(scene, plan, plan.seed + rate.games);
    rate.left_per_min += one.left / minutes;
    rate.right_per_min += one.right / minutes;
    rate.serves_per_min += static_cast<double>(one.serves) / minutes;
    rate.longest_wait_s = std::max(rate.longest_wait_s, one.longest_wait_s);
    hash.add(one.hash);
    const double goals = (one.left + one.right) / minutes;
    sum += goals, squares += goals * goals;
  }
  const double games = rate.games;
  for (double* const sum_of : {&rate.left_per_min, &rate.right_per_min, &rate.serves_per_min})
    *sum_of /= games;
  if (rate.games > 1)
    rate.error_per_min =
        1.96 * std::sqrt(std::max(0.0, squares - sum * sum / games) / (games - 1.0) / games);
  rate.hash = hash.value();
  return rate;
}

}  // namespace rink::game
