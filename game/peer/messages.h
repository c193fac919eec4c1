// The messages between peers, as plain values; each has one function that writes, reads and
// measures it.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "game/peer/message_head.h"
#include "game/peer/state_fields.h"
#include "game/peer/verdict_parts.h"
#include "game/physics/subdomain.h"

namespace rink::peer {

/// From `time` [s] on, `bat` has the acceleration `thrust` [m/s^2].
struct Key {
  double time = 0.0;
  std::uint32_t bat = 0;
  Vector2 thrust{0.0, 0.0};
  std::uint8_t input = 0;  ///< of a live player: its input, for logs alone; 0 for keys that all
                           ///< know from the start
};

/// A live player's key change, on its way to the bat's owner, which stamps it.
struct Press {
  std::uint32_t bat = 0;
  Vector2 thrust{0.0, 0.0};  ///< from the stamp on [m/s^2]
  std::uint8_t input = 1;    ///< as Key's, not 0
  double time = 0.0;  ///< not before this instant [s], for players that have seen the bat move at
                      ///< it already
};

/// The view of a bat's player, which the bat's owner sends to its peer at a window's end.
struct Observation {
  struct Puck {
    std::uint32_t number = 0;
    Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
    double radius = 0.0;
  };
  std::uint32_t bat = 0;
  std::uint32_t owner = 0;  ///< in the next window: it receives keys
  double time = 0.0;        ///< s
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};
  std::vector<Puck> pucks;  ///< the nearest of the owner's pucks, ghosts included, nearest first
};

/// The changed state of a body that had only free impacts: the rest of its state is as at the
/// window's start.
struct FreeFlightState {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  double time = 0.0;                               ///< of the last impact [s]
  std::uint32_t number = 0;

  static FreeFlightState of(std::uint32_t number, const physics::Flight& f) {
    return {{f.x, f.y}, {f.vx, f.vy}, f.time, number};
  }
  bool is_as(const physics::Flight& f) const {
    return position == Vector2(f.x, f.y) && velocity == Vector2(f.vx, f.vy) && time == f.time;
  }
  void write_to(physics::Flight& f) const {
    f.x = position.x(), f.y = position.y(), f.vx = velocity.x(), f.vy = velocity.y(), f.time = time;
  }
};

/// Sent at a window's start: bodies of the sender whose state the receiver lacks and must simulate
/// or own (of its ghosts those that it asks for, Verdict::wanted), all rest contacts of the
/// sender's bodies that the receiver now has, the keys of the window, and the observations for the
/// receiver's players.
struct Handover {
  struct Body {
    std::uint32_t number = 0;
    BodyState state;
  };
  std::uint32_t window = 0;
  std::vector<Body> bodies;
  std::vector<FreeFlightState> free_flights{};  ///< of those that the receiver has
  std::vector<RestContact> rest_contacts;
  std::vector<Key> keys;
  std::vector<Observation> observations;
};

/// A stretch of a body's path that ends at the next one, or with the window.
struct ClaimedFlight {
  double begin = 0.0;       ///< s
  std::uint64_t state = 0;  ///< a digest of the state at its beginning, and of all participants of
                            ///< the event that caused it
  float low_x = 0.0f, low_y = 0.0f, high_x = 0.0f,
        high_y = 0.0f;  ///< the box that the body sweeps [m], rounded outwards
  Box box() const { return {low_x, low_y, high_x, high_y}; }
};

/// Sent after a window was played: the events, in the sender's run, of its bodies that the receiver
/// has as ghosts, one flight for each event; and the whole paths, from the window's start, of
/// others that come into the receiver's halo. Ghosts without events are left out. The first claims
/// of a window carry the keys that the sender's players press on the receiver's bats.
struct Claims {
  struct Body {
    std::uint32_t number = 0;
    std::uint32_t flight_count = 0;  ///< of the next ones in `flights`
    bool is_known = false;           ///< to the receiver, since the window's start
  };
  std::uint32_t window = 0;
  std::uint32_t known_count =
      0;  ///< of the sender's bodies that the receiver has as ghosts: both count the same
  std::vector<Body> bodies;
  std::vector<ClaimedFlight> flights;
  std::vector<Press> presses;
};

