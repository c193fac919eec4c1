// Recovers from the loss of a peer: the others agree on the last common step, and continue from
// there.
#include <algorithm>
#include <cassert>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "im/basics/checked.h"

#include "game/peer/session/session.h"

namespace rink::peer {

namespace {

std::string listed(const std::vector<PeerNumber>& peers) {
  std::string text;
  for (const PeerNumber peer : peers) text += (text.empty() ? "" : ", ") + std::to_string(peer);
  return text;
}

}  // namespace

void Session::note_gone(PeerNumber peer, const std::string& what, bool has_finished) {
  if (!settings_.is_replicated) throw Halt(what);
  must_recover_ = true;
  if (has_finished && !State::is_in(finished_, peer))
    finished_.insert(std::upper_bound(finished_.begin(), finished_.end(), peer), peer);
  if (is_gone(peer)) return;
  last_loss_ = what;
  gone_.insert(std::upper_bound(gone_.begin(), gone_.end(), peer), peer);
  mail_.part(peer, true);
}

/// True if the message is a loss that names a new lost peer.
bool Session::learns_of_loss(PeerNumber from, std::span<const std::uint8_t> bytes) {
  Loss loss;
  if (!settings_.is_replicated || !read(bytes, loss))
    give_up(from, "peer " + std::to_string(from) + " sent what is no message");
  if (const std::string fault = validator_.fault_of(loss); !fault.empty())
    give_up(from, "peer " + std::to_string(from) + " " + fault);
  // Peers are at most a step apart, and a member's number was assigned at an earlier step.
  if (!loss.gone.empty() && loss.gone.back() >= now_.next_number)
    give_up(from, "peer " + std::to_string(from) + " sends the loss of peer " +
                      std::to_string(loss.gone.back()) + ", which never was");
  if (loss.step > now_.step + 1)
    give_up(from, "peer " + std::to_string(from) + " is at step " + std::to_string(loss.step) +
                      ", here it is " + std::to_string(now_.step));
  if (std::find(loss.gone.begin(), loss.gone.end(), settings_.number) != loss.gone.end())
    halt("peer " + std::to_string(from) + " has given this one up: it halts, others may go on");
  const std::vector<PeerNumber> word_received = loss.gone, finished = loss.finished;
  losses_[from] = std::move(loss);
  bool is_news = false;
  for (const PeerNumber peer : word_received) {
    const bool is_new = !is_gone(peer);
    is_news = is_news || is_new;
    if (is_new)
      note_gone(peer, "peer " + std::to_string(peer) + " is gone, according to peer " +
                          std::to_string(from));
    if (std::find(finished.begin(), finished.end(), peer) != finished.end())
      note_gone(peer, {}, true);
  }
  return is_news;
}

void Session::recover() {
  agree();
  for (PartReplica& replica : replicas_)
    if (!replica.rewind(now_.step)) replica = PartReplica();
  send_away(now_);
  require_majority();
  rebuild();
  must_recover_ = false;
  ++counters_.recoveries;
}

/// Agrees with all others on the lost peers and on the last common step.
void Session::agree() {
  for (bool is_agreed = false; !is_agreed;) {
    is_agreed = true;
    for (const PeerNumber to : now_.members)
      if (to != settings_.number && !is_gone(to))
        mail_.send(to, written(Loss{.step = now_.step, .gone = gone_, .finished = finished_}));
    const std::vector<PeerNumber> members = now_.members;
    for (const PeerNumber from : members) {
      if (from == settings_.number || is_gone(from)) continue;
      while (is_agreed && !(losses_[from] && losses_[from]->gone == gone_)) {
        const std::vector<std::uint8_t> bytes = mail_.receive(from);
        Loss loss;
        if (read(bytes, loss)) is_agreed = !learns_of_loss(from, bytes);  // all else is of before
      }
      if (is_agreed && losses_[from]->step < now_.step) go_back(from), is_agreed = false;
      if (!is_agreed) break;
    }
  }
}

/// A peer that joined with the undone step is no member, and one that left with it still is.
void Session::go_back(PeerNumber as) {
  if (is_newcomer_)
    throw SentAway("peer " + std::to_string(as) +
                   " did not know this one yet when others were lost");
  if (before_.step + 1 != now_.step || losses_[as]->step != before_.step)
    give_up(as, "peer " + std::to_string(as) + " is at step " + std::to_string(losses_[as]->step) +
                    ", here it is " + std::to_string(now_.step));
  send_away(now_);
  for (const PeerNumber peer : now_.members)
    if (!before_.has(peer)) mail_.admit(peer, false);
  for (const PeerNumber peer : before_.members)
    if (!now_.has(peer) && !is_gone(peer)) mail_.rejoin(peer);
  now_ = before_;
  assert(now_.has(settings_.number));
}

/// Sends all candidates away, since their admission may be undone elsewhere.
void Session::send_away(const State& state) {
  for (const Candidate& candidate : state.candidates) mail_.admit(candidate.number, false);
}

/// A majority is more than half; or half, with the first of them. Of two peers either continues,
/// but the second one cannot know whether the first does too.
Session::Majority Session::majority_of(std::vector<PeerNumber> voters) const {
  std::erase_if(voters, [&](PeerNumber peer) { return State::is_in(finished_, peer); });
  const std::size_t count = voters.size();
  const auto left = static_cast<std::size_t>(
      std::count_if(voters.begin(), voters.end(), [&](PeerNumber peer) { return !is_gone(peer); }));
  if (left > 0 && (2 * left > count || (2 * left == count && !is_gone(voters.front()))))
    return Majority::sure;
  assert(left <= count);
  return left > 0 && count == 2 ? Majority::doubtful : Majority::none;
}

/// Majorities of neighbouring steps must have a common peer, too.
void Session::require_majority() {
  const Majority majority = std::min(majority_of(now_.voters()), majority_of(now_.next_voters()));
  may_have_split_ = may_have_split_ || majority == Majority::doubtful;
  if (majority != Majority::none) return;
  const auto left = std::count_if(now_.members.begin(), now_.members.end(),
                                  [&](PeerNumber peer) { return !is_gone(peer); });
  halt(last_loss_ + ". On this side " + std::to_string(left) + " of " +
       std::to_string(now_.members.size()) + " peers are left: it halts, for the others may go on");
}

/// That peer, and the lost ones of which it has a replica.
std::vector<PeerNumber> Session::stood_for(PeerNumber by) const {
  std::vector<PeerNumber> parts{by};
  for (const PeerNumber peer : now_.members) {
    if (!is_gone(peer) || now_.is_fresh(peer)) continue;
    const auto replica = replica_of(peer, now_);
    if (!replica || is_gone(*replica))
      halt("peers " + listed(gone_) + " are gone, and with them what peer " + std::to_string(peer) +
           " had");
    if (replica == by) parts.push_back(peer);
  }
  return parts;
}

/// All that `to` may need of these parts: bodies in its zones or the halo, and those that may act
/// at a distance.
Handover Session::share(std::span<const PeerNumber> parts, const Division& division,
                        PeerNumber to) {
  Handover message;
  message.window = static_cast<std::uint32_t>(now_.window);
  for (const PeerNumber peer : parts) {
    const Part& part = replicas_[peer].part();
    std::vector<std::uint32_t> bodies;
    for (const auto& [body, state] : part.bodies) {
      const Box place =
          Box::around(state.motion().at(part.time).position, state.extent()).grown(1e-6);
      if (state.flags != 0 || division.is_near(to, place, settings_.halo)) bodies.push_back(body);
    }
    std::sort(bodies.begin(), bodies.end());
    for (const std::uint32_t body : bodies) message.bodies.push_back({body, part.bodies.at(body)});
    message.rest_contacts.insert(message.rest_contacts.end(), part.rest_contacts.begin(),
                                 part.rest_contacts.end());
    message.keys.insert(message.keys.end(), part.keys.begin(), part.keys.end());
  }
  return message;
}

void Session::rebuild() {
  assert(std::ranges::adjacent_find(gone_, std::greater_equal<>()) == gone_.end());
  assert(std::ranges::includes(gone_, finished_) && !is_gone(settings_.number));
  const std::vector<PeerNumber> parts = stood_for(settings_.number);
  State next = now_;
  ++next.step;
  const auto is_lost = [&](PeerNumber peer) { return is_gone(peer); };
  std::erase_if(next.members, is_lost);
  std::erase_if(next.fresh, is_lost);
  std::erase_if(next.admitted, [&](const Candidate& one) { return is_gone(one.number); });
  next.candidates.clear();
  next.gone = gone_;
  for (const PeerNumber peer : now_.members)
    if (is_gone(peer) && next.cuts.has(peer)) next.cuts = next.cuts.without(peer), ++next.zones;
  assert(next.has(settings_.number));
  division_ = next.division();
  std::vector<Handover> shares(next.slots);
  for (const PeerNumber to : next.members) {
    if (to == settings_.number) continue;
    std::vector<std::uint8_t> bytes = written(share(parts, division_, to));
    counters_.recovery_bytes += bytes.size();
    mail_.send(to, std::move(bytes));
  }
  shares[settings_.number] = share(parts, division_, settings_.number);
  for (const PeerNumber from : next.members) {
    if (from == settings_.number) continue;
    shares[from] = checked<Handover>(from, now_.time);
    // Else it would come before the share of who owns the body.
    if (const auto body =
            first_elsewhere(shares[from].bodies, now_.time, now_.division(), stood_for(from)))
      give_up(from, "peer " + std::to_string(from) + " hands over body " + std::to_string(*body) +
                        ", which is in another's zone");
  }
  enter(next, shares);
  PartChange change = peer_->change(true);
  for (const PeerNumber peer : parts) {
    const std::vector<Key> log = replicas_[peer].log();
    change.log.insert(change.log.end(), log.begin(), log.end());
  }
  replica(next, std::move(change));
  before_ = std::exchange(now_, std::move(next));
  if constexpr (checks_whole_structures) now_.check();
  press_again();
}

/// A new peer in the place of the old one, from the shares of all.
void Session::enter(const State& next, std::span<const Handover> shares) {
  if (peer_) counters_.peer += peer_->counters();
  peer_.emplace(whole_.spec, division_, settings_.number, whole_.body_count, settings_.halo);
  peer_->validate_by(validator_);
  for (PeerNumber peer = 0; peer < next.slots; ++peer) peer_->set_present(peer, next.has(peer));
  for (const Player& player : next.players)
    if (next.has(player.peer))
      for (const Seat& seat : settings_.seats_of(player)) peer_->players().seat(seat);
  const double time = next.time;
  // It counts stretches, of which a window may have several.
  peer_->enter(static_cast<std::uint32_t>(next.step), time, shares);
  for (const Key& key : settings_.keys)
    if (next.time == 0.0 || key.time > time) peer_->press_first(key);
  peer_->keep_changes();
  peer_->begin(stretch_end(next));
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
    const auto message = checked<Handover>(from, now_.time);
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
