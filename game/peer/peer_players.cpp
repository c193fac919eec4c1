// Live players: observations of bats that others own, and keys on their way to the owners.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/peer/peer.h"

namespace rink::peer {

bool Seat::is_due(double begin, double end) const {
  assert(period >= 0.0 && begin <= end);
  if (period == 0.0) return true;
  const auto count = [this](double time) { return std::floor((time - phase) / period); };
  return end >= phase && (begin < phase || count(end) > count(begin));
}

Observation Peer::observation_of(const Seat& seat) const {
  const physics::World& world = subdomain_.world();
  Observation observation{.bat = seat.bat,
                          .owner = 0,
                          .time = world.now(),
                          .position = world.position({seat.bat}),
                          .velocity = world.velocity({seat.bat}),
                          .pucks = {}};
  assert(roles_[seat.bat] == own && world.kind({seat.bat}) == physics::BodyKind::bat);
  observation.owner = division_.owner_of(observation.position);
  std::vector<std::pair<double, std::uint32_t>> nearest;
  if (seat.puck_count > 0)
    for (const std::vector<std::uint32_t>* bodies : {&owned_, &ghosts_})
      for (const std::uint32_t body : *bodies)
        if (world.kind({body}) == physics::BodyKind::puck && world.is_in_play({body}))
          nearest.emplace_back((world.position({body}) - observation.position).squaredNorm(), body);
  const std::size_t count = std::min<std::size_t>(seat.puck_count, nearest.size());
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count),
                    nearest.end());
  nearest.resize(count);
  for (const auto& [square, body] : nearest)
    observation.pucks.push_back(
        {body, world.position({body}), world.velocity({body}), world.radius({body})});
  return observation;
}

/// The observations of own bats whose players are due, at a window's end.
std::vector<Observation> Peer::observations_for(PeerNumber peer) const {
  std::vector<Observation> observations;
  for (const Seat& seat : seats_)
    if (seat.peer == peer && roles_[seat.bat] == own && seat.is_due(start_, end_))
      observations.push_back(observation_of(seat));
  return observations;
}

std::vector<Observation> Peer::observations_of_all(PeerNumber player) const {
  std::vector<Observation> observations;
  for (const Seat& seat : seats_)
    if (seat.peer == player && roles_[seat.bat] == own)
      observations.push_back(observation_of(seat));
  return observations;
}

void Peer::handle_observations(PeerNumber from) {
  for (Observation& observation : handovers_[from].observations) {
    const auto is_it = [&](const Seat& seat) {
      return seat.bat == observation.bat && seat.peer == number_;
    };
    if (observation.owner >= claims_.size() || std::none_of(seats_.begin(), seats_.end(), is_it))
      report(from, "shows bat " + std::to_string(observation.bat) + ", which has no player here");
    else observations_.push_back(std::move(observation));
  }
}

/// All peers stamp alike: with the first instant that can still reach the peers that have the bat
/// as a ghost, or the player's own.
void Peer::handle_presses() {
  claims_[number_].presses = std::exchange(presses_[number_], {});
  for (PeerNumber from = 0; from < claims_.size(); ++from) {
    for (const Press& press : claims_[from].presses) {
      const auto is_it = [&](const Seat& seat) {
        return seat.bat == press.bat && seat.peer == from;
      };
      if (std::none_of(seats_.begin(), seats_.end(), is_it))
        report(from,
               "presses a key of bat " + std::to_string(press.bat) + ", which it does not play");
      else if (roles_[press.bat] != own)
        report(from,
               "presses a key of bat " + std::to_string(press.bat) + " here, where it is not");
      else
        keys_.push_back(
            {std::clamp(press.time, end_, end_ + ahead_max), press.bat, press.thrust, press.input});
    }
    claims_[from].presses.clear();
  }
}

void Peer::note_log() {
  log_.clear();
  for (const Key& key : due_)
    if (key.input != 0 && roles_[key.bat] == own) log_.push_back(key);
}

}  // namespace rink::peer
