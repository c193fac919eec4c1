// Decides the next step, subject by subject. docs/peer-to-peer.md, "Joining while others play".
#include "game/peer/session/agreement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace rink::peer {

namespace {

bool lists(const std::vector<PeerNumber>& peers, PeerNumber peer) {
  return std::find(peers.begin(), peers.end(), peer) != peers.end();
}

bool has_token(const std::vector<Candidate>& all, std::uint64_t token) {
  return std::ranges::any_of(all,
                             [&](const Candidate& one) { return one.newcomer.token == token; });
}

/// True if a peer will be there, and have a zone.
bool stays(const State& next, PeerNumber peer) { return next.has(peer) && next.cuts.has(peer); }

}  // namespace

double Agreement::stretch_end(const State& state) const {
  return std::min(settings_.end_of(state.window + 1), state.scoring.next_after(state.time));
}

bool Agreement::is_complete(const State& state) const {
  return state.window == settings_.window_count ||
         (state.scoring.is_over && state.time == settings_.end_of(state.window));
}

bool Agreement::may_be_entry(const State& state, PeerNumber teller) const {
  const auto is_due = [&](const FaceOff& due) { return whole_.has_puck(due.puck); };
  return state.is_sound_for(settings_.number) &&
         std::ranges::all_of(state.scoring.face_offs, is_due) && state.has(teller) &&
         is_in_time(state);
}

/// At the end of a window, or within the next one if that is cut, and at least two windows before
/// the end.
bool Agreement::is_in_time(const State& state) const {
  if (settings_.window_count < 2 || state.window > settings_.window_count - 2) return false;
  const double begin = state.window == 0 ? 0.0 : settings_.end_of(state.window);
  return state.time == begin ||
         (settings_.goals && state.time > begin && state.time < settings_.end_of(state.window + 1));
}

State Agreement::next(const State& now, const WindowVerdicts& verdicts, const Roles& roles,
                      double time, Accusation& accusation) const {
  assert(time > now.time);
  State next = now;
  const Step step{now, verdicts, next};
  ++next.step;
  next.time = time;
  next.window += next.time == settings_.end_of(now.window + 1);
  count_goals(step, roles, accusation);
  next.members = now.next_voters();
  give_zones(step);
  let_go(step);
  if (settings_.is_replicated) admit(step);
  if (settings_.balance_windows > 0) balance(step);
  return next;
}

/// Counts the goals in the final verdicts of all.
void Agreement::count_goals(const Step& step, const Roles& roles, Accusation& accusation) const {
  if (!settings_.goals) return;
  std::vector<Goal> goals;
  const std::vector<FaceOff>& due = step.now.scoring.face_offs;
  const auto may_count = [&](PeerNumber peer, std::uint32_t puck) {
    return roles.owns(puck) ? peer == settings_.number
                            : !roles.has_ghost(puck) || roles.has_ghost_of(peer, puck);
  };
  for (const PeerNumber peer : step.now.members) {
    for (const Goal& goal : step.verdicts.of(peer).goals) {
      const auto is_of_it = [&](const auto& other) { return other.puck == goal.puck; };
      const bool can_be = whole_.has_puck(goal.puck) && goal.time >= step.now.time - 1e-9 &&
                          goal.time <= step.next.time + 1e-9 &&
                          std::ranges::none_of(goals, is_of_it) &&
                          std::ranges::none_of(due, is_of_it) && may_count(peer, goal.puck);
      if (can_be) goals.push_back(goal);
      else accusation.report(peer, "sent a goal that cannot be");
    }
  }
  step.next.scoring.count(std::move(goals), *settings_.goals);
}

/// Gives new members half of the zone of the busiest peer since zones changed last.
void Agreement::give_zones(const Step& step) {
  const auto& [now, verdicts, next] = step;
  next.fresh.clear();
  for (const PeerNumber newcomer : now.fresh) {
    std::optional<std::pair<double, double>> most;
    PeerNumber busiest = 0;
    for (const PeerNumber peer : next.cuts.peers()) {
      const double counted = peer < now.events.size() ? now.events[peer] : 0.0;
      const std::pair load(counted + static_cast<double>(verdicts.of(peer).events),
                           next.cuts.area_of(peer));
      if (!most || load > *most) most = load, busiest = peer;
    }
    assert(most && next.has(newcomer));
    next.cuts = next.cuts.with(newcomer, busiest);
    ++next.zones;
  }
}

