// Plays windows: receives, plays, concludes, and decides the owners from then on.
#include "game/peer/peer.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <tuple>
#include <utility>

#include "im/basics/checked.h"

namespace rink::peer {

namespace {

bool is_before(const Key& a, const Key& b) {
  return std::tuple(a.time, a.bat) < std::tuple(b.time, b.bat);
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
    : subdomain_(spec, body_count),
      division_(division),
      number_(number),
      halo_max_(spec.field.length + spec.field.width),
      usual_halo_(halo),
      halo_min_(0.25 * halo),
      halos_(division.peer_count(), halo),
      is_repeating_(division.peer_count(), false),
      is_present_(division.peer_count(), true),
      roles_(body_count, away),
      homes_(body_count, 0),
      end_homes_(body_count, 0),
      is_edge_(body_count, 0),
      is_watched_(body_count, 0),
      owned_places_(body_count, 0),
      owners_(body_count, 0),
      known_(division.peer_count()),
      coming_(division.peer_count()),
      presses_(division.peer_count()),
      claims_(division.peer_count()),
      verdicts_(division.peer_count()),
      handovers_(division.peer_count()) {
  assert(number < division.peer_count() && halo > 0.0 && division.zones_of(number).size() < 255);
}

void Peer::consider(std::uint32_t body, const BodyState& state) {
  assert(body < subdomain_.body_count() && !subdomain_.is_there(body));
  const Vector2 place(state.flight.x, state.flight.y);
  extent_max_ = std::max(extent_max_, state.extent().maxCoeff());
  const PeerNumber owner = division_.owner_of(place);
  if (owner != number_ && !is_in_region(number_, Box::around(place, state.extent()))) return;
  subdomain_.put(body, state);
  ghosts_.push_back(body);
}

template <class Message, class... Instants>
bool Peer::is_sound(PeerNumber from, const Message& message, Instants... instants) {
  const std::string fault = validator_ ? validator_->fault_of(message, instants...) : std::string();
  return fault.empty() || report(from, fault);
}

void Peer::receive(PeerNumber from, Claims claims) {
  assert(from < claims_.size() && from != number_);
  if (is_sound(from, claims, end_)) claims_[from] = std::move(claims);
}

void Peer::receive(PeerNumber from, const Verdict& verdict) {
  assert(from < verdicts_.size() && from != number_);
  if (is_sound(from, verdict)) verdicts_[from] = verdict;
}

void Peer::receive(PeerNumber from, Handover handover) {
  assert(from < handovers_.size() && from != number_);
  if (is_sound(from, handover, told_)) handovers_[from] = std::move(handover);
}

void Peer::begin(double until) {
  assert(until >= start_ && owned_.empty());
  if (!entered_holds_.empty()) set_rest_contacts(std::exchange(entered_holds_, {}));
  subdomain_.begin_window();
  settle(ghosts_);
  share_keys(until);
  choose_watched();
  if constexpr (checks_whole_structures) check();
}

void Peer::check() const {
  [[maybe_unused]] const std::size_t peer_count = division_.peer_count();
  assert(halos_.size() == peer_count && known_.size() == peer_count &&
         verdicts_.size() == peer_count && handovers_.size() == peer_count);
  assert(std::ranges::all_of(halos_, [](double halo) { return halo >= 0.0; }));
  for (std::size_t place = 0; place < owned_.size(); ++place) {
    assert(roles_[owned_[place]] == own && owned_places_[owned_[place]] == place);
    assert(subdomain_.is_there(owned_[place]) && homes_[owned_[place]] <= interiors_.size());
  }
  assert(std::ranges::adjacent_find(ghosts_, std::greater_equal<>()) == ghosts_.end());
  for ([[maybe_unused]] const std::uint32_t body : ghosts_)
    assert(roles_[body] == ghost && owners_[body] != number_ && subdomain_.is_there(body));
  [[maybe_unused]] const auto with_role = [this](Role role) {
    return static_cast<std::size_t>(std::ranges::count(roles_, std::uint8_t{role}));
  };
  assert(with_role(own) == owned_.size() && with_role(ghost) == ghosts_.size());
  assert(known_[number_].empty());
  for ([[maybe_unused]] const std::vector<std::uint32_t>& known : known_) {
    assert(std::ranges::adjacent_find(known, std::greater_equal<>()) == known.end());
    assert(std::ranges::all_of(known, [this](std::uint32_t body) { return roles_[body] == own; }));
  }
  assert(watched_.size() == is_watched_.size() - static_cast<std::size_t>(std::ranges::count(
                                                     is_watched_, std::uint8_t{not_watched})));
  assert(std::ranges::is_sorted(due_, is_before) && end_ >= start_);
}

Vector2 Peer::start_place(std::uint32_t body) const {
  assert(body < roles_.size());
  if (subdomain_.was_gone(body)) return subdomain_.motion_before(body).position;
  return subdomain_.motion_before(body).at(start_).position;
}

Box Peer::reach_of(std::uint32_t body) const {
  const auto place = [&](std::uint32_t b) {
    return Box::around(subdomain_.world().position({b}), extent_of(b));
  };
  Box box = place(body);
  if (subdomain_.world().is_held({body}))
    for (const std::uint32_t companion : subdomain_.group_of(body))
      box = box.with(place(companion));
  return box;
}

void Peer::play() {
  // Bodies with entries in the last window get a room again, if they have not been watched since.
  for (const std::uint32_t body : subdomain_.take_entered())
    if (roles_[body] == own && is_watched_[body] == 0) subdomain_.set_room(body, homes_[body]);
  play_keys(end_);
  survey();
}

/// Repeats the run, since a body that is no longer at home may have had impacts without entries.
void Peer::play_anew() {
  subdomain_.undo();
  play();
}

void Peer::play_keys(double until) {
  assert(std::ranges::is_sorted(due_, is_before));
  for (const Key& key : due_) {
    subdomain_.advance(std::max(key.time, subdomain_.world().now()));
    subdomain_.set_thrust(key.bat, key.thrust);
  }
  subdomain_.advance(until);
}

/// All peers decide equally, since all have received the same.
Outcome Peer::conclude() {
  bool solver_failed = false, is_final = true, are_whole = true;
  assert(verdicts_.size() == division_.peer_count() && is_present_[number_]);
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) {
    if (!is_present_[peer])
      verdicts_[peer] = {.accepts = true, .halo = static_cast<float>(halos_[peer])};
    const Verdict& verdict = verdicts_[peer];
    solver_failed = solver_failed || verdict.had_solver_failed,
    is_final = is_final && verdict.accepts;
    // Peers may differ about absent ones, which do not count.
    are_whole = are_whole && (halos_[peer] == infinity || !is_present_[peer]);
  }
  // The engine's last resorts against endless series at one instant count events in the whole
  // field.
  const bool needs_whole =
      (at_once_bound() >= physics::events_at_once_local || solver_failed) && !are_whole;
  for (PeerNumber peer = 0; peer < division_.peer_count(); ++peer) {
    is_repeating_[peer] = needs_whole || !verdicts_[peer].accepts;
    if (needs_whole) halos_[peer] = infinity;
    else if (is_final || is_repeating_[peer]) halos_[peer] = verdicts_[peer].halo;
  }
  told_ = is_final && !needs_whole ? end_ : start_;
  if (is_final && !needs_whole) return Outcome::final;
  counters_.repeats += is_repeating_[number_];
  ++attempts_;
  const bool is_fit = is_margin_fit();
  if (!is_fit) choose_margin();
  if (!is_repeating_[number_]) is_fit ? survey() : play_anew();
  return Outcome::repeat;
}

/// Sets each contact once, and only between present bodies.
void Peer::set_rest_contacts(std::vector<RestContact> rest_contacts) {
  const auto is_there = [&](physics::Partner p) {
    return p >= physics::partner::field_parts || subdomain_.is_there(p);
  };
  std::erase_if(rest_contacts, [&](const RestContact& rest) {
    return !is_there(rest.low) || !is_there(rest.high);
  });
  const auto names = [](const RestContact& rest) {
    return std::tuple(rest.low, rest.high, rest.axis);
  };
  std::stable_sort(rest_contacts.begin(), rest_contacts.end(),
                   [&](const RestContact& a, const RestContact& b) { return names(a) < names(b); });
  rest_contacts.erase(
      std::unique(rest_contacts.begin(), rest_contacts.end(),
                  [&](const RestContact& a, const RestContact& b) { return names(a) == names(b); }),
      rest_contacts.end());
  subdomain_.set_rest_contacts(std::move(rest_contacts));
}

void Peer::replay() {
  assert(is_repeating_[number_]);
  subdomain_.undo();
  std::vector<RestContact> rest_contacts = subdomain_.rest_contacts();
  for (PeerNumber from = 0; from < handovers_.size(); ++from) {
    if (from == number_) continue;
    Handover& handover = handovers_[from];
    enter_bodies(handover, from);
    for (const auto& [body, state] : handover.bodies)
      if (body < roles_.size() && roles_[body] == away)
        roles_[body] = ghost, owners_[body] = from, ghosts_.push_back(body);
    rest_contacts.insert(rest_contacts.end(), handover.rest_contacts.begin(),
                         handover.rest_contacts.end());
    due_.insert(due_.end(), handover.keys.begin(), handover.keys.end());
    handover = {};
  }
  std::sort(ghosts_.begin(), ghosts_.end());
  std::stable_sort(due_.begin(), due_.end(), is_before);
  set_rest_contacts(std::move(rest_contacts));
  subdomain_.begin_window();
  play();
}

/// Corrects doubtful ghosts: one without events has its old state; all others are sent anew, or are
/// gone.
void Peer::correct_doubtful() {
  assert(doubts_.size() == ghosts_.size() && is_unmoved_.size() == ghosts_.size());
  for (std::size_t k = 0; k < ghosts_.size(); ++k) {
    if (doubts_[k] == infinity) continue;
    if (is_unmoved_[k]) subdomain_.put(ghosts_[k], subdomain_.state_before(ghosts_[k]));
    else subdomain_.drop(ghosts_[k]);
  }
}

void Peer::commit(double until) {
  observations_ = observations_for(number_);
  note_log();
  if (keeps_changes_) note_changed();
  for (PeerNumber from = 0; from < handovers_.size(); ++from)
    complete_free_flights(handovers_[from], from);
  correct_doubtful();
  doubts_.clear();
  std::vector<RestContact> rest_contacts = subdomain_.rest_contacts();
  const auto is_own = [&](physics::Partner p) {
    return p < physics::partner::field_parts && roles_[p] == own;
  };
  std::erase_if(rest_contacts,
                [&](const RestContact& rest) { return !is_own(rest.low) && !is_own(rest.high); });
  std::vector<std::uint32_t> candidates = ghosts_;
  for (const Reach& reach : outskirts_) candidates.push_back(reach.body);
  for (PeerNumber from = 0; from < handovers_.size(); ++from) {
    if (from == number_) continue;
    enter_bodies(handovers_[from], from);
    for (const auto& [body, state] : handovers_[from].bodies)
      if (body < roles_.size()) candidates.push_back(body);
    rest_contacts.insert(rest_contacts.end(), handovers_[from].rest_contacts.begin(),
                         handovers_[from].rest_contacts.end());
    keys_.insert(keys_.end(), handovers_[from].keys.begin(), handovers_[from].keys.end());
    handle_observations(from);
  }
  for (Handover& handover : handovers_) handover = {};
  set_rest_contacts(std::move(rest_contacts));
  subdomain_.begin_window();
  ++counters_.windows;
  counters_.own_events += own_events_, counters_.ghost_events += ghost_events_;
  ++window_;
  attempts_ = 0;
  start_ = subdomain_.world().now();
  for (const std::uint32_t body : watched_)
    homes_[body] = end_homes_[body], is_watched_[body] = watched;
  settle(std::move(candidates));
  share_keys(until);
  if (!is_watch_fit()) choose_watched();
  if constexpr (checks_whole_structures) check();
}

void Peer::own_from_now(std::uint32_t body) {
  assert(roles_[body] != own && subdomain_.is_there(body));
  roles_[body] = own;
  owned_places_[body] = static_cast<std::uint32_t>(owned_.size());
  owned_.push_back(body);
  if (keeps_changes_) changed_.push_back(body);
}

void Peer::disown(std::uint32_t body) {
  roles_[body] = away;
  subdomain_.set_room(body, 0);
  ++counters_.hand_overs;
  if (keeps_changes_) left_.push_back(body);
  const std::uint32_t place = owned_places_[body], last = owned_.back();
  assert(place < owned_.size() && owned_[place] == body);
  owned_[place] = last, owned_places_[last] = place;
  owned_.pop_back();
}

/// Decides the owners from now on, the ghosts here, and the peers with ghosts of own bodies. Own
/// bodies that are no candidates are at home.
void Peer::settle(std::vector<std::uint32_t> candidates) {
  std::erase_if(candidates, [&](std::uint32_t body) { return !subdomain_.is_there(body); });
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  std::vector<Vector2> places;
  std::vector<Box> reaches;
  for (const std::uint32_t body : candidates) {
    places.push_back(subdomain_.world().position({body}));
    reaches.push_back(subdomain_.world().is_held({body})
                          ? reach_of(body)
                          : Box::around(places.back(), extent_of(body)));
  }
  for (const std::uint32_t body : ghosts_) roles_[body] = away;
  ghosts_.clear(), groups_.clear();
  for (std::vector<std::uint32_t>& known : known_) known.clear();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const std::uint32_t body = candidates[k];
    owners_[body] = division_.owner_of(places[k]);
    if (owners_[body] == number_) {
      if (roles_[body] != own) own_from_now(body);
      watch(body, watched);
      if (subdomain_.world().is_held({body})) groups_.push_back({body, reaches[k]});
      homes_[body] = 0;
      for (PeerNumber peer = 0; peer < division_.peer_count(); ++peer)
        if (peer != number_ && is_in_region(peer, reaches[k])) known_[peer].push_back(body);
      continue;
    }
    if (roles_[body] == own) disown(body);
    roles_[body] = is_in_region(number_, reaches[k]) ? ghost : away;
    if (roles_[body] == ghost) ghosts_.push_back(body);
    else subdomain_.drop(body);
  }
  std::erase_if(watched_, [&](std::uint32_t body) {
    return roles_[body] != own &&
           std::exchange(is_watched_[body], std::uint8_t{not_watched}) != not_watched;
  });
  std::vector<RestContact> rest_contacts = subdomain_.rest_contacts();
  if (!rest_contacts.empty()) set_rest_contacts(std::move(rest_contacts));
  if (!is_margin_fit()) choose_margin();
  else
    for (std::size_t k = 0; k < candidates.size(); ++k)
      if (roles_[candidates[k]] == own && !subdomain_.world().is_held({candidates[k]}))
        homes_[candidates[k]] = home_of(places[k], 0);
  counters_.held_max = std::max<std::uint64_t>(counters_.held_max, owned_.size() + ghosts_.size());
  counters_.ghost_windows += ghosts_.size();
  for (const std::vector<std::uint32_t>& known : known_) counters_.border_windows += known.size();
}

void Peer::end_at(double until) {
  assert(until >= start_);
  keys_.insert(keys_.end(), due_.begin(), due_.end());
  share_keys(until);
}

/// Sends the keys of the window that ends at `until`, and keeps later ones.
void Peer::share_keys(double until) {
  end_ = until;
  due_.clear();
  std::vector<Key> later;
  for (const Key& key : keys_) {
    if (key.bat >= roles_.size() || roles_[key.bat] == away) continue;
    if (key.time <= until) due_.push_back(key);
    else if (roles_[key.bat] == own) later.push_back(key);
  }
  std::stable_sort(due_.begin(), due_.end(), is_before);
  keys_ = std::move(later);
  assert(std::ranges::all_of(keys_, [until](const Key& key) { return !(key.time <= until); }));
}

}  // namespace rink::peer
