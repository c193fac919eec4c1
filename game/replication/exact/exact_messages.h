// What the host sends to a client that computes what it knows: once all that bodies and field have
// in common, then at each tick what the client cannot know (docs/replication.md, "Exact").
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game/model/time_grid.h"
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

/// A bat is driven otherwise from `time` [s] on.
struct ExactKey {
  double time = 0.0;
  std::uint32_t bat = 0;  ///< its rank among the known bats
  Drive before, after;
};

/// Of a body that was and is known: its state at the tick, since something hit it in the tick, or
/// something that hit it and so on, that is not known. It is not there from the tick before on.
struct ExactTold {
  std::uint32_t rank = 0;  ///< among the known bodies
  ExactState state;
};

/// A body is not known any more: from the tick on, or from the tick before on. One that was removed
/// never comes back.
struct ExactExit {
  std::uint32_t rank = 0;
  bool is_at_start = false, is_removed = false;
};

/// A body is known from the tick on.
struct ExactEntry {
  std::uint32_t number = 0, object = 0, exact_class = 0;
  std::uint32_t player = 0;  ///< of bats
  ExactState state;          ///< not of posts
};

/// One tick. Ranks count from 0 in order of numbers, among who was known before it.
struct ExactTick {
  std::optional<ExactStart> start;
  double time = 0.0;  ///< s
  std::uint64_t tag = 0;
  std::vector<ExactKey> keys;    ///< by time; those of one instant in the order in which they came
  std::vector<ExactTold> told;   ///< by rank
  std::vector<ExactExit> exits;  ///< by rank
  std::vector<ExactEntry> entries;    ///< by number
  std::optional<std::uint32_t> felt;  ///< keys of the receiver's own in effect, if it is another
                                      ///< number than before
  std::optional<std::uint32_t> hash;  ///< of all that is known after the tick
};

/// What both sides know before a tick, and what gives ranks their meaning.
struct ExactContext {
  double time = 0.0;  ///< of the tick before
  std::uint64_t tag = 0;
  const ExactStart* start = nullptr;          ///< null before the first
  std::uint32_t bats = 0;                     ///< how many are known
  std::span<const std::uint32_t> class_of{};  ///< by rank
};