/// Those that want to leave have no zone any more, unless it is the last one.
void Agreement::let_go(const Step& step) {
  const auto& [now, verdicts, next] = step;
  for (const PeerNumber peer : now.members)
    if (stays(next, peer) && verdicts.of(peer).leaves && next.cuts.peers().size() > 1)
      next.cuts = next.cuts.without(peer), ++next.zones;
}

std::optional<std::string> Agreement::objection(const State& next, const Newcomer& newcomer) const {
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

/// Drops candidates, makes one of them a member, and adds new ones.
void Agreement::admit(const Step& step) const {
  const auto& [now, verdicts, next] = step;
  const auto is_reached = [&](const Candidate& candidate) {
    return std::ranges::all_of(step.now.members, [&](PeerNumber peer) {
      return !step.next.has(peer) ||
             lists(step.verdicts.of(peer).admission.reached, candidate.number);
    });
  };
  std::erase_if(next.admitted, [&](const Candidate& one) { return !step.next.has(one.number); });
  std::erase_if(next.candidates, [&](const Candidate& one) {
    return !stays(step.next, one.sponsor) ||
           lists(step.verdicts.of(one.sponsor).admission.withdrawn, one.number);
  });
  if (next.window + 2 > settings_.window_count || next.scoring.is_over) next.candidates.clear();
  const auto first = std::ranges::find_if(next.candidates, is_reached);
  if (first != next.candidates.end()) {
    next.members.insert(std::ranges::upper_bound(next.members, first->number), first->number);
    next.fresh = {first->number};
    next.players.push_back({first->number, first->first_bat, first->newcomer.bat_count,
                            first->newcomer.puck_count, first->newcomer.hand_count});
    next.zones += first->number >= next.slots;  // so that all have a slot for it
    next.slots = std::max(next.slots, first->number + 1);
    next.admitted.push_back(std::move(*first));
    next.candidates.erase(first);
  }
  add_candidates(step);
}

void Agreement::add_candidates(const Step& step) const {
  const auto& [now, verdicts, next] = step;
  for (const PeerNumber sponsor : now.members) {
    if (!stays(next, sponsor)) continue;
    for (const Newcomer& newcomer : verdicts.of(sponsor).admission.asking) {
      // A token stands for one newcomer, whoever repeats it.
      if (has_token(next.candidates, newcomer.token) || has_token(next.admitted, newcomer.token) ||
          objection(next, newcomer))
        continue;
      next.candidates.push_back({next.next_number++, sponsor, next.bats_taken, newcomer});
      next.bats_taken += newcomer.bat_count;
      assert(next.next_number <= numbers_max && next.candidates.size() < members_max);
    }
  }
}

/// Balances by the loads that all have sent since zones changed last. Differences within three
/// standard deviations of a Poisson number move nothing.
void Agreement::balance(const Step& step) const {
  constexpr double tolerance = 1.1, deviations = 3.0;
  const auto& [now, verdicts, next] = step;
  assert(next.events.size() <= now.slots && !next.members.empty());
  next.events.resize(now.slots, 0.0);
  for (const PeerNumber peer : now.members)
    next.events[peer] += static_cast<double>(verdicts.of(peer).events);
  if (++next.counted_windows < settings_.balance_windows && next.zones == now.zones) return;
  const double all = std::accumulate(next.events.begin(), next.events.end(), 0.0),
               mean = all / static_cast<double>(next.members.size());
  if (next.zones == now.zones && mean > 0.0) {
    auto shifted = next.cuts.balanced(next.events, tolerance + deviations / std::sqrt(mean));
    if (shifted) next.cuts = std::move(*shifted), ++next.zones;
  }
  next.counted_windows = 0;
  next.events.clear();
}

}  // namespace rink::peer
