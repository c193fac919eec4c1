// Turns a replica set into a player's view: positions as the client believes them, velocities from
// its updates.
#include "loadgen/run/bots/live_player.h"

#include <algorithm>

#include "game/players/player_kinds.h"

namespace rink::loadgen {
namespace {

/// An entity without an update for so long [s] is taken to stand still, since a moving one is
/// updated at every tick.
constexpr double silence_s = 0.15;

}  // namespace

game::PlayerRules rules_on(game::PlayerRules rules, const game::Extent& extent) {
  const double width = static_cast<double>(extent.width);
  rules.field.goal_width *= width / rules.field.width;
  rules.field.length = static_cast<double>(extent.length);
  rules.field.width = width;
  return rules;
}

bool is_playable(const game::Extent& extent, const game::Shape& bat) {
  constexpr float field_max = 1e9f;                // as in scenes
  const auto fits = [](float half, float whole) {  // false for NaN
    return whole > 0.0f && whole <= field_max && half >= 0.0f && 2.0f * half <= whole;
  };
  return fits(bat.half_length, extent.length) && fits(bat.half_width, extent.width);
}

game::KeysHeld LivePlayer::decide(const game::Client& client, double instant) {
  const game::EntityReplica* bat = client.bat();
  if (bat == nullptr || !client.replicas().field()) return {};
  if (!player_ && !is_playable(*client.replicas().field(), bat->shape)) return {};
  if (!player_) take_seat(client, *bat);
  const game::SeenEntity own = seen(*bat, own_, instant);
  if (decisions_++ % game::look_about_interval == 0) look_about(client.replicas(), own.position);
  pucks_.clear();
  for (Track& track : watched_) {
    const game::EntityReplica* puck = client.replicas().find(track.object);
    if (puck != nullptr && puck->in_scope) pucks_.push_back(seen(*puck, track, instant));
  }
  return player_->decide({.position = own.position, .velocity = own.velocity, .pucks = pucks_},
                         instant);
}

void LivePlayer::take_seat(const game::Client& client, const game::EntityReplica& bat) {
  const game::PlayerSeat seat{.number = number_,
                              .team = static_cast<game::Team>(bat.shape.team),
                              .half_extent = {static_cast<double>(bat.shape.half_length),
                                              static_cast<double>(bat.shape.half_width)}};
  player_ = game::make_player(players_.kind, rules_on(players_.rules, *client.replicas().field()),
                              seat, players_.seed);
}

void LivePlayer::look_about(const game::ReplicaSet& replica_set, const game::Vector2& from) {
  const std::uint32_t wanted = player_->pucks_wanted();
  if (wanted == 0) return;
  nearest_.clear(wanted);
  for (const game::EntityReplica& entity : replica_set.entities()) {
    if (!entity.in_scope || entity.shape.kind != static_cast<std::uint8_t>(physics::BodyKind::puck))
      continue;
    const game::Vector2 there = entity.position_at(replica_set.newest().time);
    nearest_.show(entity.object, (there - from).squaredNorm());
  }
  watched_before_.swap(watched_);
  watched_.clear();
  for (const auto& found : nearest_.found()) {
    const auto before =
        std::find_if(watched_before_.begin(), watched_before_.end(),
                     [&](const Track& track) { return track.object == found.thing; });
    watched_.push_back(before != watched_before_.end() ? *before : Track{.object = found.thing});
  }
}

game::SeenEntity LivePlayer::seen(const game::EntityReplica& entity, Track& track, double instant) {
  constexpr double step_s = 1e-3;
  game::Vector2 position = entity.position_at(instant);
  const game::Vector2 along = (entity.position_at(instant + step_s) - position) / step_s;
  if (along != game::Vector2(0.0, 0.0)) {
    track.velocity = along;  // its trajectory is known
  } else {
    if (track.stamp_s >= 0.0 && entity.stamp.time > track.stamp_s)
      track.velocity = (position - track.position) / (entity.stamp.time - track.stamp_s);
    const double age_s = instant - entity.stamp.time;
    if (age_s > silence_s) track.velocity = {0.0, 0.0};
    if (age_s > 0.0) position += track.velocity * age_s;
  }
  if (entity.stamp.time > track.stamp_s) {
    track.position = entity.position_at(entity.stamp.time);
    track.stamp_s = entity.stamp.time;
  }
  const game::Vector2 half_extent(static_cast<double>(entity.shape.half_length),
                                  static_cast<double>(entity.shape.half_width));
  return {.id = entity.object.value,
          .kind = static_cast<physics::BodyKind>(entity.shape.kind),
          .position = position,
          .velocity = track.velocity,
          .half_extent = half_extent};
}

}  // namespace rink::loadgen