/// A puck of the sender's own came to rest in a goal and is out of play.
struct Goal {
  double time = 0.0;  ///< s
  std::uint32_t puck = 0;
  bool is_left = false;
};

/// A peer that asks to join while others play.
struct Newcomer {
  static constexpr std::size_t place_max = 320;
  std::uint64_t token = 0;  ///< its own choice, unique to it
  std::uint32_t bat_count = 0, puck_count = 0,
                hand_count = 0;       ///< the number of bats that it wants to play, pucks that each
                                      ///< looks at, and bats played by persons
  std::vector<std::uint8_t> place{};  ///< where others reach it, in the mail's own form
};

/// A peer's data about newcomers in a verdict.
struct Admission {
  static constexpr std::size_t asking_max = 8;
  std::vector<Newcomer> asking{};          ///< at the sender, that all shall know of
  std::vector<std::uint32_t> reached{};    ///< candidates to which the sender is connected
  std::vector<std::uint32_t> withdrawn{};  ///< its own candidates that are gone again
  bool is_empty() const { return asking.empty() && reached.empty() && withdrawn.empty(); }
};

/// Whether the sender's run of the window is consistent with all claims that it has received.
struct Verdict {
  std::uint32_t window = 0;
  bool accepts = false;
  float halo = 0.0f;  ///< m: of the next window, or, if it does not accept, with which it will
                      ///< repeat this one
  std::uint64_t at_once_max = 0;  ///< the most events at one instant
  std::uint64_t events = 0;       ///< with a body of the sender's own, in this run
  bool leaves = false;  ///< the sender wants to hand over all its bodies when the window is final
  /// For each event of its run, the one of 256 equal parts of the window in which it came, so that
  /// events of many peers are not taken for simultaneous; empty if there are more than
  /// `listed_max`, or so few peers that it does not matter.
  static constexpr std::size_t listed_max = 64;
  std::vector<std::uint8_t> listed{};
  /// Of its run, by time; and what it was asked about the run by the verdicts before.
  static constexpr std::size_t critical_max = 1024;
  std::vector<CriticalInstant> critical{};
  std::vector<InstantReport> reports{};
  bool is_about_instants() const { return !critical.empty() || !reports.empty(); }
  std::vector<Goal> goals{};  ///< in this run
  Admission admission{};
  /// To those that are no neighbours: how far own bodies reach from their places or beyond the own
  /// halo at the run's end, with those that touch them [m], or 0 if no farther than usual; peers
  /// that receive a handover all the same, for their players look at own bats; and keys of bats
  /// that others own.
  float reach = 0.0f;
  std::vector<std::uint32_t> watchers{};
  std::vector<Press> presses{};
  /// Where the sender looks beyond its halo, in the same windows.
  static constexpr std::size_t annexes_max = 64;
  std::vector<Annex> annexes{};
  /// If the window is final: ghosts that were not what their owners claim, or may remember other
  /// impacts, so that the sender needs their states. All others are their owners' bodies bit for
  /// bit.
  std::vector<std::uint32_t> wanted{};
  bool is_for_strangers() const {
    return reach > 0.0f || !watchers.empty() || !presses.empty() || !annexes.empty();
  }
  bool has_more() const { return is_for_strangers() || !wanted.empty(); }
};

template <class Stream>
bool exchange(Stream& stream, Key& key) {
  return stream.numbers(key.time, key.bat, key.thrust.x(), key.thrust.y(), key.input);
}

template <class Stream>
bool exchange(Stream& stream, Press& press) {
  return stream.numbers(press.bat, press.thrust.x(), press.thrust.y(), press.input, press.time) &&
         press.thrust.allFinite() && press.input != 0 && std::isfinite(press.time);
}

template <class Stream>
bool exchange(Stream& stream, Observation::Puck& puck) {
  return stream.numbers(puck.number, puck.position.x(), puck.position.y(), puck.velocity.x(),
                        puck.velocity.y(), puck.radius);
}

template <class Stream>
bool exchange(Stream& stream, FreeFlightState& free_flights) {
  return stream.numbers(free_flights.number, free_flights.position.x(), free_flights.position.y(),
                        free_flights.velocity.x(), free_flights.velocity.y(), free_flights.time);
}

