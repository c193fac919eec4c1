// The bodies of a world: what each of them is, and how it has moved since its last event.
#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "game/physics/bodies/body_records.h"
#include "game/physics/bodies/energy_ledger.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body_state.h"
#include "game/physics/change_log.h"
#include "game/physics/counters.h"
#include "game/physics/flight/impact_time.h"
#include "game/physics/flight/motion.h"
#include "game/physics/large_pages.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// An array for each kind of record, by body.
struct BodyTable {
  LargeArray<Body> bodies;
  std::vector<BodyShape> shapes;
  std::vector<ForceLaw> laws;
  std::vector<Real>
      rest_times;  ///< of worlds with friction: when it will have brought the body to rest [s]
  std::vector<RealVector> slowing;  ///< of worlds with friction: its part in the acceleration
  std::vector<Real> spins;          ///< of worlds with surface friction [rad/s]
};

/// The only one that rewrites last-event states. Who does so first brings the body up to the
/// instant, rebase(), which also tells those who look.
class Bodies {
 public:
  Bodies(const WorldSpec& spec, Counters& counters, EnergyLedger& ledger,
         const Observers& observers);
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  std::uint32_t count() const { return static_cast<std::uint32_t>(table_.bodies.size()); }
  const Body& operator[](std::uint32_t body) const { return table_.bodies[body]; }
  const BodyShape& build(std::uint32_t body) const { return table_.shapes[body]; }
  const ForceLaw& law(std::uint32_t body) const { return table_.laws[body]; }
  bool has_spins() const { return is_rough_; }
  /// Of worlds with surface friction.
  Real spin(std::uint32_t body) const {
    assert(body < table_.spins.size());
    return table_.spins[body];
  }
  /// Of worlds with friction.
  Real rest_time(std::uint32_t body) const {
    assert(body < table_.rest_times.size());
    return table_.rest_times[body];
  }
  const RealVector& slowing(std::uint32_t body) const {
    assert(body < table_.slowing.size());
    return table_.slowing[body];
  }

  bool is_slowed() const { return puck_friction_ > 0.0; }
  bool is_slowed(std::uint32_t body) const {
    return is_slowed() && table_.bodies[body].kind == BodyKind::puck;
  }
  bool is_fixed(Partner p) const { return !is_body(p) || table_.shapes[p].inverse_mass == 0.0; }
  Real inverse_mass(Partner p) const { return is_body(p) ? table_.shapes[p].inverse_mass : 0.0; }
  Real own_drag(std::uint32_t body) const {
    return table_.bodies[body].kind == BodyKind::bat ? bat_drag_ : puck_drag_;
  }
  /// How many are not in straight flight.
  std::uint32_t curved_count() const { return curved_count_; }

  Motion motion(std::uint32_t body) const;
  /// At its last event.
  RealVector velocity(Partner p) const {
    return is_body(p) ? RealVector(table_.bodies[p].vx, table_.bodies[p].vy) : RealVector(0.0, 0.0);
  }

  /// The next body, by number; `state` as of read(), its law being its own.
  void add(const BodyState& state);
  /// All of them at once.
  const BodyTable& table() const { return table_; }
  void restore(BodyTable table);
  /// All that the future of a body depends on and that is kept here.
  void read(std::uint32_t body, BodyState& state) const;
  void write(std::uint32_t body, const BodyState& state);

  /// Before it changes.
  void keep(std::uint32_t body) {
    if (observers_.before != nullptr) observers_.before->keep(body);
  }
  /// Brings the body up to `time`, which its event then changes.
  void rebase(std::uint32_t body, Real time);
  /// Notes that the present event changes the body, whose next event is then predicted anew.
  void touch(std::uint32_t body);
  /// Restarts the body's flight after a free impact, which predicts the next event itself.
  void restart(std::uint32_t body, const RealVector& position, const RealVector& velocity,
               Real time) {
    table_.bodies[body].restart(position.x(), position.y(), velocity.x(), velocity.y(), time);
    ++table_.bodies[body].version;
  }
  /// Puts it elsewhere, unseen.
  void put(std::uint32_t body, const RealVector& position, const RealVector& velocity, Real time) {
    table_.bodies[body].restart(position.x(), position.y(), velocity.x(), velocity.y(), time);
  }
  /// As if restart() had not been, or nothing else that changed its flight since then.
  void take_back(std::uint32_t body, const Flight& before, std::uint32_t version) {
    static_cast<Flight&>(table_.bodies[body]) = before;
    table_.bodies[body].version = version;
  }
  ChangeLog& changes() { return changes_; }

