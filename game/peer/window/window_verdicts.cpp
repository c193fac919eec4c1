// Accepts a run or widens the halo, and decides who repeats.
#include "game/peer/window/window_verdicts.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "game/peer/rounding.h"

namespace rink::peer {

namespace {

/// The factors by which halos that are too narrow grow, and all others shrink slowly.
constexpr double widening = 1.25, narrowing = 1.0 - 2e-4;
constexpr std::uint32_t attempts_max = 40;
/// After so many, annexes do not find what a halo may. If they do, the halo grows by little.
constexpr std::uint32_t annex_attempts_max = 4;
constexpr double annex_widening = 1.05;
/// By then every halo covers the whole field if needed, and honest runs of the same states agree. A
/// peer that still doubts a ghost blames its owner; one that trusts all of them waits a little
/// longer, then blames those that do not accept.
constexpr std::uint32_t attempts_before_blame = attempts_max + 64,
                        attempts_before_blaming_doubt = attempts_before_blame + 8;
/// So few peers need 8 events at one instant each before these count as endless together; listing
/// their times would cost more.
constexpr PeerNumber few_peers = 8;

std::vector<Goal> goals_of(const Share& share) {
  const physics::PartWorld& world = share.world();
  std::vector<Goal> goals;
  if (world.spec().field.goal_width == 0.0) return goals;
  std::vector<std::uint32_t> pucks;
  for (const physics::BeforeImages::KeptState& kept : share.subdomain().before().states()) {
    const std::uint32_t body = share.subdomain().number_of(kept.body);
    if (share.owns(body) && kept.state.kind == physics::BodyKind::puck &&
        !world.is_in_play({body}) && !share.subdomain().was_gone(body))
      pucks.push_back(body);
  }
  std::sort(pucks.begin(), pucks.end());
  for (const std::uint32_t puck : pucks) {
    const physics::Motion last = world.motion({puck});
    goals.push_back({last.time, puck, last.position.x() < 0.5 * world.spec().field.length});
  }
  return goals;
}

/// If each peer has no more events than this at any instant, all together have too few to matter,
/// unless there are too many peers.
std::uint64_t usual_at_once(const Halos& halos) {
  return std::max<std::uint64_t>(1, (physics::events_at_once_local - 1) / halos.present_count());
}

/// Most runs have nothing to say, and say it at once.
void note_instants(const Share& share, std::uint64_t usual, Verdict& verdict) {
  const physics::Journal& journal = share.subdomain().journal();
  verdict.at_once_max = std::max(journal.at_once_max, physics::most_at_once(journal.times));
  if (verdict.at_once_max <= usual && journal.unsolved.empty()) return;
  RunInstants instants = instants_of(share, usual);
  verdict.at_once_max = instants.at_once_max, verdict.critical = std::move(instants.critical);
  if (verdict.critical.size() <= Verdict::critical_max) return;
  verdict.critical.clear(), verdict.at_once_max = physics::events_at_once_local;
}

std::vector<std::uint8_t> parts_of(const std::vector<double>& times, const Window& window) {
  assert(window.end >= window.start);
  std::vector<std::uint8_t> parts;
  parts.reserve(times.size());
  for (const double time : times)
    parts.push_back(static_cast<std::uint8_t>(
        std::clamp(256.0 * (time - window.start) / (window.end - window.start), 0.0, 255.0)));
  return parts;
}

}  // namespace

Verdict verdict_on_run(const Share& share, const Halos& halos, const Window& window) {
  const physics::Journal& journal = share.subdomain().journal();
  Verdict verdict;
  verdict.window = window.number;
  note_instants(share, usual_at_once(halos), verdict);
  // Where too many instants were critical to be said, the count must stand for all of them.
  const bool says_all =
      !verdict.critical.empty() || verdict.at_once_max < physics::events_at_once_local;
  if (says_all && halos.present_count() > few_peers && journal.times.size() <= Verdict::listed_max)
    verdict.listed = parts_of(journal.times, window);
  verdict.goals = goals_of(share);
  return verdict;
}

WindowVerdicts::WindowVerdicts(Halos& halos, double halo_max)
    : halos_(halos),
      halo_min_(0.25 * halos.own()),
      halo_max_(halo_max),
      usual_halo_(halos.own()),
      verdicts_(halos.peer_count()),
      is_repeating_(halos.peer_count(), false) {
  assert(halo_max > 0.0);
}

const Verdict& WindowVerdicts::decide(Verdict verdict, bool agrees, double needed,
                                      bool shows_cause) {
  const double halo = halos_.own();
  verdict.accepts = agrees && needed <= halo;
  if (verdict.accepts) {
    if (halo < infinity) usual_halo_ = std::max(halo_min_, narrowing * halo);
    verdict.halo = rounded_up(usual_halo_);
  } else {
    const bool is_wide_enough = shows_cause && needed <= halo && attempts_ < annex_attempts_max;
    const double wider =
        is_wide_enough ? annex_widening * halo : std::max(widening * halo, 1.05 * needed);
    if (wider > halo_max_ || attempts_ >= attempts_max)
      verdict.halo = std::numeric_limits<float>::infinity();
    else usual_halo_ = wider, verdict.halo = rounded_up(wider);
  }
  assert(verdict.halo >= 0.0f && (verdict.accepts || verdict.halo > 0.0f));
  return verdicts_[halos_.number()] = std::move(verdict);
}

void WindowVerdicts::receive(PeerNumber from, const Verdict& verdict) {
  assert(from < verdicts_.size() && from != halos_.number());
  verdicts_[from] = verdict;
}

/// An upper bound of the events at any one instant in the whole. An instant, which is a few
/// roundings long, may span two neighbouring parts of the window.
std::uint64_t WindowVerdicts::at_once_bound() const {
  std::uint64_t sum = 0, unlisted = 0;
  for (const Verdict& verdict : verdicts_) sum += verdict.at_once_max;
  if (sum < physics::events_at_once_local) return sum;
  std::array<std::uint64_t, 256> listed{};
  for (const Verdict& verdict : verdicts_) {
    std::array<std::uint64_t, 257> own{};
    for (const std::uint8_t part : verdict.listed) ++own[part];
    if (verdict.listed.empty()) unlisted += verdict.at_once_max;
    else
      for (std::size_t part = 0; part < 256; ++part)
        listed[part] += std::min(verdict.at_once_max, own[part] + own[part + 1]);
  }
  return unlisted + *std::max_element(listed.begin(), listed.end());
}

/// What a peer adds to any instant that it does not list.
std::uint64_t WindowVerdicts::unlisted(PeerNumber peer) const {
  const Verdict& verdict = verdicts_[peer];
  return verdict.critical.empty() ? verdict.at_once_max
                                  : std::min(verdict.at_once_max, usual_at_once(halos_));
}

/// With so many peers, or so many events, listed instants tell nothing about others.
bool WindowVerdicts::may_be_anywhere() const {
  if (at_once_bound() < physics::events_at_once_local) return false;
  std::uint64_t sum = 0;
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) sum += unlisted(peer);
  return sum >= physics::events_at_once_local;
}

