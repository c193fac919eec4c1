// One interface for every engine, so that the same scene can be played, asked and measured on each.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "game/physics/body.h"
#include "game/physics/counters.h"
#include "game/physics/event.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

class World;

/// One engine at work on one set of bodies: World, an engine that steps (paper/), or another
/// library's. Questions and their meaning are those of World (world.h); all are answered at now().
/// Whoever has no use for a choice of engines uses World itself, whose calls are not virtual.
class Simulator {
 public:
  virtual ~Simulator() = default;

  virtual BodyId add(const PuckSpec& spec) = 0;
  virtual BodyId add(const BatSpec& spec) = 0;
  virtual BodyId add(const PostSpec& spec) = 0;
  virtual void remove(BodyId body) = 0;
  virtual void set_thrust(BodyId bat, const Vector2& acceleration) = 0;
  virtual void place(BodyId puck, const Vector2& position, const Vector2& velocity) = 0;
  virtual std::optional<Goal> advance(Real until) = 0;

  virtual void record_events(bool is_wanted) = 0;
  virtual std::span<const Event> events() const = 0;
  virtual void forget_events() = 0;

  virtual const WorldSpec& spec() const = 0;
  virtual Real now() const = 0;
  virtual std::uint32_t body_count() const = 0;
  virtual BodyKind kind(BodyId body) const = 0;
  virtual Real radius(BodyId body) const = 0;
  virtual RealVector half_extent(BodyId body) const = 0;
  virtual Real mass(BodyId body) const = 0;
  virtual bool is_in_play(BodyId body) const = 0;
  virtual RealVector position(BodyId body) const = 0;
  virtual RealVector velocity(BodyId body) const = 0;
  virtual bool is_free(const Vector2& centre, double radius) const = 0;
  virtual bool is_free(const Vector2& centre, const Vector2& half_extent) const = 0;

  virtual const Counters& counters() const = 0;
  virtual Real spin(BodyId) const { return 0.0; }
  virtual Real kinetic_energy() const = 0;
  virtual Real energy_introduced() const { return 0.0; }
  virtual Real work_of_thrust() const { return 0.0; }
  virtual Real dissipated() const { return 0.0; }
  virtual RealVector momentum() const = 0;
  virtual Real max_overlap() const = 0;
  virtual std::uint64_t hash() const = 0;

  /// Another that goes on from here with the same bits, recorded events apart; null for engines
  /// that cannot be copied, all but the exact one.
  virtual std::unique_ptr<Simulator> copy() const { return nullptr; }

  /// The world behind the exact engine, for those who need its closed forms; null for every other
  /// engine.
  virtual const World* exact_world() const { return nullptr; }
  virtual World* exact_world() { return nullptr; }
};

/// Bodies in play that are where none can be: centre outside the field, or not a number.
std::uint32_t escape_count(const Simulator& simulator);

}  // namespace rink::physics::inline RINK_PRECISION
