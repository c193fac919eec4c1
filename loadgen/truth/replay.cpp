// The scene as the server chose it, with every key at its stamped instant.
#include "loadgen/truth/replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "game/net/evidence_lines.h"

namespace rink::loadgen {

Replay::Replay(const game::ServerEvidence& evidence, const RelevanceArea& area)
    : game_(game::chosen_scene(evidence.choice)), area_(area), surroundings_(area, game_.world().spec().field.length, game_.world().spec().field.width), rate_hz_(evidence.rate_hz) {
  game_.record_events(true);
  for (const game::InputEvent& event : evidence.keys) {
    if (event.player >= game_.player_count())
      throw game::EvidenceError("the server's evidence has keys of player " + std::to_string(event.player) + ", but its scene has " + std::to_string(game_.player_count()) + " bats");
    game_.submit(event);
  }
  for (const game::ServerEvidence::Naming& naming : evidence.objects) entities_[naming.object] = naming.body;
}

void Replay::advance(double instant_s) {
  if (instant_s > game_.now()) game_.advance(instant_s);
}

void Replay::look_around() {
  centres_.assign(game_.world().body_count(), std::nullopt);
  placed_.clear();
  for (const game::Entity& entity : game_.entities()) {
    const Vector2 centre = announced_centre(entity.id);
    centres_[entity.id.index] = centre;
    placed_.push_back({entity.id.index, centre, entity.half_extent});
  }
  surroundings_.build(placed_);
}

void Replay::find(std::uint32_t own, std::vector<Relevant>& found) const {
  surroundings_.find(centre(own), own, found);
  if (!area_.has_team && !area_.always) return;
  const game::Team team = game_.entity({own}).team;
  const std::size_t near = found.size();
  for (const game::Entity& each : game_.entities()) {
    if (each.id.index == own || !is_relevant_anywhere(area_, team, each.kind, each.team)) continue;
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(near);
    const auto place = std::lower_bound(found.begin(), end, each.id.index, [](const Relevant& a, std::uint32_t b) { return a.entity < b; });
    if (place != end && place->entity == each.id.index) place->depth = std::numeric_limits<double>::infinity();
    else found.push_back({each.id.index, std::numeric_limits<double>::infinity()});
  }
  std::inplace_merge(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(near), found.end(), [](const Relevant& a, const Relevant& b) { return a.entity < b.entity; });
}

/// A puck that is put back at a face-off comes by no path: until the next tick, the first that can tell of it, it counts as lying where it left play.
Vector2 Replay::announced_centre(game::EntityId entity) {
  const Vector2 centre = game_.position(entity);
  if (away_.size() <= entity.index) away_.resize(entity.index + 1), replaced_s_.resize(entity.index + 1);
  std::optional<Away>& away = away_[entity.index];
  if (!game_.world().is_in_play(entity)) {
    away = Away{centre, std::nullopt};
  } else if (away) {
    constexpr double rounding = 1e-6;  // of a tick
    if (!away->until_s) away->until_s = std::ceil(game_.world().motion(entity).time * rate_hz_ - rounding) / rate_hz_;  // its first event was being put back
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
