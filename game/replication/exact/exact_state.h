// The state of a body to the last bit, as the policy "exact" sends it (docs/replication.md).
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "game/control/network_grid.h"
#include "game/physics/body_state.h"
#include "game/physics/rounding/motion_grid.h"
#include "game/replication/exact/exact_codes.h"

namespace rink::game {

/// What the bodies of a scene have in common, so that a state need not repeat it.
struct ExactClass {
  physics::BodyKind kind = physics::BodyKind::puck;
  std::uint8_t team = 2;                   ///< a Team
  double mass = 1.0;                       ///< kg; infinite for posts
  double radius = 0.0;                     ///< m
  physics::Vector2 half_extent{0.0, 0.0};  ///< of bats [m]
  double thrust = 0.0;                     ///< of bats: what each held key adds [m/s^2]
  physics::MaterialId material = 0;
  physics::Half half = physics::Half::both;  ///< of bats
  friend bool operator==(const ExactClass&, const ExactClass&) = default;
};

/// The direction in which a bat is driven: -1, 0 or 1 along each axis.
struct Drive {
  std::int8_t x = 0, y = 0;
  friend bool operator==(const Drive&, const Drive&) = default;
};

/// A body's state at its last event with all that holds it in place: its rest contacts, and who is
/// in a jam with it.
struct ExactState {
  physics::BodyState body;
  Drive drive;
  std::vector<physics::RestContact> rest_contacts;
  std::vector<std::uint32_t> jammed_with;
};

inline bool concerns(const physics::RestContact& rest, std::uint32_t body) {
  return rest.low == body || rest.high == body;
}

/// A body of `exact_class` that nothing has happened to.
inline physics::BodyState body_of(const ExactClass& exact_class, const physics::WorldSpec& spec) {
  physics::BodyState body;
  body.kind = exact_class.kind;
  body.mass = exact_class.mass;
  body.inverse_mass = exact_class.kind == physics::BodyKind::post ? 0.0 : 1.0 / exact_class.mass;
  body.flight.radius = exact_class.radius;
  body.half_extent = exact_class.half_extent;
  body.material = exact_class.material;
  body.half = exact_class.half;
  body.drag = physics::Vector2::Constant(
      exact_class.kind == physics::BodyKind::bat ? spec.bat_drag : spec.puck_drag);
  return body;
}

/// Whether the counts of its impacts can have no effect after `now` [s]: the next impact begins
/// them anew, and until then they are below all that anybody asks for (docs/replication.md, "What a
/// state needs").
inline bool are_impacts_over(const physics::BodyState& body, double now, double contact_time) {
  constexpr std::uint32_t asked_for_min = 8;
  return now - body.impacts_begin > contact_time && body.impacts < asked_for_min &&
         body.repeats_instant < now;
}
/// As are_impacts_over(), of the hops of clusters that it was in.
inline bool are_hops_over(const physics::BodyState& body, double now, double contact_time) {
  return body.hops == 0 && now - body.last_hop > 8.0 * contact_time;
}

/// What a state is told against.
struct ExactInstant {
  const physics::WorldSpec& spec;
  GridInstants grid;
  double now = 0.0;  ///< s
};

namespace exact {

inline constexpr double speed_max = 1000.0;  ///< of received states, beyond all scenes [m/s]

template <class Stream>
bool exchange(Stream& stream, Drive& drive) {
  const auto sign = [](int along) { return std::int64_t{along > 0} - std::int64_t{along < 0}; };
  std::int64_t x = sign(drive.x), y = sign(drive.y);
  if (!stream.ranged(x, -1, 1) || !stream.ranged(y, -1, 1)) return false;
  if constexpr (Stream::is_reading)
    drive = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)};
  return true;
}

template <class Stream>
bool partner(Stream& stream, physics::Partner& value) {
  bool is_body = physics::is_body(value);
  if (!stream.flag(is_body)) return false;
  std::uint64_t word = is_body ? value : value - physics::partner::field_parts;
  if (is_body ? !count(stream, word, exact_number_max - 1, 8) : !stream.bits(word, 4)) return false;
  if constexpr (Stream::is_reading)
    value = static_cast<physics::Partner>(is_body ? word : physics::partner::field_parts + word);
  return true;
}

template <class Stream>
bool exchange(Stream& stream, physics::RestContact& rest) {
  std::int64_t axis = rest.axis;
  if (!partner(stream, rest.low) || !partner(stream, rest.high) || rest.low == rest.high ||
      !stream.ranged(axis, 0, 1) || !any(stream, rest.pull_time) || !any(stream, rest.force) ||
      !any(stream, rest.turn_time) || !any(stream, rest.age.time) ||
      !stream.flag(rest.age.follows_keys) || !stream.bits(rest.age.lower, 32) ||
      !stream.bits(rest.age.higher, 32) || !stream.bits(rest.age.rank, 32))
    return false;
  if constexpr (Stream::is_reading) rest.axis = static_cast<int>(axis);
  return std::isfinite(rest.age.time);
}