/// Critical instants of all peers, those of one time together.
std::vector<AskedInstant> WindowVerdicts::instants_to_ask() const {
  struct Listed {
    CriticalInstant instant;
    PeerNumber peer;
  };
  std::vector<Listed> all;
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer)
    for (const CriticalInstant& one : verdicts_[peer].critical) all.push_back({one, peer});
  std::ranges::stable_sort(all, {}, [](const Listed& one) { return one.instant.time; });
  const bool may_be_many = at_once_bound() >= physics::events_at_once_local;
  std::vector<AskedInstant> asked;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    std::vector<std::uint64_t> counts;
    for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) counts.push_back(unlisted(peer));
    AskedInstant one{all[begin].instant.time, all[begin].instant.time, false};
    for (; end < all.size() && all[end].instant.time <= one.high + 3.0 * instant_margin(one.high);
         ++end) {
      const auto& [instant, peer] = all[end];
      one.high = instant.time, one.is_unsolved = one.is_unsolved || instant.is_unsolved;
      counts[peer] = std::max(counts[peer], instant.events);
    }
    const bool are_many = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) >=
                          physics::events_at_once_local;
    one.low -= instant_margin(one.low), one.high += 2.0 * instant_margin(one.high);
    if (one.is_unsolved || (may_be_many && are_many)) asked.push_back(one);
  }
  return asked;
}

