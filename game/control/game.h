// The game: makes all entities from a scene, applies inputs at their exact instants, keeps the
// score, and lists changes for observers.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "game/control/bat_controller.h"
#include "game/control/network_grid.h"
#include "game/model/scene.h"
#include "game/model/state_hash.h"
#include "game/physics/body_state.h"
#include "game/physics/halves/halves.h"
#include "game/physics/simulator_choice.h"
#include "game/physics/world.h"

namespace rink::game {

/// An entity is a body of the game's world; a bat that left and came back is a new one.
using EntityId = physics::BodyId;

/// The constant properties of an entity.
struct Entity {
  EntityId id;
  physics::BodyKind kind = physics::BodyKind::puck;
  Team team = Team::none;               ///< of bats
  Vector2 half_extent{0.0, 0.0};        ///< m; both the radius for discs
  std::optional<std::uint32_t> player;  ///< of bats
};

/// `team` put `puck` into the other's goal at `time` [s].
struct ScoredGoal {
  double time = 0.0;
  EntityId puck;
  Team team = Team::none;
};

/// `puck` had stayed in one half for too long and was put before `team` at `time` [s].
struct ServedPuck {
  double time = 0.0;
  EntityId puck;
  Team team = Team::none;
};

struct Score {
  std::uint32_t left = 0, right = 0;
  friend bool operator==(const Score&, const Score&) = default;
};

/// Factory and mediator. Knows no clock: the caller says how far to `advance`. The game depends on
/// the scene and the inputs alone, never on how often or how far `advance` is called. At one
/// instant motion and goals come first, then the network grid, then face-offs, then serves, then
/// inputs in order of player, each player's in order of submission.
class Game {
 public:
  /// All bats of the scene are in play from the start, and the scene's scripted keys are submitted.
  /// `engine` moves the bodies; there must be no objection to it (asserted).
  explicit Game(const Scene& scene, const physics::SimulatorChoice& engine = {});

  /// Another game that continues from here with the same bits; the engine must be the exact one
  /// (asserted).
  Game copy() const { return Game(*this); }
  Game(Game&&) = default;
  Game& operator=(Game&&) = default;

  /// Queues `event` for its own instant, which must be finite and not before now(); its player must
  /// have a bat in the scene (both asserted). Keys and pushes for a bat that is not in play at that
  /// instant, entering twice and leaving twice have no effect. `enter` puts the bat back at its
  /// home or, if that is taken, at the nearest free place, and tries again every `placement_retry`
  /// seconds when there is none. If inputs or face-offs of now() have been played already, that
  /// instant is over, for motion may follow from them: the event comes at the next one that a
  /// double can tell from it. Answers the event as it was queued, which is what a log must hold.
  InputEvent submit(InputEvent event);

  /// Plays up to and including `until` [s], not before now(). Once the match is over bats and pucks
  /// still move, but goals count no more and scored pucks stay out.
  void advance(double until);
  /// As advance(until), on the exact engine (asserted), but also ends after the event with which
  /// `budget` is exceeded, which it must not have been before (asserted): then it answers false.
  /// Going on, with or without a budget, comes to the same bits as if it had not stopped.
  bool advance(double until, physics::EventBudget& budget);
  /// A body of another simulation of the scene, in its state there.
  struct ShownBody {
    EntityId id;
    physics::BodyState state;
  };
  /// The goals of another simulation of the scene, and the pucks that are to come back, by time,
  /// then puck.
  struct ShownScore {
    struct FaceOff {
      double time = 0.0;  ///< s
      EntityId puck;
      Team conceding = Team::none;
    };
    Score score;
    bool is_over = false;
    std::vector<FaceOff> face_offs;
    std::vector<physics::HalfStay> stays;  ///< where the scene limits them
  };
  /// Shows what another simulation of the scene has come to at `until` [s], not before now(), on
  /// the exact engine (both asserted): these bodies have changed there, these keys of bats in play
  /// have taken effect, and that is the score. Nothing is simulated, no goals are listed, and a
  /// game that was shown once is never advanced.
  void show(double until, std::span<const ShownBody> bodies, std::span<const InputEvent> keys,
            const ShownScore& score);

  /// Whether the last `advance` ended so, perhaps with events of now() still to come.
  bool is_cut_short() const { return is_cut_short_; }

  static constexpr double placement_retry = 0.1;  ///< s

  /// Makes `events` list all events of bodies; off at first, when it costs nothing.
  void record_events(bool is_wanted) { simulator_->record_events(is_wanted); }
  /// The events of the last `advance`, in order of time.
  std::span<const physics::Event> events() const { return simulator_->events(); }

  double now() const { return simulator_->now(); }
  const physics::Simulator& simulator() const { return *simulator_; }
  /// The closed forms of a game on the exact engine; asserted, for no other engine has them.
  const physics::World& world() const {
    assert(world_ != nullptr);
    return *world_;
  }
  const MatchRules& rules() const { return rules_; }
  /// Only the exact engine uses it. Its left_off() lists the bodies that had no room on it in the
  /// last `advance`.
  const NetworkGrid& network_grid() const { return grid_; }