/// The whole number of steps that `value` is, if it is one that fits 52 bits.
inline std::optional<std::int64_t> steps_of(double value, double step) {
  const double steps = value / step;
  if (!(std::abs(steps) < 0x1p52) || std::nearbyint(steps) != steps ||
      std::signbit(value) != (value < 0.0))
    return std::nullopt;
  return static_cast<std::int64_t>(steps);
}

/// A flight that begins on the network grid, in whole numbers.
struct GridFlight {
  static constexpr std::int64_t margin = std::int64_t{1}
                                         << 20;  ///< beyond the field, in steps: 1 m
  std::uint64_t ago = 0;                         ///< in instants before the last one
  std::int64_t x = 0, y = 0, vx = 0, vy = 0;
};

/// How many places there are along a side of `length` [m].
inline std::uint64_t place_count(double length) {
  return static_cast<std::uint64_t>(std::ceil(length / physics::MotionGrid::position_step)) +
         2 * GridFlight::margin;
}

/// Nothing if it begins elsewhere.
inline std::optional<GridFlight> on_grid(const physics::Flight& f, const ExactInstant& instant) {
  using physics::MotionGrid;
  if (!instant.grid.exist()) return std::nullopt;
  const std::uint64_t number = instant.grid.nearest(f.time), last = instant.grid.last(instant.now);
  if (number > last || instant.grid.at(number) != f.time) return std::nullopt;
  const auto x = steps_of(f.x, MotionGrid::position_step),
             y = steps_of(f.y, MotionGrid::position_step),
             vx = steps_of(f.vx, MotionGrid::velocity_step),
             vy = steps_of(f.vy, MotionGrid::velocity_step);
  if (!x || !y || !vx || !vy) return std::nullopt;
  const auto is_near = [](std::int64_t place, double length) {
    return place + GridFlight::margin >= 0 &&
           static_cast<std::uint64_t>(place + GridFlight::margin) < place_count(length);
  };
  if (!is_near(*x, instant.spec.field.length) || !is_near(*y, instant.spec.field.width))
    return std::nullopt;
  return GridFlight{last - number, *x, *y, *vx, *vy};
}

template <class Stream>
bool place(Stream& stream, std::int64_t& value, double length) {
  std::uint64_t word = static_cast<std::uint64_t>(value + GridFlight::margin);
  if (!below(stream, word, place_count(length))) return false;
  value = static_cast<std::int64_t>(word) - GridFlight::margin;
  return true;
}

/// Half a metre a second in 18 bits.
template <class Stream>
bool speed(Stream& stream, std::int64_t& value) {
  std::uint64_t word = folded(value);
  if (!count(stream, word, std::uint64_t{1} << 53, 17)) return false;
  value = unfolded(word);
  return true;
}

template <class Stream>
bool exchange(Stream& stream, GridFlight& f, const ExactInstant& instant) {
  mark(stream, "state.time");
  if (!count(stream, f.ago, std::uint64_t{1} << 40, 3)) return false;
  mark(stream, "state.position");
  if (!place(stream, f.x, instant.spec.field.length) ||
      !place(stream, f.y, instant.spec.field.width))
    return false;
  mark(stream, "state.velocity");
  return speed(stream, f.vx) && speed(stream, f.vy);
}

/// Where and when its flight began, and how: on the network grid in short, else every bit.
template <class Stream>
bool exchange_flight(Stream& stream, physics::Flight& f, const ExactInstant& instant) {
  using physics::MotionGrid;
  std::optional<GridFlight> short_form;
  if constexpr (!Stream::is_reading) short_form = on_grid(f, instant);
  mark(stream, "state.form");
  bool is_on_grid = short_form.has_value();
  if (instant.grid.exist() && !stream.flag(is_on_grid)) return false;
  if (!is_on_grid) {
    mark(stream, "state.position");
    if (!near(stream, f.x, 3) || !near(stream, f.y, 2)) return false;
    mark(stream, "state.velocity");
    if (!near(stream, f.vx, -1) || !near(stream, f.vy, -1)) return false;
    mark(stream, "state.time");
    return like(stream, f.time, instant.now);
  }
  if constexpr (Stream::is_reading) short_form.emplace();
  if (!exchange(stream, *short_form, instant)) return false;
  if constexpr (Stream::is_reading) {
    const std::uint64_t last = instant.grid.last(instant.now);
    if (short_form->ago > last) return false;
    f.time = instant.grid.at(last - short_form->ago);
    f.x = static_cast<double>(short_form->x) * MotionGrid::position_step;
    f.y = static_cast<double>(short_form->y) * MotionGrid::position_step;
    f.vx = static_cast<double>(short_form->vx) * MotionGrid::velocity_step;
    f.vy = static_cast<double>(short_form->vy) * MotionGrid::velocity_step;
  }
  return true;
}

