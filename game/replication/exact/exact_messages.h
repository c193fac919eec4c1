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
#include "game/replication/exact/exact_start.h"
#include "game/replication/exact/exact_state.h"

namespace rink::game {

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

/// A body is out of scope, but known and computed on (`lingers`); or it is not known any more, from
/// the tick on or from the tick before on. One that was removed never comes back.
struct ExactExit {
  std::uint32_t rank = 0;
  bool lingers = false, is_at_start = false, is_removed = false;
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
  std::vector<std::uint32_t> returns;  ///< ranks of lingering bodies that are in scope again
  std::vector<ExactEntry> entries;     ///< by number
  std::optional<std::uint32_t> felt;   ///< keys of the receiver's own in effect, if it is another
                                       ///< number than before
  std::optional<std::uint32_t> hash;   ///< of all that is known after the tick
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
  mark(stream, "keys.count");
  if (!size(stream, tick.keys, 2)) return false;
  auto form = KeyTimes::full;
  if constexpr (!Stream::is_reading) form = key_times(tick.keys);
  std::uint64_t form_word = static_cast<std::uint64_t>(form);
  if (!count(stream, form_word, 2, 0)) return false;
  form = static_cast<KeyTimes>(form_word);
  std::uint64_t last = form == KeyTimes::full ? 0 : key_base(form, context.time);
  const unsigned order = form == KeyTimes::microseconds ? 11 : 6;
  double latest = context.time;
  for (ExactKey& key : tick.keys) {
    mark(stream, "keys.time");
    if (form == KeyTimes::full) {
      if (!stream.full(key.time)) return false;
    } else {
      std::uint64_t gap = Stream::is_reading ? 0 : key_steps(form, key.time) - last;
      if (!count(stream, gap, std::uint64_t{1} << 40, order)) return false;
      last += gap;
      if constexpr (Stream::is_reading) key.time = key_instant(form, last);
    }
    std::uint64_t bat = key.bat;
    mark(stream, "keys.bat");
    if (!(key.time >= latest && key.time <= tick.time) || !below(stream, bat, context.bats))
      return false;
    latest = key.time;
    key.bat = static_cast<std::uint32_t>(bat);
    if constexpr (Stream::is_reading) key.before = drives[key.bat];
    mark(stream, "keys.drive");
    if (!drive_change(stream, key.before, key.after)) return false;
    drives[key.bat] = key.after;
  }
  return true;
}

template <class Stream>
bool exchange_entry(Stream& stream, ExactEntry& entry, const ExactStart& start, double now,
                    std::int64_t& last) {
  std::uint64_t off = folded(static_cast<std::int64_t>(entry.object) -
                             static_cast<std::int64_t>(entry.number) - start.object_base);
  std::uint64_t exact_class = entry.exact_class;
  mark(stream, "entries.number");
  if (!rising(stream, entry.number, last, exact_number_max)) return false;
  mark(stream, "entries.object");
  if (!count(stream, off, std::uint64_t{1} << 34, 0)) return false;
  mark(stream, "entries.class");
  if (!below(stream, exact_class, start.classes.size())) return false;
  const std::int64_t object =
      unfolded(off) + static_cast<std::int64_t>(entry.number) + start.object_base;
  if (object < 0 || object >= 0xffffffff) return false;  // the greatest is the empty handle
  entry.object = static_cast<std::uint32_t>(object);
  entry.exact_class = static_cast<std::uint32_t>(exact_class);
  const ExactClass& kind = start.classes[entry.exact_class];
  mark(stream, "entries.player");
  if (kind.kind == physics::BodyKind::bat && !small(stream, entry.player, exact_number_max, 5))
    return false;
  return kind.kind == physics::BodyKind::post ||
         exchange(stream, entry.state, kind, {start.spec, start.grid, now});
}

template <class Stream>
bool exchange_changes(Stream& stream, ExactTick& tick, const ExactContext& context) {
  const ExactStart& start = *context.start;
  std::int64_t last = -1;
  mark(stream, "told.count");
  if (!size(stream, tick.told)) return false;
  for (ExactTold& each : tick.told) {
    mark(stream, "told.rank");
    if (!rising(stream, each.rank, last, context.class_of.size())) return false;
    const ExactClass& kind = start.classes[context.class_of[each.rank]];
    if (kind.kind == physics::BodyKind::post ||
        !exchange(stream, each.state, kind, {start.spec, start.grid, tick.time}))
      return false;
  }
  last = -1;
  mark(stream, "exits");
  if (!size(stream, tick.exits)) return false;
  for (ExactExit& each : tick.exits)
    if (!rising(stream, each.rank, last, context.class_of.size()) || !stream.flag(each.lingers) ||
        (!each.lingers && !stream.flag(each.is_at_start)) ||
        (each.is_at_start && !stream.flag(each.is_removed)))
      return false;
  last = -1;
  mark(stream, "returns");
  if (!size(stream, tick.returns)) return false;
  for (std::uint32_t& rank : tick.returns)
    if (!rising(stream, rank, last, context.class_of.size())) return false;
  last = -1;
  mark(stream, "entries.count");
  return size(stream, tick.entries) && std::ranges::all_of(tick.entries, [&](ExactEntry& each) {
           return exchange_entry(stream, each, start, tick.time, last);
         });
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

/// The time mostly is the one that the tick before foretells, and the tag so but for roundings.
template <class Stream>
bool exchange_instant(Stream& stream, ExactTick& tick, const ExactContext& context) {
  const double expected = context.time + context.start->tick_s;
  const auto passed = static_cast<std::uint64_t>(std::llround(1e9 * context.start->tick_s));
  std::uint64_t off = folded(static_cast<std::int64_t>(tick.tag - context.tag - passed));
  bool is_on_time = tick.time == expected && tick.tag != 0 && off < 256;
  if (!stream.flag(is_on_time)) return false;
  if (is_on_time) {
    if (!count(stream, off, 255, 0)) return false;
    if constexpr (Stream::is_reading)
      tick.time = expected,
      tick.tag = context.tag + passed + static_cast<std::uint64_t>(unfolded(off));
  } else {
    std::uint64_t time = std::bit_cast<std::uint64_t>(tick.time);
    bool has_tag = tick.tag != 0;
    if (!foretold(stream, time, std::bit_cast<std::uint64_t>(expected)) || !stream.flag(has_tag))
      return false;
    tick.time = std::bit_cast<double>(time);
    const double gap = tick.time - context.time;
    if (!(gap >= 0.0 && tick.time <= 1e9)) return false;
    const auto since = static_cast<std::uint64_t>(std::llround(1e9 * gap));
    if (has_tag && !foretold(stream, tick.tag, context.tag + since)) return false;
  }
  if (!(tick.time >= context.time && tick.time <= 1e9)) return false;
  constexpr double gap_max = 10.0;  // s: the receiver plays what is between
  return !Stream::is_reading || tick.start.has_value() || tick.time - context.time <= gap_max;
}

/// The whole message. `context` is that of before the tick, `drives` those of the known bats, by
/// rank, which follow the keys; with a new start nobody is known and the time before is 0.
template <class Stream>
bool exchange(Stream& stream, ExactTick& tick, ExactContext context, std::vector<Drive>& drives) {
  bool has_start = tick.start.has_value(), has_keys = !tick.keys.empty(),
       has_changes = !tick.told.empty() || !tick.exits.empty() || !tick.returns.empty() ||
                     !tick.entries.empty(),
       has_felt = tick.felt.has_value(), has_hash = tick.hash.has_value();
  mark(stream, "flags");
  if (!stream.flag(has_start)) return false;
  if (has_start) {
    mark(stream, "start");
    if constexpr (Stream::is_reading) tick.start.emplace();
    if (!exchange(stream, *tick.start)) return false;
    context = {.start = &*tick.start};
  }
  mark(stream, "instant");
  if (context.start == nullptr || !exchange_instant(stream, tick, context)) return false;
  mark(stream, "flags");
  if (!stream.flag(has_keys) || !stream.flag(has_changes) || !stream.flag(has_felt) ||
      !stream.flag(has_hash))
    return false;
  if (has_keys && !exchange_keys(stream, tick, context, drives)) return false;
  if (has_changes && !exchange_changes(stream, tick, context)) return false;
  if constexpr (Stream::is_reading) {
    if (has_felt) tick.felt.emplace();
    if (has_hash) tick.hash.emplace();
  }
  mark(stream, "felt");
  if (has_felt && !small(stream, *tick.felt, 0xffffffff, 8)) return false;
  mark(stream, "hash");
  return !has_hash || stream.bits(*tick.hash, 32);
}

}  // namespace exact
}  // namespace rink::game
