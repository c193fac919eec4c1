// What begins the host's conversation with a client that computes: all that bodies and field have
// in common.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "game/physics/body.h"
#include "game/replication/exact/exact_state.h"

namespace rink::game {

struct ExactPost {
  std::uint32_t number = 0, exact_class = 0;
  double x = 0.0, y = 0.0;  ///< m
};

/// Begins a conversation, or begins it anew: the client knows nobody but the posts.
struct ExactStart {
  physics::WorldSpec spec;
  GridInstants grid;              ///< the scene's network grid
  double tick_s = 0.0;            ///< between two ticks, if they are on time
  std::uint32_t object_base = 0;  ///< mostly a body's object less its number
  std::vector<ExactClass> classes;
  std::vector<ExactPost> posts;  ///< all there are, whether or not they are in scope
};

namespace exact {

template <class Stream>
bool exchange(Stream& stream, physics::PairTable& table) {
  for (std::size_t a = 0; a < table.material_count(); ++a)
    for (std::size_t b = a; b < table.material_count(); ++b) {
      const auto first = static_cast<physics::MaterialId>(a),
                 second = static_cast<physics::MaterialId>(b);
      double value = table(first, second);
      if (!stream.full(value) || !(value >= 0.0 && value <= 1e6)) return false;
      if constexpr (Stream::is_reading) table.set(first, second, value);
    }
  return true;
}
template <class Stream>
bool exchange(Stream& stream, physics::RestitutionTable& table) {
  if (!exchange(stream, static_cast<physics::PairTable&>(table))) return false;
  for (std::size_t a = 0; a < table.material_count(); ++a)
    for (std::size_t b = a; b < table.material_count(); ++b)
      if (table(static_cast<physics::MaterialId>(a), static_cast<physics::MaterialId>(b)) > 1.0)
        return false;
  return true;
}

template <class Stream>
bool within(Stream& stream, double& value, double low, double high) {
  return stream.full(value) && value >= low && value <= high;
}

/// All that changes the motion; what changes cost alone is the receiver's own.
template <class Stream>
bool exchange(Stream& stream, physics::WorldSpec& spec) {
  physics::Field& field = spec.field;
  std::int64_t materials = static_cast<std::int64_t>(spec.restitution.material_count());
  bool is_rough = spec.surface_friction.has_value();
  if (!within(stream, field.length, 1e-3, 1e6) || !within(stream, field.width, 1e-3, 1e6) ||
      !within(stream, field.goal_width, 0.0, field.width) || !stream.bits(field.wall, 8) ||
      !stream.flag(field.bats_keep_to_half) || !within(stream, spec.puck_drag, 0.0, 1e4) ||
      !within(stream, spec.bat_drag, 0.0, 1e4) || !within(stream, spec.puck_friction, 0.0, 1e4) ||
      !within(stream, spec.contact_time, 1e-9, 1.0) || !stream.flag(spec.allow_overlap) ||
      !stream.ranged(materials, 1, 256) || field.wall >= materials || !stream.flag(is_rough))
    return false;
  if constexpr (Stream::is_reading) {
    const auto count = static_cast<std::size_t>(materials);
    spec.restitution = physics::RestitutionTable(count);
    if (is_rough)
      spec.surface_friction = physics::SurfaceFriction{physics::PairTable(count),
                                                       physics::RestitutionTable(count, 0.0)};
  }
  return exchange(stream, spec.restitution) &&
         (!is_rough || (exchange(stream, spec.surface_friction->coefficient) &&
                        exchange(stream, spec.surface_friction->tangential_restitution)));
}

template <class Stream>
bool exchange(Stream& stream, ExactClass& each, std::size_t materials) {
  std::int64_t kind = static_cast<std::int64_t>(each.kind),
               half = static_cast<std::int64_t>(each.half), team = each.team;
  if (!stream.ranged(kind, 0, 2) || !stream.ranged(half, 0, 2) || !stream.ranged(team, 0, 2) ||
      !stream.bits(each.material, 8) || each.material >= materials)
    return false;
  if constexpr (Stream::is_reading) {
    each.kind = static_cast<physics::BodyKind>(kind), each.half = static_cast<physics::Half>(half);
    each.team = static_cast<std::uint8_t>(team);
  }
  switch (each.kind) {
    case physics::BodyKind::puck:
      return within(stream, each.radius, 1e-6, 1e6) && within(stream, each.mass, 1e-12, 1e12);
    case physics::BodyKind::bat:
      return within(stream, each.half_extent.x(), 1e-6, 1e6) &&
             within(stream, each.half_extent.y(), 1e-6, 1e6) &&
             within(stream, each.mass, 1e-12, 1e12) && within(stream, each.thrust, 0.0, 1e6);
    case physics::BodyKind::post:
      if constexpr (Stream::is_reading) each.mass = std::numeric_limits<double>::infinity();
      return within(stream, each.radius, 0.0, 1e6);
  }
  return false;
}

/// Of all messages of the policy. Others refuse each other.
inline constexpr std::uint64_t exact_version = 2;

template <class Stream>
bool exchange(Stream& stream, ExactStart& start) {
  std::uint64_t version = exact_version;
  if (!stream.bits(version, 8) || version != exact_version) return false;
  if (!exchange(stream, start.spec) || !within(stream, start.grid.rate_hz, 0.0, 1000.0) ||
      !within(stream, start.tick_s, 0.0, 10.0) || !stream.bits(start.object_base, 32) ||
      !size(stream, start.classes) ||
      !std::ranges::all_of(start.classes,
                           [&](ExactClass& each) {
                             return exchange(stream, each, start.spec.restitution.material_count());
                           }) ||
      !size(stream, start.posts))
    return false;
  std::int64_t last = -1;
  for (ExactPost& post : start.posts) {
    std::int64_t exact_class = post.exact_class;
    if (!rising(stream, post.number, last, exact_number_max) || start.classes.empty() ||
        !stream.ranged(exact_class, 0, static_cast<std::int64_t>(start.classes.size()) - 1))
      return false;
    post.exact_class = static_cast<std::uint32_t>(exact_class);
    if (start.classes[post.exact_class].kind != physics::BodyKind::post ||
        !within(stream, post.x, 0.0, start.spec.field.length) ||
        !within(stream, post.y, 0.0, start.spec.field.width))
      return false;
  }
  return true;
}

}  // namespace exact
}  // namespace rink::game