namespace exact {

/// Instants of keys on a grid travel as multiples of it: of 1 us, of key_grid, or every bit.
enum class KeyTimes : std::uint8_t { microseconds, grid, full };

inline std::uint64_t key_steps(KeyTimes form, double time) {
  return static_cast<std::uint64_t>(form == KeyTimes::microseconds ? std::llround(time * 1e6)
                                                                   : std::llround(time / key_grid));
}
inline double key_instant(KeyTimes form, std::uint64_t steps) {
  return form == KeyTimes::microseconds ? static_cast<double>(steps) / 1e6
                                        : static_cast<double>(steps) * key_grid;
}
/// The last multiple that is not after `time`, from which the first key counts.
inline std::uint64_t key_base(KeyTimes form, double time) {
  return static_cast<std::uint64_t>(
      std::floor(form == KeyTimes::microseconds ? time * 1e6 : time / key_grid));
}
inline KeyTimes key_times(std::span<const ExactKey> keys) {
  for (const KeyTimes form : {KeyTimes::grid, KeyTimes::microseconds})
    if (std::ranges::all_of(keys, [&](const ExactKey& key) {
          return key.time < 1e9 && key_instant(form, key_steps(form, key.time)) == key.time;
        }))
      return form;
  return KeyTimes::full;
}

template <class Stream>
bool drive_change(Stream& stream, const Drive& before, Drive& after) {
  const auto is_step = [](int from, int to) { return from != to && (from == 0 || to == 0); };
  bool is_along_y = before.x == after.x;
  bool is_simple =
      is_along_y ? is_step(before.y, after.y) : before.y == after.y && is_step(before.x, after.x);
  if (!stream.flag(is_simple)) return false;
  if (!is_simple) return exchange(stream, after);
  if (!stream.flag(is_along_y)) return false;
  if constexpr (Stream::is_reading) after = before;
  const std::int8_t from = is_along_y ? before.y : before.x;
  std::int8_t& to = is_along_y ? after.y : after.x;
  bool is_positive = to > 0;
  if (from == 0 && !stream.flag(is_positive)) return false;
  if constexpr (Stream::is_reading)
    to = static_cast<std::int8_t>(from != 0 ? 0 : is_positive ? 1 : -1);
  return true;
}

/// `drives` are as of before the tick, and follow the keys.
template <class Stream>
bool exchange_keys(Stream& stream, ExactTick& tick, const ExactContext& context,
                   std::vector<Drive>& drives) {
  if (!size(stream, tick.keys)) return false;
  auto form = KeyTimes::full;
  if constexpr (!Stream::is_reading) form = key_times(tick.keys);
  std::uint64_t form_word = static_cast<std::uint64_t>(form);
  if (!stream.bits(form_word, 2) || form_word > 2) return false;
  form = static_cast<KeyTimes>(form_word);
  std::uint64_t last = form == KeyTimes::full ? 0 : key_base(form, context.time);
  const unsigned order = form == KeyTimes::microseconds ? 10 : 6;
  double latest = context.time;
  for (ExactKey& key : tick.keys) {
    if (form == KeyTimes::full) {
      if (!stream.full(key.time)) return false;
    } else {
      std::uint64_t gap = Stream::is_reading ? 0 : key_steps(form, key.time) - last;
      if (!count(stream, gap, std::uint64_t{1} << 40, order)) return false;
      last += gap;
      if constexpr (Stream::is_reading) key.time = key_instant(form, last);
    }
    std::int64_t bat = key.bat;
    if (!(key.time >= latest && key.time <= tick.time) || context.bats == 0 ||
        !stream.ranged(bat, 0, context.bats - 1))
      return false;
    latest = key.time;
    key.bat = static_cast<std::uint32_t>(bat);
    if constexpr (Stream::is_reading) key.before = drives[key.bat];
    if (!drive_change(stream, key.before, key.after)) return false;
    drives[key.bat] = key.after;
  }
  return true;
}

/// Ranks or numbers in rising order, as gaps.
template <class Stream>
bool rising(Stream& stream, std::uint32_t& value, std::int64_t& last, std::uint64_t below) {
  std::uint64_t gap = static_cast<std::uint64_t>(value - last - 1);
  if (!count(stream, gap, below, 5)) return false;
  last += 1 + static_cast<std::int64_t>(gap);
  if (last >= static_cast<std::int64_t>(below)) return false;
  value = static_cast<std::uint32_t>(last);
  return true;
}

template <class Stream>
bool exchange_entry(Stream& stream, ExactEntry& entry, const ExactStart& start, double now,
                    std::int64_t& last) {
  std::uint64_t off = folded(static_cast<std::int64_t>(entry.object) -
                             static_cast<std::int64_t>(entry.number) - start.object_base);
  std::int64_t exact_class = entry.exact_class;
  if (!rising(stream, entry.number, last, exact_number_max) ||
      !count(stream, off, std::uint64_t{1} << 34, 0) || start.classes.empty() ||
      !stream.ranged(exact_class, 0, static_cast<std::int64_t>(start.classes.size()) - 1))
    return false;
  const std::int64_t object =
      unfolded(off) + static_cast<std::int64_t>(entry.number) + start.object_base;
  if (object < 0 || object >= 0xffffffff) return false;  // the greatest is the empty handle
  entry.object = static_cast<std::uint32_t>(object);
  entry.exact_class = static_cast<std::uint32_t>(exact_class);
  const ExactClass& kind = start.classes[entry.exact_class];
  if (kind.kind == physics::BodyKind::bat && !small(stream, entry.player, exact_number_max, 5))
    return false;
  return kind.kind == physics::BodyKind::post ||
         exchange(stream, entry.state, kind, {start.spec, start.grid, now});
}

template <class Stream>
bool exchange_changes(Stream& stream, ExactTick& tick, const ExactContext& context) {
  const ExactStart& start = *context.start;
  std::int64_t last = -1;
  if (!size(stream, tick.told)) return false;
  for (ExactTold& each : tick.told) {
    if (!rising(stream, each.rank, last, context.class_of.size())) return false;
    const ExactClass& kind = start.classes[context.class_of[each.rank]];
    if (kind.kind == physics::BodyKind::post ||
        !exchange(stream, each.state, kind, {start.spec, start.grid, tick.time}))
      return false;
  }
  last = -1;
  if (!size(stream, tick.exits)) return false;
  for (ExactExit& each : tick.exits)
    if (!rising(stream, each.rank, last, context.class_of.size()) ||
        !stream.flag(each.is_at_start) || (each.is_at_start && !stream.flag(each.is_removed)))
      return false;
  last = -1;
  return size(stream, tick.entries) && std::ranges::all_of(tick.entries, [&](ExactEntry& each) {
           return exchange_entry(stream, each, start, tick.time, last);
         });
}

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

template <class Stream>
bool exchange(Stream& stream, ExactStart& start) {
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

/// The difference to what the tick before foretells, or every bit.
template <class Stream>
bool foretold(Stream& stream, std::uint64_t& word, std::uint64_t expected) {
  std::uint64_t off = folded(static_cast<std::int64_t>(word - expected));
  bool is_near = off < 256;
  if (!stream.flag(is_near) || !(is_near ? count(stream, off, 255, 0) : stream.bits(word, 64)))
    return false;
  if constexpr (Stream::is_reading)
    if (is_near) word = expected + static_cast<std::uint64_t>(unfolded(off));
  return true;
}

template <class Stream>
bool exchange_instant(Stream& stream, ExactTick& tick, const ExactContext& context) {
  const double tick_s = context.start->tick_s;
  std::uint64_t time = std::bit_cast<std::uint64_t>(tick.time);
  if (!foretold(stream, time, std::bit_cast<std::uint64_t>(context.time + tick_s))) return false;
  tick.time = std::bit_cast<double>(time);
  if (!(tick.time >= context.time && tick.time <= 1e9)) return false;
  constexpr double gap_max = 10.0;  // s: the receiver plays what is between
  if (Stream::is_reading && !tick.start && tick.time - context.time > gap_max) return false;
  bool has_tag = tick.tag != 0;
  if (!stream.flag(has_tag)) return false;
  if (!has_tag) return true;
  const auto passed = static_cast<std::uint64_t>(std::llround(1e9 * (tick.time - context.time)));
  return foretold(stream, tick.tag, context.tag + passed);
}

/// The whole message. `context` is that of before the tick, `drives` those of the known bats, by
/// rank, which follow the keys; with a new start nobody is known and the time before is 0.
template <class Stream>
bool exchange(Stream& stream, ExactTick& tick, ExactContext context, std::vector<Drive>& drives) {
  bool has_start = tick.start.has_value(), has_keys = !tick.keys.empty(),
       has_changes = !tick.told.empty() || !tick.exits.empty() || !tick.entries.empty(),
       has_felt = tick.felt.has_value(), has_hash = tick.hash.has_value();
  if (!stream.flag(has_start)) return false;
  if (has_start) {
    if constexpr (Stream::is_reading) tick.start.emplace();
    if (!exchange(stream, *tick.start)) return false;
    context = {.start = &*tick.start};
  }
  if (context.start == nullptr || !exchange_instant(stream, tick, context) ||
      !stream.flag(has_keys) || !stream.flag(has_changes) || !stream.flag(has_felt) ||
      !stream.flag(has_hash))
    return false;
  if (has_keys && !exchange_keys(stream, tick, context, drives)) return false;
  if (has_changes && !exchange_changes(stream, tick, context)) return false;
  if constexpr (Stream::is_reading) {
    if (has_felt) tick.felt.emplace();
    if (has_hash) tick.hash.emplace();
  }
  return (!has_felt || small(stream, *tick.felt, 0xffffffff, 8)) &&
         (!has_hash || stream.bits(*tick.hash, 32));
}

}  // namespace exact
}  // namespace rink::game
