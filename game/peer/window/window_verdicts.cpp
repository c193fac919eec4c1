// Accepts a run or widens the halo, and decides who repeats.
#include "game/peer/window/window_verdicts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "game/peer/rounding.h"

namespace rink::peer {

namespace {

/// The factors by which halos that are too narrow grow, and all others shrink slowly.
constexpr double widening = 1.25, narrowing = 1.0 - 2e-4;
constexpr std::uint32_t attempts_max = 40;
/// By then every halo covers the whole field if needed, and honest runs of the same states agree. A
/// peer that still doubts a ghost blames its owner; one that trusts all of them waits a little
/// longer, then blames those that do not accept.
constexpr std::uint32_t attempts_before_blame = attempts_max + 64,
                        attempts_before_blaming_doubt = attempts_before_blame + 8;
/// So few peers need 8 events at one instant each before these count as endless together; listing
/// their times would cost more.
constexpr PeerNumber few_peers = 8;

std::vector<Goal> goals_of(const Share& share) {
  const physics::World& world = share.world();
  std::vector<Goal> goals;
  if (world.spec().field.goal_width == 0.0) return goals;
  std::vector<std::uint32_t> pucks;
  for (const physics::BeforeImages::KeptState& kept : share.subdomain().before().states())
    if (share.owns(kept.body) && kept.state.kind == physics::BodyKind::puck &&
        !world.is_in_play({kept.body}) && !share.subdomain().was_gone(kept.body))
      pucks.push_back(kept.body);
  std::sort(pucks.begin(), pucks.end());
  for (const std::uint32_t puck : pucks) {
    const physics::Motion last = world.motion({puck});
    goals.push_back({last.time, puck, last.position.x() < 0.5 * world.spec().field.length});
  }
  return goals;
}

std::vector<std::uint8_t> parts_of(const std::vector<double>& times, const Window& window) {
  assert(window.end >= window.start);
  std::vector<std::uint8_t> parts;
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
  verdict.at_once_max = std::max(journal.at_once_max, physics::most_at_once(journal.times));
  verdict.had_solver_failed = journal.had_solver_failed;
  if (halos.present_count() > few_peers && journal.times.size() <= Verdict::listed_max)
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

const Verdict& WindowVerdicts::decide(Verdict verdict, bool agrees, double needed) {
  const double halo = halos_.own();
  verdict.accepts = agrees && needed <= halo;
  if (verdict.accepts) {
    if (halo < infinity) usual_halo_ = std::max(halo_min_, narrowing * halo);
    verdict.halo = rounded_up(usual_halo_);
  } else {
    const double wider = std::max(widening * halo, 1.05 * needed);
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

Outcome WindowVerdicts::conclude() {
  assert(verdicts_.size() == halos_.peer_count() && halos_.is_present(halos_.number()));
  bool solver_failed = false, is_final = true;
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) {
    if (!halos_.is_present(peer))
      verdicts_[peer] = {.accepts = true, .halo = static_cast<float>(halos_.of(peer))};
    solver_failed = solver_failed || verdicts_[peer].had_solver_failed;
    is_final = is_final && verdicts_[peer].accepts;
  }
  // The engine's last resorts against endless series at one instant count events in the whole
  // field.
  const bool needs_whole =
      (at_once_bound() >= physics::events_at_once_local || solver_failed) && !halos_.are_whole();
  for (PeerNumber peer = 0; peer < verdicts_.size(); ++peer) {
    is_repeating_[peer] = needs_whole || !verdicts_[peer].accepts;
    if (needs_whole) halos_.set(peer, infinity);
    else if (is_final || is_repeating_[peer]) halos_.set(peer, verdicts_[peer].halo);
  }
  if (is_final && !needs_whole) return Outcome::final;
  ++attempts_;
  return Outcome::repeat;
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
