// Compares others' states with own bodies and ghosts.
#include "game/peer/session/others_states.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "game/peer/session/part_change.h"

namespace rink::peer {

namespace {

std::string says(std::uint32_t body, const char* fault) {
  return "says that body " + std::to_string(body) + fault;
}

bool is_here(const Share& share, std::uint32_t body) {
  return body < share.roles().body_count() && share.roles().of(body) != Role::away;
}

/// The numbers, sorted.
std::vector<std::uint32_t> numbers_of(const Handover& part) {
  std::vector<std::uint32_t> numbers;
  for (const Handover::Body& body : part.bodies) numbers.push_back(body.number);
  for (const FreeFlightState& flight : part.free_flights) numbers.push_back(flight.number);
  std::ranges::sort(numbers);
  return numbers;
}

bool is_elsewhere(const FreeFlightState& flight, const Share& share, const Division& division,
                  PeerNumber from) {
  constexpr double rounding = 1e-6;  // m: far more than a place is rounded by
  const physics::Motion motion{.time = flight.time,
                               .position = flight.position,
                               .velocity = flight.velocity,
                               .drag = Vector2::Constant(share.world().spec().puck_drag)};
  const Vector2 place = motion.at(share.world().now()).position;
  return !division.is_near(from, Box::around(place, {0.0, 0.0}), rounding);
}

/// Of bodies that are all of `from`.
std::string fault_of_owner(const Share& share, PeerNumber from,
                           std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t body : numbers)
    if (is_here(share, body) && !share.roles().has_ghost_of(from, body))
      return says(body, " is its own, which is another's");
  if (const auto twice = std::ranges::adjacent_find(numbers); twice != numbers.end())
    return "has body " + std::to_string(*twice) + " twice";
  for (const std::uint32_t ghost : share.roles().ghosts())
    if (share.roles().has_ghost_of(from, ghost) && !std::ranges::binary_search(numbers, ghost))
      return "leaves out body " + std::to_string(ghost) + ", which is its own";
  return {};
}

}  // namespace

std::string fault_of_known(const Share& share, std::span<const Handover::Body> bodies,
                           std::span<const FreeFlightState> free_flights) {
  for (const auto& [body, state] : bodies)
    if (is_here(share, body) && !are_same(share.state(body), state))
      return says(body, " is as it is not");
  for (const FreeFlightState& flight : free_flights)
    if (is_here(share, flight.number) && !flight.is_as(share.subdomain().flight(flight.number)))
      return says(flight.number, " is as it is not");
  return {};
}

std::string fault_of_record(const Share& share, PeerNumber from, const PartRecord& record,
                            std::span<const Handover::Body> bodies) {
  for (const std::uint32_t body : record.committed.dropped)
    if (is_here(share, body) && share.roles().has_ghost_of(from, body))
      return says(body, " is another's, which is its own");
  return fault_of_known(share, bodies, {});
}

std::string fault_of_part(const Share& share, const Division& division, PeerNumber from,
                          const Handover& part) {
  const std::vector<std::uint32_t> numbers = numbers_of(part);
  for (const std::string& fault : {fault_of_owner(share, from, numbers),
                                   fault_of_known(share, part.bodies, part.free_flights)})
    if (!fault.empty()) return fault;
  if (const auto body = first_elsewhere(part.bodies, share.world().now(), division, {{from}}))
    return says(*body, " is its own, which is in another's zone");
  for (const FreeFlightState& flight : part.free_flights)
    if (is_elsewhere(flight, share, division, from))
      return says(flight.number, " is its own, which is in another's zone");
  return {};
}

}  // namespace rink::peer
