// Recovers from the loss of a peer: the others agree on the last common step, and continue from
// there.
#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "game/peer/session/part_change.h"
#include "game/peer/session/session.h"
#include "game/peer/verdict_tree.h"
#include "im/basics/checked.h"

namespace rink::peer {

namespace {

std::string listed(const std::vector<PeerNumber>& peers) {
  std::string text;
  for (const PeerNumber peer : peers) text += (text.empty() ? "" : ", ") + std::to_string(peer);
  return text;
}

std::string why_a_minority_halts(const State& now, const Losses& losses) {
  const auto left =
      std::ranges::count_if(now.members, [&](PeerNumber peer) { return !losses.is_gone(peer); });
  return losses.last() + ". On this side " + std::to_string(left) + " of " +
         std::to_string(now.members.size()) + " peers are left: it halts, for the others may go on";
}

/// Each share names all of the part that it is of.
std::vector<Key> pending_keys(std::span<const Handover> shares) {
  std::vector<Key> pending;
  for (const Handover& share : shares)
    std::ranges::copy_if(share.keys, std::back_inserter(pending),
                         [](const Key& key) { return key.input != 0; });
  return pending;
}

/// What its sender has said before it knew of a loss.
bool is_of_before(std::span<const std::uint8_t> bytes, const physics::Field& field) {
  const auto is_one = [&](auto message) { return read(bytes, message); };
  return is_one(Claims{}) || is_one(Verdict{}) || is_one(VerdictBundle{}) || is_one(Handover{}) ||
         is_one(PartRecord{}) || is_one(SnapshotPiece{}) || is_one(FaceOffWord{}) ||
         is_one(Entry{.state = {.cuts = Cuts::whole(field)}});
}

}  // namespace

void Session::recover() {
  inbox_.defer_faults(false);
  while (!agree()) {
  }
  standby_.rewind(now_.step);
  send_away(now_);
  const Losses::Majority majority = inbox_.losses().majority(now_);
  may_have_split_ = may_have_split_ || majority == Losses::Majority::doubtful;
  if (majority == Losses::Majority::none) inbox_.halt(why_a_minority_halts(now_, inbox_.losses()));
  rebuild();
  inbox_.recovered();
  ++counters_.recoveries;
}

/// Agrees with all others on the lost peers and on the last common step. False if there may be
/// something new to tell.
bool Session::agree() {
  inbox_.tell(now_);
  const Losses& losses = inbox_.losses();
  std::vector<PeerNumber> others = now_.members;
  std::erase_if(others,
                [&](PeerNumber peer) { return peer == settings_.number || losses.is_away(peer); });
  // At once: a newcomer that those behind do not know yet may wait for a word of theirs.
  const auto behind = std::ranges::find_if(others, [&](PeerNumber peer) {
    return losses.agrees(peer) && losses.heard(peer)->step < now_.step;
  });
  if (behind != others.end()) return go_back(*behind), false;
  std::vector<PeerNumber> awaited = others;
  std::erase_if(awaited, [&](PeerNumber peer) { return losses.agrees(peer); });
  if (awaited.empty()) return inbox_.has_settled(now_);
  // Who waited for one of them alone might wait for one that waits for this one.
  const auto [from, bytes] = mail_.receive_any(awaited);
  inbox_.count_word(from);
  if (Loss loss; read(bytes, loss)) inbox_.learns_of_loss(from, bytes, now_);
  else if (!is_of_before(bytes, whole_.spec.field)) inbox_.give_up(from, "sent what is no message");
  return false;
}

/// A peer that joined with the undone step is no member, and one that left with it still is.
void Session::go_back(PeerNumber as) {
  if (inbox_.is_newcomer())
    throw SentAway("peer " + std::to_string(as) +
                   " did not know this one yet when others were lost");
  if (before_.step + 1 != now_.step || inbox_.losses().heard(as)->step != before_.step)
    inbox_.give_up(as, "is at step " + std::to_string(inbox_.losses().heard(as)->step) +
                           ", here it is " + std::to_string(now_.step));
  send_away(now_);
  for (const PeerNumber peer : now_.members)
    if (!before_.has(peer)) mail_.admit(peer, false);
  for (const PeerNumber peer : before_.members)
    if (!now_.has(peer) && !inbox_.losses().is_away(peer)) mail_.rejoin(peer);
  now_ = before_;
  assert(now_.has(settings_.number));
}

/// Sends all candidates away, since their admission may be undone elsewhere.
void Session::send_away(const State& state) {
  for (const Candidate& candidate : state.candidates) mail_.admit(candidate.number, false);
}

void Session::rebuild() {
  assert(!inbox_.losses().is_gone(settings_.number));
  inbox_.losses().check();
  if (const auto unkept = Replicas::first_unkept(now_, inbox_.losses()))
    inbox_.halt("peers " + listed(inbox_.losses().gone()) + " are gone, and with them what peer " +
                std::to_string(*unkept) + " had");
  PartRecord record;
  const std::vector<Part> parts = standby_.played_parts(now_, whole_.spec, record.inherited);
  const auto share = [&](PeerNumber to) {
    Handover message = Replicas::share(parts, division_, to, settings_.halo);
    message.window = static_cast<std::uint32_t>(now_.window);
    return message;
  };
  State next = now_;
  ++next.step;
  const auto is_lost = [&](PeerNumber peer) { return inbox_.losses().is_gone(peer); };
  std::erase_if(next.members, is_lost);
  std::erase_if(next.fresh, is_lost);
  std::erase_if(next.admitted,
                [&](const Candidate& one) { return inbox_.losses().is_gone(one.number); });
  next.candidates.clear();
  next.gone = inbox_.losses().gone();
  for (const PeerNumber peer : now_.members)
    if (inbox_.losses().is_gone(peer) && next.cuts.has(peer))
      next.cuts = next.cuts.without(peer), ++next.zones;
  assert(next.has(settings_.number));
  division_ = next.division();
  std::vector<Handover> shares(next.slots);
  for (const PeerNumber to : next.members) {
    if (to == settings_.number) continue;
    std::vector<std::uint8_t> bytes = written(share(to));
    counters_.recovery_bytes += bytes.size();
    mail_.send(to, std::move(bytes));
  }
  shares[settings_.number] = share(settings_.number);
  for (const PeerNumber from : next.members)
    if (from != settings_.number) {
      shares[from] = inbox_.checked<Handover>(from, now_, now_.time);
      const std::vector<PeerNumber> owners = Replicas::parts_of(from, now_, inbox_.losses());
      if (const auto body =
              first_elsewhere(shares[from].bodies, now_.time, now_.division(), owners))
        inbox_.give_up(from,
                       "hands over body " + std::to_string(*body) + ", which is in another's zone");
    }
  enter(next, shares);
  standby_.pass({now_, next, true}, *peer_, std::move(record));
  before_ = std::exchange(now_, std::move(next));
  if constexpr (checks_whole_structures) now_.check();
  press_again();
  if (settings_.losses.are_set()) settings_.losses.when_recovered(pending_keys(shares));
}

/// A new peer in the place of the old one, from the shares of all.
void Session::enter(const State& next, std::span<const Handover> shares) {
  if (peer_) counters_.peer += peer_->counters();
  peer_.emplace(whole_.spec, division_, settings_.number, whole_.body_count, settings_.halo);
  peer_->validate_by(inbox_.validator());
  // Who has no shares comes late.
  if (settings_.keeps_to_neighbours) peer_->keep_to_neighbours(shares.empty());
  for (PeerNumber peer = 0; peer < next.slots; ++peer) peer_->set_present(peer, next.has(peer));
  for (const Player& player : next.players)
    if (next.has(player.peer))
      for (const Seat& seat : settings_.seats_of(player)) peer_->players().seat(seat);
  if (settings_.losses.are_set()) settings_.losses.when_entered(*peer_);
  const double time = next.time;
  // It counts stretches, of which a window may have several.
  peer_->enter(static_cast<std::uint32_t>(next.step), time, shares);
  for (const Key& key : settings_.keys)
    if (next.time == 0.0 || key.time > time) peer_->press_first(key);
  peer_->begin(agreement_.stretch_end(next));
  peer_->part_log().begin(inbox_.validator());
}

/// Presses keys of undone windows again. Bats have other owners now, by their observations.
void Session::press_again() {
  std::vector<Observation> seen = peer_->players().all_for(settings_.number);
  for (const PeerNumber to : now_.members) {
    if (to == settings_.number) continue;
    Handover message;
    message.observations = peer_->players().all_for(to);
    mail_.send(to, written(message));
  }
  for (const PeerNumber from : now_.members) {
    if (from == settings_.number) continue;
    const auto message = inbox_.checked<Handover>(from, now_, now_.time);
    seen.insert(seen.end(), message.observations.begin(), message.observations.end());
  }
  for (Sent& sent : sent_) {
    const auto observation = std::find_if(seen.begin(), seen.end(), [&](const Observation& one) {
      return one.bat == sent.press.bat;
    });
    if (sent.step < now_.step || observation == seen.end() || observation->owner >= now_.slots)
      continue;
    sent.step = now_.step + 1;
    peer_->players().press(observation->owner, sent.press);
  }
}

}  // namespace rink::peer
