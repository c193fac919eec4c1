// Advances from one event to the next, and lets the world move exactly in between.
#include "game/control/game.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

#include "game/control/free_place.h"
#include "game/physics/subdomain.h"
#include "game/physics/world_journal.h"
#include "im/basics/checked.h"

namespace rink::game {
namespace {

Team other(Team team) { return team == Team::left ? Team::right : Team::left; }

physics::Halves halves_of(const Scene& scene, const physics::World* world) {
  if (world == nullptr || scene.rules.possession_s == 0.0) return {};
  return {scene.world.field.length / 2, scene.rules.possession_s};
}

/// Where a puck is put that `team` is to have.
Vector2 spot_before(Team team, const physics::Field& field, const MatchRules& rules) {
  const double from_end = rules.face_off_distance * field.length;
  return {team == Team::left ? from_end : field.length - from_end, field.width / 2};
}

/// Puts the pucks whose time in one half is over before the other side. One for which there is no
/// place stays where it is, and on its way.
void serve(physics::World& world, const MatchRules& rules, physics::Halves& halves,
           std::vector<ServedPuck>& served) {
  for (const physics::HalfStay& stay : halves.stays()) {
    if (stay.until > world.now()) continue;
    const Team team = stay.half == physics::Half::left ? Team::right : Team::left;
    const auto place = nearest_free_disc(world, spot_before(team, world.spec().field, rules),
                                         world.radius(stay.puck));
    if (!place) {
      halves.prolong(stay.puck, stay.until + Game::placement_retry);
      continue;
    }
    world.place(stay.puck, *place, Vector2::Zero());
    halves.restart(stay.puck);
    served.push_back({world.now(), stay.puck, team});
  }
}

}  // namespace

Game::Game(const Scene& scene, const physics::SimulatorChoice& engine)
    : simulator_(physics::make_simulator(scene.world, engine)),
      world_(simulator_->exact_world()),
      rules_(scene.rules),
      grid_(world_ != nullptr ? scene.network_grid : 0.0),
      halves_(halves_of(scene, world_)) {
  for (const Post& post : scene.bodies.posts) {
    const EntityId id = simulator_->add(post.body);
    entities_.push_back({.id = id,
                         .kind = physics::BodyKind::post,
                         .team = Team::none,
                         .half_extent = simulator_->half_extent(id),
                         .player = std::nullopt});
  }
  for (const Bat& bat : scene.bodies.bats) {
    seats_.push_back({bat, BatController(bat.thrust), std::nullopt});
    spawn_bat(player_count() - 1, bat.body.position, bat.body.velocity);
  }
  for (const Puck& puck : scene.bodies.pucks) {
    const EntityId id = simulator_->add(puck.body);
    entities_.push_back({.id = id,
                         .kind = physics::BodyKind::puck,
                         .team = Team::none,
                         .half_extent = simulator_->half_extent(id),
                         .player = std::nullopt});
    if (halves_.are_kept()) halves_.follow(*world_, id);
  }
  spawned_.clear();
  for (const InputEvent& event : scene.keys) submit(event);
  assert(player_count() == scene.bodies.bats.size());
  if constexpr (checks_whole_structures) check();
}

Game::Game(const Game& other)
    : simulator_(other.simulator_->copy()),
      world_(nullptr),
      rules_(other.rules_),
      grid_(other.grid_),
      entities_(other.entities_),
      seats_(other.seats_),
      inputs_(other.inputs_),
      submitted_(other.submitted_),
      over_(other.over_),
      face_offs_(other.face_offs_),
      halves_(other.halves_),
      score_(other.score_),
      is_over_(other.is_over_),
      is_cut_short_(other.is_cut_short_) {
  assert(simulator_ != nullptr);
  world_ = simulator_->exact_world();
}

void Game::spawn_bat(std::uint32_t player, const Vector2& position, const Vector2& velocity) {
  Seat& seat = seats_[player];
  assert(!seat.entity && "a player has one bat");
  physics::BatSpec body = seat.bat.body;
  body.position = position;
  body.velocity = velocity;
  seat.entity = simulator_->add(body);
  assert((entities_.empty() || entities_.back().id < *seat.entity) &&
         "a new body has the greatest id, so entities stay in order");
  entities_.push_back({.id = *seat.entity,
                       .kind = physics::BodyKind::bat,
                       .team = seat.bat.team,
                       .half_extent = body.half_extent,
                       .player = player});
  spawned_.push_back(entities_.back());
}

InputEvent Game::submit(InputEvent event) {
  assert(std::isfinite(event.time) && event.time >= now() && event.player < player_count() &&
         is_sound(event.push));
  if (event.time == over_)
    event.time = std::nextafter(over_, std::numeric_limits<double>::infinity());
  inputs_.push_back({event, submitted_++});
  std::push_heap(inputs_.begin(), inputs_.end(), QueuedInput::is_later);
  return event;
}

void Game::advance(double until) { play(until, nullptr); }

bool Game::advance(double until, physics::EventBudget& budget) {
  assert(world_ != nullptr && !budget.is_exceeded());
  return play(until, &budget);
}

bool Game::play(double until, physics::EventBudget* budget) {
  assert(std::isfinite(until) && until >= now());
  spawned_.clear();
  removed_.clear();
  scored_.clear();
  served_.clear();
  grid_.forget();
  simulator_->forget_events();
  do {
    is_cut_short_ = !play_until(next_instant(until), budget);
    if (is_cut_short_) return false;
    if (now() == grid_.next()) grid_.round(*simulator_->exact_world());
    face_off_until(now());
    if (halves_.next() <= now()) {
      over_ = now();
      serve(*simulator_->exact_world(), rules_, halves_, served_);
    }
    apply_inputs_until(now());
    if (halves_.are_kept()) halves_.look(*world_);
  } while (now() < until);
  assert(next_instant(std::numeric_limits<double>::infinity()) > now() &&
         "all that was due has been done");
  if constexpr (checks_whole_structures) check();
  return true;
}

void Game::show(double until, std::span<const ShownBody> bodies, std::span<const InputEvent> keys,
                const ShownScore& score) {
  assert(world_ != nullptr && std::isfinite(until) && until >= now());
  spawned_.clear();
  removed_.clear();
  scored_.clear();
  served_.clear();
  physics::World& world = *simulator_->exact_world();
  physics::Subdomain::show_instant(world, until);
  for (const ShownBody& body : bodies) {
    assert(is_there(body.id));
    physics::Subdomain::show(world, body.id.index, body.state);
  }
  for (const InputEvent& key : keys) {
    assert(key.player < player_count() && seats_[key.player].entity);
    seats_[key.player].controller.take(key);
  }
  score_ = score.score;
  is_over_ = score.is_over;
  face_offs_ = score.face_offs;
  if (is_over_) halves_ = {};
  halves_.show(score.stays);
}

/// The earliest instant at which more than motion happens, at most `until`.
double Game::next_instant(double until) const {
  if (!inputs_.empty()) until = std::min(until, inputs_.front().event.time);
  if (!face_offs_.empty()) until = std::min(until, face_offs_.front().time);
  return std::min({until, grid_.next(), halves_.next()});
}

/// A goal may bring the next instant forward, for its face-off is one.
bool Game::play_until(double until, physics::EventBudget* budget) {
  const auto is_exceeded = [budget] { return budget != nullptr && budget->is_exceeded(); };
  const auto move = [&] {
    if (halves_.are_kept())
      return halves_.advance(*simulator_->exact_world(), *world_, until, budget);
    return budget != nullptr ? simulator_->exact_world()->advance(until, *budget)
                             : simulator_->advance(until);
  };
  while (const std::optional<physics::Goal> goal = move()) {
    count_goal(*goal);
    if (is_exceeded()) return false;
    until = next_instant(until);
  }
  return !is_exceeded();
}

void Game::count_goal(const physics::Goal& goal) {
  if (is_over_) return;
  assert(simulator_->kind(goal.puck) == physics::BodyKind::puck);
  const Team conceding = goal.end == physics::End::left ? Team::left : Team::right,
             scoring = other(conceding);
  std::uint32_t& goals = scoring == Team::left ? score_.left : score_.right;
  ++goals;
  scored_.push_back({goal.time, goal.puck, scoring});
  is_over_ = rules_.goals_to_win && goals >= *rules_.goals_to_win;
  if (is_over_) face_offs_.clear(), halves_ = {};
  else schedule({goal.time + rules_.face_off_delay, goal.puck, conceding});
}

void Game::schedule(const FaceOff& due) {
  const auto is_before = [](const FaceOff& a, const FaceOff& b) {
    return std::tuple(a.time, a.puck) < std::tuple(b.time, b.puck);
  };
  assert(std::isfinite(due.time) && !is_over_);
  face_offs_.insert(std::upper_bound(face_offs_.begin(), face_offs_.end(), due, is_before), due);
}

void Game::face_off_until(double instant) {
  while (!face_offs_.empty() && face_offs_.front().time <= instant) {
    over_ = instant;
    const FaceOff due = face_offs_.front();
    face_offs_.erase(face_offs_.begin());
    face_off(due);
  }
}

void Game::face_off(const FaceOff& due) {
  assert(!simulator_->is_in_play(due.puck) && "it lies in the goal into which it went");
  if (const auto place = nearest_free_disc(
          *simulator_, spot_before(due.conceding, simulator_->spec().field, rules_),
          simulator_->radius(due.puck)))
    simulator_->place(due.puck, *place, Vector2::Zero());
  else schedule({due.time + placement_retry, due.puck, due.conceding});
}

void Game::apply_inputs_until(double instant) {
  while (!inputs_.empty() && inputs_.front().event.time <= instant) {
    over_ = instant;
    const InputEvent event = inputs_.front().event;
    std::pop_heap(inputs_.begin(), inputs_.end(), QueuedInput::is_later);
    inputs_.pop_back();
    apply(event);
  }
}

void Game::apply(const InputEvent& event) {
  assert(event.player < player_count());
  if (event.kind == InputKind::enter) return enter(event.player);
  if (event.kind == InputKind::leave) return leave(event.player);
  Seat& seat = seats_[event.player];
  if (!seat.entity) return;
  seat.controller.take(event);
  simulator_->set_thrust(*seat.entity, seat.controller.thrust());
}

void Game::enter(std::uint32_t player) {
  if (seats_[player].entity) return;
  const physics::BatSpec& home = seats_[player].bat.body;
  if (const auto place =
          nearest_free_rectangle(*simulator_, home.position, home.half_extent, home.half))
    spawn_bat(player, *place, Vector2::Zero());
  else submit({.time = now() + placement_retry, .player = player, .kind = InputKind::enter});
}

void Game::leave(std::uint32_t player) {
  Seat& seat = seats_[player];
  if (!seat.entity) return;
  const auto there = std::lower_bound(entities_.begin(), entities_.end(), *seat.entity,
                                      [](const Entity& a, EntityId id) { return a.id < id; });
  assert(there != entities_.end() && there->id == *seat.entity && there->player == player);
  removed_.push_back(*there);
  entities_.erase(there);
  simulator_->remove(*seat.entity);
  seat.entity.reset();
  seat.controller.release_all();
}

bool Game::is_there(EntityId entity) const {
  return std::binary_search(entities_.begin(), entities_.end(),
                            Entity{.id = entity, .player = std::nullopt},
                            [](const Entity& a, const Entity& b) { return a.id < b.id; });
}

const Entity& Game::entity(EntityId entity) const {
  assert(is_there(entity));
  return *std::lower_bound(entities_.begin(), entities_.end(), entity,
                           [](const Entity& a, EntityId id) { return a.id < id; });
}

void observe(const Game& game, physics::WorldJournal& journal) {
  assert(game.simulator_->exact_world() != nullptr);
  journal.observe(*game.simulator_->exact_world());
}

double key_thrust(const Game& game, std::uint32_t player) {
  assert(player < game.seats_.size());
  return game.seats_[player].bat.thrust;
}

Push pushed(const Game& game, std::uint32_t player) {
  assert(player < game.seats_.size());
  return game.seats_[player].controller.pushed();
}

void Game::check() const {
  assert(std::ranges::is_sorted(entities_, {}, &Entity::id));
  std::size_t bats = 0;
  for (const Entity& entity : entities_) {
    assert(entity.id.index < simulator_->body_count() &&
           simulator_->kind(entity.id) == entity.kind);
    assert(entity.player.has_value() == (entity.kind == physics::BodyKind::bat));
    assert(!entity.player || seats_[*entity.player].entity == entity.id);
    bats += entity.player ? 1u : 0u;
  }
  assert(bats == static_cast<std::size_t>(std::ranges::count_if(
                     seats_, [](const Seat& seat) { return seat.entity.has_value(); })) &&
         "every bat of a seat is an entity");
  assert(std::ranges::is_heap(inputs_, QueuedInput::is_later));
  assert(std::ranges::all_of(inputs_, [this](const QueuedInput& input) {
    return input.event.time >= now() && input.number < submitted_;
  }));
  assert(std::ranges::is_sorted(
      face_offs_, {}, [](const FaceOff& due) { return std::tuple(due.time, due.puck.index); }));
  assert(std::ranges::all_of(
      face_offs_, [this](const FaceOff& due) { return !simulator_->is_in_play(due.puck); }));
  assert(now() < grid_.next() || is_cut_short_);
  assert(over_ <= now() && (!is_over_ || face_offs_.empty()));
}

std::uint64_t Game::hash() const {
  std::vector<const BatController*> players;
  for (const Seat& seat : seats_) players.push_back(&seat.controller);
  StateHash hash = begun_game_hash(simulator_->hash(), entities_, players, score_);
  for (const FaceOff& due : face_offs_) hash.add(due.time), hash.add(std::uint64_t{due.puck.index});
  add_stays(hash, halves_.stays());
  return hash.value();
}

void add_stays(StateHash& hash, std::span<const physics::HalfStay> stays) {
  for (const physics::HalfStay& stay : stays)
    hash.add(stay.until), hash.add(std::uint64_t{stay.puck.index} << 1 |
                                   (stay.half == physics::Half::right ? 1u : 0u));
}

StateHash begun_game_hash(std::uint64_t world, std::span<const Entity> entities,
                          std::span<const BatController* const> players, const Score& score) {
  assert(std::ranges::is_sorted(entities, {}, &Entity::id));
  StateHash hash;
  hash.add(world);
  for (const Entity& entity : entities) hash.add(std::uint64_t{entity.id.index});
  for (const BatController* player : players) hash.add(player->digest());
  hash.add(std::uint64_t{score.left} << 32 | score.right);
  return hash;
}

}  // namespace rink::game