template <class Stream>
bool exchange(Stream& stream, ClaimedFlight& flight) {
  return stream.numbers(flight.begin, flight.state, flight.low_x, flight.low_y, flight.high_x,
                        flight.high_y);
}

template <class Stream, class Item>
bool exchange_items(Stream& stream, std::vector<Item>& list) {
  return std::all_of(list.begin(), list.end(), [&](Item& item) {
    if constexpr (std::is_integral_v<Item>) return stream.number(item);
    else return exchange(stream, item);
  });
}

/// Each as its difference from the one before it: bodies of one scene have much in common.
template <class Stream>
bool exchange_items(Stream& stream, std::vector<Handover::Body>& bodies) {
  NumberGaps gaps;
  const BodyState none;
  const BodyState* before = &none;
  for (auto& [number, state] : bodies) {
    if (!gaps.exchange(stream, number) || !exchange_changes(stream, state, *before)) return false;
    before = &state;
  }
  return true;
}

template <class Stream>
bool exchange_items(Stream& stream, std::vector<Claims::Body>& bodies) {
  NumberGaps gaps;
  return std::all_of(bodies.begin(), bodies.end(), [&](Claims::Body& body) {
    std::uint64_t known_and_count =
        std::uint64_t{body.flight_count} << 1 | static_cast<std::uint64_t>(body.is_known);
    if (!gaps.exchange(stream, body.number) || !stream.varint(known_and_count)) return false;
    if constexpr (Stream::is_reading) {
      body.is_known = (known_and_count & 1) != 0;
      body.flight_count = static_cast<std::uint32_t>(known_and_count >> 1);
    }
    return known_and_count >> 33 == 0;
  });
}

template <class Stream, class Item>
bool exchange_list(Stream& stream, std::vector<Item>& list) {
  return stream.size(list) && exchange_items(stream, list);
}

template <class Stream, class Item>
bool exchange_short_list(Stream& stream, std::vector<Item>& list) {
  return stream.short_size(list) && exchange_items(stream, list);
}

/// Numbers of bodies, in fewest bytes where they rise.
template <class Stream>
bool exchange_numbers(Stream& stream, bool are_there, std::vector<std::uint32_t>& numbers) {
  if (!are_there) return numbers.clear(), true;
  NumberGaps gaps;
  return stream.short_size(numbers) && !numbers.empty() &&
         std::all_of(numbers.begin(), numbers.end(),
                     [&](std::uint32_t& number) { return gaps.exchange(stream, number); });
}

/// A list that is marked as present, which then is not empty.
template <class Stream, class Item>
bool exchange_part(Stream& stream, bool is_there, std::vector<Item>& list) {
  if (!is_there) return list.clear(), true;
  return exchange_short_list(stream, list) && !list.empty();
}

template <class Stream>
bool exchange(Stream& stream, Observation& observation) {
  return stream.numbers(observation.bat, observation.owner, observation.time,
                        observation.position.x(), observation.position.y(),
                        observation.velocity.x(), observation.velocity.y()) &&
         exchange_list(stream, observation.pucks);
}

template <class Stream>
bool exchange(Stream& stream, Handover& message) {
  Head head({!message.bodies.empty(), !message.free_flights.empty(), !message.rest_contacts.empty(),
             !message.keys.empty(), !message.observations.empty()});
  return head.exchange(stream) && stream.varint(message.window) &&
         exchange_part(stream, head.has(0), message.bodies) &&
         exchange_part(stream, head.has(1), message.free_flights) &&
         exchange_part(stream, head.has(2), message.rest_contacts) &&
         exchange_part(stream, head.has(3), message.keys) &&
         exchange_part(stream, head.has(4), message.observations);
}

template <class Stream>
bool exchange(Stream& stream, Claims& message) {
  Head head({!message.bodies.empty(), !message.flights.empty(), !message.presses.empty()});
  if (!head.exchange(stream) || !stream.varint(message.window) ||
      !stream.varint(message.known_count) || !exchange_part(stream, head.has(0), message.bodies) ||
      !exchange_part(stream, head.has(1), message.flights) ||
      !exchange_part(stream, head.has(2), message.presses))
    return false;
  std::size_t count = 0;
  for (const Claims::Body& body : message.bodies) count += body.flight_count;
  return count == message.flights.size();
}

