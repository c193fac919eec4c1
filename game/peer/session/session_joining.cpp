// Admits newcomers during the game by the verdicts of a final window, equally at all peers.
// docs/peer-to-peer.md, "Joining while others play".
#include <algorithm>
#include <cassert>
#include <utility>

#include "game/peer/session/session.h"

namespace rink::peer {

namespace {

bool is_among(const std::vector<PeerNumber>& peers, PeerNumber peer) {
  return std::find(peers.begin(), peers.end(), peer) != peers.end();
}

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

/// Gives new members half of the zone of the busiest peer since zones changed last.
void Session::give_zones(State& next) const {
  next.fresh.clear();
  for (const PeerNumber newcomer : now_.fresh) {
    std::optional<std::pair<double, double>> most;
    PeerNumber busiest = 0;
    for (const PeerNumber peer : next.cuts.peers()) {
      const double counted = peer < now_.events.size() ? now_.events[peer] : 0.0;
      const std::pair load(counted + static_cast<double>(peer_->verdicts().of(peer).events),
                           next.cuts.area_of(peer));
      if (!most || load > *most) most = load, busiest = peer;
    }
    assert(most && next.has(newcomer));
    next.cuts = next.cuts.with(newcomer, busiest);
    ++next.zones;
  }
}

/// The reason why a newcomer cannot be a candidate at the step that leads to `next`.
std::optional<std::string> Session::objection(const State& next, const Newcomer& newcomer) const {
  if (next.window + 3 > settings_.window_count || next.scoring.is_over)
    return "the game is about to end";
  if (next.members.size() + next.candidates.size() >= members_max)
    return "there are " + std::to_string(members_max) + " peers already";
  if (next.next_number >= numbers_max)
    return "this session has let in " + std::to_string(numbers_max) +
           " peers, and gives no more numbers";
  const std::uint32_t free = settings_.bat_count - std::min(settings_.bat_count, next.bats_taken);
  if (newcomer.bat_count > free)
    return "it wants to play " + std::to_string(newcomer.bat_count) + " bats, of " +
           std::to_string(settings_.bat_count) + " here " + std::to_string(free) + " are free";
  return std::nullopt;
}

/// Adds and drops candidates, and makes one of them a member.
void Session::admit(State& next) const {
  const std::vector<PeerNumber> zoned = next.cuts.peers();
  const auto stays = [&](PeerNumber sponsor) {
    return next.has(sponsor) && State::is_in(zoned, sponsor);
  };
  const auto is_reached = [&](PeerNumber candidate) {
    return std::all_of(now_.members.begin(), now_.members.end(), [&](PeerNumber peer) {
      return !next.has(peer) || is_among(peer_->verdicts().of(peer).admission.reached, candidate);
    });
  };
  std::erase_if(next.admitted, [&](const Candidate& one) { return !next.has(one.number); });
  std::erase_if(next.candidates, [&](const Candidate& one) {
    return !stays(one.sponsor) ||
           is_among(peer_->verdicts().of(one.sponsor).admission.withdrawn, one.number);
  });
  if (next.window + 2 > settings_.window_count || next.scoring.is_over) next.candidates.clear();
  const auto first = std::find_if(next.candidates.begin(), next.candidates.end(),
                                  [&](const Candidate& one) { return is_reached(one.number); });
  if (first != next.candidates.end()) {
    next.members.insert(std::upper_bound(next.members.begin(), next.members.end(), first->number),
                        first->number);
    next.fresh = {first->number};
    next.players.push_back({first->number, first->first_bat, first->newcomer.bat_count,
                            first->newcomer.puck_count, first->newcomer.hand_count});
    next.zones += first->number >= next.slots;  // so that all have a slot for it
    next.slots = std::max(next.slots, first->number + 1);
    next.admitted.push_back(std::move(*first));
    next.candidates.erase(first);
  }
  for (const PeerNumber sponsor : now_.members) {
    if (!stays(sponsor)) continue;
    for (const Newcomer& newcomer : peer_->verdicts().of(sponsor).admission.asking) {
      if (objection(next, newcomer)) continue;
      next.candidates.push_back({next.next_number++, sponsor, next.bats_taken, newcomer});
      next.bats_taken += newcomer.bat_count;
      assert(next.next_number <= numbers_max && next.candidates.size() < members_max);
    }
  }
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
      const auto reason = objection(next, newcomer);
      mail_.refuse(newcomer.token, reason.value_or("the peer that was asked is leaving"), !reason);
    }
    std::erase_if(asking_, [&](const Newcomer& one) { return one.token == newcomer.token; });
  }
}

