// What happened to which body in a window of time.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/partner.h"
#include "game/physics/body_state.h"
#include "game/physics/counters.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// The part of one body in one event: the state in which it went on. One that was only looked at
/// went on as before.
struct Change {
  static constexpr std::uint32_t straight = 0xffffffff;

  Real time;                  ///< of the event [s]
  Real x, y, vx, vy, since;   ///< as of Flight
  std::uint64_t conditions;   ///< a digest of all else that its future depends on
  std::uint32_t body, event;  ///< changes of one event have the same number, and stand side by side
  std::uint32_t motion;       ///< in Journal::motions; `straight` if it flies freely
  float reach = 0.0f;  ///< how far around the body the event looked for a pile, if at all [m]
};

/// Kept by a world for the subdomain that looks at it (subdomain.h). The world calls bodies by
/// their slots in it; what is entered calls them by their numbers in the whole.
struct Journal {
  /// A rectangle, sides included [m].
  struct Room {
    Real low_x, low_y, high_x, high_y;
    bool holds(Real x, Real y) const {
      return low_x <= x && x <= high_x && low_y <= y && y <= high_y;
    }
  };

  struct Sight {
    std::vector<std::uint32_t> looked_at;  ///< slots
    Real reach = 0.0;                      ///< as in Change
    void clear() { looked_at.clear(), reach = 0.0; }
  };

  std::vector<Change> changes;
  std::vector<Motion>
      motions;  ///< of those that went on along a curve, or have companions, or are out of play
  Sight sight;  ///< of the event at hand
  std::uint32_t event = 0;
  std::uint64_t mixed_digest =
      0;               ///< a digest of what the event at hand does to the rhythm of impacts
  Real time = 0.0;     ///< of it
  Real played = -1.0;  ///< the instant at which advance() began, if it had been there
  std::uint64_t at_once_max = 0;       ///< the most events at one instant
  std::vector<Real> times;             ///< of all events that are counted so
  std::vector<std::uint32_t> counted;  ///< the numbers of these events, as in Change
  std::vector<Real> unsolved;          ///< when a joint impact could not be solved
  // Free impacts of bodies that stay far from all that the reader cares for are counted, not
  // entered.
  std::vector<std::uint8_t> rooms_of;  ///< by slot: 1 + the room in which the body is; 0 if all
                                       ///< that happens to it is entered
  std::vector<Room> rooms;
  Real quiet_until =
      -1.0;  ///< [s] up to which a body must stay in its room if nothing else happens to it
  std::uint64_t quiet_events = 0;      ///< in this window
  std::vector<std::uint32_t> entered;  ///< bodies that were in a room until something was entered
                                       ///< of them: from then on all is
  /// Whether a window is being played in parts. Then bodies that have been played further than the
  /// event at hand were elsewhere then, and what it found of them is not entered; `unsure` if such
  /// an event looked at others, too.
  enum class Parts : std::uint8_t { none, sure, unsure };
  Parts parts = Parts::none;
  RestContactAge age;
  std::span<const std::uint32_t> numbers;  ///< by slot: of the body in the whole
  /// A bat is driven otherwise from then on.
  struct Thrust {
    Real time;
    std::uint32_t body;
    RealVector thrust;
  };
  std::vector<Thrust> thrusts;

  std::uint32_t number_of(std::uint32_t slot) const {
    if (numbers.empty()) return slot;  // a whole world's
    assert(slot < numbers.size());
    return numbers[slot];
  }

  /// A body, by its slot, as an event leaves it.
  struct Entry {
    std::uint32_t body;
    const Flight& flight;
    std::uint64_t conditions;
  };
  void enter(const Entry& entry) {
    const auto& [slot, f, conditions] = entry;
    const std::uint32_t body = number_of(slot);
    if (rooms_of[slot] != 0) rooms_of[slot] = 0, entered.push_back(body);
    changes.push_back({time, f.x, f.y, f.vx, f.vy, f.time, conditions, body, event,
                       Change::straight, static_cast<float>(sight.reach)});
  }
  bool is_quiet(std::uint32_t body, const Flight& f) const {
    if (rooms_of[body] == 0) return false;
    const Room& room = rooms[rooms_of[body] - 1u];
    const Real ahead = quiet_until - f.time;  // drag would only make the way shorter
    return room.holds(f.x, f.y) && room.holds(f.x + f.vx * ahead, f.y + f.vy * ahead);
  }
  /// Whether a free impact of two bodies, after it, is counted only.
  bool is_quiet(const Entry& low, const Entry& high) const {
    return is_quiet(low.body, low.flight) && is_quiet(high.body, high.flight);
  }
  void enter_impact(const Entry& low, const Entry& high) {
    if (is_quiet(low, high)) ++quiet_events;
    else enter(low), enter(high);
  }
  /// The event that is about to be processed, of these slots or parts of the field.
  void begin_event(Real at, Partner lower, Partner higher) {
    const auto named = [this](Partner p) { return is_body(p) ? number_of(p) : p; };
    const RestContactAge next{static_cast<double>(at), at <= played, named(lower), named(higher),
                              0};
    age = next.time == age.time ? std::max(age, next) : next;
    time = at;
  }
  void count_event(Real at, std::uint64_t at_once) {
    at_once_max = std::max(at_once_max, at_once);
    times.push_back(at), counted.push_back(event);
  }
  std::uint64_t digest_of(std::uint32_t slot, std::uint32_t count) const {
    return ((std::uint64_t{number_of(slot)} << 32 | count) + 1) * 0x9e3779b97f4a7c15ULL;
  }
  void mix_digest(std::uint32_t slot, std::uint32_t count) {
    mixed_digest += digest_of(slot, count);
  }
  RestContactAge next_age() {
    ++age.rank;
    return age;
  }

  /// How far it had come between two events; but for rooms, which whoever goes back sets.
  struct Mark {
    std::size_t changes = 0, motions = 0, times = 0, unsolved = 0, thrusts = 0, entered = 0;
    std::uint32_t event = 0;
    Real time = 0.0, played = -1.0;
    std::uint64_t at_once_max = 0, quiet_events = 0;
    RestContactAge age{};
  };
  Mark mark() const {
    return {changes.size(), motions.size(), times.size(), unsolved.size(),
            thrusts.size(), entered.size(), event,        time,
            played,         at_once_max,    quiet_events, age};
  }
  void go_back(const Mark& mark) {
    changes.resize(mark.changes), motions.resize(mark.motions);
    times.resize(mark.times), counted.resize(mark.times);
    unsolved.resize(mark.unsolved), thrusts.resize(mark.thrusts), entered.resize(mark.entered);
    sight.clear();
    event = mark.event, mixed_digest = 0;
    time = mark.time, played = mark.played;
    at_once_max = mark.at_once_max, quiet_events = mark.quiet_events;
    age = mark.age;
  }
};

}  // namespace rink::physics::inline RINK_PRECISION
