// Plays windows in steps.
#include "game/peer/session/session.h"

#include <cassert>
#include <iterator>
#include <numeric>
#include <utility>

#include "game/peer/session/others_states.h"
#include "game/peer/session/tree_agreement.h"
#include "game/peer/standby/packed_states.h"
#include "game/peer/standby/part_at_start.h"
#include "im/basics/checked.h"

namespace rink::peer {

namespace {

Addressees all_but(PeerNumber own, std::vector<PeerNumber> members) {
  std::erase(members, own);
  return {members, members};
}

/// Of pucks whose stays are limited.
physics::Halves halves_at_start(const Whole& whole, const SessionSettings& settings,
                                const physics::PartWorld& world) {
  if (!settings.goals || settings.goals->possession == 0.0) return {};
  assert(settings.peer_count == 1 && !settings.is_replicated);
  physics::Halves halves(whole.spec.field.length / 2, settings.goals->possession);
  for (std::uint32_t body = 0; body < whole.body_count; ++body)
    if (whole.has_puck(body)) halves.follow(world, {body});
  return halves;
}

}  // namespace

Whole Whole::of(const Start& start) {
  Whole whole{.spec = start.spec(), .body_count = start.body_count()};
  if (whole.spec.field.goal_width == 0.0) return whole;
  assert(whole.spec.field.goal_width > 0.0);
  start.visit([&](std::uint32_t, const physics::World& world, physics::BodyId id) {
    whole.puck_radii.push_back(world.kind(id) == physics::BodyKind::puck ? world.radius(id) : 0.0);
  });
  return whole;
}

Session::Session(const Start& start, const Cuts& cuts, SessionSettings settings, Mail& mail,
                 const std::function<void()>& when_taken)
    : settings_(std::move(settings)),
      mail_(mail),
      whole_(Whole::of(start)),
      agreement_(settings_, whole_),
      now_{.members = std::vector<PeerNumber>(settings_.peer_count), .cuts = cuts},
      before_(now_),
      division_(cuts.division(settings_.peer_count)),
      inbox_(settings_, Validator(start), mail, false),
      standby_(settings_, inbox_, mail_) {
  assert(settings_.number < settings_.peer_count && settings_.halo > 0.0);
  assert(settings_.window_count > 0 && settings_.end_of);
  std::iota(now_.members.begin(), now_.members.end(), PeerNumber{0});
  now_.slots = now_.next_number = settings_.peer_count;
  now_.players = settings_.players;
  for (const Player& player : now_.players)
    now_.bats_taken = std::max(now_.bats_taken, player.first_bat + player.bat_count);
  before_ = now_;
  standby_.make_room(now_.slots), inbox_.make_room(now_.slots);
  inbox_.remember(before_);
  const Validator& scene = inbox_.validator();
  const PartSnapshot near =
      part_at_start(start, division_, settings_.number, settings_.halo, scene);
  if (settings_.is_replicated) standby_.begin_others(start, now_);
  if (when_taken) when_taken();
  peer_.emplace(whole_.spec, division_, settings_.number, whole_.body_count, settings_.halo);
  peer_->validate_by(scene);
  if (settings_.keeps_to_neighbours) peer_->keep_to_neighbours(false);
  [[maybe_unused]] const bool is_read =
      unpack(near.states, scene,
             [this](const Handover::Body& body) { peer_->consider(body.number, body.state); });
  assert(is_read);
  for (const Key& key : settings_.keys) peer_->press_first(key);
  for (const Player& player : now_.players)
    for (const Seat& seat : settings_.seats_of(player)) peer_->players().seat(seat);
  now_.scoring.halves = halves_at_start(whole_, settings_, peer_->world());
  peer_->begin(settings_.end_of(1));
  if (settings_.is_replicated) standby_.begin_own(peer_->part_log());
  if constexpr (checks_whole_structures) now_.check();
}

/// Sends what `make(to)` makes to the addressees, and receives theirs.
template <class Make>
void Session::exchange(const Addressees& addressees, Make&& make,
                       const std::function<void()>& meanwhile) {
  for (const PeerNumber to : addressees.to) mail_.send(to, written(make(to)));
  if (meanwhile) meanwhile();
  for (const PeerNumber from : addressees.from)
    peer_->receive(from, inbox_.received<decltype(make(from))>(from, now_));
  inbox_.give_up_accused(peer_->accusation());
}

void Session::advance() {
  for (;;) try {
      const bool is_awaited = inbox_.must_recover() && settings_.losses.are_set();
      if (inbox_.must_recover()) recover();
      if (!is_over() && !is_awaited) play_window();
      return;
    } catch (const LossTold&) {
    } catch (const PeerGone& gone) {
      inbox_.note_gone(gone.peer(), gone.what(), gone.has_finished());
    }
}

void Session::play_window() {
  const std::uint64_t window = now_.window + 1;
  while (now_.window < window && !has_left_) play_stretch();
}

void Session::play_stretch() {
  inbox_.defer_faults(settings_.agrees_by_tree(now_.members.size()));
  announce();
  assert(now_.has(settings_.number));
  follow(*peer_, now_.scoring.halves);
  State next = now_;
  double next_end = 0.0;
  const auto enter_next = [&] {
    Accusation accusation;
    next =
        agreement_.next(now_, peer_->verdicts(), peer_->share().roles(), peer_->now(), accusation);
    inbox_.give_up_accused(accusation);
    if (!next.scoring.is_over) next.scoring.halves = peer_->share().halves();
    next_end = agreement_.stretch_end(next);
    if (next.zones == now_.zones) return;
    division_ = next.division();
    peer_->divide(division_);
    counters_.shifts += next.slots == now_.slots && next.cuts.peers() == now_.cuts.peers();
  };
  // Without replicas all peers stay, so the mail's collective can be used, unless goals or keys
  // must be sent.
  const bool is_short = !settings_.is_replicated && !settings_.goals && now_.bats_taken == 0 &&
                        !settings_.takes_latecomers;
  const auto agree_all = [&] {
    if (is_short) return peer::agree(*peer_, settings_.peer_count, mail_);
    std::vector<std::vector<std::uint8_t>> words;
    if (settings_.agrees_by_tree(now_.members.size())) {
      words.push_back(TreeAgreement(now_, *peer_, inbox_, mail_).run());
      inbox_.give_up_accused(peer_->accusation());
      if (settings_.is_replicated) inbox_.note_round(now_, words);
      return;
    }
    exchange(all_but(settings_.number, now_.members),
             [&](PeerNumber) { return peer_->verdicts().own(); });
    if (!settings_.is_replicated) return;
    for (const PeerNumber peer : now_.members) words.push_back(written(peer_->verdicts().of(peer)));
    inbox_.note_round(now_, words);
  };
  const auto exchange_with = [&](const Addressees& addressees, auto&& make,
                                 const std::function<void()>& meanwhile) {
    exchange(addressees, make, meanwhile);
  };
  const bool is_cut =
      peer_->end() < settings_.end_of(now_.window + 1);  // then the window continues after it
  WindowHooks hooks = is_cut ? WindowHooks{} : settings_.hooks;
  hooks.when_final = enter_next;
  play_steps(*peer_, next_end, exchange_with, agree_all, hooks);
  inbox_.give_up_accused(peer_->accusation());  // before its states become the next step's
  if (settings_.goals) face_off(next);
  // A puck that found no place is due again, which rounding can put a little before the end of the
  // window.
  if (const double end = agreement_.stretch_end(next); end != next_end) peer_->end_at(end);
  if (settings_.is_replicated) log_stretch(next);
  else log_.insert(log_.end(), peer_->log().begin(), peer_->log().end());
  assert(next.step == now_.step + 1 && next.time > now_.time);
  has_left_ = !next.has(settings_.number) || (wishes_to_leave_ && next.members.size() == 1);
  adopt(std::move(next));
  inbox_.enter();
  if (settings_.when_committed) settings_.when_committed();
}

/// The log of who has left goes with whoever kept it.
void Session::log_stretch(const State& next) {
  PartRecord record = peer_->part_log().record();
  for (const PeerNumber leaver : now_.members)
    if (!next.has(leaver) && standby_.replicas().keeps(leaver, now_)) {
      const std::vector<Key> log = standby_.replicas().log(leaver);
      record.inherited.insert(record.inherited.end(), log.begin(), log.end());
    }
  standby_.pass({now_, next}, *peer_, std::move(record));
}

void Session::adopt(State next) {
  for (const PeerNumber peer : now_.members)
    if (!next.has(peer) && peer != settings_.number) {
      mail_.part(peer, false);
      peer_->set_present(peer, false);
    }
  standby_.make_room(next.slots), inbox_.make_room(next.slots);
  if (settings_.is_replicated && next.has(settings_.number)) greet(next);
  before_ = std::exchange(now_, std::move(next));
  if constexpr (checks_whole_structures) now_.check();
  std::erase_if(sent_, [&](const Sent& sent) { return sent.step + 2 <= now_.step; });
}

void Session::press(const Observation& seen, const Press& press) {
  peer_->players().press(seen.owner, press);
  this->press(press);
}

void Session::press(const Press& press) {
  if (settings_.is_replicated) sent_.push_back({now_.step + 1, press});
}

SessionCounters Session::counters() const {
  SessionCounters all = counters_;
  all.replica_bytes = standby_.bytes(), all.replica_snapshots = standby_.snapshots();
  all.peer += peer_->counters();
  return all;
}

/// Of all members, by peer.
std::vector<Handover> Session::last_parts() {
  Handover own = own_bodies(*peer_);
  own.window = static_cast<std::uint32_t>(now_.window);
  own.keys = settings_.is_replicated ? standby_.replicas().log(settings_.number) : log_;
  std::vector<Handover> parts(now_.slots);
  for (const PeerNumber to : now_.members)
    if (to != settings_.number) mail_.send(to, written(own));
  for (const PeerNumber from : now_.members) {
    if (from == settings_.number) continue;
    parts[from] = inbox_.final_handover(from, now_);
    const std::string fault = fault_of_part(peer_->share(), division_, from, parts[from]);
    if (!fault.empty()) inbox_.give_up(from, fault);
  }
  parts[settings_.number] = std::move(own);
  return parts;
}

std::vector<Handover> Session::end() {
  wishes_to_leave_ = false;
  std::vector<Handover> all;
  for (;;) try {
      if (inbox_.must_recover()) recover(), all.clear();
      if (!is_over() && settings_.losses.are_set()) return {};
      while (!is_over()) play_window();
      if (has_left_) return {};
      all = last_parts();
      inbox_.confirm(all, now_);
      return all;
    } catch (const LossTold&) {
    } catch (const PeerGone& gone) {
      // Whoever has left in good order had the confirmations of all.
      if (!all.empty() && gone.has_finished() && inbox_.is_confirmed(now_)) return all;
      inbox_.note_gone(gone.peer(), gone.what(), gone.has_finished());
    }
}

}  // namespace rink::peer