Session::Session(const physics::World& whole, SessionSettings settings, Mail& mail,
                 std::vector<PeerNumber> members)
    : settings_(std::move(settings)),
      mail_(mail),
      whole_(Whole::of(whole)),
      validator_(whole),
      now_{.cuts = Cuts::whole(whole.spec().field)},
      before_(now_),
      division_(now_.division()),
      is_newcomer_(true) {
  assert(settings_.is_replicated && !members.empty());
  enter_late(std::move(members));
}

/// True at the end of a window, or within the next one if that is cut, and at least two windows
/// before the end.
bool Session::is_in_time(const State& state) const {
  if (settings_.window_count < 2 || state.window > settings_.window_count - 2) return false;
  const double begin = state.window == 0 ? 0.0 : settings_.end_of(state.window);
  return state.time == begin ||
         (settings_.goals && state.time > begin && state.time < settings_.end_of(state.window + 1));
}

/// The first entry from any of these peers; lost ones are skipped.
std::optional<Entry> Session::first_entry(std::vector<PeerNumber> from) {
  while (!from.empty()) try {
      const std::vector<std::uint8_t> bytes = mail_.receive(from.front());
      Entry entry{.state = now_};
      Loss loss;
      if (read(bytes, entry)) {
        const State& state = entry.state;
        const bool has_pucks =
            std::all_of(state.scoring.face_offs.begin(), state.scoring.face_offs.end(),
                        [&](const FaceOff& due) { return whole_.has_puck(due.puck); });
        if (!state.is_sound_for(settings_.number) || !has_pucks || !state.has(from.front()) ||
            !is_in_time(state))
          throw ProtocolError("peer " + std::to_string(from.front()) +
                              " sent an entry that cannot be");
        // Lost players are checked too: `seats_of` throws for bats that do not exist.
        for (const Player& player : state.players) settings_.seats_of(player);
        teller_ = from.front();
        return entry;
      }
      if (read(bytes, loss))
        throw SentAway("peer " + std::to_string(from.front()) +
                       " lost others before this one was in");
      throw ProtocolError("peer " + std::to_string(from.front()) + " sent what is no message");
    } catch (const PeerGone& gone) {
      note_gone(gone.peer(), gone.what());
      std::erase(from, gone.peer());
    }
  return std::nullopt;
}

/// All others send the same entry, or have lost a peer; then a recovery follows, in which entries
/// are outdated.
void Session::receive_same(const Entry& entry) try {
  const std::vector<std::uint8_t> expected = written(entry);
  for (const PeerNumber from : now_.members) {
    if (from == settings_.number || from == teller_) continue;
    for (std::vector<std::uint8_t> bytes = mail_.receive(from); bytes != expected;
         bytes = mail_.receive(from)) {
      Loss loss;
      if (!read(bytes, loss))
        throw ProtocolError("peer " + std::to_string(from) + " sent another entry than peer " +
                            std::to_string(teller_));
      if (learns_of_loss(from, bytes)) return;
    }
  }
} catch (const PeerGone& gone) {
  note_gone(gone.peer(), gone.what(), gone.has_finished());
}

void Session::enter_late(std::vector<PeerNumber> members) {
  const auto entry = first_entry(std::move(members));
  if (!entry) throw SentAway(last_loss_);
  now_ = before_ = entry->state;
  std::erase_if(gone_, [&](PeerNumber peer) { return !now_.has(peer); });
  must_recover_ = !gone_.empty();
  const std::vector<PeerNumber> lost = std::exchange(gone_, now_.gone);
  gone_.insert(gone_.end(), lost.begin(), lost.end());
  std::sort(gone_.begin(), gone_.end());
  make_room(now_.slots);
  division_ = now_.division();
  for (const std::vector<Candidate>* all : {&now_.admitted, &now_.candidates})
    for (const Candidate& one : *all)
      if (one.number != settings_.number) mail_.expect(one, false, now_);
  for (const PeerNumber peer : now_.members)
    if (peer != settings_.number && !is_gone(peer)) mail_.admit(peer, true);
  if (!must_recover_) receive_same(*entry);
  enter(now_, {});
  replicas_[settings_.number].add({.step = now_.step,
                                   .time = peer_->now(),
                                   .is_whole = true,
                                   .bodies = {},
                                   .gone = {},
                                   .rest_contacts = {},
                                   .keys = {},
                                   .log = {}});
}

}  // namespace rink::peer
