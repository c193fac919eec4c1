// Compares ghosts with claims, event by event.
#include "game/peer/window/claim_check.h"

#include <algorithm>
#include <cassert>
#include <string>

namespace rink::peer {

namespace {

/// The paths of one claimed body, from a little before each begins.
void add_paths(std::span<const ClaimedFlight> flights, std::size_t first, double end,
               std::vector<PathFlight>& paths) {
  for (std::size_t k = first; k < flights.size(); ++k)
    paths.push_back({flights[k].begin - time_margin,
                     k + 1 < flights.size() ? flights[k + 1].begin : end, 0, flights[k].box()});
}

bool leads_to(const ClaimedFlight& flight, const Vector2& place) {
  constexpr double rounding = 1e-6;  // m: far more than a place is rounded by
  return flight.box().grown(rounding).meets(Box::around(place, {0.0, 0.0}));
}

}  // namespace

ClaimCheck::ClaimCheck(const Share& share, const Halos& halos, const Homes& homes,
                       const ClaimTrace& trace, Accusation& accusation)
    : share_(share),
      halos_(halos),
      homes_(homes),
      trace_(trace),
      accusation_(accusation),
      claims_(halos.peer_count()) {}

void ClaimCheck::receive(PeerNumber from, Claims claims) {
  assert(from < claims_.size() && from != halos_.number());
  claims_[from] = std::move(claims);
}

std::vector<Press> ClaimCheck::take_presses(PeerNumber from) {
  assert(from < claims_.size());
  return std::exchange(claims_[from].presses, {});
}

bool ClaimCheck::are_possible(const Window& window) {
  const Roles& roles = share_.roles();
  std::vector<std::uint32_t> counts(claims_.size(), 0);
  for (const std::uint32_t body : roles.ghosts()) ++counts[roles.owner_of_ghost(body)];
  for (PeerNumber peer = 0; peer < claims_.size(); ++peer) {
    if (peer == halos_.number() || !halos_.is_present(peer)) continue;
    if (!halos_.has_neighbour(peer)) {
      if (counts[peer] > 0)
        return accusation_.report(peer, "has " + std::to_string(counts[peer]) +
                                            " bodies here, where it has no neighbour");
      continue;
    }
    if (claims_[peer].window != window.number)
      return accusation_.report(peer, "claims window " + std::to_string(claims_[peer].window) +
                                          " instead of " + std::to_string(window.number));
    if (claims_[peer].known_count != counts[peer])
      return accusation_.report(peer, "counts " + std::to_string(claims_[peer].known_count) +
                                          " of its bodies here, there are " +
                                          std::to_string(counts[peer]));
    for (const Claims::Body& body : claims_[peer].bodies) {
      const bool is_there =
          body.number < roles.body_count() && (body.is_known ? roles.has_ghost_of(peer, body.number)
                                                             : roles.of(body.number) == Role::away);
      if (!is_there)
        return accusation_.report(
            peer, "claims body " + std::to_string(body.number) + ", which it does not own");
    }
  }
  return true;
}

/// The claimed flights of each ghost, by its place; those of others, which have no run here to
/// compare with, are added to `beyond`.
std::vector<ClaimCheck::Flights> ClaimCheck::sort_claims(const Window& window,
                                                         std::vector<PathFlight>& beyond) const {
  std::vector<Flights> claimed(share_.roles().ghosts().size());
  for (const PeerNumber peer : halos_.neighbours()) {
    const Claims& claims = claims_[peer];
    std::size_t first = 0;
    for (const Claims::Body& body : claims.bodies) {
      const Flights flights = Flights(claims.flights).subspan(first, body.flight_count);
      first += body.flight_count;
      if (body.is_known) claimed[share_.roles().place_of_ghost(body.number)] = flights;
      else add_paths(flights, 0, window.end, beyond);
    }
  }
  return claimed;
}

/// The time at which the ghost's run here first differs from its owner's claim, usually never; and
/// its claimed path from then on.
double ClaimCheck::first_difference(std::uint32_t ghost, Flights flights, const Window& window,
                                    std::vector<PathFlight>& beyond) const {
  const std::span<const ClaimTrace::Step> steps = trace_.steps_of(ghost);
  std::size_t k = 0;
  while (k < steps.size() && k < flights.size() && steps[k].state == flights[k].state &&
         trace_.time_of(steps[k]) == flights[k].begin)
    ++k;
  if (k == steps.size() && k == flights.size()) return infinity;
  const double here = k < steps.size() ? trace_.time_of(steps[k]) : infinity,
               there = k < flights.size() ? flights[k].begin : infinity;
  const double parting = std::min(here, there) - time_margin,
               flight_end = std::min(there, window.end);
  const physics::Motion motion =
      k == 0 ? share_.subdomain().motion_before(ghost) : trace_.motion_after(steps[k - 1]);
  if (parting < flight_end && !share_.subdomain().was_gone(ghost))
    beyond.push_back(
        {parting, flight_end, 0,
         swept(motion, std::max(parting, window.start), flight_end, share_.extent_of(ghost))});
  add_paths(flights, k, window.end, beyond);
  return parting;
}

bool ClaimCheck::may_touch_own(const PathFlight& foreign) const {
  return homes_.are_met_by(foreign.box.grown(touch_margin).grown(share_.extent_max())) ||
         trace_.may_touch(foreign);
}

bool ClaimCheck::has_doubtful(const ClaimTrace::Event& event) const {
  const Roles& roles = share_.roles();
  for (std::size_t k = event.begin; k < event.end; ++k) {
    const physics::Change& change = share_.subdomain().journal().changes[k];
    if (roles.has_ghost(change.body) && change.time >= doubts_[roles.place_of_ghost(change.body)])
      return true;
  }
  return false;
}

bool ClaimCheck::agree(const Window& window) {
  const std::vector<std::uint32_t>& ghosts = share_.roles().ghosts();
  doubts_.assign(ghosts.size(), infinity);
  is_unmoved_.assign(ghosts.size(), true);
  std::vector<PathFlight> beyond;
  const std::vector<Flights> claimed = sort_claims(window, beyond);
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    assert(share_.roles().owner_of_ghost(ghosts[k]) != halos_.number());
    is_unmoved_[k] = claimed[k].empty();
    doubts_[k] = first_difference(ghosts[k], claimed[k], window, beyond);
  }
  weigh();
  return std::ranges::none_of(beyond, [&](const auto& flight) { return may_touch_own(flight); }) &&
         std::ranges::none_of(trace_.mixed(),
                              [&](const auto& event) { return has_doubtful(event); });
}

