// The values of attributes and parameters of Rink's object model; one function writes and reads
// each (docs/wire.md).
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "game/control/match_flow.h"
#include "game/model/push.h"
#include "game/physics/body.h"
#include "rti/wire/stream.h"

namespace rink::game {

/// Where an entity's centre is [m], in single precision: on a 20 m field that rounds by at most
/// 1e-6 m.
struct Position {
  float x = 0.0f, y = 0.0f;
  friend bool operator==(const Position&, const Position&) = default;
};

/// The sent form of a centre at `position` [m].
inline Position rounded(const physics::Vector2& position) {
  return {static_cast<float>(position.x()), static_cast<float>(position.y())};
}

/// An entity's centre [m] and velocity [m/s]; the object model states the resolution on the wire.
struct Snapshot {
  physics::Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};
  friend bool operator==(const Snapshot&, const Snapshot&) = default;
};

/// The shape of an entity. For discs both half extents are the radius [m].
struct Shape {
  std::uint8_t kind = 0;  ///< a physics::BodyKind
  std::uint8_t team = 0;  ///< a Team
  float half_length = 0.0f, half_width = 0.0f;
  /// Its own drag [1/s], friction with the table and thrust by each held key [m/s^2], by which
  /// residuals of its trajectory are coded; 0 for none.
  float drag = 0.0f, friction = 0.0f, thrust = 0.0f;
  float mass = 0.0f;  ///< kg; 0 of what no impact moves
};

/// The number of its player's key events in effect on a bat, and the keys that are down (bit k for
/// Key k).
struct Input {
  std::uint32_t count = 0;
  std::uint8_t held = 0;
  friend bool operator==(const Input&, const Input&) = default;
};

struct Goals {
  std::uint32_t left = 0, right = 0;
  std::uint8_t is_over = 0;
  friend bool operator==(const Goals&, const Goals&) = default;
};

/// Length and width of the field [m].
struct Extent {
  float length = 0.0f, width = 0.0f;
};

/// One key, as the character of the paper's KeyDown and KeyUp: a, d, w or s.
struct KeyCharacter {
  std::uint8_t character = 0;
};

/// A push, in steps of 1/127 of the thrust, with 127 for none: octets have no sign.
struct PushSteps {
  std::uint8_t x = Push::whole, y = Push::whole;
};
inline PushSteps steps_of(const Push& push) {
  return {static_cast<std::uint8_t>(push.x + Push::whole),
          static_cast<std::uint8_t>(push.y + Push::whole)};
}
inline Push push_of(const PushSteps& steps) {
  return {static_cast<std::int8_t>(steps.x - Push::whole),
          static_cast<std::int8_t>(steps.y - Push::whole)};
}

/// The bat given to a player (bat k is the object called "bat-k"; all bits set for none) and its
/// place: enough to declare a first interest.
struct SeatOffer {
  static constexpr std::uint32_t no_bat = 0xffffffffu;
  std::uint32_t bat = no_bat;
  Position position;
};

/// The pace of a server, for players that take turns or keep logical time with it (docs/rti.md,
/// "The game under time management").
struct Pace {
  double ticks_per_second = 0.0;    ///< above 0
  std::uint8_t is_synchronous = 0;  ///< the server steps when every player has sent Update
  std::uint8_t is_time_managed = 0;
  std::uint8_t is_late = 0;  ///< this player joined after the call to the start
};

/// A player's request to pause or resume a match.
struct PauseWish {
  std::uint8_t is_wanted = 0;
};

/// The text of a hosted match's scene; a view of bytes that the caller keeps.
struct SceneText {
  static constexpr std::size_t size_max = 32'000;  ///< bytes
  rti::Bytes text;
};

/// The period of a host's ticks.
struct TickPeriod {
  static constexpr double longest = 10.0;  ///< s
  double seconds = 0.0;
};

template <class Stream>
bool exchange(Stream& stream, TickPeriod& tick) {
  return stream.finite(tick.seconds) && tick.seconds >= 0.0 && tick.seconds <= TickPeriod::longest;
}

template <class Stream>
bool exchange(Stream& stream, PauseWish& wish) {
  return stream.range(wish.is_wanted, 1);
}

template <class Stream>
bool exchange(Stream& stream, SceneText& scene) {
  return stream.template bytes<std::uint32_t>(scene.text, SceneText::size_max);
}

