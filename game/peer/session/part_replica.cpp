// Keeps parts up to date, with the step before.
#include "game/peer/session/part_replica.h"

#include <cassert>
#include <cmath>

#include "game/peer/message_bytes.h"
#include "game/physics/subdomain.h"
#include "im/basics/checked.h"

namespace rink::peer {

std::vector<std::uint8_t> written(PartChange message) { return bytes_from(message); }
bool read(std::span<const std::uint8_t> bytes, PartChange& message) {
  return read_whole(bytes, message);
}

std::optional<std::uint32_t> first_elsewhere(std::span<const Handover::Body> bodies, double time,
                                             const Division& division,
                                             std::span<const PeerNumber> owners) {
  constexpr double rounding = 1e-6;  // m: far more than a place is rounded by
  assert(std::isfinite(time));
  for (const auto& [body, state] : bodies) {
    // A puck in a goal keeps its velocity, but stays.
    const physics::Vector2 centre = physics::Subdomain::is_out_of_play(state)
                                        ? physics::Vector2(state.flight.x, state.flight.y)
                                        : state.motion().at(time).position;
    const Box place = Box::around(centre, {0.0, 0.0});
    if (std::ranges::none_of(
            owners, [&](PeerNumber owner) { return division.is_near(owner, place, rounding); }))
      return body;
  }
  return std::nullopt;
}

bool PartReplica::add(PartChange change) {
  const std::optional<std::uint64_t> step = last_   ? std::optional(last_->step)
                                            : base_ ? std::optional(base_->step)
                                                    : std::nullopt;
  if (!change.is_whole && (!step || change.step != *step + 1)) return false;
  apply();
  last_ = std::move(change);
  if constexpr (checks_whole_structures) check();
  return true;
}

void PartReplica::check() const {
  assert(!last_ || last_->is_whole || (base_ && last_->step == base_->step + 1));
  assert(!last_ || last_->is_whole || last_->time >= base_->time);
}

void PartReplica::apply() {
  if (!last_) return;
  PartChange& change = *last_;
  if (!base_ || change.is_whole) base_ = Part{};
  Part& part = *base_;
  part.step = change.step, part.time = change.time;
  for (const std::uint32_t body : change.gone) part.bodies.erase(body);
  for (const auto& [body, state] : change.bodies) part.bodies[body] = state;
  for (const FreeFlightState& free_flight : change.free_flights)
    if (const auto kept = part.bodies.find(free_flight.number); kept != part.bodies.end())
      free_flight.write_to(kept->second.flight);
  part.rest_contacts = std::move(change.rest_contacts);
  part.keys = std::move(change.keys);
  part.log.insert(part.log.end(), change.log.begin(), change.log.end());
  last_.reset();
  if constexpr (checks_whole_structures) check();
}

bool PartReplica::rewind(std::uint64_t step) {
  if (last_ && last_->step == step) return true;
  if (!base_ || base_->step != step) return false;
  last_.reset();
  if constexpr (checks_whole_structures) check();
  return true;
}

const Part& PartReplica::part() {
  apply();
  assert(base_);
  return *base_;
}

std::vector<Key> PartReplica::log() const {
  std::vector<Key> all;
  if (base_ && !(last_ && last_->is_whole)) all = base_->log;
  if (last_) all.insert(all.end(), last_->log.begin(), last_->log.end());
  return all;
}

}  // namespace rink::peer
