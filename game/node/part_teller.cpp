// Decides which own bodies each other node receives.
#include "game/node/part_teller.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace rink::game {

PartTeller::PartTeller(const physics::Field& field, std::uint32_t body_count,
                       peer::PeerNumber node_count, peer::PeerNumber own)
    : field_(field),
      number_(own),
      listeners_(node_count, Listener{.cells = Cells::all_of(field),
                                      .coming = {},
                                      .always = {},
                                      .is_told = std::vector<bool>(body_count),
                                      .is_anew = false}),
      was_own_(body_count) {
  assert(own < node_count);
}

void PartTeller::seat(peer::PeerNumber to, std::uint32_t bat) {
  assert(to < listeners_.size() && bat < was_own_.size());
  std::vector<std::uint32_t>& always = listeners_[to].always;
  if (std::ranges::binary_search(always, bat)) return;
  always.insert(std::ranges::upper_bound(always, bat), bat);
}

/// A node says it before it plays the window, so this one is at most a window behind it.
bool PartTeller::follow(peer::PeerNumber from, const WantedCells& wanted) {
  if (from >= listeners_.size() || from == number_) return false;
  std::optional<Cells> cells = Cells::of_runs(field_, wanted.side, wanted.runs);
  if (!cells || wanted.step <= step_ || wanted.step > step_ + 2) return false;
  Listener& listener = listeners_[from];
  if (listener.coming) {
    if (wanted.step <= listener.coming->first) return false;
    listener.cells = std::move(listener.coming->second);
  }
  listener.coming.emplace(wanted.step, *std::move(cells));
  return true;
}

void PartTeller::begin(const peer::Peer& peer) {
  assert(step_ == 0 && own_.empty());
  take_own(peer, {});
  for (Listener& listener : listeners_)
    for (const Own& own : own_) listener.is_told[own.body] = true;
}

void PartTeller::begin_again(const peer::Peer& peer, std::uint64_t window) {
  step_ = window, is_last_ = false;
  own_.clear(), was_own_.assign(was_own_.size(), false);
  for (Listener& listener : listeners_) {
    listener.cells = Cells::all_of(field_);
    listener.coming.reset();
    listener.is_told.assign(listener.is_told.size(), false);
    listener.is_anew = true;
  }
  take_own(peer, {});
}

void PartTeller::look(const peer::Peer& peer, const peer::PartChange& change, bool is_last) {
  assert(change.step == step_ + 1 && !is_last_);
  step_ = change.step, is_last_ = is_last;
  whole_.clear();
  for (Listener& listener : listeners_)
    if (listener.coming && listener.coming->first <= step_) {
      listener.cells = std::move(listener.coming->second);
      listener.coming.reset();
    }
  forget_left(peer);
  take_own(peer, change);
}

void PartTeller::forget_left(const peer::Peer& peer) {
  for (const Own& own : own_) {
    if (peer.share().owns(own.body)) continue;
    was_own_[own.body] = false;
    for (Listener& listener : listeners_) listener.is_told[own.body] = false;
  }
}

void PartTeller::take_own(const peer::Peer& peer, const peer::PartChange& change) {
  const physics::PartWorld& world = peer.world();
  std::vector<Own::Change> changes(was_own_.size(), Own::Change::none);
  for (const peer::Handover::Body& body : change.bodies) changes[body.number] = Own::Change::whole;
  for (const peer::FreeFlightState& flight : change.free_flights)
    changes[flight.number] = Own::Change::free_flight;
  own_.clear();
  for (const std::uint32_t body : peer.owned()) {
    if (world.kind({body}) == physics::BodyKind::post) continue;
    own_.push_back({body, !was_own_[body], changes[body], world.position({body})});
    was_own_[body] = true;
  }
}

bool PartTeller::is_wanted(const Listener& to, const Own& own) const {
  return is_last_ || to.cells.contains(own.position) ||
         std::ranges::binary_search(to.always, own.body);
}

std::span<const std::uint8_t> PartTeller::bytes_for(peer::PeerNumber to, const peer::Peer& peer,
                                                    const peer::PartChange& change) {
  assert(to < listeners_.size() && to != number_ && change.step == step_);
  Listener& listener = listeners_[to];
  const bool wants_whole = std::ranges::all_of(own_, [&](const Own& own) {
    return is_wanted(listener, own) && (own.has_come || listener.is_told[own.body]);
  });
  if (wants_whole) {
    for (const Own& own : own_) listener.is_told[own.body] = true;
    if (whole_.empty()) whole_ = written(change);  // one buffer for all who want it
    count(change);
  } else {
    bytes_ = written(part_for(listener, peer, change));
  }
  listener.is_anew = false;
  const std::vector<std::uint8_t>& bytes = wants_whole ? whole_ : bytes_;
  (is_last_ ? counters_.last_bytes : counters_.bytes) += bytes.size();
  return bytes;
}

peer::PartChange PartTeller::part_for(Listener& to, const peer::Peer& peer,
                                      const peer::PartChange& change) {
  using Change = Own::Change;
  peer::PartChange part{.step = change.step,
                        .time = change.time,
                        .is_whole = false,
                        .bodies = {},
                        .gone = {},
                        .rest_contacts = {},
                        .keys = {},
                        .log = change.log};
  const peer::Share& share = peer.share();
  for (const Own& own : own_) {
    const bool was_told = to.is_told[own.body], is_told = is_wanted(to, own);
    to.is_told[own.body] = is_told;
    if (!is_told && (was_told || own.has_come || to.is_anew)) part.gone.push_back(own.body);
    if (is_told && (!was_told || own.change == Change::whole))
      part.bodies.push_back({own.body, share.state(own.body)});
    else if (is_told && own.change == Change::free_flight)
      part.free_flights.push_back(
          peer::FreeFlightState::of(own.body, share.subdomain().flight(own.body)));
  }
  std::ranges::sort(part.bodies, {}, &peer::Handover::Body::number);
  const auto is_there = [&](physics::Partner each) {
    return std::ranges::binary_search(part.bodies, each, {}, &peer::Handover::Body::number);
  };
  std::ranges::copy_if(
      change.rest_contacts, std::back_inserter(part.rest_contacts),
      [&](const peer::RestContact& each) { return is_there(each.low) || is_there(each.high); });
  count(part);
  return part;
}

void PartTeller::count(const peer::PartChange& told) {
  const std::uint64_t bodies = told.bodies.size() + told.free_flights.size();
  counters_.goodbyes += told.gone.size();
  if (!is_last_) ++counters_.windows, counters_.bodies += bodies;
  else counters_.last_bodies += bodies;
}

}  // namespace rink::game
