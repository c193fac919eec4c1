// Between stretches of a window: puts pucks back. docs/peer-to-peer.md, "Goals".
#include <algorithm>
#include <bit>
#include <cassert>

#include "game/peer/session/session.h"

namespace rink::peer {

/// Puts back all pucks that are due at the end of the committed stretch, and then those whose time
/// in one half is over before the other side, as Game does.
void Session::face_off(State& next) {
  while (next.scoring.next() <= next.time) {
    const FaceOff due = next.scoring.face_offs.front();
    next.scoring.face_offs.erase(next.scoring.face_offs.begin());
    if (!put_back(due))
      next.scoring.schedule({due.time + settings_.goals->placement_retry, due.puck, due.is_left});
  }
  physics::Halves& halves = next.scoring.halves;
  if (!halves.are_kept()) return;
  halves.look(peer_->world());
  if (halves.next() > next.time) return;
  for (const physics::HalfStay& stay : halves.stays()) {
    if (stay.until > next.time) continue;
    const bool is_to_left = stay.half == physics::Half::right;
    if (put_back({next.time, stay.puck.index, is_to_left})) halves.restart(stay.puck);
    else halves.prolong(stay.puck, stay.until + settings_.goals->placement_retry);
  }
  halves.look(peer_->world());
}

/// Each peer knows its own bodies, so a place is free if it is free at all peers. False if none is.
bool Session::put_back(const FaceOff& due) {
  constexpr std::size_t asked = 64;
  assert(whole_.has_puck(due.puck) && settings_.goals);
  const double radius = whole_.puck_radii[due.puck];
  for (std::size_t first = 0;; first += asked) {
    const std::vector<Vector2> places = settings_.goals->places(due.is_left, radius, first, asked);
    if (places.empty()) return false;
    assert(places.size() <= asked && "a word has one bit for each");
    FaceOffWord word{.puck = due.puck, .taken = 0, .body = {}};
    // Whatever overlaps a place within the own halo is an own body or a ghost.
    std::uint64_t known_free = 0;
    const Halos& halos = peer_->halos();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const std::uint64_t place = std::uint64_t{1} << k;
      const Box disc = Box::around(places[k], Vector2(radius, radius));
      if (!peer_->world().is_free(places[k], radius)) word.taken |= place;
      else if (halos.division().is_within(halos.number(), disc, halos.own())) known_free |= place;
    }
    if (peer_->share().owns(due.puck))
      word.body.push_back({due.puck, peer_->share().state(due.puck)});
    const std::uint64_t taken = agree_on(word, known_free);
    const auto free = static_cast<std::size_t>(std::countr_one(taken));
    if (free < places.size()) {
      assert(word.body.front().number == due.puck);
      peer_->put_back(word.body.front(), places[free]);
      return true;
    }
    if (places.size() < asked) return false;
  }
}

/// Exchanges the peers' messages, and returns the places that are taken at any peer. `word` has the
/// puck afterwards. Who says of a place in `known_free` that it is taken is given up.
std::uint64_t Session::agree_on(FaceOffWord& word, std::uint64_t known_free) {
  for (const PeerNumber to : now_.members)
    if (to != settings_.number) mail_.send(to, written(word));
  std::uint64_t taken = word.taken;
  std::vector<std::vector<std::uint8_t>> words;
  const std::vector<std::uint8_t> own = written(word);
  for (const PeerNumber from : now_.members) {
    if (from == settings_.number) {
      words.push_back(own);
      continue;
    }
    const auto word_received = inbox_.checked<FaceOffWord>(from, now_, peer_->now());
    if (word_received.puck != word.puck ||
        (!word_received.body.empty() && word_received.body.front().number != word.puck))
      inbox_.give_up(from, "sends puck " + std::to_string(word_received.puck) + " where puck " +
                               std::to_string(word.puck) + " is due");
    const Roles& roles = peer_->share().roles();
    const bool may_have = !roles.owns(word.puck) &&
                          (!roles.has_ghost(word.puck) || roles.has_ghost_of(from, word.puck));
    if (!word_received.body.empty() && !may_have)
      inbox_.give_up(from, "sends puck " + std::to_string(word.puck) + ", which it does not own");
    if ((word_received.taken & known_free) != 0)
      inbox_.give_up(from, "says that a place for puck " + std::to_string(word.puck) +
                               " is taken, which is free");
    taken |= word_received.taken;
    words.push_back(written(word_received));
    if (word.body.empty()) word.body = word_received.body;
  }
  if (settings_.is_replicated) inbox_.note_round(now_, words);
  if (word.body.empty())
    throw ProtocolError("no peer has puck " + std::to_string(word.puck) + ", which is due");
  return taken;
}

}  // namespace rink::peer
