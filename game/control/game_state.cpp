// Reads and writes all that a game's future depends on, by one function.
#include "game/control/game_state.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

#include "game/model/system_reason.h"
#include "game/physics/snapshot_stream.h"

namespace rink::game {
namespace {

constexpr std::uint64_t magic = 0x656d'6167'6b6e'6972;  // "rinkgame", little endian
constexpr std::uint32_t version = 2;                    ///< from 2 on with pushes

template <class Stream, class Value>
bool exchange_optional(Stream& stream, std::optional<Value>& value) {
  bool is_there = value.has_value();
  if (!stream.truth(is_there)) return false;
  if (is_there && !value) value.emplace();
  if (!is_there) value.reset();
  if constexpr (std::is_same_v<Value, EntityId>) return !is_there || stream.number(value->index);
  else return !is_there || stream.number(*value);
}

template <class Stream>
bool exchange_entity(Stream& stream, Entity& entity) {
  auto& [id, kind, team, half_extent, player] = entity;
  return stream.number(id.index) && stream.choice(kind, physics::BodyKind::post) &&
         stream.choice(team, Team::none) && stream.numbers(half_extent.x(), half_extent.y()) &&
         exchange_optional(stream, player);
}

template <class Stream>
bool exchange_push(Stream& stream, Push& push) {
  return stream.numbers(push.x, push.y) && is_sound(push);
}

template <class Stream>
bool exchange_event(Stream& stream, InputEvent& event) {
  auto& [time, player, kind, key, push] = event;
  return stream.numbers(time, player) && stream.choice(kind, InputKind::push) &&
         stream.choice(key, Key::down) && exchange_push(stream, push);
}

KeysHeld keys_of(std::uint8_t bits) {
  KeysHeld keys;
  for (const Key key : all_keys) keys.set(key, (bits >> static_cast<unsigned>(key) & 1u) != 0);
  return keys;
}

template <class Stream>
bool exchange_controller(Stream& stream, BatController& controller, double thrust) {
  std::uint8_t keys = controller.keys().bits();
  std::uint32_t input_count = controller.input_count();
  Push push = controller.pushed();
  if (!stream.numbers(keys, input_count) || !exchange_push(stream, push)) return false;
  controller = BatController(thrust, keys_of(keys), input_count, push);
  return true;
}

bool exchange_world(physics::SnapshotWriter& writer,
                    std::unique_ptr<physics::Simulator>& simulator) {
  std::vector<std::uint8_t> world = simulator->exact_world()->save();
  return writer.number_list(world);
}

bool exchange_world(ByteReader& reader, std::unique_ptr<physics::Simulator>& simulator) {
  std::vector<std::uint8_t> bytes;
  if (!reader.number_list(bytes)) return false;
  std::optional<physics::World> world = physics::World::restore(bytes, simulator->spec().slabs);
  if (!world) return false;
  simulator = std::make_unique<physics::World>(std::move(*world));
  return true;
}

template <class Stream>
bool exchange_stay(Stream& stream, physics::HalfStay& stay) {
  return stream.numbers(stay.puck.index, stay.until) &&
         stream.choice(stay.half, physics::Half::right);
}

/// Whether these can be the stays of a game that goes on in `world`.
bool may_be(std::span<const physics::HalfStay> stays, const physics::World& world) {
  return std::ranges::adjacent_find(stays, std::greater_equal<>(), &physics::HalfStay::puck) ==
             stays.end() &&
         std::ranges::all_of(stays, [&world](const physics::HalfStay& stay) {
           return stay.puck.index < world.body_count() &&
                  world.kind(stay.puck) == physics::BodyKind::puck && world.is_in_play(stay.puck) &&
                  std::isfinite(stay.until) && stay.until > world.now();
         });
}

}  // namespace

/// Rules and bats are the scene's, and so is the way in which its world is divided.
template <class Stream>
bool GameState::exchange(Stream& stream, Game& game) {
  if (!exchange_world(stream, game.simulator_)) return false;
  if (!stream.numbers(game.submitted_, game.over_, game.score_.left, game.score_.right) ||
      !stream.truth(game.is_over_))
    return false;
  if (std::uint64_t done = game.grid_.done(); game.grid_.instants().exist()) {
    if (!stream.number(done)) return false;
    game.grid_.restart(done);
  }
  if (!stream.size(game.entities_) || !stream.size(game.inputs_) || !stream.size(game.face_offs_))
    return false;
  for (Entity& entity : game.entities_)
    if (!exchange_entity(stream, entity)) return false;
  for (Game::Seat& seat : game.seats_)
    if (!exchange_controller(stream, seat.controller, seat.bat.thrust) ||
        !exchange_optional(stream, seat.entity))
      return false;
  for (Game::QueuedInput& input : game.inputs_)
    if (!exchange_event(stream, input.event) || !stream.number(input.number)) return false;
  for (Game::FaceOff& due : game.face_offs_)
    if (!stream.numbers(due.time, due.puck.index) || !stream.choice(due.conceding, Team::none))
      return false;
  return exchange_halves(stream, game);
}

/// Of scenes that limit how long pucks stay in a half.
template <class Stream>
bool GameState::exchange_halves(Stream& stream, Game& game) {
  if (game.rules_.possession_s == 0.0) return true;
  std::vector<physics::HalfStay> stays = game.halves_.stays();
  if (!stream.size(stays)) return false;
  for (physics::HalfStay& stay : stays)
    if (!exchange_stay(stream, stay)) return false;
  if constexpr (std::is_same_v<Stream, ByteReader>) {
    const physics::World& world = *game.simulator_->exact_world();
    if (!may_be(stays, world) || (game.is_over_ && !stays.empty())) return false;
    if (game.is_over_) game.halves_ = {};
    else game.halves_.restore(world, stays);
  }
  return true;
}

/// True if the state can be played: the checksum detects damage, this detects forged bytes.
bool GameState::is_sound(const Game& game) {
  const std::uint32_t bodies = game.simulator_->body_count();
  for (std::size_t i = 0; i < game.entities_.size(); ++i) {
    const Entity& entity = game.entities_[i];
    if (entity.id.index >= bodies || (i > 0 && !(game.entities_[i - 1].id < entity.id)))
      return false;
    if (game.simulator_->kind(entity.id) != entity.kind ||
        entity.player.has_value() != (entity.kind == physics::BodyKind::bat))
      return false;
    if (entity.player &&
        (*entity.player >= game.player_count() || game.seats_[*entity.player].entity != entity.id))
      return false;
  }
  for (std::uint32_t player = 0; player < game.player_count(); ++player) {
    const std::optional<EntityId> bat = game.bat(player);
    if (bat && !(game.is_there(*bat) && game.entity(*bat).player == player)) return false;
  }
  if (const GridInstants grid = game.grid_.instants();
      grid.exist() &&
      !(grid.at(game.grid_.done()) <= game.now() && game.now() <= game.grid_.next()))
    return false;
  if (!(game.over_ <= game.now()) || (game.is_over_ && !game.face_offs_.empty()) ||
      !std::ranges::is_heap(game.inputs_, Game::QueuedInput::is_later))
    return false;
  std::vector<EntityId> due_pucks;
  for (const Game::FaceOff& due : game.face_offs_) due_pucks.push_back(due.puck);
  std::ranges::sort(due_pucks);
  if (std::ranges::adjacent_find(due_pucks) != due_pucks.end()) return false;
  const auto is_due = [&game](double time) { return std::isfinite(time) && time >= game.now(); };
  return std::ranges::all_of(game.inputs_,
                             [&](const Game::QueuedInput& input) {
                               return is_due(input.event.time) &&
                                      input.event.player < game.player_count() &&
                                      input.number < game.submitted_;
                             }) &&
         std::ranges::all_of(game.face_offs_,
                             [&](const Game::FaceOff& due) {
                               return is_due(due.time) && due.puck.index < bodies &&
                                      game.simulator_->kind(due.puck) == physics::BodyKind::puck &&
                                      !game.simulator_->is_in_play(due.puck);
                             }) &&
         std::ranges::is_sorted(game.face_offs_, {}, [](const Game::FaceOff& due) {
           return std::tuple(due.time, due.puck.index);
         });
}

std::vector<std::uint8_t> GameState::save(const Game& game, const Scene& scene) {
  assert(game.simulator().exact_world() != nullptr &&
         game.player_count() == scene.bodies.bats.size());
  Game state = game.copy();
  std::vector<std::uint8_t> bytes;
  physics::SnapshotWriter writer(bytes);
  std::uint64_t kind = magic, of_scene = fingerprint(scene);
  std::uint32_t format = version;
  writer.numbers(kind, format, of_scene);
  [[maybe_unused]] const bool is_written = exchange(writer, state);
  assert(is_written);
  physics::add_checksum(bytes);
  return bytes;
}

GameState::Restored GameState::restore(std::span<const std::uint8_t> bytes, const Scene& scene) {
  const auto refuse = [](const std::string& error) { return Restored{std::nullopt, error}; };
  std::uint64_t kind = 0, of_scene = 0;
  std::uint32_t format = 0;
  if (!ByteReader(std::as_bytes(bytes)).number(kind) || kind != magic)
    return refuse("is no saved game");
  const auto content = physics::without_checksum(bytes);
  if (!content) return refuse("is damaged: a saved game whose checksum does not fit");
  ByteReader reader(*content);
  if (!reader.numbers(kind, format, of_scene))
    return refuse("is damaged: a saved game without a header");
  if (format != version)
    return refuse("is a saved game of version " + std::to_string(format) + ", expected version " +
                  std::to_string(version));
  if (of_scene != fingerprint(scene))
    return refuse(
        "was saved in another scene than this; expected the same scene, seed and number of bodies");
  Restored restored{Game(scene), ""};
  if (!exchange(reader, *restored.game) || !reader.is_at_end())
    return refuse("is no saved game of this version's world");
  restored.game->world_ = restored.game->simulator_->exact_world();
  if (!is_sound(*restored.game)) return refuse("is a saved game that contradicts itself");
  return restored;
}

void write_game_state(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw SceneError(file.string() + ": cannot be written: " + system_reason(errno));
}

std::vector<std::uint8_t> read_game_state(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw SceneError(file.string() + ": cannot be read: expected a saved game");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Game game_in_state(std::span<const std::uint8_t> bytes, const Scene& scene,
                   const std::string& file) {
  GameState::Restored restored = GameState::restore(bytes, scene);
  if (!restored.game) throw SceneError(file + ": " + restored.error);
  return std::move(*restored.game);
}

}  // namespace rink::game