  void set_flags(std::uint32_t body, std::uint8_t flags) { table_.bodies[body].flags |= flags; }
  void clear_flags(std::uint32_t body, std::uint8_t flags) {
    table_.bodies[body].flags = static_cast<std::uint8_t>(table_.bodies[body].flags & ~flags);
  }
  void set_mouth(std::uint32_t body, Body::Mouth mouth) { table_.bodies[body].mouth = mouth; }
  void set_velocity(std::uint32_t body, const RealVector& velocity) {
    table_.bodies[body].vx = velocity.x(), table_.bodies[body].vy = velocity.y();
  }
  void set_velocity(std::uint32_t body, int axis, Real speed) {
    (axis == 0 ? table_.bodies[body].vx : table_.bodies[body].vy) = speed;
  }
  void set_spin(std::uint32_t body, Real spin) {
    assert(is_rough_);
    table_.spins[body] = spin;
  }
  void set_thrust(std::uint32_t body, const RealVector& thrust) {
    table_.shapes[body].thrust = thrust;
  }
  void set_slowing(std::uint32_t body, const RealVector& slowing) {
    assert(is_slowed(body));
    table_.slowing[body] = slowing;
  }
  /// Its law along an axis, from its last event on.
  void set_law(std::uint32_t body, int axis, Real acceleration, Real drag);
  /// Its acceleration by friction and until when, of one that is touched already.
  void slide(std::uint32_t body, const RealVector& acceleration, Real rest_time);

  /// By the event at hand.
  std::span<const std::uint32_t> touched() const { return touched_; }
  /// Enters what the event at hand took from those that it touched; only where books are kept.
  void close_books();
  /// The next event is at hand.
  void forget_touched();

 private:
  void write_law(std::uint32_t body);

  EnergyLedger& ledger_;
  Counters& counters_;
  const Observers& observers_;
  Real puck_drag_, bat_drag_;
  Real puck_friction_;
  bool is_rough_;
  BodyTable table_;
  std::uint32_t curved_count_ = 0;
  std::vector<std::uint32_t> touched_;
  ChangeLog changes_;
};

inline Motion motion_at(const Bodies& bodies, std::uint32_t body, Real time) {
  return bodies.motion(body).at(time);
}

/// The position of motion_at(), bit for bit; of a body in straight flight it takes a quarter of the
/// instructions.
inline RealVector position_at(const Bodies& bodies, std::uint32_t body, Real time) {
  const Body& b = bodies[body];
  if (b.is(Body::curved) || bodies.is_slowed()) return motion_at(bodies, body, time).position;
  const Real s = warp_unaccelerated(time - b.time, bodies.own_drag(body)).s;
  return {b.x + b.vx * s + 0.0, b.y + b.vy * s + 0.0};  // -0 becomes 0, as there
}

/// Whether it is at rest, and will be until something acts on it.
inline bool is_still(const Bodies& bodies, std::uint32_t body) {
  return bodies.velocity(body) == RealVector(0.0, 0.0) &&
         bodies.law(body).acceleration == RealVector(0.0, 0.0);
}

/// At its last event.
inline RealVector acceleration_of(const Bodies& bodies, Partner p) {
  if (bodies.is_fixed(p)) return {0.0, 0.0};
  return bodies.law(p).acceleration - bodies.law(p).drag.cwiseProduct(bodies.velocity(p));
}

/// Of its motion and spin at its last event [J].
Real energy_of(const Bodies& bodies, std::uint32_t body);

/// What the law of the body has cost since its last event, at `time`.
EnergyTransfer energy_transfer_until(const Bodies& bodies, std::uint32_t body, Real time);

/// From its centre to the sides of its bounding box.
inline RealVector extent_of(const Bodies& bodies, std::uint32_t body) {
  return bodies.build(body).half_extent + RealVector::Constant(bodies[body].radius);
}

/// Half extents and radii of both, as one shape around the centre of one.
inline RoundedBox shape_of(const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  return {bodies.build(a).half_extent + bodies.build(b).half_extent,
          bodies[a].radius + bodies[b].radius};
}

}  // namespace rink::physics::inline RINK_PRECISION
