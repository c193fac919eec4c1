// Plays windows in steps, and keeps replicas of others' parts.
#include "game/peer/session/session.h"

#include <cassert>
#include <iterator>
#include <numeric>
#include <utility>

#include "im/basics/checked.h"

namespace rink::peer {

Whole Whole::of(const physics::World& world) {
  Whole whole{.spec = world.spec(), .body_count = world.body_count()};
  if (whole.spec.field.goal_width == 0.0) return whole;
  assert(whole.spec.field.goal_width > 0.0);
  for (std::uint32_t body = 0; body < whole.body_count; ++body)
    whole.puck_radii.push_back(world.kind({body}) == physics::BodyKind::puck ? world.radius({body})
                                                                             : 0.0);
  return whole;
}

Session::Session(const physics::World& whole, const Cuts& cuts, SessionSettings settings,
                 Mail& mail, const std::function<void()>& when_taken)
    : settings_(std::move(settings)),
      mail_(mail),
      whole_(Whole::of(whole)),
      agreement_(settings_, whole_),
      now_{.members = std::vector<PeerNumber>(settings_.peer_count), .cuts = cuts},
      before_(now_),
      division_(cuts.division(settings_.peer_count)),
      replicas_(settings_.number),
      inbox_(settings_, Validator(whole), mail, false) {
  assert(settings_.number < settings_.peer_count && settings_.halo > 0.0);
  assert(whole.now() == 0.0 && settings_.window_count > 0 && settings_.end_of);
  std::iota(now_.members.begin(), now_.members.end(), PeerNumber{0});
  now_.slots = now_.next_number = settings_.peer_count;
  now_.players = settings_.players;
  for (const Player& player : now_.players)
    now_.bats_taken = std::max(now_.bats_taken, player.first_bat + player.bat_count);
  before_ = now_;
  replicas_.make_room(now_.slots), inbox_.make_room(now_.slots);
  std::vector<Handover::Body> near;
  for (std::uint32_t body = 0; body < whole_.body_count; ++body)
    if (division_.is_near(settings_.number,
                          Box::around(whole.position({body}), whole.half_extent({body})),
                          settings_.halo) ||
        division_.owner_of(whole.position({body})) == settings_.number)
      near.push_back({body, physics::Subdomain::state_in(whole, body)});
  if (settings_.is_replicated) replicas_.begin(whole, now_, division_);
  if (when_taken) when_taken();
  peer_.emplace(whole_.spec, division_, settings_.number, whole_.body_count, settings_.halo);
  peer_->validate_by(inbox_.validator());
  for (const auto& [body, state] : near) peer_->consider(body, state);
  for (const Key& key : settings_.keys) peer_->press_first(key);
  for (const Player& player : now_.players)
    for (const Seat& seat : settings_.seats_of(player)) peer_->players().seat(seat);
  if (settings_.is_replicated) peer_->keep_changes();
  peer_->begin(settings_.end_of(1));
  if constexpr (checks_whole_structures) now_.check();
}

/// Sends what `make(to)` makes to all members, and receives theirs.
template <class Make>
void Session::exchange(Make&& make, const std::function<void()>& meanwhile) {
  for (const PeerNumber to : now_.members)
    if (to != settings_.number) mail_.send(to, written(make(to)));
  if (meanwhile) meanwhile();
  for (const PeerNumber from : now_.members)
    if (from != settings_.number)
      peer_->receive(from, inbox_.received<decltype(make(from))>(from, now_));
  if (const Accusation& found = peer_->accusation(); found.is_made())
    inbox_.give_up(found.peer(), found.fault());
}

void Session::advance() {
  for (;;) try {
      if (inbox_.must_recover()) recover();
      if (!is_over()) play_window();
      return;
    } catch (const PeerGone& gone) {
      inbox_.note_gone(gone.peer(), gone.what(), gone.has_finished());
    }
}

void Session::play_window() {
  const std::uint64_t window = now_.window + 1;
  while (now_.window < window && !has_left_) play_stretch();
}

void Session::play_stretch() {
  announce();
  assert(now_.has(settings_.number));
  State next = now_;
  double next_end = 0.0;
  const auto enter_next = [&] {
    Accusation accusation;
    next =
        agreement_.next(now_, peer_->verdicts(), peer_->share().roles(), peer_->now(), accusation);
    if (accusation.is_made()) inbox_.give_up(accusation.peer(), accusation.fault());
    next_end = agreement_.stretch_end(next);
    if (next.zones == now_.zones) return;
    division_ = next.division();
    peer_->divide(division_);
    counters_.shifts += next.slots == now_.slots && next.cuts.peers() == now_.cuts.peers();
  };
  // Without replicas all peers stay, so the mail's collective can be used, unless goals must be
  // sent.
  const auto agree_all = [&] {
    settings_.is_replicated || settings_.goals
        ? exchange([&](PeerNumber) { return peer_->verdicts().own(); })
        : peer::agree(*peer_, settings_.peer_count, mail_);
  };
  const auto exchange_all = [&](auto&& make, const std::function<void()>& meanwhile) {
    exchange(make, meanwhile);
  };
  const bool is_cut =
      peer_->end() < settings_.end_of(now_.window + 1);  // then the window continues after it
  WindowHooks hooks = is_cut ? WindowHooks{} : settings_.hooks;
  hooks.when_final = enter_next;
  play_steps(*peer_, next_end, exchange_all, agree_all, hooks);
  if (settings_.goals) face_off(next);
  // A puck that found no place is due again, which rounding can put a little before the end of the
  // window.
  if (const double end = agreement_.stretch_end(next); end != next_end) peer_->end_at(end);
  if (settings_.is_replicated) {
    PartChange change = peer_->change(false);
    for (const PeerNumber leaver : now_.members)
      if (!next.has(leaver) && replicas_.keeps(leaver, now_)) {
        const std::vector<Key> log = replicas_.log(leaver);
        change.log.insert(change.log.end(), log.begin(), log.end());
      }
    replicate(next, std::move(change));
  } else {
    log_.insert(log_.end(), peer_->log().begin(), peer_->log().end());
  }
  assert(next.step == now_.step + 1 && next.time > now_.time);
  has_left_ = !next.has(settings_.number) || (wishes_to_leave_ && next.members.size() == 1);
  adopt(std::move(next));
  inbox_.enter();
}

/// Updates the replicas of the own part, here and at another peer, and those of others here, to the
/// step that leads to `next`.
void Session::replicate(const State& next, PartChange change) {
  change.step = next.step;
  [[maybe_unused]] const bool is_next = replicas_.add(settings_.number, change);
  assert(is_next);
  const auto to =
      next.has(settings_.number) ? Replicas::keeper_of(settings_.number, next) : std::nullopt;
  if (to) {
    if (!change.is_whole &&
        (to != Replicas::keeper_of(settings_.number, now_) || now_.is_fresh(settings_.number))) {
      change = peer_->change(true);
      change.step = next.step;
      change.log = replicas_.log(settings_.number);
    }
    std::vector<std::uint8_t> bytes = written(std::move(change));
    counters_.replica_bytes += bytes.size();
    mail_.send(*to, std::move(bytes));
  }
  for (const PeerNumber from : next.members) {
    if (from == settings_.number || !now_.has(from) || !replicas_.keeps(from, next)) continue;
    auto kept = inbox_.checked<PartChange>(from, now_, next.time);
    if (const auto body = first_elsewhere(kept.bodies, next.time, division_, {{from}}))
      inbox_.give_up(
          from, "sends body " + std::to_string(*body) + " as its own, which is in another's zone");
    if (kept.step != next.step || !replicas_.add(from, std::move(kept)))
      inbox_.give_up(from, "sent what is not its part at step " + std::to_string(next.step));
  }
}

void Session::adopt(State next) {
  for (const PeerNumber peer : now_.members)
    if (!next.has(peer) && peer != settings_.number) {
      mail_.part(peer, false);
      peer_->set_present(peer, false);
    }
  replicas_.make_room(next.slots), inbox_.make_room(next.slots);
  if (settings_.is_replicated && next.has(settings_.number)) greet(next);
  before_ = std::exchange(now_, std::move(next));
  if constexpr (checks_whole_structures) now_.check();
  std::erase_if(sent_, [&](const Sent& sent) { return sent.step + 2 <= now_.step; });
}

void Session::press(const Observation& seen, const Press& press) {
  peer_->players().press(seen.owner, press);
  if (settings_.is_replicated) sent_.push_back({now_.step + 1, press});
}

SessionCounters Session::counters() const {
  SessionCounters all = counters_;
  all.peer += peer_->counters();
  return all;
}

std::vector<Handover> Session::end() {
  wishes_to_leave_ = false;
  std::vector<Handover> all;
  for (;;) try {
      if (inbox_.must_recover()) recover();
      while (!is_over()) play_window();
      if (has_left_) return {};
      Handover own = own_bodies(*peer_);
      own.window = static_cast<std::uint32_t>(now_.window);
      own.keys = settings_.is_replicated ? replicas_.log(settings_.number) : log_;
      std::vector<Handover> parts(now_.slots);
      for (const PeerNumber to : now_.members)
        if (to != settings_.number) mail_.send(to, written(own));
      for (const PeerNumber from : now_.members)
        if (from != settings_.number) parts[from] = inbox_.final_handover(from, now_);
      parts[settings_.number] = std::move(own);
      all = std::move(parts);
      // No peer leaves before all have received all.
      for (const PeerNumber to : now_.members)
        if (to != settings_.number) mail_.send(to, written(Handover{}));
      for (const PeerNumber from : now_.members)
        if (from != settings_.number) inbox_.received<Handover>(from, now_);
      return all;
    } catch (const PeerGone& gone) {
      if (!all.empty() && gone.has_finished()) return all;
      inbox_.note_gone(gone.peer(), gone.what(), gone.has_finished());
    }
}

}  // namespace rink::peer
