// The exact rink: every body moves on a closed form between events, and every event happens at its
// exact time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "game/physics/body.h"
#include "game/physics/change_log.h"
#include "game/physics/counters.h"
#include "game/physics/event.h"
#include "game/physics/event_budget.h"
#include "game/physics/flight/motion.h"
#include "game/physics/real.h"
#include "game/physics/simulator.h"

namespace rink::physics::inline RINK_PRECISION {

class Engine;
class MotionGrid;
class Slabs;
class WorldJournal;

/// A set of bodies in a field, and a simulated time that only moves forward. Pure: the same calls
/// give the same bits, whatever the cell size and however often advance() stops on the way. Method,
/// proofs and limits: docs/physics.md.
class World final : public Simulator {
 public:
  explicit World(const WorldSpec& spec);
  ~World() override;
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Adds a body at now(). The place must be free (asserted); ask is_free() first when in doubt.
  BodyId add(const PuckSpec& spec) override;
  BodyId add(const BatSpec& spec) override;
  BodyId add(const PostSpec& spec) override;

  /// Takes the body out of the world at now(), for good. What it held in place is released.
  void remove(BodyId body) override;

  /// From now() on `bat` accelerates by `acceleration` [m/s^2] less its drag. Handing in the
  /// present thrust changes nothing.
  void set_thrust(BodyId bat, const Vector2& acceleration) override;

  /// Puts a puck there at now(), back in play if it was out of it; what it held in place is
  /// released. The place must be free (asserted).
  void place(BodyId puck, const Vector2& position, const Vector2& velocity) override;

  /// Processes every event up to and including `until` [s] (not before now()), or up to the first
  /// goal, which it returns at the goal's exact time. Where it stops never changes the motion: an
  /// instant that it has been to is over, and what set_thrust(), place(), add() or remove() bring
  /// about there happens when it goes on.
  std::optional<Goal> advance(Real until) override;
  /// As advance(until), but also ends after the event with which `budget` is exceeded, which it
  /// must not have been before (asserted). Whatever is left of that instant comes when it goes on.
  std::optional<Goal> advance(Real until, EventBudget& budget);

  /// From now on keeps a record of every event, for observers; off at first. Never changes the
  /// motion.
  void record_events(bool is_wanted) override;
  /// Recorded since the last forget_events(), in order of time; valid until anything else is asked
  /// of the world.
  std::span<const Event> events() const override;
  void forget_events() override;

  Real now() const override;  ///< s
  /// The centre at now() [m], evaluated on demand; where it left play for a puck that did.
  RealVector position(BodyId body) const override;
  RealVector velocity(BodyId body) const override;  ///< at now() [m/s]
  /// At now(), anticlockwise [rad/s]; changed by impacts alone.
  Real spin(BodyId body) const override;

  /// Closed form since the body's last event, valid until its next: what a distant replica needs to
  /// follow it exactly.
  Motion motion(BodyId body) const;
  /// Grows by one or more whenever motion() changes.
  std::uint32_t motion_version(BodyId body) const;
  /// Who moves on otherwise since `cursor` was read last: whose motion() changed, who was added,
  /// removed or scored; in no order, and perhaps more than once. Everybody at the first reading,
  /// and after a long time without one. Valid until anything else is asked of the world; readers do
  /// not disturb each other, but they must share a thread.
  std::span<const BodyId> changed(ChangeCursor& cursor) const;

  std::uint32_t body_count() const override;  ///< bodies ever added; valid ids are below
  BodyKind kind(BodyId body) const override;
  Real radius(BodyId body) const override;             ///< of a puck or post [m]; 0 for a bat
  RealVector half_extent(BodyId body) const override;  ///< of the body's bounding box [m]
  Real mass(BodyId body) const override;               ///< kg; infinity for a post
  MaterialId material(BodyId body) const;
  RealVector thrust(BodyId body) const;  ///< as set, whether or not the body yields to it [m/s^2]
  bool is_in_play(BodyId body) const override;  ///< false once it has scored or was removed
  bool is_removed(BodyId body) const;
  bool is_resting(BodyId body) const;  ///< at rest, and will be until something else acts on it
  bool is_held(
      BodyId body) const;  ///< in rest contact along some axis, or part of a pressed cluster

  /// Whether a disc (or rectangle) centred there would lie inside the field and overlap no body at
  /// now(); touching is free.
  bool is_free(const Vector2& centre, double radius) const override;
  bool is_free(const Vector2& centre, const Vector2& half_extent) const override;

  /// The state as bytes: the same on every machine for the same bits. Recorded events are an
  /// observer's and not among it.
  std::vector<std::uint8_t> save() const;
  /// A world that goes on from there with the same bits, divided as `slabs` says; nothing if the
  /// bytes are no intact snapshot of this version and scalar.
  static std::optional<World> restore(std::span<const std::uint8_t> bytes,
                                      const std::optional<SlabPlan>& slabs = SlabPlan{});

  const WorldSpec& spec() const override;
  const Counters& counters() const override;
  Real kinetic_energy() const override;  ///< of the bodies in play at now(), spin included [J]
  /// The books of energy at now() [J], each from its own closed forms; all 0 unless
  /// WorldSpec::accounts_energy. Always kinetic_energy() = energy_introduced() + work_of_thrust() -
  /// dissipated(), but for rounding. Introduced is the energy of bodies as they were added or
  /// placed, less that of bodies as they were removed or scored.
  Real energy_introduced() const override;
  Real work_of_thrust() const override;
  Real dissipated() const override;      ///< lost to drag, to friction and in impacts
  RealVector momentum() const override;  ///< of the bodies in play [kg m/s]
  /// The deepest overlap of any two bodies, or of a body and a wall, at now() [m]; 0 if none
  /// overlap. Looks at every body.
  Real max_overlap() const override;

  /// FNV-1a of the last-event states of all bodies in order of their ids. Equal for equal
  /// histories, whatever the cell size and wherever advance() stopped.
  std::uint64_t hash() const override;

  std::unique_ptr<Simulator> copy() const override;
  const World* exact_world() const override { return this; }
  World* exact_world() override { return this; }

 private:
  friend class MotionGrid;
  friend class Subdomain;
  friend class WorldJournal;
  explicit World(std::unique_ptr<Engine> engine);
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<Slabs> slabs_;
};

}  // namespace rink::physics::inline RINK_PRECISION
