// The messages between peers, as plain values; each has one function that writes, reads and
// measures it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <type_traits>
#include <vector>

#include "game/peer/box.h"
#include "game/physics/subdomain.h"
#include "im/basics/varint.h"

namespace rink::peer {

using physics::BodyState;
using physics::RestContact;

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
  std::uint32_t number = 0;
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};  ///< m, m/s
  double time = 0.0;                               ///< of the last impact [s]

  static FreeFlightState of(std::uint32_t number, const physics::Flight& f) {
    return {number, {f.x, f.y}, {f.vx, f.vy}, f.time};
  }
  bool is_as(const physics::Flight& f) const {
    return position == Vector2(f.x, f.y) && velocity == Vector2(f.vx, f.vy) && time == f.time;
  }
  void write_to(physics::Flight& f) const {
    f.x = position.x(), f.y = position.y(), f.vx = velocity.x(), f.vy = velocity.y(), f.time = time;
  }
};

/// Sent at a window's start: bodies of the sender whose state the receiver lacks and must simulate
/// or own, all rest contacts of the sender's bodies that the receiver now has, the keys of the
/// window, and the observations for the receiver's players.
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
  std::uint64_t at_once_max = 0;   ///< the most events at one instant
  bool had_solver_failed = false;  ///< simultaneous impacts that have no solution
  std::uint64_t events = 0;        ///< with a body of the sender's own, in this run
  bool leaves = false;  ///< the sender wants to hand over all its bodies when the window is final
  /// For each event of its run, the one of 256 equal parts of the window in which it came, so that
  /// events of many peers are not taken for simultaneous; empty if there are more than
  /// `listed_max`, or so few peers that it does not matter.
  static constexpr std::size_t listed_max = 64;
  std::vector<std::uint8_t> listed{};
  std::vector<Goal> goals{};  ///< in this run
  Admission admission{};
};

/// A whole number in as few bytes as it needs (im/basics/varint.h). A reader takes no longer form
/// of it, for a message has one form of bytes.
template <class Stream, class Number>
bool exchange_short(Stream& stream, Number& number) {
  std::array<std::byte, varint_size_max> bytes{};
  put_varint(bytes.data(), number);
  std::size_t size = 0;
  for (std::uint64_t byte = 0x80; byte >= 0x80 && size < bytes.size(); ++size) {
    byte = static_cast<std::uint64_t>(bytes[size]);
    if (!stream.word(byte, 1)) return false;
    bytes[size] = static_cast<std::byte>(byte);
  }
  std::uint64_t whole = 0;
  if (get_varint(std::span(bytes).first(size), whole) == 0) return false;
  number = static_cast<Number>(whole);
  const bool has_64_bits = size < bytes.size() || bytes.back() <= std::byte{1};
  return number == whole && size == varint_size(whole) && has_64_bits;
}

/// The first byte of the messages of every window: it marks which of the mostly absent parts
/// follow. Its highest bit is always set, as in no other message that may come instead (Loss,
/// Entry).
class Head {
 public:
  explicit Head(std::initializer_list<bool> parts) : count_(static_cast<int>(parts.size())) {
    assert(parts.size() <= 7 && "the eighth bit is always set");
    int bit = 0;
    for (const bool is_there : parts) bits_ |= static_cast<std::uint64_t>(is_there) << bit++;
  }
  template <class Stream>
  bool exchange(Stream& stream) {
    return stream.word(bits_, 1) && bits_ >> count_ == 0x80u >> count_;
  }
  bool has(int part) const {
    assert(part >= 0 && part < count_);
    return (bits_ >> part & 1) != 0;
  }

 private:
  int count_;
  std::uint64_t bits_ = 0x80;
};

template <class Stream>
bool exchange(Stream& stream, BodyState& s) {
  auto& [flight, mass, inverse_mass, half_extent, thrust, acceleration, drag, impacts_begin,
         last_hop, impacts, hops, repeats, repeats_instant, rest_time, slowing, spin, jam, kind,
         material, half, flags, mouth] = s;
  return stream.numbers(flight.x, flight.y, flight.vx, flight.vy, flight.time, flight.radius, mass,
                        inverse_mass, half_extent.x(), half_extent.y(), thrust.x(), thrust.y(),
                        acceleration.x(), acceleration.y(), drag.x(), drag.y(), impacts_begin,
                        last_hop, impacts, hops, repeats, repeats_instant, rest_time, slowing.x(),
                        slowing.y(), spin, jam) &&
         stream.choice(kind, physics::BodyKind::post) && stream.number(material) &&
         stream.choice(half, physics::Half::both) && stream.numbers(flags, mouth);
}

