// A replay of a recorded game, look by look: the true state that all figures are measured against.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "game/control/game.h"
#include "game/net/server_trace.h"
#include "game/net/trace_lines.h"
#include "loadgen/measure/truth/encounters.h"
#include "loadgen/measure/truth/filter_relevance.h"
#include "loadgen/measure/truth/reach.h"
#include "loadgen/measure/truth/surroundings.h"
#include "loadgen/mobility/trace_follower.h"
#include "loadgen/mobility/trace_scene.h"

namespace rink::loadgen {

/// The replayed game is not the one that the server played, so no figure from it can be trusted.
class DifferentGame : public game::TraceError {
 public:
  using game::TraceError::TraceError;
};

/// Entities are named by the numbers of their bodies. Instants never decrease.
class Replay {
 public:
  /// Throws game::TraceError if the trace names players that the scene lacks, game::SceneError if
  /// there is no such scene or the saved game is not of it.
  Replay(const game::ServerTrace& trace, const RelevanceArea& area);

  /// The game's beginning [s]: 0, or the time of its saved state.
  double begin_s() const { return begin_s_; }
  /// Plays up to `instant_s`.
  void advance(double instant_s);
  /// Updates all positions; call it once for each instant at which `find` is used.
  void look_around();

  /// True if relevance depends on the past, so that `look_around` must be called regularly from the
  /// beginning.
  bool looks_back() const { return filter_ && filter_->looks_back(); }

  bool is_there(std::uint32_t entity) const {
    return entity < centres_.size() && centres_[entity].has_value();
  }
  /// The centre at the last look; `entity` must have been in play.
  const Vector2& centre(std::uint32_t entity) const {
    assert(is_there(entity));
    return *centres_[entity];
  }
  /// Keeps this look for `passed`.
  void remember() { before_ = centres_, around_before_ = around_; }
  /// `RelevanceIntervals::Passed` for an entity that is relevant to the bat `own` now and was not
  /// at the remembered look.
  double passed(std::uint32_t own, const Relevant& now);
  /// The first tick that could announce `entity` at its new place after its latest face-off, if
  /// there was one by the last look; from then on it counts there.
  std::optional<double> replaced_s(std::uint32_t entity) const {
    return entity < replaced_s_.size() ? replaced_s_[entity] : std::nullopt;
  }
  Vector2 half_extent(std::uint32_t entity) const { return game_.world().half_extent({entity}); }
  /// Finds the entities relevant to the bat `own`, ascending; those relevant wherever they are
  /// count as infinitely deep.
  void find(std::uint32_t own, std::vector<Relevant>& found);

  std::optional<std::uint32_t> entity_of_object(std::uint32_t object) const;
  std::optional<std::uint32_t> bat_of(std::uint32_t player) const;
  const game::Game& game() const { return game_; }
  std::uint32_t player_count() const { return game_.player_count(); }
  /// Contacts since the instant before.
  std::span<const physics::Event> events() const { return game_.events(); }
  std::uint64_t hash() const { return game_.hash(); }

 private:
  struct Away {
    Vector2 centre;                 ///< where it left play
    std::optional<double> until_s;  ///< the first tick after it was put back, once it was
  };
  Replay(PlayedScene played, const game::ServerTrace& trace, const RelevanceArea& area);
  Vector2 announced_centre(game::EntityId entity);
  double reach(const game::Entity& entity) const;
  std::optional<double> depth_before(std::uint32_t a, std::uint32_t b) const;
  std::optional<double> depth_before(std::uint32_t own, std::uint32_t entity,
                                     const Encounters::Way& way) const;
  bool is_of_contact() const { return area_.shape == RelevanceArea::Shape::contact; }

  game::Game game_;
  std::optional<TraceFollower> follower_;  ///< of a scene that is a trace
  double begin_s_;
  RelevanceArea area_;
  Surroundings surroundings_;
  Reach puck_reach_, bat_reach_;
  std::vector<double> acceleration_max_;  ///< by player [m/s^2]
  Encounters encounters_;
  std::optional<FilterRelevance> filter_;
  double rate_hz_;
  std::vector<std::optional<Away>> away_;                      ///< by entity; pucks out of play
  std::vector<std::optional<double>> replaced_s_;              ///< by entity
  std::unordered_map<std::uint32_t, std::uint32_t> entities_;  ///< by object
  std::vector<Placed> placed_;
  std::vector<Reaching> reaching_;
  std::vector<double> around_, around_before_;            ///< by entity; of `contact` alone
  std::vector<std::optional<Vector2>> centres_, before_;  ///< by entity
};

}  // namespace rink::loadgen