template <class Stream>
bool exchange(Stream& stream, Goal& goal) {
  return stream.numbers(goal.time, goal.puck) && stream.truth(goal.is_left) &&
         std::isfinite(goal.time);
}

template <class Stream>
bool exchange(Stream& stream, Newcomer& newcomer) {
  const bool is_good = stream.numbers(newcomer.token, newcomer.bat_count, newcomer.puck_count,
                                      newcomer.hand_count) &&
                       newcomer.hand_count <= newcomer.bat_count;
  return is_good && stream.number_list(newcomer.place) &&
         newcomer.place.size() <= Newcomer::place_max;
}

template <class Stream>
bool exchange(Stream& stream, Admission& admission) {
  return exchange_list(stream, admission.asking) &&
         admission.asking.size() <= Admission::asking_max &&
         stream.number_list(admission.reached) && stream.number_list(admission.withdrawn);
}

template <class Stream>
bool exchange_instants(Stream& stream, bool are_there, Verdict& message) {
  if (!are_there) return message.critical.clear(), message.reports.clear(), true;
  return exchange_short_list(stream, message.critical) &&
         exchange_short_list(stream, message.reports) && message.is_about_instants() &&
         message.critical.size() <= Verdict::critical_max;
}

template <class Stream>
bool exchange_for_strangers(Stream& stream, bool is_there, Verdict& message) {
  if (!is_there) {
    message.reach = 0.0f, message.watchers = {}, message.presses = {}, message.annexes = {};
    return true;
  }
  return stream.number(message.reach) && message.reach >= 0.0f &&
         exchange_short_list(stream, message.watchers) &&
         exchange_short_list(stream, message.presses) &&
         exchange_short_list(stream, message.annexes) &&
         message.annexes.size() <= Verdict::annexes_max && message.is_for_strangers();
}

/// `is_alone`: it tells its window itself.
template <class Stream>
bool exchange(Stream& stream, Verdict& message, bool is_alone = true) {
  Head head({message.accepts, message.is_about_instants(), message.leaves, !message.listed.empty(),
             !message.goals.empty(), !message.admission.is_empty(), message.has_more()});
  if (!head.exchange(stream) || (is_alone && !stream.varint(message.window)) ||
      !stream.number(message.halo) || !(message.halo >= 0.0f))
    return false;
  message.accepts = head.has(0), message.leaves = head.has(2);
  if (!stream.varint(message.at_once_max) || !stream.varint(message.events) ||
      !exchange_instants(stream, head.has(1), message))
    return false;
  if (!exchange_part(stream, head.has(3), message.listed) ||
      message.listed.size() > Verdict::listed_max ||
      !exchange_part(stream, head.has(4), message.goals))
    return false;
  if (!head.has(5)) message.admission = {};
  else if (!exchange(stream, message.admission) || message.admission.is_empty()) return false;
  Head more({message.is_for_strangers(), !message.wanted.empty()});
  if (head.has(6) && (!more.exchange(stream) || !(more.has(0) || more.has(1)))) return false;
  return exchange_for_strangers(stream, head.has(6) && more.has(0), message) &&
         exchange_numbers(stream, head.has(6) && more.has(1), message.wanted);
}

/// With a checksum of four bytes at the end.
std::vector<std::uint8_t> written(Handover message);
std::vector<std::uint8_t> written(Claims message);
std::vector<std::uint8_t> written(Verdict message);
/// False, with the message in no particular state, unless the bytes are one whole message.
bool read(std::span<const std::uint8_t> bytes, Handover& message);
bool read(std::span<const std::uint8_t> bytes, Claims& message);
bool read(std::span<const std::uint8_t> bytes, Verdict& message);

/// How many bytes written() would make; changes nothing.
std::size_t measured(Handover& message);
std::size_t measured(Claims& message);
std::size_t measured(Verdict& message);
/// The bytes of a state, by which states are compared.
std::vector<std::uint8_t> bytes_of(BodyState state);
bool are_same(BodyState a, BodyState b);
bool are_same(const std::vector<RestContact>& a, const std::vector<RestContact>& b);

}  // namespace rink::peer
