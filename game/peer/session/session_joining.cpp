// Admits newcomers during the game by the verdicts of a final window, equally at all peers.
// docs/peer-to-peer.md, "Joining while others play".
#include <algorithm>
#include <cassert>
#include <utility>

#include "game/peer/session/session.h"

namespace rink::peer {

namespace {

const Candidate* find(const std::vector<Candidate>& candidates, std::uint64_t token) {
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& one) {
    return one.newcomer.token == token;
  });
  return found == candidates.end() ? nullptr : &*found;
}

}  // namespace

/// Puts newcomers, and a wish to leave, into this window's verdict.
void Session::announce() {
  if (!settings_.is_replicated) return peer_->announce(wishes_to_leave_, {});
  for (Newcomer& newcomer : mail_.callers()) asking_.push_back(std::move(newcomer));
  Admission own_word;
  own_word.asking.assign(asking_.begin(),
                         asking_.begin() + static_cast<std::ptrdiff_t>(
                                               std::min(asking_.size(), Admission::asking_max)));
  for (const Candidate& candidate : now_.candidates) {
    if (mail_.reaches(candidate.number)) own_word.reached.push_back(candidate.number);
    if (candidate.sponsor == settings_.number && mail_.has_given_up(candidate.number))
      own_word.withdrawn.push_back(candidate.number);
  }
  peer_->announce(wishes_to_leave_, std::move(own_word));
}

/// Sends the decisions.
void Session::greet(const State& next) {
  for (const PeerNumber peer : next.fresh) {
    std::vector<std::uint8_t> bytes = written(Entry{.state = next});
    counters_.entry_bytes += bytes.size();
    mail_.admit(peer, true);
    mail_.send(peer, std::move(bytes));
    peer_->set_present(peer, true);
    for (const Seat& seat : settings_.seats_of(next.players.back())) peer_->players().seat(seat);
  }
  for (const Candidate& one : now_.candidates)
    if (!find(next.candidates, one.newcomer.token) && !next.has(one.number))
      mail_.admit(one.number, false);
  for (const Candidate& one : next.candidates)
    if (!find(now_.candidates, one.newcomer.token))
      mail_.expect(one, one.sponsor == settings_.number, next);
  for (const Newcomer& newcomer : peer_->verdicts().own().admission.asking) {
    if (!find(next.candidates, newcomer.token)) {
      const auto reason = agreement_.objection(next, newcomer);
      mail_.refuse(newcomer.token, reason.value_or("the peer that was asked is leaving"), !reason);
    }
    std::erase_if(asking_, [&](const Newcomer& one) { return one.token == newcomer.token; });
  }
}

Session::Session(const Start& start, SessionSettings settings, Mail& mail,
                 std::vector<PeerNumber> members)
    : settings_(std::move(settings)),
      mail_(mail),
      whole_(Whole::of(start)),
      agreement_(settings_, whole_),
      now_{.cuts = Cuts::whole(start.spec().field)},
      before_(now_),
      division_(now_.division()),
      inbox_(settings_, Validator(start), mail, true),
      standby_(settings_, inbox_, mail_) {
  assert(settings_.is_replicated && !members.empty());
  inbox_.remember(before_);
  enter_late(std::move(members));
}

/// The first entry from any of these peers; lost ones are skipped.
std::optional<std::pair<PeerNumber, Entry>> Session::first_entry(std::vector<PeerNumber> from) {
  while (!from.empty()) try {
      const std::vector<std::uint8_t> bytes = mail_.receive(from.front());
      Entry entry{.state = now_};
      Loss loss;
      if (read(bytes, entry)) {
        if (!agreement_.may_be_entry(entry.state, from.front()))
          throw ProtocolError("peer " + std::to_string(from.front()) +
                              " sent an entry that cannot be");
        // Lost players are checked too: `seats_of` throws for bats that do not exist.
        for (const Player& player : entry.state.players) settings_.seats_of(player);
        return std::pair(from.front(), std::move(entry));
      }
      if (read(bytes, loss))
        throw SentAway("peer " + std::to_string(from.front()) +
                       " lost others before this one was in");
      throw ProtocolError("peer " + std::to_string(from.front()) + " sent what is no message");
    } catch (const PeerGone& gone) {
      inbox_.note_gone(gone.peer(), gone.what());
      std::erase(from, gone.peer());
    }
  return std::nullopt;
}

/// All others send the same entry, or have lost a peer; then a recovery follows, in which entries
/// are outdated.
void Session::receive_same(const Entry& entry, PeerNumber teller) try {
  const std::vector<std::uint8_t> expected = written(entry);
  for (const PeerNumber from : now_.members) {
    if (from == settings_.number || from == teller) continue;
    for (std::vector<std::uint8_t> bytes = mail_.receive(from); bytes != expected;
         bytes = mail_.receive(from)) {
      Loss loss;
      if (!read(bytes, loss))
        throw ProtocolError("peer " + std::to_string(from) + " sent another entry than peer " +
                            std::to_string(teller));
      if (inbox_.learns_of_loss(from, bytes, now_)) return;
    }
  }
} catch (const PeerGone& gone) {
  inbox_.note_gone(gone.peer(), gone.what(), gone.has_finished());
}

void Session::enter_late(std::vector<PeerNumber> members) {
  const auto entry = first_entry(std::move(members));
  if (!entry) throw SentAway(inbox_.losses().last());
  now_ = before_ = entry->second.state;
  inbox_.begin(now_);
  standby_.make_room(now_.slots), inbox_.make_room(now_.slots);
  division_ = now_.division();
  for (const std::vector<Candidate>* all : {&now_.admitted, &now_.candidates})
    for (const Candidate& one : *all)
      if (one.number != settings_.number) mail_.expect(one, false, now_);
  for (const PeerNumber peer : now_.members)
    if (peer != settings_.number && !inbox_.losses().is_away(peer)) mail_.admit(peer, true);
  if (!inbox_.must_recover()) receive_same(entry->second, entry->first);
  enter(now_, {});
  standby_.enter(now_, peer_->part_log());
}

}  // namespace rink::peer
