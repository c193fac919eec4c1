// Bodies, their rhythms and their jams without an engine that plays them: for tests of single
// parts.
#pragma once

#include <cstdint>
#include <limits>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/bodies/energy_ledger.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/bodies/observers.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {

/// What stands in the way of nobody: no walls are asked, and nothing happens by itself.
struct LooseBodies {
  WorldSpec spec;
  Observers observers;
  EventRecord record;
  EnergyLedger ledger{false};
  Bodies bodies;
  ImpactHistory history;
  Jams jams;

  explicit LooseBodies(const WorldSpec& of)
      : spec(of),
        bodies(spec, record.counters(), ledger, observers),
        history(spec, bodies, observers),
        jams(bodies, history, observers) {}

  std::uint32_t add(BodyState state) {
    state.inverse_mass = state.kind == BodyKind::post ? 0.0 : 1.0 / state.mass;
    bodies.add(state);
    history.add();
    jams.add();
    return bodies.count() - 1;
  }
  std::uint32_t add_puck(const Vector2& position, const Vector2& velocity = {0.0, 0.0},
                         double mass = 1.0) {
    return add(state_of_kind(BodyKind::puck, position, velocity, mass));
  }
  /// A square with a side of 0.25 m.
  std::uint32_t add_bat(const Vector2& position, const Vector2& velocity = {0.0, 0.0},
                        double mass = 1.0) {
    return add(state_of_kind(BodyKind::bat, position, velocity, mass));
  }
  std::uint32_t add_post(const Vector2& position) {
    return add(state_of_kind(BodyKind::post, position, {0.0, 0.0},
                             std::numeric_limits<double>::infinity()));
  }
  /// The thrust is part of the body's law only after its group shares it, or it is woken.
  void thrust(std::uint32_t body, const Vector2& acceleration) {
    bodies.set_thrust(body, acceleration);
  }
  /// As they are: a face touched along `axis`, `low` on the side of smaller coordinates.
  static Contact face_between(std::uint32_t low, Partner high, int axis) {
    Vector2 normal(0.0, 0.0);
    normal[axis] = -1.0;
    return {low, high, {0.0, normal, axis, normal}};
  }

 private:
  static BodyState state_of_kind(BodyKind kind, const Vector2& position, const Vector2& velocity,
                                 double mass) {
    BodyState state;
    state.kind = kind;
    state.flight.x = position.x(), state.flight.y = position.y();
    state.flight.vx = velocity.x(), state.flight.vy = velocity.y();
    state.flight.radius = kind == BodyKind::puck ? 0.03125 : 0.0;
    if (kind == BodyKind::bat) state.half_extent = {0.125, 0.125};
    state.mass = mass;
    return state;
  }
};

}  // namespace rink::physics::test