template <class Stream>
bool exchange(Stream& stream, MatchState& state) {
  auto phase = static_cast<std::uint8_t>(state.phase),
       wants = static_cast<std::uint8_t>(
           (state.wants_rematch[0] ? 1 : 0) | (state.wants_rematch[1] ? 2 : 0) |
           (state.is_unrecorded ? 4 : 0) | (state.takes_keys_alone ? 8 : 0));
  auto winner = static_cast<std::uint8_t>(state.winner.value_or(Team::none)),
       holder = static_cast<std::uint8_t>(state.holder.value_or(Team::none));
  const bool is_sound = stream.number(state.number) &&
                        stream.range(phase, static_cast<std::uint8_t>(MatchPhase::over)) &&
                        stream.range(wants, 15) && stream.range(winner, 2) &&
                        stream.range(holder, 2) && stream.finite(state.until_s) &&
                        stream.finite(state.clock_real_s) && stream.finite(state.clock_simulated_s);
  if (!is_sound || !Stream::is_reading) return is_sound;
  state.phase = static_cast<MatchPhase>(phase);
  state.wants_rematch = {(wants & 1) != 0, (wants & 2) != 0};
  state.is_unrecorded = (wants & 4) != 0;
  state.takes_keys_alone = (wants & 8) != 0;
  state.winner.reset();
  if (static_cast<Team>(winner) != Team::none) state.winner = static_cast<Team>(winner);
  state.holder.reset();
  if (static_cast<Team>(holder) != Team::none) state.holder = static_cast<Team>(holder);
  return true;
}

template <class Stream>
bool exchange(Stream& stream, Position& position) {
  return stream.number(position.x) && stream.number(position.y) && std::isfinite(position.x) &&
         std::isfinite(position.y);
}

template <class Stream>
bool exchange(Stream& stream, Snapshot& snapshot) {
  return stream.finite(snapshot.position.x()) && stream.finite(snapshot.position.y()) &&
         stream.finite(snapshot.velocity.x()) && stream.finite(snapshot.velocity.y());
}

inline bool is_strength(float value) { return std::isfinite(value) && value >= 0.0f; }

template <class Stream>
bool exchange(Stream& stream, Shape& shape) {
  return stream.number(shape.kind) && stream.number(shape.team) &&
         stream.number(shape.half_length) && stream.number(shape.half_width) &&
         stream.number(shape.drag) && stream.number(shape.friction) &&
         stream.number(shape.thrust) && stream.number(shape.mass) &&
         std::isfinite(shape.half_length) && std::isfinite(shape.half_width) &&
         is_strength(shape.drag) && is_strength(shape.friction) && is_strength(shape.thrust) &&
         is_strength(shape.mass);
}

template <class Stream>
bool exchange(Stream& stream, Input& input) {
  return stream.number(input.count) && stream.number(input.held);
}

template <class Stream>
bool exchange(Stream& stream, Goals& goals) {
  return stream.number(goals.left) && stream.number(goals.right) && stream.number(goals.is_over);
}

template <class Stream>
bool exchange(Stream& stream, Extent& extent) {
  return stream.number(extent.length) && stream.number(extent.width) && extent.length >= 0.0f &&
         std::isfinite(extent.length) && extent.width >= 0.0f && std::isfinite(extent.width);
}

template <class Stream>
bool exchange(Stream& stream, KeyCharacter& key) {
  return stream.number(key.character);
}

template <class Stream>
bool exchange(Stream& stream, PushSteps& steps) {
  constexpr std::uint8_t most = 2 * Push::whole;
  return stream.range(steps.x, most) && stream.range(steps.y, most);
}

template <class Stream>
bool exchange(Stream& stream, SeatOffer& seat) {
  return stream.number(seat.bat) && exchange(stream, seat.position);
}

template <class Stream>
bool exchange(Stream& stream, Pace& pace) {
  return stream.finite(pace.ticks_per_second) && pace.ticks_per_second > 0.0 &&
         stream.range(pace.is_synchronous, 1) && stream.range(pace.is_time_managed, 1) &&
         stream.range(pace.is_late, 1);
}

/// The values one after the other, in `buffer`, which is overwritten; valid as long as it is.
template <class... Values>
rti::Bytes encode(std::vector<std::byte>& buffer, Values... values) {
  buffer.clear();
  rti::Writer writer(buffer);
  [[maybe_unused]] const bool is_sound = (exchange(writer, values) && ...);
  assert(is_sound && "what we tell others, they must be able to take");
  return buffer;
}

/// Reads `value` from exactly all of `bytes`, which are not trusted: false otherwise, and the value
/// may be half read.
template <class Value>
bool decode(rti::Bytes bytes, Value& value) {
  rti::Reader reader(bytes);
  return exchange(reader, value) && reader.is_at_end();
}

}  // namespace rink::game
