// Things of a scene in their fixed order, and the memory of the last goal.
#include "game/match/sight.h"

namespace rink::game {

MatchSight sight_of(const Scene& scene) {
  MatchSight sight;
  sight.field = scene.world.field;
  sight.goals_to_win = scene.rules.goals_to_win;
  const auto add = [&](physics::BodyKind kind, Team team, const Vector2& position,
                       const Vector2& half_extent) {
    const auto id = static_cast<std::uint32_t>(sight.things.size());
    sight.things.push_back(
        {.id = id, .kind = kind, .team = team, .position = position, .half_extent = half_extent});
  };
  for (const Bat& bat : scene.bodies.bats)
    add(physics::BodyKind::bat, bat.team, bat.body.position, bat.body.half_extent);
  for (const Puck& puck : scene.bodies.pucks)
    add(physics::BodyKind::puck, Team::none, puck.body.position,
        Vector2::Constant(puck.body.radius));
  for (const Post& post : scene.bodies.posts)
    add(physics::BodyKind::post, Team::none, post.body.position,
        Vector2::Constant(post.body.radius));
  return sight;
}

void show_game(const Game& game, MatchSight& sight) {
  sight.time = game.now();
  sight.score = game.score();
  sight.things.clear();
  for (const Entity& entity : game.entities()) {
    if (entity.kind == physics::BodyKind::puck && !game.simulator().is_in_play(entity.id) &&
        !game.is_over())
      continue;
    sight.things.push_back({.id = entity.id.index,
                            .kind = entity.kind,
                            .team = entity.team,
                            .position = game.position(entity.id),
                            .velocity = game.velocity(entity.id),
                            .half_extent = entity.half_extent});
  }
}

void GoalWatch::look(MatchSight& sight, double now_s, double face_off_delay) {
  const bool is_anew = sight.score.left < score_.left || sight.score.right < score_.right;
  if (sight.score != score_ && !is_anew) {
    scorer_ = sight.score.left > score_.left ? Team::left : Team::right;
    goal_time_ = sight.time;
    goal_real_s_ = now_s;
  }
  if (is_anew || sight.time > goal_time_ + face_off_delay) scorer_.reset();
  score_ = sight.score;
  sight.scorer = scorer_;
  sight.since_goal_s = scorer_ ? now_s - goal_real_s_ : 0.0;
}

}  // namespace rink::game