  /// All present entities, in order of id. A scored puck stays, out of play, until its face-off.
  std::span<const Entity> entities() const { return entities_; }
  bool is_there(EntityId entity) const;
  const Entity& entity(EntityId entity) const;  ///< which must exist
  Vector2 position(EntityId entity) const {
    return simulator_->position(entity);
  }  ///< at now() [m]
  Vector2 velocity(EntityId entity) const {
    return simulator_->velocity(entity);
  }  ///< at now() [m/s]

  /// The number of the scene's bats, in play or not.
  std::uint32_t player_count() const { return static_cast<std::uint32_t>(seats_.size()); }
  std::optional<EntityId> bat(std::uint32_t player) const {
    assert(player < player_count());
    return seats_[player].entity;
  }
  const KeysHeld& keys_held(std::uint32_t player) const {
    assert(player < player_count());
    return seats_[player].controller.keys();
  }
  /// Key events and pushes that have taken effect on `player`'s bat since the start.
  std::uint32_t input_count(std::uint32_t player) const {
    assert(player < player_count());
    return seats_[player].controller.input_count();
  }

  const Score& score() const { return score_; }
  bool is_over() const { return is_over_; }

  /// The changes of the last `advance`, in order of time; valid until the next. Entities from the
  /// start are in none of them.
  std::span<const Entity> spawned() const { return spawned_; }
  std::span<const Entity> removed() const { return removed_; }
  std::span<const ScoredGoal> scored() const { return scored_; }

  /// Makes `journal` list which bodies each event of a game on the exact engine (asserted)
  /// concerns, for as long as the game is played. Never changes the motion.
  friend void observe(const Game& game, physics::WorldJournal& journal);
  /// What each held key adds to the acceleration of the player's bat [m/s^2]; the player must have
  /// a seat (asserted).
  friend double key_thrust(const Game& game, std::uint32_t player);
  /// What the player, who must have a seat (asserted), pushes beside the keys.
  friend Push pushed(const Game& game, std::uint32_t player);

  /// Pucks that were put before the other side in the last `advance`, in order of time.
  friend std::span<const ServedPuck> served_in(const Game& game) { return game.served_; }
  /// Of the pucks in play, by id, how long they may stay in their halves; none where the scene sets
  /// no limit, on other engines than the exact one, and once the match is over.
  friend std::vector<physics::HalfStay> stays_in(const Game& game) { return game.halves_.stays(); }

  /// FNV-1a of the world's hash, the entities, held keys, score, pending face-offs and stays: equal
  /// for equal games.
  std::uint64_t hash() const;

  /// Asserts that entities and seats refer to each other, that queued inputs are in order and not
  /// in the past, and that the score is possible.
  void check() const;

 private:
  friend class GameState;  // saves and restores it
  Game(const Game& other);

  struct Seat {
    Bat bat;
    BatController controller;
    std::optional<EntityId> entity;
  };
  struct QueuedInput {
    InputEvent event;
    std::uint64_t number;  ///< of submission
    std::tuple<double, std::uint32_t, std::uint64_t> turn() const {
      return {event.time, event.player, number};
    }
    /// A heap's order: the input to apply first is the greatest.
    static bool is_later(const QueuedInput& a, const QueuedInput& b) { return a.turn() > b.turn(); }
  };
  using FaceOff = ShownScore::FaceOff;

  void spawn_bat(std::uint32_t player, const Vector2& position, const Vector2& velocity);
  bool play(double until, physics::EventBudget* budget);
  bool play_until(double until, physics::EventBudget* budget);
  void count_goal(const physics::Goal& goal);
  void schedule(const FaceOff& due);
  void face_off_until(double instant);
  void face_off(const FaceOff& due);
  void apply_inputs_until(double instant);
  void apply(const InputEvent& event);
  void enter(std::uint32_t player);
  void leave(std::uint32_t player);
  double next_instant(double until) const;

  std::unique_ptr<physics::Simulator> simulator_;
  const physics::World* world_;  ///< of the simulator, if exact
  MatchRules rules_;
  NetworkGrid grid_;
  std::vector<Entity> entities_;
  std::vector<Seat> seats_;
  std::vector<QueuedInput> inputs_;  ///< a heap, earliest first
  std::uint64_t submitted_ = 0;
  double over_ = -1.0;  ///< the last instant of which more than motion has been played [s]
  std::vector<FaceOff> face_offs_;  ///< ordered by time, then puck
  physics::Halves halves_;
  Score score_;
  bool is_over_ = false, is_cut_short_ = false;
  std::vector<Entity> spawned_, removed_;
  std::vector<ScoredGoal> scored_;
  std::vector<ServedPuck> served_;
};

/// The beginning of a game's hash, for games in parts: the world's hash, its entities, the keys
/// held, in order of player, and the score; pending face-offs follow.
StateHash begun_game_hash(std::uint64_t world, std::span<const Entity> entities,
                          std::span<const BatController* const> players, const Score& score);
/// Then the stays, if the scene limits them.
void add_stays(StateHash& hash, std::span<const physics::HalfStay> stays);

}  // namespace rink::game