/// All that a state may have beside its flight, each part behind a flag that says whether it is as
/// of a body that flies by its own law and was hit long ago.
template <class Stream>
bool exchange_rest(Stream& stream, ExactState& state, const physics::BodyState& own, double now,
                   double contact_time) {
  physics::BodyState& b = state.body;
  bool has_law = b.acceleration != own.acceleration || b.drag != own.drag,
       has_impacts = !are_impacts_over(b, now, contact_time),
       has_hops = !are_hops_over(b, now, contact_time),
       has_slide = b.rest_time != own.rest_time || b.slowing != own.slowing,
       has_spin = b.spin != 0.0, is_lasting = b.flags != 0 || b.mouth != 0;
  if (!stream.flag(has_law) || !stream.flag(has_impacts) || !stream.flag(has_hops) ||
      !stream.flag(has_slide) || !stream.flag(has_spin) || !stream.flag(is_lasting))
    return false;
  if (has_law && !(any(stream, b.acceleration) && any(stream, b.drag))) return false;
  if (has_impacts && !(any(stream, b.impacts_begin) && any(stream, b.repeats_instant) &&
                       stream.bits(b.impacts, 32) && stream.bits(b.repeats, 32)))
    return false;
  if (has_hops && !(any(stream, b.last_hop) && stream.bits(b.hops, 32))) return false;
  if (has_slide && !(any(stream, b.rest_time) && any(stream, b.slowing))) return false;
  if (has_spin && !(any(stream, b.spin) && std::isfinite(b.spin))) return false;
  return !is_lasting ||
         (stream.bits(b.flags, 8) && stream.bits(b.mouth, 2) &&
          small(stream, b.jam, exact_number_max - 1, 8) && size(stream, state.rest_contacts) &&
          std::ranges::all_of(state.rest_contacts,
                              [&](auto& each) { return exchange(stream, each); }) &&
          size(stream, state.jammed_with) &&
          std::ranges::all_of(state.jammed_with, [&](auto& each) {
            return small(stream, each, exact_number_max - 1, 8);
          }));
}

/// `state` of a body of `exact_class` as of `instant`. A reader's state has defaults.
template <class Stream>
bool exchange(Stream& stream, ExactState& state, const ExactClass& exact_class,
              const ExactInstant& instant) {
  const auto& [spec, grid, now] = instant;
  const bool is_bat = exact_class.kind == physics::BodyKind::bat;
  mark(stream, "state.drive");
  if (is_bat && !exchange(stream, state.drive)) return false;
  physics::BodyState own = body_of(exact_class, spec);
  own.thrust = exact_class.thrust * physics::Vector2(state.drive.x, state.drive.y);
  if (is_bat) own.acceleration = own.thrust;
  if constexpr (Stream::is_reading) state.body = own;
  bool is_plain = false;
  if constexpr (!Stream::is_reading) {
    const physics::BodyState& b = state.body;
    is_plain = b.acceleration == own.acceleration && b.drag == own.drag && b.spin == 0.0 &&
               b.rest_time == own.rest_time && b.slowing == own.slowing && b.flags == 0 &&
               b.mouth == 0 && are_impacts_over(b, now, spec.contact_time) &&
               are_hops_over(b, now, spec.contact_time);
  }
  if (!exchange_flight(stream, state.body.flight, instant)) return false;
  mark(stream, "state.rest");
  return stream.flag(is_plain) &&
         (is_plain || exchange_rest(stream, state, own, now, spec.contact_time));
}

}  // namespace exact

/// Whether a received state could be one in `spec` at `now` [s], as far as it tells by itself.
bool is_possible(const ExactState& state, const physics::WorldSpec& spec, double now);

/// Whether states that an engine had leave room for `body` in `part`, but for roundings. Rules of
/// the received kind keep nonsense out of the engine.
bool has_room_for(const physics::BodyState& body, const physics::Subdomain& part);

/// A number that two states share only if all is equal on which the future of bodies depends that
/// are out of the reach of their impact histories.
std::uint64_t digest_of(std::uint32_t number, const physics::BodyState& body);

}  // namespace rink::game
