// What all peers share: the books about bodies that a library need not keep, and frames.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/peers/overlap.h"
#include "game/physics/simulator.h"

namespace rink::peers {

/// Half of it [m]: thin walls would let through what Chipmunk, which looks only at the ends of
/// frames, sees on neither side.
inline constexpr double wall_thickness = 1.0;

/// A library's world as a Simulator. A peer says how bodies are made, moved and asked; the rest is
/// here.
class PeerWorld : public physics::Simulator {
 public:
  PeerWorld(const physics::WorldSpec& spec, double dt);

  BodyId add(const physics::PuckSpec& spec) final;
  BodyId add(const physics::BatSpec& spec) final;
  BodyId add(const physics::PostSpec& spec) final;
  void remove(BodyId body) final;
  void set_thrust(BodyId bat, const Vector2& acceleration) final {
    thrusts_[bat.index] = acceleration;
  }
  /// Peers have no goals, so no puck ever waits to be placed (asserted).
  void place(BodyId puck, const Vector2& position, const Vector2& velocity) final;
  std::optional<physics::Goal> advance(double until) final;

  /// A peer counts impacts but keeps no record of events.
  void record_events(bool) final {}
  std::span<const physics::Event> events() const final { return {}; }
  void forget_events() final {}

  const physics::WorldSpec& spec() const final { return spec_; }
  double now() const final { return static_cast<double>(frames_) * dt_; }
  std::uint32_t body_count() const final { return static_cast<std::uint32_t>(outlines_.size()); }
  BodyKind kind(BodyId body) const final { return outlines_[body.index].kind; }
  double radius(BodyId body) const final { return outlines_[body.index].radius; }
  Vector2 half_extent(BodyId body) const final { return outlines_[body.index].reach(); }
  double mass(BodyId body) const final { return outlines_[body.index].mass; }
  bool is_in_play(BodyId body) const final { return !is_removed_[body.index]; }
  Vector2 position(BodyId body) const final {
    return is_removed_[body.index] ? last_places_[body.index] : place_of(body.index);
  }
  Vector2 velocity(BodyId body) const final {
    return is_removed_[body.index] ? Vector2(0.0, 0.0) : velocity_of(body.index);
  }
  bool is_free(const Vector2& centre, double radius) const final;
  bool is_free(const Vector2& centre, const Vector2& half_extent) const final;

  const physics::Counters& counters() const final { return counters_; }
  double kinetic_energy() const final;
  Vector2 momentum() const final;
  double max_overlap() const final;
  std::uint64_t hash() const final;

 protected:
  /// Body number `index`, counted from 0 in order of creation, of this outline; infinite mass never
  /// moves.
  virtual void make(std::size_t index, const Outline& outline, const Vector2& position,
                    const Vector2& velocity) = 0;
  virtual void destroy(std::size_t index) = 0;
  virtual Vector2 place_of(std::size_t index) const = 0;
  virtual Vector2 velocity_of(std::size_t index) const = 0;
  /// One frame under thrusts().
  virtual void step() = 0;

  double dt() const { return dt_; }
  double drag_of(BodyKind kind) const {
    return kind == BodyKind::bat ? spec_.bat_drag : spec_.puck_drag;
  }
  const std::vector<Vector2>& thrusts() const { return thrusts_; }
  const Vector2& thrust_of(std::size_t index) const { return thrusts_[index]; }
  /// A new contact between two kinds of bodies, or of a body and a wall.
  void count_impact(BodyKind a, BodyKind b);
  void count_wall_impact() { ++counters_.wall_impacts; }

 private:
  BodyId add(const Outline& outline, const Vector2& position, const Vector2& velocity);
  bool is_clear(const Vector2& centre, const Outline& outline) const;

  physics::WorldSpec spec_;
  double dt_;
  std::uint64_t frames_ = 0;
  std::vector<Outline> outlines_;
  std::vector<Vector2> thrusts_, last_places_;
  std::vector<bool> is_removed_;
  physics::Counters counters_;
};

}  // namespace rink::peers
