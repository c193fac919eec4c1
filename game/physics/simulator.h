// One interface for every engine, so that the same scene can be played, asked and measured on each.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/physics/body.h"
#include "game/physics/counters.h"
#include "game/physics/world.h"

namespace rink::physics {

/// One engine at work on one set of bodies. Questions and their meaning are those of World
/// (world.h); all are answered at now(). Whoever has no use for a choice of engines uses World
/// itself.
class Simulator {
 public:
  virtual ~Simulator() = default;

  virtual BodyId add(const PuckSpec& spec) = 0;
  virtual BodyId add(const BatSpec& spec) = 0;
  virtual BodyId add(const PostSpec& spec) = 0;
  virtual void remove(BodyId body) = 0;
  virtual void set_thrust(BodyId bat, const Vector2& acceleration) = 0;
  virtual void place(BodyId puck, const Vector2& position, const Vector2& velocity) = 0;
  virtual std::optional<Goal> advance(double until) = 0;

  virtual void record_events(bool is_wanted) = 0;
  virtual std::span<const Event> events() const = 0;
  virtual void forget_events() = 0;

  virtual const WorldSpec& spec() const = 0;
  virtual double now() const = 0;
  virtual std::uint32_t body_count() const = 0;
  virtual BodyKind kind(BodyId body) const = 0;
  virtual double radius(BodyId body) const = 0;
  virtual Vector2 half_extent(BodyId body) const = 0;
  virtual double mass(BodyId body) const = 0;
  virtual bool is_in_play(BodyId body) const = 0;
  virtual Vector2 position(BodyId body) const = 0;
  virtual Vector2 velocity(BodyId body) const = 0;
  virtual bool is_free(const Vector2& centre, double radius) const = 0;
  virtual bool is_free(const Vector2& centre, const Vector2& half_extent) const = 0;

  virtual Counters counters() const = 0;
  virtual double spin(BodyId) const { return 0.0; }
  virtual double kinetic_energy() const = 0;
  virtual double energy_introduced() const { return 0.0; }
  virtual double work_of_thrust() const { return 0.0; }
  virtual double dissipated() const { return 0.0; }
  virtual Vector2 momentum() const = 0;
  virtual double max_overlap() const = 0;
  virtual std::uint64_t hash() const = 0;

  /// Another that goes on from here with the same bits, recorded events apart; null for engines
  /// that cannot be copied, all but the exact one.
  virtual std::unique_ptr<Simulator> copy() const { return nullptr; }

  /// The world behind the exact engine, for those who need its closed forms; null for every other
  /// engine.
  virtual const World* exact_world() const { return nullptr; }
};

/// `engine` is one of engine_names(), `integrator` one of integrator_names(). `integrator` and the
/// length of a frame `dt` [s] apply to the stepped engines, paper and naive.
struct SimulatorChoice {
  std::string engine = "exact";
  std::string integrator = "euler";
  double dt = 1.0 / 60.0;
  bool has_sharp_corners = true;  ///< of bats, where the paper's engine lets a disc meet them
};

/// exact: events at their exact times (docs/physics.md). paper: frames with times of impact; naive:
/// frames with static tests only (docs/paper-engine.md).
const std::vector<std::string>& engine_names();
/// euler (explicit), semi_implicit (Euler), verlet (velocity Verlet) and rk4 (classical
/// Runge-Kutta).
const std::vector<std::string>& integrator_names();

/// Why make_simulator() cannot make this, naming what would be possible; nothing if it can.
std::optional<std::string> objection(const SimulatorChoice& choice);

/// An engine without bodies. There must be no objection (asserted).
std::unique_ptr<Simulator> make_simulator(const WorldSpec& spec,
                                          const SimulatorChoice& choice = {});

/// The exact engine, going on from `world`.
std::unique_ptr<Simulator> exact_simulator(World world);

/// Bodies in play that are where none can be: centre outside the field, or not a number.
std::uint32_t escape_count(const Simulator& simulator);

}  // namespace rink::physics