void ClaimCheck::blame_doubted() {
  const Roles& roles = share_.roles();
  assert(doubts_.size() == roles.ghosts().size());
  const auto doubted = std::ranges::find_if(doubts_, [](double doubt) { return doubt < infinity; });
  if (doubted == doubts_.end()) return;
  const std::uint32_t body = roles.ghosts()[static_cast<std::size_t>(doubted - doubts_.begin())];
  accusation_.report(roles.owner_of_ghost(body),
                     "claims what cannot be agreed with of body " + std::to_string(body));
}

bool ClaimCheck::is_doubtful(std::uint32_t ghost) const {
  const std::size_t place = share_.roles().place_of_ghost(ghost);
  return place < doubts_.size() && doubts_[place] < infinity;
}

/// Claims show where a body goes and who was there, but not all that it remembers of impacts. That
/// follows from its events if all who were in them are as they truly are.
void ClaimCheck::weigh() {
  is_tainted_.clear();
  if (std::ranges::none_of(doubts_, [](double doubt) { return doubt < infinity; })) return;
  is_tainted_.resize(share_.roles().body_count(), false);
  const std::vector<physics::Change>& changes = share_.subdomain().journal().changes;
  for (std::size_t begin = 0, end = 0; begin < changes.size(); begin = end) {
    bool is_tainted = false;
    for (end = begin; end < changes.size() && changes[end].event == changes[begin].event; ++end)
      is_tainted = is_tainted || is_tainted_[changes[end].body];
    if (!is_tainted && !has_doubtful({begin, end})) continue;
    for (std::size_t k = begin; k < end; ++k) is_tainted_[changes[k].body] = true;
  }
}

