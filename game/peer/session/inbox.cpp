// Learns of losses, and gives up who lies.
#include "game/peer/session/inbox.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::peer {

Inbox::Inbox(const SessionSettings& settings, Validator validator, Mail& mail, bool is_newcomer)
    : settings_(settings),
      validator_(std::move(validator)),
      mail_(mail),
      is_newcomer_(is_newcomer) {}

Handover Inbox::final_handover(PeerNumber from, const State& now) {
  Handover part = received<Handover>(from, now);
  if (const std::string fault = validator_.fault_of(part.keys); !fault.empty())
    give_up(from, fault);
  return part;
}

bool Inbox::learns_of_loss(PeerNumber from, std::span<const std::uint8_t> bytes, const State& now) {
  Loss loss;
  if (!settings_.is_replicated || !read(bytes, loss)) give_up(from, "sent what is no message");
  std::string fault = validator_.fault_of(loss);
  if (fault.empty()) fault = Losses::fault_of(loss, now);
  if (!fault.empty()) give_up(from, fault);
  if (State::is_in(loss.gone, settings_.number))
    halt("peer " + std::to_string(from) + " has given this one up: it halts, others may go on");
  losses_.hear(from, loss);
  bool is_news = false;
  for (const PeerNumber peer : loss.gone) {
    const bool is_new = !losses_.is_gone(peer);
    is_news = is_news || is_new;
    if (is_new)
      note_gone(peer, "peer " + std::to_string(peer) + " is gone, according to peer " +
                          std::to_string(from));
    if (State::is_in(loss.finished, peer)) note_gone(peer, {}, true);
  }
  return is_news;
}

void Inbox::note_gone(PeerNumber peer, const std::string& what, bool has_finished) {
  assert(peer != settings_.number);
  if (!settings_.is_replicated) throw Halt(what);
  must_recover_ = true;
  if (losses_.note(peer, what, has_finished)) mail_.part(peer, true);
}

void Inbox::give_up(PeerNumber peer, const std::string& fault) const {
  assert(peer != settings_.number && !fault.empty());
  const std::string what = "peer " + std::to_string(peer) + " " + fault;
  if (!settings_.is_replicated) throw ProtocolError(what);
  throw PeerGone(peer, false, what);
}

void Inbox::halt(const std::string& what) const {
  if (is_newcomer_) throw SentAway(what);
  throw Halt(what);
}

void Inbox::begin(const State& now) {
  assert(is_newcomer_);
  losses_.begin(now);
  must_recover_ =
      std::ranges::any_of(losses_.gone(), [&](PeerNumber peer) { return now.has(peer); });
}

}  // namespace rink::peer
