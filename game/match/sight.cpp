// Things of a scene in their fixed order, and the memory of the last goal.
#include "game/match/sight.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <span>
#include <utility>

#include "im/basics/checked.h"

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

void drop_scored(MatchSight& sight) {
  std::erase_if(sight.things, [&](const Thing& thing) {
    return thing.kind == physics::BodyKind::puck &&
           (thing.position.x() < 0.0 || thing.position.x() > sight.field.length);
  });
}

void show_prediction(const PredictedRink& rink, double delay_s, LinkFigures& figures) {
  figures.lead_ms = 1e3 * delay_s;
  figures.corrections = rink.own_corrections().visible_count;
  figures.last_correction_mm = 1e3 * rink.own_corrections().last_visible;
}

namespace {

/// Of pucks, those in play are shown, and once the match is over all.
bool is_shown(const Game& game, const Entity& entity) {
  return entity.kind != physics::BodyKind::puck || game.simulator().is_in_play(entity.id) ||
         game.is_over();
}

}  // namespace

void GameSight::show(const Game& game, MatchSight& sight) {
  sight.time = game.now();
  sight.score = game.score();
  const std::optional<EndingPossession> ending = ending_possession(game);
  sight.holder = ending ? std::optional(ending->team) : std::nullopt;
  sight.possession_s = ending ? ending->until - game.now() : 0.0;
  movers_.look(game.world());
  const auto has_other_place = [&](physics::BodyId id) {
    const bool is_there = game.is_there(id) && is_shown(game, game.entity(id));
    return id.index >= place_of_.size() || is_there != (place_of_[id.index] != nowhere);
  };
  if (sight.things.size() != shown_ || game.is_over() != is_over_ ||
      std::ranges::any_of(movers_.changed(), has_other_place))
    return show_all(game, sight);
  for (const std::span<const physics::BodyId> bodies : {movers_.changed(), movers_.moving()})
    for (const physics::BodyId id : bodies) {
      if (place_of_[id.index] == nowhere) continue;
      assert(place_of_[id.index] < sight.things.size());
      Thing& thing = sight.things[place_of_[id.index]];
      thing.position = game.position(id);
      thing.velocity = game.velocity(id);
      if (thing.kind == physics::BodyKind::puck) thing.spin = game.simulator().spin(id);
    }
  if constexpr (checks_whole_structures) check(sight);
}

void GameSight::check(const MatchSight& sight) const {
  assert(sight.things.size() == shown_);
  for (std::size_t place = 0; place < sight.things.size(); ++place)
    assert(sight.things[place].id < place_of_.size() && place_of_[sight.things[place].id] == place);
  assert(shown_ == static_cast<std::size_t>(std::ranges::count_if(
                       place_of_, [](std::uint32_t place) { return place != nowhere; })));
}

void GameSight::show_all(const Game& game, MatchSight& sight) {
  sight.things.clear();
  place_of_.assign(game.world().body_count(), nowhere);
  for (const Entity& entity : game.entities()) {
    if (!is_shown(game, entity)) continue;
    place_of_[entity.id.index] = static_cast<std::uint32_t>(sight.things.size());
    sight.things.push_back({.id = entity.id.index,
                            .kind = entity.kind,
                            .team = entity.team,
                            .position = game.position(entity.id),
                            .velocity = game.velocity(entity.id),
                            .half_extent = entity.half_extent,
                            .spin = entity.kind == physics::BodyKind::puck
                                        ? static_cast<double>(game.simulator().spin(entity.id))
                                        : 0.0});
  }
  shown_ = sight.things.size();
  is_over_ = game.is_over();
  if constexpr (checks_whole_structures) check(sight);
}

void GoalWatch::look(MatchSight& sight, double now_s, double face_off_delay) {
  assert(face_off_delay >= 0.0);
  const bool is_anew = sight.score.left < score_.left || sight.score.right < score_.right;
  if (sight.score != score_ && !is_anew) {
    scorer_ = sight.score.left > score_.left ? Team::left : Team::right;
    goal_time_ = sight.time;
    goal_real_s_ = now_s;
  }
  if (is_anew || sight.time > goal_time_ + face_off_delay) scorer_.reset();
  assert((!scorer_ || now_s >= goal_real_s_) && "real time never falls");
  score_ = sight.score;
  sight.scorer = scorer_;
  sight.since_goal_s = scorer_ ? now_s - goal_real_s_ : 0.0;
  serves_.look(sight, now_s);
}

/// A puck that is put elsewhere leaps further than any flies between two pictures; over a network
/// it does so a round trip after its time is shown to be over.
void ServeWatch::look(MatchSight& sight, double now_s) {
  constexpr double about_over_s = 0.25, leap = 0.3, patience_s = 1.0;
  if (sight.phase != MatchPhase::playing) sight.holder.reset();
  if (sight.holder && sight.possession_s < about_over_s)
    ending_ = sight.holder, ending_real_s_ = now_s;
  if (sight.phase != MatchPhase::playing || now_s > ending_real_s_ + patience_s) ending_.reset();
  const auto has_leapt = [&](const Thing& puck) {
    const auto before = std::ranges::find(pucks_, puck.id, &Thing::id);
    const bool is_left = puck.position.x() < sight.field.length / 2;
    return before != pucks_.end() && (puck.position - before->position).norm() > leap &&
           is_left != (ending_ == Team::left);
  };
  const auto is_puck = [](const Thing& thing) { return thing.kind == physics::BodyKind::puck; };
  std::vector<Thing> pucks;
  std::ranges::copy_if(sight.things, std::back_inserter(pucks), is_puck);
  if (ending_ && std::ranges::any_of(pucks, has_leapt)) {
    served_ = *ending_ == Team::left ? Team::right : Team::left;
    served_real_s_ = now_s;
    ending_.reset();
  }
  pucks_ = std::move(pucks);
  if (sight.phase != MatchPhase::playing || now_s > served_real_s_ + shown_s) served_.reset();
  sight.served = served_;
}

}  // namespace rink::game
