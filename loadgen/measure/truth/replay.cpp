// Replays the scene as the server chose it, with every key at its stamped instant.
#include "loadgen/measure/truth/replay.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "game/control/game_state.h"
#include "game/net/trace_lines.h"

namespace rink::loadgen {

Replay::Replay(const game::ServerTrace& trace, const RelevanceArea& area)
    : Replay(played_scene(trace.choice), trace, area) {}

Replay::Replay(PlayedScene played, const game::ServerTrace& trace, const RelevanceArea& area)
    : game_(trace.state_file.empty()
                ? game::Game(played.scene)
                : game::game_in_state(trace.state, played.scene, trace.state_file)),
      begin_s_(game_.now()),
      area_(area),
      surroundings_(area, played.scene.world.field.length, played.scene.world.field.width),
      puck_reach_(area.contact_s, played.scene.world.puck_drag, played.scene.world.puck_friction),
      bat_reach_(area.contact_s, played.scene.world.bat_drag, 0.0),
      encounters_(played.scene.world.field.length, played.scene.world.field.width),
      rate_hz_(trace.rate_hz) {
  const game::Scene& scene = played.scene;
  for (const game::Bat& bat : scene.bodies.bats)
    acceleration_max_.push_back(std::numbers::sqrt2 * bat.thrust);  // two neighbouring keys
  if (area.shape == RelevanceArea::Shape::filter) filter_.emplace(area, scene);
  game_.record_events(true);
  for (const game::InputEvent& event : trace.keys) {
    if (event.player >= game_.player_count())
      throw game::TraceError("the server's evidence has keys of player " +
                             std::to_string(event.player) + ", but its scene has " +
                             std::to_string(game_.player_count()) + " bats");
    if (event.time < begin_s_)
      throw game::TraceError("the server's evidence has keys from before " + trace.state_file +
                             ", which it began from");
    game_.submit(event);
  }
  for (const game::ServerTrace::Naming& naming : trace.objects)
    entities_[naming.object] = naming.body;
  if (!played.trace) return;
  follower_.emplace(*std::move(played.trace));
  follower_->show(begin_s_, game_);
}

void Replay::advance(double instant_s) {
  if (!(instant_s > game_.now())) return;
  if (follower_) follower_->show(instant_s, game_);
  else game_.advance(instant_s);
}

void Replay::look_around() {
  centres_.assign(game_.world().body_count(), std::nullopt);
  around_.assign(is_of_contact() ? centres_.size() : 0, 0.0);
  placed_.clear(), reaching_.clear();
  for (const game::Entity& entity : game_.entities()) {
    if (follower_ && !follower_->is_there(*entity.player)) continue;
    const Vector2 centre = announced_centre(entity.id);
    centres_[entity.id.index] = centre;
    if (filter_) continue;
    if (!is_of_contact()) {
      placed_.push_back({entity.id.index, centre, entity.half_extent});
      continue;
    }
    const bool is_disc = entity.kind != physics::BodyKind::bat;
    around_[entity.id.index] =
        (is_disc ? entity.half_extent.x() : entity.half_extent.norm()) + reach(entity);
    reaching_.push_back({entity.id.index, centre, around_[entity.id.index],
                         entity.kind == physics::BodyKind::puck});
  }
  if (filter_) filter_->look_around(game_, centres_);
  else if (is_of_contact()) encounters_.build(reaching_);
  else surroundings_.build(placed_);
}

/// How far the entity can get by its own law; 0 for a puck that is not at its announced place yet.
double Replay::reach(const game::Entity& entity) const {
  if (entity.kind == physics::BodyKind::post || away_[entity.id.index]) return 0.0;
  const physics::Motion motion = game_.world().motion(entity.id);
  const bool is_adrift =
      motion.acceleration.isZero(0.0) &&
      motion.drag.x() == motion.drag.y();  // nearly all are, and then it costs half
  const double speed =
      is_adrift ? motion.velocity.norm() * std::exp(-motion.drag.x() * (game_.now() - motion.time))
                : game_.velocity(entity.id).norm();
  return entity.kind == physics::BodyKind::bat
             ? bat_reach_.of(speed, acceleration_max_[*entity.player])
             : puck_reach_.of(speed);
}

double Replay::passed(std::uint32_t own, const Relevant& now) {
  if (filter_) return 1.0;  // a filter decides relevance without a depth
  Encounters::Way way{now.depth, std::nullopt};
  if (is_of_contact() && std::isfinite(now.depth)) way = encounters_.way(own, now.entity);
  const std::optional<double> before = depth_before(own, now.entity, way);
  return before && *before < 0.0 ? *before / (*before - way.depth) : 1.0;
}

std::optional<double> Replay::depth_before(std::uint32_t own, std::uint32_t entity,
                                           const Encounters::Way& way) const {
  if (!way.via) return depth_before(own, entity);
  const auto first = depth_before(own, *way.via), second = depth_before(*way.via, entity);
  return first && second ? std::optional(std::min(*first, *second)) : std::nullopt;
}

std::optional<double> Replay::depth_before(std::uint32_t a, std::uint32_t b) const {
  if (a >= before_.size() || b >= before_.size() || !before_[a] || !before_[b]) return std::nullopt;
  assert(!is_of_contact() || around_before_.size() == before_.size());
  if (is_of_contact())
    return around_before_[a] + around_before_[b] - (*before_[a] - *before_[b]).norm();
  return depth(area_, *before_[a], *before_[b], half_extent(b));
}

void Replay::find(std::uint32_t own, std::vector<Relevant>& found) {
  if (filter_) filter_->find(own, game_, centres_, found);
  else if (is_of_contact()) encounters_.find(own, found);
  else surroundings_.find(centre(own), own, found);
  assert(std::ranges::adjacent_find(found, std::greater_equal<>(), &Relevant::entity) ==
         found.end());
  if (!area_.has_team && !area_.always) return;
  const game::Team team = game_.entity({own}).team;
  const std::size_t near = found.size();
  for (const game::Entity& each : game_.entities()) {
    if (each.id.index == own || !is_there(each.id.index) ||
        !is_relevant_anywhere(area_, team, each.kind, each.team))
      continue;
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(near);
    const auto place =
        std::lower_bound(found.begin(), end, each.id.index,
                         [](const Relevant& a, std::uint32_t b) { return a.entity < b; });
    if (place != end && place->entity == each.id.index)
      place->depth = std::numeric_limits<double>::infinity();
    else found.push_back({each.id.index, std::numeric_limits<double>::infinity()});
  }
  std::inplace_merge(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(near), found.end(),
                     [](const Relevant& a, const Relevant& b) { return a.entity < b.entity; });
}

/// A puck that is put back at a face-off jumps: until the next tick, the first that can announce
/// it, it counts as lying where it left play.
Vector2 Replay::announced_centre(game::EntityId entity) {
  const Vector2 centre = game_.position(entity);
  if (away_.size() <= entity.index)
    away_.resize(entity.index + 1), replaced_s_.resize(entity.index + 1);
  std::optional<Away>& away = away_[entity.index];
  if (!game_.world().is_in_play(entity)) {
    away = Away{centre, std::nullopt};
  } else if (away) {
    constexpr double rounding = 1e-6;  // of a tick
    if (!away->until_s)
      away->until_s = std::ceil(game_.world().motion(entity).time * rate_hz_ - rounding) /
                      rate_hz_;  // its first event was the jump
    if (game_.now() < *away->until_s - rounding / rate_hz_) return away->centre;
    replaced_s_[entity.index] = away->until_s;
    away.reset();
  }
  return centre;
}

std::optional<std::uint32_t> Replay::entity_of_object(std::uint32_t object) const {
  const auto found = entities_.find(object);
  return found == entities_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> Replay::bat_of(std::uint32_t player) const {
  const std::optional<game::EntityId> bat = game_.bat(player);
  return bat ? std::optional(bat->index) : std::nullopt;
}

}  // namespace rink::loadgen