/// Whether all peers that have own events then have had the right count of them, or all that are in
/// the field: those events, in that order, are then the truth's.
bool WindowVerdicts::is_settled(const AskedInstant& asked, std::size_t place) const {
  std::uint64_t own = 0, led = 0;
  bool are_few = !asked.is_unsolved, are_same = true;
  const InstantReport* first = nullptr;
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) {
    if (!halos_.is_present(peer)) continue;
    // Who says nothing of it may have had events then: Peer names it.
    if (place >= verdicts_[peer].reports.size()) return false;
    const InstantReport& report = verdicts_[peer].reports[place];
    if (report.own == 0) continue;
    if (first == nullptr) first = &report;
    own += report.own, led += report.led;
    are_few = are_few && report.events < physics::events_at_once_local;
    are_same = are_same && report.events == first->events && report.digest == first->digest;
  }
  return first == nullptr || (are_few && own < physics::events_at_once_local) ||
         (are_same && led == first->events);
}

/// Only who has own events at such an instant needs to see all that comes then. If that does not
/// help, somebody else has missed something, so that all look.
void WindowVerdicts::repeat_unsettled(std::span<const AskedInstant> asked) {
  bool is_settled_everywhere = true, is_wider = false;
  for (std::size_t place = 0; place < asked.size(); ++place) {
    if (is_settled(asked[place], place)) continue;
    is_settled_everywhere = false;
    for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) {
      const std::vector<InstantReport>& reports = verdicts_[peer].reports;
      if (place >= reports.size() || reports[place].own == 0 || halos_.of(peer) == infinity)
        continue;
      repeat_with_whole(peer), is_wider = true;
    }
  }
  if (is_settled_everywhere || is_wider) return;
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) repeat_with_whole(peer);
}

void WindowVerdicts::repeat_with_whole(PeerNumber peer) {
  is_repeating_[peer] = true;
  verdicts_[peer].halo = std::numeric_limits<float>::infinity();
}

/// The engine's last resorts against endless series at one instant count events in the whole field.
/// That is looked into once all accept: before, runs have events that nobody will have.
void WindowVerdicts::look_at_instants(std::span<const AskedInstant> reported) {
  if (halos_.are_whole() || !std::ranges::all_of(verdicts_, &Verdict::accepts)) return;
  if (may_be_anywhere())
    for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) repeat_with_whole(peer);
  else if (reported.empty()) asked_ = instants_to_ask();
  else repeat_unsettled(reported);
}

void WindowVerdicts::set_halo(PeerNumber peer) {
  halos_.set(peer, verdicts_[peer].halo);
  const std::vector<Annex>& announced = verdicts_[peer].annexes;
  if (announced.empty() && halos_.annexes(peer).empty()) return;
  std::vector<Box> annexes;
  annexes.reserve(announced.size());
  for (const Annex& annex : announced) annexes.push_back(annex.box());
  halos_.set_annexes(peer, std::move(annexes));
}

Outcome WindowVerdicts::conclude() {
  assert(verdicts_.size() == halos_.peer_count() && halos_.is_present(halos_.number()));
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) {
    if (!halos_.is_present(peer))
      verdicts_[peer] = {.accepts = true, .halo = static_cast<float>(halos_.of(peer))};
    is_repeating_[peer] = !verdicts_[peer].accepts;
  }
  const std::vector<AskedInstant> reported = std::exchange(asked_, {});
  look_at_instants(reported);
  if (!asked_.empty()) return Outcome::repeat;
  const bool is_final = std::ranges::none_of(is_repeating_, std::identity());
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer)
    if (is_final || is_repeating_[peer]) set_halo(peer);
  if (is_final) return Outcome::final;
  ++attempts_;
  return Outcome::repeat;
}

double WindowVerdicts::reach() const {
  double widest = 0.0;
  for (const Verdict& verdict : verdicts_)
    widest = std::max(widest, static_cast<double>(verdict.reach));
  return widest;
}

bool WindowVerdicts::is_stuck() const { return attempts_ >= attempts_before_blame; }

/// Without blame, a false claim that is possible and was accepted would repeat the window for ever.
void WindowVerdicts::blame_refusing(const Window& window, Accusation& accusation) const {
  if (attempts_ < attempts_before_blaming_doubt) return;
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer)
    if (peer != halos_.number() && halos_.is_present(peer) && !verdicts_[peer].accepts)
      accusation.report(peer, "accepts no run of window " + std::to_string(window.number));
}

void WindowVerdicts::make_room(PeerNumber peer_count) {
  assert(peer_count >= verdicts_.size());
  verdicts_.resize(peer_count), is_repeating_.resize(peer_count, false);
}

}  // namespace rink::peer
