// Judges whether the run of a window is consistent with the others' claims: docs/peer-to-peer.md,
// "The rule".
#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <string>

#include "game/peer/peer.h"
#include "game/peer/rounding.h"

namespace rink::peer {

namespace {

/// Bodies further apart than this do not affect each other at an instant [m]: twice the widest gap
/// in the engine's clusters, and all roundings.
constexpr double touch_margin = 4e-5;
/// Events within this time of each other count as simultaneous [s]: twice the engine's instant.
constexpr double time_margin = 2e-9;
/// The factors by which halos that are too narrow grow, and all others shrink slowly.
constexpr double widening = 1.25, narrowing = 1.0 - 2e-4;
constexpr std::uint32_t attempts_max = 40;
/// By then every halo covers the whole field if needed, and honest runs of the same states agree. A
/// peer that still doubts a ghost blames its owner; one that trusts all of them waits a little
/// longer, then blames those that do not accept.
constexpr std::uint32_t attempts_before_blame = attempts_max + 64,
                        attempts_before_blaming_doubt = attempts_before_blame + 8;
/// So few peers need 8 events at one instant each before these count as endless together; listing
/// their times would cost more.
constexpr PeerNumber few_peers = 8;

}  // namespace

bool Peer::report(PeerNumber peer, const std::string& of) {
  if (accusation_.empty())
    accusation_ = "peer " + std::to_string(peer) + " " + of, reported_ = peer;
  return false;
}

/// Without blame, a false claim that is possible and was accepted would repeat the window for ever.
void Peer::blame(bool doubts_ghosts) {
  const auto doubted =
      std::find_if(doubts_.begin(), doubts_.end(), [](double doubt) { return doubt < infinity; });
  assert(!doubts_ghosts || doubts_.size() == ghosts_.size());
  if (doubts_ghosts && doubted != doubts_.end()) {
    const std::uint32_t body = ghosts_[static_cast<std::size_t>(doubted - doubts_.begin())];
    report(owners_[body], "claims what cannot be agreed with of body " + std::to_string(body));
  }
  for (PeerNumber peer = 0; peer < verdicts_.size() && attempts_ >= attempts_before_blaming_doubt;
       ++peer)
    if (peer != number_ && is_present_[peer] && !verdicts_[peer].accepts)
      report(peer, "accepts no run of window " + std::to_string(window_));
}

/// True if claims name the expected bodies.
bool Peer::validate_claims() {
  std::vector<std::uint32_t> counts(claims_.size(), 0);
  for (const std::uint32_t body : ghosts_) ++counts[owners_[body]];
  for (PeerNumber peer = 0; peer < claims_.size(); ++peer) {
    if (peer == number_ || !is_present_[peer]) continue;
    if (claims_[peer].window != window_)
      return report(peer, "claims window " + std::to_string(claims_[peer].window) + " instead of " +
                              std::to_string(window_));
    if (claims_[peer].known_count != counts[peer])
      return report(peer, "counts " + std::to_string(claims_[peer].known_count) +
                              " of its bodies here, there are " + std::to_string(counts[peer]));
    for (const Claims::Body& body : claims_[peer].bodies) {
      const bool is_there = body.number < roles_.size() &&
                            roles_[body.number] == (body.is_known ? ghost : away) &&
                            (!body.is_known || owners_[body.number] == peer);
      if (!is_there)
        return report(peer,
                      "claims body " + std::to_string(body.number) + ", which it does not own");
    }
  }
  return true;
}

Vector2 Peer::known_place(std::uint32_t body) const {
  const auto found = std::lower_bound(ghosts_.begin(), ghosts_.end(), body);
  const auto place = static_cast<std::size_t>(found - ghosts_.begin());
  const bool is_doubtful = found != ghosts_.end() && *found == body && place < doubts_.size() &&
                           doubts_[place] < infinity && !subdomain_.was_gone(body);
  return is_doubtful ? subdomain_.motion_before(body).at(start_).position
                     : subdomain_.world().position({body});
}

const Verdict& Peer::judge() {
  Verdict& verdict = verdicts_[number_];
  const double halo = halos_[number_], needed = needed_halo();
  const bool is_true = validate_claims();
  if (is_true) handle_presses();
  const bool is_trusted = is_true && validate_ghosts();
  if (attempts_ >= attempts_before_blame) blame(is_true && !is_trusted);
  const std::uint64_t at_once_max =
      std::max(subdomain_.journal().at_once_max, physics::most_at_once(subdomain_.journal().times));
  verdict = {window_,
             is_trusted && needed <= halo,
             0.0f,
             at_once_max,
             subdomain_.journal().had_solver_failed,
             own_events_,
             wishes_to_leave_,
             parts_of_events(),
             goals(),
             admission_};
  if (verdict.accepts) {
    if (halo < infinity) usual_halo_ = std::max(halo_min_, narrowing * halo);
    verdict.halo = rounded_up(usual_halo_);
  } else {
    const double wider = std::max(widening * halo, 1.05 * needed);
    if (wider > halo_max_ || attempts_ >= attempts_max)
      verdict.halo = std::numeric_limits<float>::infinity();
    else usual_halo_ = wider, verdict.halo = rounded_up(wider);
  }
  assert(verdict.halo >= 0.0f && (verdict.accepts || verdict.halo > 0.0f));
  counters_.verdict_bytes += measured(verdict);
  return verdict;
}

/// The goals in the run of this window.
std::vector<Goal> Peer::goals() const {
  const physics::World& world = subdomain_.world();
  std::vector<Goal> goals;
  if (world.spec().field.goal_width == 0.0) return goals;
  std::vector<std::uint32_t> pucks;
  for (const physics::BeforeImages::KeptState& kept : subdomain_.before().states())
    if (roles_[kept.body] == own && kept.state.kind == physics::BodyKind::puck &&
        !world.is_in_play({kept.body}) && !subdomain_.was_gone(kept.body))
      pucks.push_back(kept.body);
  std::sort(pucks.begin(), pucks.end());
  for (const std::uint32_t puck : pucks) {
    const physics::Motion last = world.motion({puck});
    goals.push_back({last.time, puck, last.position.x() < 0.5 * world.spec().field.length});
  }
  return goals;
}

std::vector<std::uint8_t> Peer::parts_of_events() const {
  assert(end_ >= start_);
  std::vector<std::uint8_t> parts;
  const std::vector<double>& times = subdomain_.journal().times;
  if (static_cast<PeerNumber>(std::count(is_present_.begin(), is_present_.end(), true)) <=
          few_peers ||
      times.size() > Verdict::listed_max)
    return parts;
  for (const double time : times)
    parts.push_back(static_cast<std::uint8_t>(
        std::clamp(256.0 * (time - start_) / (end_ - start_), 0.0, 255.0)));
  return parts;
}

/// An upper bound of the events at any one instant in the whole. An instant, which is a few
/// roundings long, may span two neighbouring parts of the window.
std::uint64_t Peer::at_once_bound() const {
  assert(verdicts_.size() == halos_.size());
  std::uint64_t sum = 0, unlisted = 0;
  for (const Verdict& verdict : verdicts_) sum += verdict.at_once_max;
  if (sum < physics::events_at_once_local) return sum;
  std::array<std::uint64_t, 256> listed{};
  for (const Verdict& verdict : verdicts_) {
    std::array<std::uint64_t, 257> own{};
    for (const std::uint8_t part : verdict.listed) ++own[part];
    if (verdict.listed.empty()) unlisted += verdict.at_once_max;
    else
      for (std::size_t part = 0; part < 256; ++part)
        listed[part] += std::min(verdict.at_once_max, own[part] + own[part + 1]);
  }
  return unlisted + *std::max_element(listed.begin(), listed.end());
}

/// The halo that contains all own paths, so that no unknown body outside the halo can touch them.
double Peer::needed_halo() const {
  double most = 0.0;
  for (const PathFlight& flight : flights_) {
    const Box box = flight.box.grown(touch_margin);
    double least = infinity;
    for (const Box& zone : division_.zones_of(number_))
      least = std::min(least, std::max({zone.low_x - box.low_x, zone.low_y - box.low_y,
                                        box.high_x - zone.high_x, box.high_y - zone.high_y}));
    most = std::max(most, least);
  }
  return most;
}

/// The time at which the ghost's run here first differs from its owner's claim, usually never; and
/// its claimed path from then on.
double Peer::first_difference(std::uint32_t ghost, std::span<const ClaimedFlight> flights,
                              std::vector<PathFlight>& beyond) const {
  const std::vector<physics::Change>& changes = subdomain_.journal().changes;
  const std::span<const Step> steps = steps_of(ghost);
  std::size_t k = 0;
  while (k < steps.size() && k < flights.size() && steps[k].state == flights[k].state &&
         changes[steps[k].change].time == flights[k].begin)
    ++k;
  if (k == steps.size() && k == flights.size()) return infinity;
  const double here = k < steps.size() ? changes[steps[k].change].time : infinity,
               there = k < flights.size() ? flights[k].begin : infinity;
  const double parting = std::min(here, there) - time_margin, flight_end = std::min(there, end_);
  const physics::Motion motion =
      k == 0 ? subdomain_.motion_before(ghost) : motion_after(steps[k - 1]);
  if (parting < flight_end && !subdomain_.was_gone(ghost))
    beyond.push_back({parting, flight_end, 0,
                      swept(motion, std::max(parting, start_), flight_end, extent_of(ghost))});
  for (; k < flights.size(); ++k)
    beyond.push_back({flights[k].begin - time_margin,
                      k + 1 < flights.size() ? flights[k + 1].begin : end_, 0, flights[k].box()});
  return parting;
}

bool Peer::may_touch_own(const PathFlight& foreign) const {
  const Box box = foreign.box.grown(touch_margin);
  const Box centres = box.grown(extent_max_);
  if (std::any_of(interiors_.begin(), interiors_.end(),
                  [&](const Box& interior) { return interior.meets(centres); }))
    return true;
  // Most doubtful ghosts are at the rim of the halo, where no own body comes.
  return hull_.meets(box) &&
         std::any_of(flights_.begin(), flights_.end(), [&](const PathFlight& flight) {
           return flight.begin - time_margin <= foreign.end &&
                  foreign.begin <= flight.end + time_margin && flight.box.meets(box);
         });
}

/// Checks parts (a) and (b) of the rule.
bool Peer::validate_ghosts() {
  doubts_.assign(ghosts_.size(), infinity);
  is_unmoved_.assign(ghosts_.size(), true);
  std::vector<PathFlight> beyond;
  std::vector<std::span<const ClaimedFlight>> claimed_of(ghosts_.size());
  const auto place_of = [&](std::uint32_t body) {
    return static_cast<std::size_t>(std::lower_bound(ghosts_.begin(), ghosts_.end(), body) -
                                    ghosts_.begin());
  };
  for (const Claims& claims : claims_) {
    std::size_t first = 0;
    for (const Claims::Body& body : claims.bodies) {
      const std::span<const ClaimedFlight> flights =
          std::span(claims.flights).subspan(first, body.flight_count);
      first += body.flight_count;
      if (body.is_known) {
        claimed_of[place_of(body.number)] = flights;
        continue;
      }
      for (std::size_t k = 0; k < flights.size(); ++k)
        beyond.push_back({flights[k].begin - time_margin,
                          k + 1 < flights.size() ? flights[k + 1].begin : end_, 0,
                          flights[k].box()});
    }
  }
  for (std::size_t k = 0; k < ghosts_.size(); ++k) {
    assert(roles_[ghosts_[k]] == ghost && owners_[ghosts_[k]] != number_);
    is_unmoved_[k] = claimed_of[k].empty();
    doubts_[k] = first_difference(ghosts_[k], claimed_of[k], beyond);
  }
  if (std::any_of(beyond.begin(), beyond.end(),
                  [&](const PathFlight& flight) { return may_touch_own(flight); }))
    return false;
  return std::none_of(mixed_.begin(), mixed_.end(), [&](const Events& event) {
    for (std::size_t k = event.begin; k < event.end; ++k) {
      const physics::Change& change = subdomain_.journal().changes[k];
      if (roles_[change.body] == ghost && change.time >= doubts_[place_of(change.body)])
        return true;
    }
    return false;
  });
}

}  // namespace rink::peer
