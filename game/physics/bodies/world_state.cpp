// The order of the bytes, and what a state must be to be possible.
#include "game/physics/bodies/world_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "game/physics/snapshot_stream.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr std::uint64_t magic = 0x7061'6e73'6b6e'6972;  // "rinksnap", little endian
constexpr std::uint32_t version = 5;

// Every member of these is bound by name: whoever adds one is told by the compiler to say here
// whether it is saved.

/// A table of numbers from 0 to `most`.
template <class Stream, class Table>
bool exchange_table(Stream& stream, Table& table, double most) {
  auto materials = static_cast<std::uint32_t>(table.material_count());
  if (!stream.number(materials) || materials == 0 || materials > 256) return false;
  if (materials != table.material_count()) table = Table(materials);
  for (std::uint32_t a = 0; a < materials; ++a)
    for (std::uint32_t b = 0; b <= a; ++b) {
      double value = table(static_cast<MaterialId>(a), static_cast<MaterialId>(b));
      if (!stream.number(value) || !(value >= 0.0 && value <= most)) return false;
      table.set(static_cast<MaterialId>(a), static_cast<MaterialId>(b), value);
    }
  return true;
}

template <class Stream>
bool exchange(Stream& stream, std::optional<SurfaceFriction>& friction) {
  bool is_there = friction.has_value();
  if (!stream.truth(is_there)) return false;
  if (!is_there) return true;
  if (!friction) friction.emplace();
  auto& [coefficient, tangential_restitution] = *friction;
  return exchange_table(stream, coefficient, std::numeric_limits<double>::max()) &&
         exchange_table(stream, tangential_restitution, 1.0);
}

template <class Stream>
bool exchange(Stream& stream, Field& field) {
  auto& [length, width, goal_width, wall, bats_keep_to_half] = field;
  return exchange_all(stream, length, width, goal_width, wall) && stream.truth(bats_keep_to_half) &&
         length > 0.0 && width > 0.0 && goal_width >= 0.0 && goal_width <= width;
}

template <class Stream>
bool exchange(Stream& stream, WorldSpec& spec) {
  auto& [field, puck_drag, bat_drag, puck_friction, restitution, surface_friction, accounts_energy,
         contact_time, cell_size, queue, slabs, allow_overlap] = spec;
  static_cast<void>(slabs);  // whoever restores a world says how it is played
  return exchange(stream, field) &&
         exchange_all(stream, puck_drag, bat_drag, puck_friction, contact_time, cell_size) &&
         exchange_table(stream, restitution, 1.0) && exchange(stream, surface_friction) &&
         stream.choice(queue, QueuePolicy::windows) && stream.truth(accounts_energy) &&
         stream.truth(allow_overlap) && puck_friction >= 0.0 && puck_drag >= 0.0 &&
         bat_drag >= 0.0 && contact_time > 0.0 && cell_size >= 0.0 &&
         field.wall < restitution.material_count();
}

template <class Stream>
bool exchange(Stream& stream, Counters& counters) {
  auto& [disc, post, wall, bat, bat_bat, goals, thrust, rests, releases, hops, freezes, stops,
         turns, joint, at_once, hop_energy, crossings, stale, predictions, evaluations, touched,
         slabs] = counters;
  static_cast<void>(slabs);
  return exchange_all(stream, disc, post, wall, bat, bat_bat, goals, thrust, rests, releases, hops,
                      freezes, stops, turns, joint, at_once, hop_energy, crossings, stale,
                      predictions, evaluations, touched);
}

/// Of one body, in all the arrays that have an entry for it.
template <class Stream>
bool exchange_body(Stream& stream, Body& body, BodyShape& build, ForceLaw& law,
                   ImpactCounts& counts) {
  auto& [x, y, vx, vy, time, radius] = static_cast<Flight&>(body);
  auto& [mass, inverse_mass, half_extent, thrust, half] = build;
  auto& [acceleration, drag] = law;
  auto& [window_start, last_hop, impacts, hops, repeats, first_contacts] = counts;
  return exchange_all(stream, x, y, vx, vy, time, radius, body.inverse_mass, body.version) &&
         stream.choice(body.kind, BodyKind::post) &&
         exchange_all(stream, body.material, body.flags, body.mouth, mass, inverse_mass) &&
         exchange_all(stream, half_extent.x(), half_extent.y(), thrust.x(), thrust.y()) &&
         stream.choice(half, Half::both) &&
         exchange_all(stream, acceleration.x(), acceleration.y(), drag.x(), drag.y(), window_start,
                      last_hop, impacts, hops, repeats.instant, repeats.count,
                      first_contacts.instant, first_contacts.count);
}

template <class Stream>
bool exchange_hold(Stream& stream, RestContact& rest) {
  auto& [low, high, axis, pull_time, force, turn_time, age] = rest;
  static_cast<void>(age);  // they stand in order of it
  return exchange_all(stream, low, high, axis, pull_time, force, turn_time);
}