template <class Stream>
bool exchange(Stream& stream, RestContact& rest) {
  auto& [low, high, axis, pull_time, force, turn_time, age] = rest;
  return stream.numbers(low, high, axis, pull_time, force, turn_time, age.time, age.lower,
                        age.higher, age.rank) &&
         stream.truth(age.follows_keys) && (axis == 0 || axis == 1);
}

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
bool exchange(Stream& stream, Handover::Body& body) {
  return stream.number(body.number) && exchange(stream, body.state);
}

template <class Stream>
bool exchange(Stream& stream, FreeFlightState& free_flights) {
  return stream.numbers(free_flights.number, free_flights.position.x(), free_flights.position.y(),
                        free_flights.velocity.x(), free_flights.velocity.y(), free_flights.time);
}

template <class Stream>
bool exchange(Stream& stream, Claims::Body& body) {
  return stream.numbers(body.number, body.flight_count) && stream.truth(body.is_known);
}

template <class Stream>
bool exchange_single(Stream& stream, float& value) {
  auto bits = std::bit_cast<std::uint32_t>(value);
  if (!stream.number(bits)) return false;
  value = std::bit_cast<float>(bits);
  return true;
}

template <class Stream>
bool exchange(Stream& stream, ClaimedFlight& flight) {
  return stream.numbers(flight.begin, flight.state) && exchange_single(stream, flight.low_x) &&
         exchange_single(stream, flight.low_y) && exchange_single(stream, flight.high_x) &&
         exchange_single(stream, flight.high_y);
}

template <class Stream, class Item>
bool exchange_list(Stream& stream, std::vector<Item>& list) {
  if (!stream.size(list)) return false;
  for (Item& item : list)
    if (!exchange(stream, item)) return false;
  return true;
}

/// A list that is marked as present, which then is not empty.
template <class Stream, class Item>
bool exchange_part(Stream& stream, bool is_there, std::vector<Item>& list) {
  std::uint64_t count = list.size();
  if (!is_there) return list.clear(), true;
  if (!exchange_short(stream, count) || count == 0 || count > stream.count_max()) return false;
  list.resize(count);
  return std::all_of(list.begin(), list.end(), [&](Item& item) {
    if constexpr (std::is_integral_v<Item>) return stream.number(item);
    else return exchange(stream, item);
  });
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
  return head.exchange(stream) && exchange_short(stream, message.window) &&
         exchange_part(stream, head.has(0), message.bodies) &&
         exchange_part(stream, head.has(1), message.free_flights) &&
         exchange_part(stream, head.has(2), message.rest_contacts) &&
         exchange_part(stream, head.has(3), message.keys) &&
         exchange_part(stream, head.has(4), message.observations);
}

template <class Stream>
bool exchange(Stream& stream, Claims& message) {
  Head head({!message.bodies.empty(), !message.flights.empty(), !message.presses.empty()});
  if (!head.exchange(stream) || !exchange_short(stream, message.window) ||
      !exchange_short(stream, message.known_count) ||
      !exchange_part(stream, head.has(0), message.bodies) ||
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
  return is_good && stream.size(newcomer.place) && newcomer.place.size() <= Newcomer::place_max &&
         std::all_of(newcomer.place.begin(), newcomer.place.end(),
                     [&](std::uint8_t& byte) { return stream.number(byte); });
}

template <class Stream>
bool exchange_numbers(Stream& stream, std::vector<std::uint32_t>& peers) {
  return stream.size(peers) && std::all_of(peers.begin(), peers.end(), [&](std::uint32_t& peer) {
           return stream.number(peer);
         });
}

template <class Stream>
bool exchange(Stream& stream, Admission& admission) {
  return exchange_list(stream, admission.asking) &&
         admission.asking.size() <= Admission::asking_max &&
         exchange_numbers(stream, admission.reached) &&
         exchange_numbers(stream, admission.withdrawn);
}

template <class Stream>
bool exchange(Stream& stream, Verdict& message) {
  Head head({message.accepts, message.had_solver_failed, message.leaves, !message.listed.empty(),
             !message.goals.empty(), !message.admission.is_empty()});
  if (!head.exchange(stream) || !exchange_short(stream, message.window) ||
      !exchange_single(stream, message.halo) || !(message.halo >= 0.0f))
    return false;
  message.accepts = head.has(0), message.had_solver_failed = head.has(1),
  message.leaves = head.has(2);
  if (!exchange_short(stream, message.at_once_max) || !exchange_short(stream, message.events))
    return false;
  if (!exchange_part(stream, head.has(3), message.listed) ||
      message.listed.size() > Verdict::listed_max ||
      !exchange_part(stream, head.has(4), message.goals))
    return false;
  if (!head.has(5)) return message.admission = {}, true;
  return exchange(stream, message.admission) && !message.admission.is_empty();
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

}  // namespace rink::peer
