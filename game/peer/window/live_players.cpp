// Makes observations of bats, and stamps the keys that answer them.
#include "game/peer/window/live_players.h"
#include "im/basics/sorted_set.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace rink::peer {

bool Seat::is_due(double begin, double end) const {
  assert(period >= 0.0 && begin <= end);
  if (period == 0.0) return true;
  const auto count = [this](double time) { return std::floor((time - phase) / period); };
  return end >= phase && (begin < phase || count(end) > count(begin));
}

LivePlayers::LivePlayers(const Share& share, const Halos& halos, Accusation& accusation)
    : share_(share), halos_(halos), accusation_(accusation), presses_(halos.peer_count()) {}

void LivePlayers::seat(const Seat& seat) {
  assert(seat.bat < share_.roles().body_count() && seat.period >= 0.0);
  seats_.push_back(seat);
}

void LivePlayers::move_seat(const Seat& seat) {
  std::erase_if(seats_, [&](const Seat& earlier) { return earlier.bat == seat.bat; });
  this->seat(seat);
}

void LivePlayers::press(PeerNumber owner, const Press& press) {
  assert(owner < presses_.size() && press.input != 0);
  presses_[owner].push_back(press);
}

std::vector<Press> LivePlayers::take_presses(PeerNumber owner) {
  assert(owner < presses_.size());
  return std::exchange(presses_[owner], {});
}

std::vector<Press> LivePlayers::take_strange_presses() {
  std::vector<Press> taken;
  for (PeerNumber owner = 0; owner < presses_.size(); ++owner) {
    if (presses_[owner].empty() || owner == halos_.number() || halos_.has_neighbour(owner))
      continue;
    taken.insert(taken.end(), presses_[owner].begin(), presses_[owner].end());
    presses_[owner].clear();
  }
  return taken;
}

bool LivePlayers::plays(PeerNumber peer, std::uint32_t bat) const {
  return std::ranges::any_of(
      seats_, [&](const Seat& seat) { return seat.bat == bat && seat.peer == peer; });
}

/// All peers stamp alike: with the first instant that can still reach the peers that have the bat
/// as a ghost, or the player's own.
void LivePlayers::stamp(PeerNumber from, std::span<const Press> presses, double end,
                        TimedKeys& keys) {
  for (const Press& press : presses) {
    if (!plays(from, press.bat))
      accusation_.report(
          from, "presses a key of bat " + std::to_string(press.bat) + ", which it does not play");
    // Its player went where an observation said, which may have been false: no proof of a lie.
    else if (share_.owns(press.bat))
      keys.add(
          {std::clamp(press.time, end, end + ahead_max), press.bat, press.thrust, press.input});
  }
}

bool LivePlayers::is_unseen(std::uint32_t bat) const {
  for (PeerNumber peer = 0; peer < halos_.peer_count(); ++peer)
    if (peer != halos_.number() && std::ranges::count(share_.known(peer), bat) > 0) return false;
  return share_.owns(bat);
}

void LivePlayers::stamp_unseen(double start, TimedKeys& keys) {
  std::vector<Key> stamped;
  std::erase_if(early_, [&](const Early& each) {
    const Press& press = each.press;
    if (press.time > start || !plays(each.from, press.bat) || !is_unseen(press.bat)) return false;
    stamped.push_back({start, press.bat, press.thrust, press.input});
    return true;
  });
  if (!stamped.empty()) keys.repeat_with(stamped);
}

void LivePlayers::stamp_early(double end, TimedKeys& keys) {
  std::erase_if(early_, [&](Early& each) {
    if (!plays(each.from, each.press.bat)) return true;
    if (!share_.owns(each.press.bat) && !std::exchange(each.is_late, true)) return false;
    stamp(each.from, {&each.press, 1}, end, keys);
    return true;
  });
}

Observation LivePlayers::observation_of(const Seat& seat) const {
  const physics::PartWorld& world = share_.world();
  Observation observation{.bat = seat.bat,
                          .owner = 0,
                          .time = world.now(),
                          .position = world.position({seat.bat}),
                          .velocity = world.velocity({seat.bat}),
                          .pucks = {}};
  assert(share_.owns(seat.bat) && world.kind({seat.bat}) == physics::BodyKind::bat);
  observation.owner = halos_.owner_of(observation.position);
  std::vector<std::pair<double, std::uint32_t>> nearest;
  if (seat.puck_count > 0)
    for (const std::vector<std::uint32_t>* bodies :
         {&share_.roles().owned(), &share_.roles().ghosts()})
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

std::vector<Observation> LivePlayers::due_for(PeerNumber player, const Window& window) const {
  std::vector<Observation> observations;
  for (const Seat& seat : seats_)
    if (seat.peer == player && share_.owns(seat.bat) && seat.is_due(window.start, window.end))
      observations.push_back(observation_of(seat));
  return observations;
}

std::vector<PeerNumber> LivePlayers::strangers_due(const Window& window) const {
  std::vector<PeerNumber> peers;
  for (const Seat& seat : seats_)
    if (seat.peer != halos_.number() && !halos_.has_neighbour(seat.peer) &&
        halos_.is_present(seat.peer) && share_.owns(seat.bat) &&
        seat.is_due(window.start, window.end))
      peers.push_back(seat.peer);
  make_sorted_set(peers);
  return peers;
}

std::vector<Observation> LivePlayers::all_for(PeerNumber player) const {
  std::vector<Observation> observations;
  for (const Seat& seat : seats_)
    if (seat.peer == player && share_.owns(seat.bat)) observations.push_back(observation_of(seat));
  return observations;
}

void LivePlayers::receive(PeerNumber from, std::vector<Observation> observations) {
  for (Observation& observation : observations) {
    if (observation.owner >= halos_.peer_count() || !plays(halos_.number(), observation.bat))
      accusation_.report(
          from, "shows bat " + std::to_string(observation.bat) + ", which has no player here");
    else observations_.push_back(std::move(observation));
  }
}

void LivePlayers::make_room(PeerNumber peer_count) {
  assert(peer_count >= presses_.size());
  presses_.resize(peer_count);
}

}  // namespace rink::peer
