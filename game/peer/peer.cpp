// Plays windows: receives, plays, concludes, and decides the owners from then on.
#include "game/peer/peer.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "im/basics/checked.h"

namespace rink::peer {

namespace {

template <class Message, class... Instants>
std::string fault_in(const std::optional<Validator>& validator, const Message& message,
                     Instants... instants) {
  return validator ? validator->fault_of(message, instants...) : std::string();
}

}  // namespace

PeerCounters& PeerCounters::operator+=(const PeerCounters& other) {
  windows += other.windows, repeats += other.repeats, own_events += other.own_events,
      ghost_events += other.ghost_events, hand_overs += other.hand_overs;
  held_max = std::max(held_max, other.held_max);
  ghost_windows += other.ghost_windows, border_windows += other.border_windows;
  arrival_bytes += other.arrival_bytes, claim_bytes += other.claim_bytes,
      verdict_bytes += other.verdict_bytes;
  return *this;
}

Peer::Peer(const physics::WorldSpec& spec, const Division& division, PeerNumber number,
           std::uint32_t body_count, double halo)
    : halos_(division, number, halo),
      share_(spec, body_count, division.peer_count()),
      homes_(share_, halos_),
      trace_(share_, homes_),
      check_(share_, halos_, homes_, trace_, accusation_),
      annexes_(share_, halos_, check_),
      verdicts_(halos_, spec.field.length + spec.field.width),
      players_(share_, halos_, accusation_),
      handovers_(share_, halos_, keys_, accusation_),
      part_log_(share_, keys_) {}

void Peer::consider(std::uint32_t body, const BodyState& state) {
  assert(body < share_.roles().body_count() && !share_.subdomain().is_there(body));
  const Vector2 place(state.flight.x, state.flight.y);
  share_.note_extent(state);
  if (halos_.owner_of(place) != number() &&
      !halos_.is_near(number(), Box::around(place, state.extent())))
    return;
  share_.put(body, state);
  entered_.bodies.push_back(body);
}

/// `begin` decides the owners.
void Peer::enter(std::uint32_t window, double start, std::span<const Handover> parts) {
  assert(owned().empty() && entered_.bodies.empty() && start >= now());
  window_.number = window, window_.start = start;
  share_.play({}, start);
  for (const Handover& part : parts) {
    for (const auto& [body, state] : part.bodies) {
      if (body >= share_.roles().body_count() || share_.subdomain().is_there(body)) continue;
      share_.put(body, state);
      entered_.bodies.push_back(body);
    }
    entered_.rest_contacts.insert(entered_.rest_contacts.end(), part.rest_contacts.begin(),
                                  part.rest_contacts.end());
    keys_.add(part.keys);
  }
}

void Peer::begin(double until) {
  assert(until >= window_.start && owned().empty());
  if (!entered_.rest_contacts.empty()) share_.set_rest_contacts(std::move(entered_.rest_contacts));
  share_.begin_window();
  settle(std::move(entered_.bodies));
  entered_ = {};
  end_at(until);
  homes_.choose_watched(window_);
  if constexpr (checks_whole_structures) check();
}

void Peer::receive(PeerNumber from, Claims claims) {
  const std::string fault = fault_in(validator_, claims, window_.end);
  if (fault.empty()) check_.receive(from, std::move(claims));
  else accusation_.report(from, fault);
}

void Peer::receive(PeerNumber from, std::span<const Press> presses) {
  for (const Press& press : presses)
    if (const std::string fault = fault_in(validator_, press); fault.empty())
      players_.receive_early(from, press);
    else accusation_.report(from, fault);
  const bool is_prepared = now() == window_.start;  // and not played yet
  if (is_prepared) players_.stamp_unseen(window_.start, keys_);
}

std::string Peer::fault_of(const Verdict& verdict) const {
  if (verdict.window != window_.number)
    return "judges window " + std::to_string(verdict.window) + " instead of " +
           std::to_string(window_.number);
  if (const std::size_t due = verdicts_.asked().size(); verdict.reports.size() != due)
    return "reports on " + std::to_string(verdict.reports.size()) + " instants instead of " +
           std::to_string(due);
  return fault_in(validator_, verdict);
}

void Peer::receive(PeerNumber from, const Verdict& verdict) {
  const std::string fault = fault_of(verdict);
  if (fault.empty()) verdicts_.receive(from, verdict);
  else accusation_.report(from, fault);
}

void Peer::receive(PeerNumber from, Handover handover) {
  // Who does not repeat the window is sent an empty one.
  const bool is_expected = told_ > window_.start || verdicts_.repeats(number());
  if (const std::uint32_t due = is_expected ? window_.number : 0; handover.window != due)
    accusation_.report(from, "hands over for window " + std::to_string(handover.window) +
                                 " instead of " + std::to_string(due));
  const std::string fault = fault_in(validator_, handover, told_);
  if (fault.empty()) handovers_.receive(from, std::move(handover));
  else accusation_.report(from, fault);
}

/// Checks all own bodies anew.
void Peer::divide(const Division& division) {
  halos_.divide(division, verdicts_.usual_halo());
  const PeerNumber peer_count = division.peer_count();
  share_.make_room(peer_count), check_.make_room(peer_count), verdicts_.make_room(peer_count);
  players_.make_room(peer_count), handovers_.make_room(peer_count);
  homes_.reopen();
}

void Peer::play() {
  homes_.restore_rooms();
  share_.play(keys_.due(), window_.end);
  homes_.find_edge(), trace_.follow(window_);
}

Claims Peer::claims_for(PeerNumber peer) {
  Claims message = trace_.claims_for(peer, window_, halos_);
  message.presses = players_.take_presses(peer);
  counters_.claim_bytes += measured(message);
  return message;
}

const Verdict& Peer::judge() {
  const bool is_possible = check_.are_possible(window_);
  players_.stamp_early(window_.end, keys_);
  if (is_possible) {
    players_.stamp(number(), players_.take_presses(number()), window_.end, keys_);
    for (const PeerNumber from : halos_.neighbours())
      players_.stamp(from, check_.take_presses(from), window_.end, keys_);
  }
  const bool agrees = is_possible && check_.agree(window_);
  if (verdicts_.is_stuck()) {
    if (is_possible && !agrees) check_.blame_doubted();
    verdicts_.blame_refusing(window_, accusation_);
  }
  Verdict own = verdict_on_run(share_, halos_, window_);
  own.reports = reports_on(share_, verdicts_.asked());
  own.events = trace_.own_events();
  own.leaves = leaves_;
  own.admission = admission_;
  if (halos_.are_kept_to_neighbours()) own.reach = trace_.reach_for_strangers(halos_);
  own.watchers = players_.strangers_due(window_);
  own.presses = players_.take_strange_presses();
  const double needed = trace_.needed_halo(halos_.own_zones());
  const bool accepts = agrees && needed <= halos_.own();
  if (accepts) own.wanted = check_.wanted();
  const bool shows_cause = annexes_.announce(accepts, window_, verdicts_, own);
  counters_.verdict_bytes += measured(own);  // what is decided now has a fixed length
  return verdicts_.decide(std::move(own), agrees, needed, shows_cause);
}

/// All peers decide equally, since all have received the same. A body that is no longer at home may
/// have had impacts without entries, so its run is repeated.
Outcome Peer::conclude() {
  const Outcome outcome = verdicts_.conclude();
  halos_.end_run(verdicts_.reach());
  players_.stamp_early(window_.end, keys_);
  for (PeerNumber from = 0; from < halos_.peer_count(); ++from) {
    players_.stamp(from, verdicts_.of(from).presses, window_.end, keys_);
    share_.expect(from, {});
    handovers_.note_wanted(from, verdicts_.of(from).wanted);
  }
  told_ = outcome == Outcome::final ? window_.end : window_.start;
  const bool is_safe = homes_.are_safe();
  if (outcome == Outcome::final && !is_safe) homes_.reopen();
  if (outcome == Outcome::final || !verdicts_.asked().empty()) return outcome;
  const bool repeats = verdicts_.repeats(number());
  counters_.repeats += repeats;
  if (!is_safe) homes_.choose(window_);
  if (!repeats && is_safe) homes_.find_edge(), trace_.follow(window_);
  if (!repeats && !is_safe) share_.undo(), play();
  return outcome;
}

Handover Peer::handover_for(PeerNumber peer) {
  Handover message = handovers_.for_repeat(peer, window_);
  counters_.arrival_bytes += measured(message);
  return message;
}

Handover Peer::handover_for(PeerNumber peer, double until) {
  Handover message = handovers_.for_next(peer, window_, until, homes_, trace_);
  message.observations = players_.due_for(peer, window_);
  counters_.arrival_bytes += measured(message);
  return message;
}

void Peer::replay() {
  assert(verdicts_.repeats(number()));
  share_.undo();
  std::vector<RestContact> rest_contacts = share_.subdomain().rest_contacts();
  for (PeerNumber from = 0; from < halos_.peer_count(); ++from) {
    Handover handover = handovers_.enter(from);
    // By number, as ghosts are listed: each comes to the end of the list.
    std::ranges::sort(handover.bodies, {}, &Handover::Body::number);
    for (const auto& [body, state] : handover.bodies)
      if (share_.roles().of(body) == Role::away) share_.add_ghost(body, from);
    rest_contacts.insert(rest_contacts.end(), handover.rest_contacts.begin(),
                         handover.rest_contacts.end());
    keys_.repeat_with(handover.keys);
  }
  share_.set_rest_contacts(std::move(rest_contacts));
  share_.begin_window();
  part_log_.note_repeat();
  play();
}

void Peer::commit(double until) {
  players_.observe(window_);
  keys_.note_log(share_.roles());
  changes_.note_window(share_);
  part_log_.note_window(trace_.own_events() + trace_.ghost_events());
  handovers_.complete(check_);
  check_.correct(share_);
  std::vector<RestContact> rest_contacts = share_.own_rest_contacts();
  std::vector<std::uint32_t> candidates = ghosts();
  for (const Reach& reach : homes_.outskirts()) candidates.push_back(reach.body);
  for (PeerNumber from = 0; from < halos_.peer_count(); ++from) {
    Handover handover = handovers_.enter(from);
    for (const auto& [body, state] : handover.bodies) candidates.push_back(body);
    rest_contacts.insert(rest_contacts.end(), handover.rest_contacts.begin(),
                         handover.rest_contacts.end());
    keys_.add(handover.keys);
    players_.receive(from, std::move(handover.observations));
  }
  share_.set_rest_contacts(std::move(rest_contacts));
  share_.begin_window();
  ++counters_.windows;
  counters_.own_events += trace_.own_events(), counters_.ghost_events += trace_.ghost_events();
  ++window_.number, window_.start = now();
  halos_.begin_window();
  verdicts_.begin_window();
  homes_.begin_window();
  settle(std::move(candidates));
  window_.end = until;
  keys_.begin_window(until, share_.roles());
  players_.stamp_unseen(window_.start, keys_);
  if (!homes_.is_watch_fit(window_)) homes_.choose_watched(window_);
  if constexpr (checks_whole_structures) check();
}

void Peer::settle(std::vector<std::uint32_t> candidates) {
  const Settlement settled = share_.settle(std::move(candidates), halos_);
  changes_.note(settled);
  homes_.settle(settled, window_);
  counters_.hand_overs += settled.left.size();
  counters_.held_max =
      std::max<std::uint64_t>(counters_.held_max, owned().size() + ghosts().size());
  counters_.ghost_windows += ghosts().size();
  for (PeerNumber peer = 0; peer < halos_.peer_count(); ++peer)
    counters_.border_windows += share_.known(peer).size();
}

void Peer::end_at(double until) {
  assert(until >= window_.start);
  window_.end = until;
  keys_.end_at(until, share_.roles());
}

void Peer::put_back(const Handover::Body& scored, const Vector2& place) {
  halos_.make_way(scored.state.extent().maxCoeff());
  const Settlement settled = share_.put_back(scored, place, halos_);
  changes_.note(settled);
  homes_.settle(settled, window_);
  counters_.hand_overs += settled.left.size();
  share_.begin_window();
  if constexpr (checks_whole_structures) check();
}

Vector2 Peer::known_place(std::uint32_t body) const {
  return share_.roles().has_ghost(body) && check_.is_doubtful(body) &&
                 !share_.subdomain().was_gone(body)
             ? share_.subdomain().motion_before(body).at(window_.start).position
             : world().position({body});
}

void Peer::check() const {
  share_.check(number());
  homes_.check();
  keys_.check();
  assert(window_.end >= window_.start);
}

}  // namespace rink::peer
