// What a world did since it was made: the proof that what did not happen cost nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rink::physics {

/// What can happen to a body; `rest` is the beginning of a rest contact, `release` its end, `stop`
/// where friction has brought a puck to rest, `turn` where that of a pushed puck takes another
/// direction.
enum class EventKind : std::uint8_t {
  puck_puck,
  post,
  wall,
  puck_bat,
  bat_bat,
  goal,
  thrust,
  rest,
  release,
  hop,
  freeze,
  stop,
  turn
};
/// As they stand in files, in order of the enumeration.
inline constexpr std::array event_kind_names{"puck_puck", "post",   "wall", "puck_bat", "bat_bat",
                                             "goal",      "thrust", "rest", "release",  "hop",
                                             "freeze",    "stop",   "turn"};
/// Whether two things met.
constexpr bool is_impact(EventKind kind) { return kind <= EventKind::bat_bat; }

/// Of windows that were played by tiles (WorldSpec::slabs); no part of a snapshot.
struct SlabCounters {
  std::uint64_t windows = 0;    ///< those undone among them
  std::uint64_t undone = 0;     ///< and played anew
  std::uint64_t put_off = 0;    ///< events, as often as they were put off
  std::uint64_t last_pass = 0;  ///< events that were left to the last pass
  std::uint64_t late = 0;       ///< courses that had to be checked

  friend bool operator==(const SlabCounters&, const SlabCounters&) = default;
};

/// Every count starts at 0 and only grows. Counters are not part of a world's state: cell size and
/// queue change them, never the motion.
struct Counters {
  std::uint64_t disc_impacts = 0;  ///< puck against puck
  std::uint64_t post_impacts = 0;  ///< puck or bat against a post or the edge of a goal
  std::uint64_t wall_impacts =
      0;                          ///< puck or bat against a wall, or a bat against the halfway line
  std::uint64_t bat_impacts = 0;  ///< puck against bat
  std::uint64_t bat_bat_impacts = 0;
  std::uint64_t goals = 0;
  std::uint64_t thrust_changes = 0;
  std::uint64_t rests = 0;     ///< rest contacts that began
  std::uint64_t releases = 0;  ///< rest contacts that ended by a pull or by sliding off an edge
  std::uint64_t hops = 0;      ///< pressed clusters separated as one
  std::uint64_t freezes = 0;   ///< pressed clusters found in static equilibrium
  std::uint64_t stops = 0;     ///< pucks that friction brought to rest
  std::uint64_t turns = 0;     ///< the friction of a pushed puck was aimed anew, or the group that
                               ///< pushes it came to a stop
  std::uint64_t joint_impacts = 0;  ///< impacts at one instant that were solved as one problem;
                                    ///< each contact that took an impulse also counts as an impact
  std::uint64_t events_at_once_max =
      0;                    ///< the most events processed at one instant, a joint impact being one
  double hop_energy = 0.0;  ///< kinetic energy that hops added to what thrust gave [J]
  std::uint64_t crossings = 0;     ///< bookkeeping: a body changed its grid cell
  std::uint64_t stale_events = 0;  ///< bookkeeping: an event whose partner had changed course
  std::uint64_t predictions = 0;   ///< pairs of bodies looked at; not those on curves whose boxes
                                   ///< say that they are too far
  std::uint64_t evaluations = 0;   ///< positions evaluated: bodies brought up to the instant of an
                                   ///< event of theirs. What is asked from outside is not counted
  std::uint64_t bodies_touched = 0;  ///< last-event states rewritten
  SlabCounters slabs{};              ///< bookkeeping

  friend bool operator==(const Counters&, const Counters&) = default;

  /// Physical events: all that rewrote the state of a body.
  std::uint64_t events() const {
    return disc_impacts + post_impacts + wall_impacts + bat_impacts + bat_bat_impacts + goals +
           thrust_changes + releases + hops + freezes + stops + turns;
  }
  /// Those and the beginnings of rest contacts: all that can be recorded.
  std::uint64_t recordable() const { return events() + rests; }
  /// Impacts of any kind.
  std::uint64_t impacts() const {
    return disc_impacts + post_impacts + wall_impacts + bat_impacts + bat_bat_impacts;
  }
  std::uint64_t& of(EventKind kind);
};

/// The counter of each kind of event.
inline constexpr std::array<std::uint64_t Counters::*, event_kind_names.size()> counter_of_kind{
    &Counters::disc_impacts,   &Counters::post_impacts,    &Counters::wall_impacts,
    &Counters::bat_impacts,    &Counters::bat_bat_impacts, &Counters::goals,
    &Counters::thrust_changes, &Counters::rests,           &Counters::releases,
    &Counters::hops,           &Counters::freezes,         &Counters::stops,
    &Counters::turns};

inline std::uint64_t& Counters::of(EventKind kind) {
  return this->*counter_of_kind[static_cast<std::size_t>(kind)];
}

}  // namespace rink::physics
