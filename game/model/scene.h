// A scene: the field, all bodies, the rules of the match and the keys to play, as plain values from
// which a Game is made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "game/model/key.h"
#include "game/physics/body.h"

namespace rink::game {

using physics::Vector2;

/// A scene or key log that cannot be used; what() names file, line, key, value and what was
/// expected, as far as they are known.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A body or population, named `body`, that has no place: a file's reader adds its line.
class PlacementError : public SceneError {
 public:
  PlacementError(std::string name, const std::string& what)
      : SceneError(what), body(std::move(name)) {}
  std::string body;
};

/// Left defends the goal at x = 0.
enum class Team : std::uint8_t { left, right, none };

struct Puck {
  std::string name;
  physics::PuckSpec body;
};

struct Bat {
  std::string name;
  physics::BatSpec body;
  double thrust = 10.0;  ///< acceleration that each held key adds [m/s^2], 0 or more
  Team team = Team::none;
};

struct Post {
  std::string name;
  physics::PostSpec body;
};

struct Bodies {
  std::vector<Puck> pucks;
  std::vector<Bat> bats;  ///< player k plays bat k
  std::vector<Post> posts;
};

inline std::size_t count_of(const Bodies& bodies) {
  return bodies.pucks.size() + bodies.bats.size() + bodies.posts.size();
}

/// How the speeds of seeded pucks are distributed about their mean; directions are uniform.
enum class SpeedDistribution : std::uint8_t {
  fixed,    ///< all the mean
  uniform,  ///< from 0 to twice the mean
  maxwell   ///< of a gas in equilibrium, cut at five times the mean
};

/// `count` bodies of one kind, at random places drawn from the scene's seed.
struct Population {
  physics::BodyKind kind = physics::BodyKind::puck;
  std::string name;  ///< body k is called name-k
  std::uint32_t count = 0;
  double radius_min = 0.04, radius_max = 0.04;          ///< of pucks and posts [m], uniform between
  Vector2 half_extent{0.05, 0.05};                      ///< of bats [m]
  double mass = 1.0;                                    ///< of pucks and bats [kg]
  double mean_speed = 0.0;                              ///< of pucks [m/s]
  SpeedDistribution speeds = SpeedDistribution::fixed;  ///< of pucks
  double thrust = 10.0;                                 ///< of bats [m/s^2]
  std::optional<Team> team;                             ///< of bats; absent: left and right in turn
  physics::MaterialId material = 0;
};

struct MatchRules {
  /// Below, a puck for which there is no place would be due again before it could have left.
  static constexpr double possession_min = 0.1;

  std::optional<std::uint32_t>
      goals_to_win;                 ///< absent in a crowd: goals are counted and play goes on
  double face_off_delay = 1.0;      ///< from a goal until its puck is back [s], above 0
  double face_off_distance = 0.25;  ///< of the spot from the conceding side's end, as part of the
                                    ///< field's length, within (0, 1)
  double possession_s = 0.0;  ///< how long a puck may stay in one half until the other side gets
                              ///< it, from possession_min on; 0: as long as it likes
};

/// The description of a game. `bodies` are all bodies: first those that the scene places itself,
/// then the populations.
struct Scene {
  std::string name;
  std::uint64_t seed = 1;
  physics::WorldSpec world;
  std::vector<std::string> materials{"plain"};  ///< names of the entries of world.restitution
  MatchRules rules;
  Bodies placed;  ///< bodies that the scene names one by one
  std::vector<Population> populations;
  Bodies bodies;                 ///< placed and populated, as populate() made them
  std::vector<InputEvent> keys;  ///< scripted, ordered by time
  double network_grid = 0.0;  ///< so often a second bodies that have changed are put on a grid of
                              ///< places and speeds (physics::MotionGrid); 0: never
};

/// Draws `scene.bodies` anew from placed, populations and seed: equal bits on every machine. No two
/// bodies overlap and pucks of one size are packed as densely as a hexagonal lattice allows. Throws
/// PlacementError if a placed body overlaps another or leaves the field, or if a population does
/// not fit.
void populate(Scene& scene);

/// The same scene with its populations drawn from another seed.
Scene with_seed(Scene scene, std::uint64_t seed);

/// The same crowd with `bat_count` bats: area (of equal shape), goals, pucks and posts in
/// proportion, so that density stays. Placed bodies keep their relative places. Throws SceneError
/// if the scene has no population of bats to change, or `bat_count` cannot be reached.
Scene scaled_to_bats(Scene scene, std::uint32_t bat_count);

/// The same field with `count` pucks or bats (`kind`) instead, placed ones included: density
/// changes. Throws SceneError if the scene has no population of them to change, or `count` cannot
/// be reached, PlacementError if they do not fit.
Scene with_count(Scene scene, physics::BodyKind kind, std::uint32_t count);

/// FNV-1a of all that decides a game, without its name and keys: scenes that differ in anything
/// else differ in this (but for chance).
std::uint64_t fingerprint(const Scene& scene);

}  // namespace rink::game