/// The specification apart, which comes first.
template <class Stream>
bool exchange_state(Stream& stream, WorldState& state) {
  auto& [spec, clock, counters, table, impact_counts, jams, ledger, rest_contacts] = state;
  if (!exchange_all(stream, clock.now, jams.count, clock.instant_begin, clock.events_at_once) ||
      !stream.truth(clock.is_played) || !stream.truth(clock.solver_failed) ||
      !exchange(stream, counters))
    return false;
  auto& [bodies, shapes, laws, rest_times, slowings, spins] = table;
  if (!stream.size(bodies) || !stream.size(rest_contacts) || !stream.size(jams.frozen))
    return false;
  const std::size_t count = bodies.size();
  shapes.resize(count), laws.resize(count), impact_counts.resize(count), jams.numbers.resize(count);
  for (std::size_t body = 0; body < count; ++body)
    if (!exchange_body(stream, bodies[body], shapes[body], laws[body], impact_counts[body]) ||
        !stream.number(jams.numbers[body]))
      return false;
  if (spec.puck_friction > 0.0) rest_times.resize(count), slowings.resize(count);
  if (spec.surface_friction) spins.resize(count);
  for (Real& time : rest_times)
    if (!exchange_all(stream, time)) return false;
  for (RealVector& slowing : slowings)
    if (!exchange_all(stream, slowing.x(), slowing.y())) return false;
  for (Real& spin : spins)
    if (!exchange_all(stream, spin)) return false;
  if (!ledger.exchange(stream)) return false;
  for (RestContact& rest : rest_contacts)
    if (!exchange_hold(stream, rest)) return false;
  for (std::uint32_t& body : jams.frozen)
    if (!stream.number(body)) return false;
  return true;
}

/// Posts cannot be moved, nor what was removed and left its number empty; all else can, or an
/// impact would divide by the sum of two inverse masses of 0.
bool has_sound_mass(const Body& b, const BodyShape& build) {
  if (!(build.mass > 0.0) || b.inverse_mass != build.inverse_mass) return false;
  if (b.kind == BodyKind::post || (b.is(Body::removed) && build.inverse_mass == 0.0))
    return build.inverse_mass == 0.0;
  return build.inverse_mass > 0.0 && std::isfinite(build.inverse_mass) &&
         build.inverse_mass == Real(1.0) / build.mass;
}

bool is_sound(const Body& b, const BodyShape& build, const ForceLaw& law, const WorldState& state) {
  const auto is_finite = [](const RealVector& v) { return v.allFinite(); };
  return is_finite({b.x, b.y}) && is_finite({b.vx, b.vy}) && is_finite(law.acceleration) &&
         is_finite(build.half_extent) && build.half_extent.minCoeff() >= 0.0 &&
         is_finite(build.thrust) && b.time <= state.clock.now && b.radius >= 0.0 &&
         std::isfinite(b.radius) && has_sound_mass(b, build) &&
         b.material < state.spec.restitution.material_count() && b.mouth <= Body::right_mouth &&
         law.drag.minCoeff() >= 0.0;
}

bool is_sound(const WorldState& state) {
  const BodyTable& table = state.bodies;
  const auto count = static_cast<std::uint32_t>(table.bodies.size());
  for (std::uint32_t body = 0; body < count; ++body)
    if (!is_sound(table.bodies[body], table.shapes[body], table.laws[body], state) ||
        !std::isfinite(state.impact_counts[body].last_hop))
      return false;
  const auto is_partner = [&](Partner p) {
    return p < count || (p >= partner::field_parts && p <= partner::halfway);
  };
  const auto is_fixed = [&](Partner p) {
    return !is_body(p) || table.shapes[p].inverse_mass == 0.0;
  };
  return std::isfinite(state.clock.now) &&
         std::all_of(state.jams.frozen.begin(), state.jams.frozen.end(),
                     [&](std::uint32_t body) { return body < count; }) &&
         std::all_of(state.rest_contacts.begin(), state.rest_contacts.end(),
                     [&](const RestContact& rest) {
                       return is_partner(rest.low) && is_partner(rest.high) &&
                              !(is_fixed(rest.low) && is_fixed(rest.high)) &&
                              (rest.axis == 0 || rest.axis == 1);
                     });
}

}  // namespace

std::vector<std::uint8_t> to_snapshot(WorldState state) {
  std::vector<std::uint8_t> bytes;
  SnapshotWriter writer(bytes);
  std::uint64_t kind = magic;
  std::uint32_t format = version, digits = std::numeric_limits<Real>::digits;
  writer.numbers(kind, format, digits);
  exchange(writer, state.spec);
  exchange_state(writer, state);
  add_checksum(bytes);
  return bytes;
}

std::optional<WorldState> from_snapshot(std::span<const std::uint8_t> bytes) {
  const auto content = without_checksum(bytes);
  if (!content) return std::nullopt;
  ByteReader reader(*content);
  std::uint64_t kind = 0;
  std::uint32_t format = 0, digits = 0;
  if (!reader.numbers(kind, format, digits) || kind != magic || format != version ||
      digits != std::numeric_limits<Real>::digits)
    return std::nullopt;
  std::optional<WorldState> state(std::in_place);
  if (!exchange(reader, state->spec)) return std::nullopt;
  state->ledger = EnergyLedger(state->spec.accounts_energy);
  if (!exchange_state(reader, *state) || !reader.is_at_end() || !is_sound(*state))
    return std::nullopt;
  return state;
}

}  // namespace rink::physics::inline RINK_PRECISION
