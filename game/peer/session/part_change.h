// What changed in a peer's own part with a step, for whoever shows it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/messages.h"

namespace rink::peer {

/// The change of a peer's own part since the step before.
struct PartChange {
  std::uint64_t step = 0;  ///< the step that it leads to
  double time = 0.0;       ///< then [s]
  bool is_whole = false;   ///< `bodies` and `log` are all, nothing is kept
  std::vector<Handover::Body> bodies;
  std::vector<FreeFlightState> free_flights{};  ///< of those that are kept
  std::vector<std::uint32_t> gone;              ///< to other owners
  std::vector<RestContact> rest_contacts;       ///< all of them
  std::vector<Key> keys;                        ///< all keys of live players that are still to take
                                                ///< effect
  std::vector<Key> log;                         ///< of live players, that took effect
};

template <class Stream>
bool exchange(Stream& stream, PartChange& change) {
  Head head({change.is_whole, !change.bodies.empty(), !change.free_flights.empty(),
             !change.gone.empty(), !change.rest_contacts.empty(), !change.keys.empty(),
             !change.log.empty()});
  if (!head.exchange(stream)) return false;
  change.is_whole = head.has(0);
  return stream.varint(change.step) && stream.number(change.time) &&
         exchange_part(stream, head.has(1), change.bodies) &&
         exchange_part(stream, head.has(2), change.free_flights) &&
         exchange_part(stream, head.has(3), change.gone) &&
         exchange_part(stream, head.has(4), change.rest_contacts) &&
         exchange_part(stream, head.has(5), change.keys) &&
         exchange_part(stream, head.has(6), change.log);
}
std::vector<std::uint8_t> written(PartChange message);
bool read(std::span<const std::uint8_t> bytes, PartChange& message);

/// Where the body is at `time` [s]: a puck in a goal keeps its velocity, but stays.
Vector2 place_of(const BodyState& state, double time);

/// The first of these bodies, at `time` [s], that is in none of the zones of `owners`; nothing if
/// all are.
std::optional<std::uint32_t> first_elsewhere(std::span<const Handover::Body> bodies, double time,
                                             const Division& division,
                                             std::span<const PeerNumber> owners);

}  // namespace rink::peer
