// Runs the protocol of peer.h, peer after peer.
#include "game/peer/assembly.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace rink::peer {

namespace {

template <class Message>
Message passed_on(const std::vector<std::uint8_t>& bytes) {
  Message received;
  if (!read(bytes, received)) throw std::logic_error("a message that cannot be read back");
  return received;
}

}  // namespace

Assembly::Assembly(const physics::World& whole, const Division& division, double halo,
                   double window, bool keeps_to_neighbours)
    : owners_(whole.body_count()), window_(window) {
  assert(whole.now() == 0.0 && window > 0.0);
  for (PeerNumber number = 0; number < division.peer_count(); ++number) {
    Peer& peer = peers_.emplace_back(whole.spec(), division, number, whole.body_count(), halo);
    peer.validate_by(Validator(whole));
    if (keeps_to_neighbours) peer.keep_to_neighbours(false);
    for (std::uint32_t body = 0; body < whole.body_count(); ++body)
      peer.consider(body, physics::Subdomain::state_in(whole, body));
  }
}

void Assembly::press(const Key& key) {
  assert(!has_begun_ && key.bat < owners_.size());
  for (Peer& peer : peers_) peer.press_first(key);
}

/// Sends what `make(from, to)` makes, from each peer to its addressees, as bytes. Each must expect
/// exactly what it receives.
template <class Make>
void Assembly::exchange(Addressees (*addressees_of)(const Peer&), Make&& make) {
  std::vector<Addressees> all;
  for (const Peer& peer : peers_) all.push_back(addressees_of(peer));
  std::size_t expected = 0;
  for (const Addressees& addressees : all) expected += addressees.from.size();
  for (Peer& from : peers_)
    for (const PeerNumber to : all[from.number()].to) {
      if (!std::ranges::binary_search(all[to].from, from.number()))
        throw std::logic_error("a message that nobody expects");
      const std::vector<std::uint8_t> bytes = written(make(from, to));
      ++sent_.messages, sent_.bytes += bytes.size(), --expected;
      peers_[to].receive(from.number(), passed_on<decltype(make(from, to))>(bytes));
    }
  if (expected > 0) throw std::logic_error("a message that nobody sends");
}

void Assembly::exchange_verdicts() {
  for (const Peer& from : peers_) {
    const std::vector<std::uint8_t> bytes = written(from.verdicts().own());
    for (Peer& to : peers_)
      if (to.number() != from.number()) to.receive(from.number(), passed_on<Verdict>(bytes));
  }
}

void Assembly::advance() {
  if (!has_begun_)
    for (Peer& peer : peers_) peer.begin(window_);
  has_begun_ = true;
  for (Peer& peer : peers_) peer.play();
  for (;;) {
    exchange(claim_addressees, [](Peer& from, PeerNumber to) { return from.claims_for(to); });
    for (Peer& peer : peers_) peer.judge();
    if (!accusation().empty()) throw std::logic_error(accusation());
    exchange_verdicts();
    Outcome outcome = Outcome::final;
    for (Peer& peer : peers_) outcome = peer.conclude();
    if (outcome == Outcome::final) break;
    exchange(repeat_addressees, [](Peer& from, PeerNumber to) { return from.handover_for(to); });
    for (Peer& peer : peers_)
      if (peer.verdicts().repeats(peer.number())) peer.replay();
  }
  ++count_;
  if (next_division_)
    for (Peer& peer : peers_) peer.divide(*next_division_);
  next_division_.reset();
  const double next = window_ * static_cast<double>(count_ + 1);
  exchange(handover_addressees,
           [&](Peer& from, PeerNumber to) { return from.handover_for(to, next); });
  for (Peer& peer : peers_) peer.commit(next);
  assert(std::ranges::all_of(peers_, [this](const Peer& peer) { return peer.now() == now(); }));
  note_owners();
}

void Assembly::note_owners() {
  std::vector<std::uint8_t> counts(owners_.size(), 0);
  for (const Peer& peer : peers_)
    for (const std::uint32_t body : peer.owned()) owners_[body] = peer.number(), ++counts[body];
  misowned_ = static_cast<std::uint32_t>(
      std::count_if(counts.begin(), counts.end(), [](std::uint8_t count) { return count != 1; }));
}

std::string Assembly::accusation() const {
  for (const Peer& peer : peers_)
    if (peer.accusation().is_made())
      return "at peer " + std::to_string(peer.number()) + ": " + peer.accusation().text();
  return {};
}

}  // namespace rink::peer
