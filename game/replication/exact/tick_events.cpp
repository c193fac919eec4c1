// Joins bodies by union and find over the world's journal.
#include "game/replication/exact/tick_events.h"

#include <algorithm>
#include <cassert>

#include "game/physics/subdomain.h"

namespace rink::game {
namespace {

std::int8_t sign(double value) {
  return static_cast<std::int8_t>(value > 0.0 ? 1 : value < 0.0 ? -1 : 0);
}

Drive drive(const physics::Vector2& thrust) { return {sign(thrust.x()), sign(thrust.y())}; }

/// Who touches whom for longer than an instant. Posts never move, and join nobody.
std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts_in(const physics::World& world) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto can_move = [&world](physics::Partner p) {
    return physics::is_body(p) && world.kind({p}) != physics::BodyKind::post;
  };
  for (const physics::RestContact& rest : physics::WorldJournal::rest_contacts(world))
    if (can_move(rest.low) && can_move(rest.high)) pairs.emplace_back(rest.low, rest.high);
  auto jams = physics::WorldJournal::jams(world);
  std::ranges::stable_sort(jams, {}, [](const auto& each) { return each.second; });
  for (std::size_t k = 1; k < jams.size(); ++k)
    if (jams[k].second == jams[k - 1].second) pairs.emplace_back(jams[k - 1].first, jams[k].first);
  return pairs;
}

}  // namespace

TickEvents::TickEvents(const Game& game) {
  observe(game, journal_);
  drives_.resize(game.world().body_count());
  was_out_of_play_.resize(game.world().body_count());
  for (const Entity& entity : game.entities()) {
    if (entity.player) drives_[entity.id.index] = drive(game.world().thrust(entity.id));
    was_out_of_play_[entity.id.index] = !game.world().is_in_play(entity.id);
  }
  contacts_before_ = contacts_in(game.world());
}

void TickEvents::look(const Game& game) {
  for (const Entity& entity : game.removed()) removed_.push_back(entity.id.index);
  was_out_of_play_.resize(game.world().body_count());
  for (const EntityId each : game.network_grid().left_off()) left_off_.push_back(each.index);
  for (const ScoredGoal& goal : game.scored())  // it may be back within the tick
    if (game.world().is_in_play(goal.puck)) was_out_of_play_[goal.puck.index] = 1;
}

void TickEvents::list_drive_changes() {
  for (const physics::Journal::Thrust& each : journal_.thrusts()) {
    Drive& now = drives_[each.body];
    const Drive after = drive(each.thrust);
    drive_changes_.push_back({each.time, each.body, now, after});
    now = after;
  }
}

std::uint32_t TickEvents::root_of(std::uint32_t body) {
  while (parents_[body] != body) body = parents_[body] = parents_[parents_[body]];
  return body;
}

void TickEvents::join(std::uint32_t a, std::uint32_t b) {
  concern(a), concern(b);
  parents_[root_of(a)] = root_of(b);
}

void TickEvents::concern(std::uint32_t body) {
  if (is_concerned_[body] != 0) return;
  is_concerned_[body] = 1;
  parents_[body] = body;
  concerned_.push_back(body);
}

void TickEvents::join_events() {
  const std::span<const physics::Change> changes = journal_.changes();
  for (std::size_t k = 0; k < changes.size(); ++k) {
    concern(changes[k].body);
    if (k > 0 && changes[k].event == changes[k - 1].event)
      join(changes[k - 1].body, changes[k].body);
  }
}

/// A contact may concern a body that was in another one with somebody, and so on.
void TickEvents::join_contacts(const Pairs& contacts) {
  for (std::size_t before = concerned_.size() + 1; before != concerned_.size();) {
    before = concerned_.size();
    for (const auto& [a, b] : contacts)
      if (is_concerned_[a] != 0 || is_concerned_[b] != 0) join(a, b);
  }
}

void TickEvents::close(const Game& game) {
  const physics::World& world = game.world();
  parents_.resize(world.body_count());
  is_concerned_.resize(world.body_count());
  was_out_of_play_.resize(world.body_count());
  drives_.resize(world.body_count());
  list_drive_changes();
  join_events();
  for (const std::uint32_t body : removed_) concern(body);
  // Who does not know all that is near to it would put it on the grid.
  for (const std::uint32_t body : left_off_) concern(body), was_out_of_play_[body] = 1;
  Pairs contacts = contacts_in(world);
  contacts_before_.insert(contacts_before_.end(), contacts.begin(), contacts.end());
  join_contacts(contacts_before_);
  contacts_before_ = std::move(contacts);
  std::ranges::sort(concerned_, {},
                    [this](std::uint32_t body) { return std::pair(root_of(body), body); });
  for (std::size_t first = 0, end = 0; first < concerned_.size(); first = end) {
    Group group;
    for (; end < concerned_.size() && root_of(concerned_[end]) == root_of(concerned_[first]);
         ++end) {
      const std::uint32_t body = concerned_[end];
      const bool is_out = !world.is_in_play({body});
      if (was_out_of_play_[body] != 0) group.is_unforeseeable = true;
      was_out_of_play_[body] = is_out ? 1 : 0;
    }
    group.bodies = std::span(concerned_).subspan(first, end - first);
    if (group.bodies.size() > 1 || group.is_unforeseeable) groups_.push_back(group);
  }
}

void TickEvents::forget() {
  for (const std::uint32_t body : concerned_) is_concerned_[body] = 0;
  concerned_.clear(), groups_.clear(), drive_changes_.clear(), removed_.clear();
  left_off_.clear();
  journal_.forget();
}

}  // namespace rink::game
