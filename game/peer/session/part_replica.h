// A copy of a peer's own part, so that another can continue in its place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
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
  return stream.numbers(change.step, change.time) && stream.truth(change.is_whole) &&
         exchange_list(stream, change.bodies) && exchange_list(stream, change.free_flights) &&
         stream.size(change.gone) &&
         std::all_of(change.gone.begin(), change.gone.end(),
                     [&](std::uint32_t& body) { return stream.number(body); }) &&
         exchange_list(stream, change.rest_contacts) && exchange_list(stream, change.keys) &&
         exchange_list(stream, change.log);
}
std::vector<std::uint8_t> written(PartChange message);
bool read(std::span<const std::uint8_t> bytes, PartChange& message);

/// The first of these bodies, at `time` [s], that is in none of the zones of `owners`; nothing if
/// all are.
std::optional<std::uint32_t> first_elsewhere(std::span<const Handover::Body> bodies, double time,
                                             const Division& division,
                                             std::span<const PeerNumber> owners);

/// A peer's own part at a step.
struct Part {
  std::uint64_t step = 0;
  double time = 0.0;  ///< s
  std::unordered_map<std::uint32_t, BodyState> bodies;
  std::vector<RestContact> rest_contacts;
  std::vector<Key> keys, log;  ///< as PartChange's, but `log` since the start
};

/// The part at the last two steps, since peers are never further apart.
class PartReplica {
 public:
  /// Adds the next step's change, or a whole part. False, with nothing changed, if it is neither.
  bool add(PartChange change);
  /// Returns to one of the last two steps (false if it is neither), which is then the last.
  bool rewind(std::uint64_t step);
  /// The part at the last step; the step before is dropped.
  const Part& part();
  /// The log at the last step; the step before is kept.
  std::vector<Key> log() const;

  /// Asserts that the last change, unless it is whole, follows the step before.
  void check() const;

 private:
  void apply();
  std::optional<Part> base_;
  std::optional<PartChange> last_;
};

}  // namespace rink::peer