bool ClaimCheck::is_uncertain(std::uint32_t ghost) const {
  return is_doubtful(ghost) || (!is_tainted_.empty() && is_tainted_[ghost]);
}

/// If its owner claims no event of it, it is as it was, and known.
std::vector<std::uint32_t> ClaimCheck::wanted() const {
  std::vector<std::uint32_t> wanted;
  const std::vector<std::uint32_t>& ghosts = share_.roles().ghosts();
  for (std::size_t k = 0; k < doubts_.size(); ++k)
    if (!is_unmoved_[k] && is_uncertain(ghosts[k])) wanted.push_back(ghosts[k]);
  return wanted;
}

ClaimCheck::Flights ClaimCheck::claims_of(std::uint32_t ghost) const {
  const Claims& claims = claims_[share_.roles().owner_of_ghost(ghost)];
  std::size_t first = 0;
  for (const Claims::Body& body : claims.bodies) {
    if (body.is_known && body.number == ghost)
      return Flights(claims.flights).subspan(first, body.flight_count);
    first += body.flight_count;
  }
  return {};
}

/// An owner that claims no event of a ghost hands over nothing of it. What it hands over of others
/// is where the last claimed flight has led to.
bool ClaimCheck::contradicts(std::uint32_t ghost, const BodyState& state) const {
  const physics::Subdomain& subdomain = share_.subdomain();
  if (!is_doubtful(ghost)) {
    const bool is_certain = is_tainted_.empty() || !is_tainted_[ghost];
    return is_certain ? !are_same(subdomain.state(ghost), state)
                      : !FreeFlightState::of(ghost, state.flight).is_as(subdomain.flight(ghost));
  }
  const Flights claimed = claims_of(ghost);
  if (claimed.empty()) return !are_same(subdomain.state_before(ghost), state);
  const Vector2 place = physics::Subdomain::is_out_of_play(state)
                            ? Vector2(state.flight.x, state.flight.y)
                            : state.motion().at(share_.world().now()).position;
  return !leads_to(claimed.back(), place);
}

/// The impact that led to this flight is one of those claimed; after it the body may only have been
/// looked at, which is claimed too.
bool ClaimCheck::contradicts(const FreeFlightState& flight) const {
  const physics::Subdomain& subdomain = share_.subdomain();
  if (!is_doubtful(flight.number)) return !flight.is_as(subdomain.flight(flight.number));
  const Flights claimed = claims_of(flight.number);
  const std::uint8_t mouth = subdomain.state_before(flight.number).mouth;
  const auto is_impact = [&](const ClaimedFlight& one) {
    const auto partner = ClaimTrace::partner_in(one.state, flight, mouth);
    return partner < share_.roles().body_count() && partner != flight.number;
  };
  const physics::Motion motion{.time = flight.time,
                               .position = flight.position,
                               .velocity = flight.velocity,
                               .drag = Vector2::Constant(share_.world().spec().puck_drag)};
  return std::ranges::none_of(claimed, is_impact) ||
         !leads_to(claimed.back(), motion.at(share_.world().now()).position);
}

void ClaimCheck::correct(Share& share) {
  const std::vector<std::uint32_t>& ghosts = share.roles().ghosts();
  assert(&share == &share_ && doubts_.size() == ghosts.size());
  for (std::size_t k = 0; k < ghosts.size(); ++k)
    if (is_uncertain(ghosts[k])) share.correct(ghosts[k], is_unmoved_[k]);
  doubts_.clear(), is_tainted_.clear();
}

void ClaimCheck::make_room(PeerNumber peer_count) {
  assert(peer_count >= claims_.size());
  claims_.resize(peer_count);
}

}  // namespace rink::peer
