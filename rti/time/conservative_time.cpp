// Clocks, bounds and grants.
#include "rti/time/conservative_time.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "im/basics/checked.h"

namespace rink::rti {

namespace {
constexpr double at_once = -time_unbounded;  ///< a need that any GALT meets
}

const ConservativeTime::Clock& ConservativeTime::clock(std::uint32_t federate) const {
  static const Clock unused;
  return federate < clocks_.size() ? clocks_[federate] : unused;
}

ConservativeTime::Clock& ConservativeTime::clock(std::uint32_t federate) {
  if (federate >= clocks_.size()) {
    clocks_.resize(federate + 1);
    for (LeastTree* tree : {&bounds_, &floors_, &lookaheads_, &needs_}) tree->widen(clocks_.size());
  }
  return clocks_[federate];
}

void ConservativeTime::weigh_all() {
  for (LeastTree* tree : {&bounds_, &floors_, &lookaheads_, &needs_}) tree->widen(clocks_.size());
  for (std::uint32_t i = 0; i < clocks_.size(); ++i) weigh(i);
}

bool ConservativeTime::enable_regulation(std::uint32_t federate, double lookahead) {
  Clock& mine = clock(federate);
  if (mine.is_regulating || mine.is_advancing || !is_valid_lookahead(lookahead)) return false;
  // No message of a newly regulating federate may be in another's past: its time moves at once to
  // one from which that holds, so that the others cannot advance beyond it meanwhile.
  double past = 0.0, horizon = 0.0;
  for (const Clock& other : clocks_) {
    if (&other == &mine || !other.is_constrained) continue;
    past = std::max(past, other.time);
    horizon = std::max(horizon, other.horizon);
  }
  mine.is_regulating = mine.awaits_regulation = true;
  mine.lookahead = lookahead;
  mine.enabling = std::max(mine.time, past - lookahead);
  if (mine.is_constrained)
    horizon =
        std::max(horizon,
                 mine.horizon);  // else another could answer at an instant that is complete for it
  mine.floor = std::max(horizon, mine.enabling + lookahead);
  assert(mine.enabling >= mine.time && mine.floor >= mine.enabling);
  weigh(federate);
  return true;
}

bool ConservativeTime::disable_regulation(std::uint32_t federate) {
  Clock& mine = clock(federate);
  if (!mine.is_regulating) return false;
  mine.is_regulating = mine.awaits_regulation = false;
  weigh(federate);
  return true;
}

bool ConservativeTime::enable_constrained(std::uint32_t federate) {
  Clock& mine = clock(federate);
  if (mine.is_constrained || mine.awaits_constraint || mine.is_advancing) return false;
  mine.awaits_constraint = true;
  weigh(federate);
  return true;
}

bool ConservativeTime::disable_constrained(std::uint32_t federate) {
  Clock& mine = clock(federate);
  if (!mine.is_constrained && !mine.awaits_constraint) return false;
  mine.is_constrained = mine.awaits_constraint = false;
  weigh(federate);
  return true;
}

bool ConservativeTime::modify_lookahead(std::uint32_t federate, double lookahead) {
  Clock& mine = clock(federate);
  if (!mine.is_regulating || mine.awaits_regulation || mine.is_advancing ||
      !is_valid_lookahead(lookahead))
    return false;
  mine.lookahead = lookahead;
  mine.floor =
      std::max(mine.floor, mine.time + lookahead);  // an earlier promise holds: a shorter lookahead
                                                    // takes effect as its time advances
  weigh(federate);
  return true;
}

bool ConservativeTime::request(std::uint32_t federate, AdvanceKind kind, double time) {
  Clock& mine = clock(federate);
  if (mine.is_advancing || mine.awaits_regulation || mine.awaits_constraint ||
      !is_valid_time(time) || time < mine.time)
    return false;
  mine.is_advancing = true;
  mine.kind = kind;
  mine.asked = time;
  if (kind == AdvanceKind::time_advance || kind == AdvanceKind::time_advance_available)
    mine.floor = std::max(mine.floor, earliest_stamp(time, mine.lookahead, kind));
  weigh(federate);
  return true;
}

void ConservativeTime::remove(std::uint32_t federate, TimeListener& listener) {
  if (federate >= clocks_.size()) return;
  while (!clocks_[federate].queue.is_empty())
    listener.discard(federate, clocks_[federate].queue.pop());
  clocks_[federate] = {};
  weigh(federate);
}

bool ConservativeTime::may_send(std::uint32_t federate, double time) const {
  const Clock& mine = clock(federate);
  if (!mine.is_regulating || mine.awaits_regulation || !is_valid_time(time)) return false;
  return time >= mine.floor &&
         (!mine.is_advancing || time >= earliest_stamp(mine.asked, mine.lookahead, mine.kind));
}

double ConservativeTime::earliest(std::uint32_t federate) const {
  const Clock& mine = clock(federate);
  return mine.is_regulating ? mine.floor : time_unbounded;
}

bool ConservativeTime::is_constrained(std::uint32_t federate) const {
  return clock(federate).is_constrained;
}
bool ConservativeTime::is_regulating(std::uint32_t federate) const {
  return clock(federate).is_regulating;
}
double ConservativeTime::time(std::uint32_t federate) const { return clock(federate).time; }

void ConservativeTime::enqueue(std::uint32_t federate, const TimedEntry& entry) {
  Clock& mine = clock(federate);
  assert(mine.is_constrained && entry.time >= mine.horizon && "a message in its receiver's past");
  mine.queue.push(entry);
  if (awaits_message(mine)) weigh(federate);
}

void ConservativeTime::withdraw(std::uint32_t federate, const TimedEntry& entry) {
  clock(federate).queue.withdraw(entry);
  if (awaits_message(clock(federate))) weigh(federate);
}

/// The time that a federate would be granted if no message came meanwhile.
double ConservativeTime::goal(const Clock& clock) {
  assert(clock.is_advancing);
  return is_next_message(clock.kind) ? std::min(clock.asked, clock.queue.next_time()) : clock.asked;
}

double ConservativeTime::need(const Clock& clock) const {
  double least = time_unbounded;
  if (clock.awaits_regulation) least = clock.is_constrained ? clock.enabling : at_once;
  if (clock.awaits_constraint) least = std::min(least, clock.time);
  if (!clock.is_constrained && !clock.queue.is_empty()) least = at_once;
  if (!clock.is_advancing) return least;
  if (!clock.is_constrained || clock.kind == AdvanceKind::flush_queue) return at_once;
  return std::min(least, is_complete(clock.kind) ? just_after(goal(clock)) : goal(clock));
}

/// Enters what follows from a federate's clock into the trees.
void ConservativeTime::weigh(std::uint32_t federate) {
  const Clock& mine = clocks_[federate];
  assert(is_valid_time(mine.time) && is_valid_lookahead(mine.lookahead));
  assert(!mine.is_advancing || mine.asked >= mine.time);
  assert(!mine.awaits_regulation || (mine.is_regulating && mine.enabling >= mine.time));
  assert(!mine.is_regulating || mine.floor >= mine.time);
  assert(!mine.is_constrained || (mine.horizon >= mine.time && !mine.awaits_constraint));
  assert(!mine.is_constrained || mine.queue.next_time() >= mine.horizon);
  const bool may_be_lowered = mine.is_regulating && awaits_message(mine);
  double bound = time_unbounded;
  if (mine.is_regulating)
    bound = may_be_lowered
                ? std::max(mine.floor, earliest_stamp(goal(mine), mine.lookahead, mine.kind))
                : mine.floor;
  bounds_.set(federate, bound);
  floors_.set(federate, may_be_lowered ? mine.floor : time_unbounded);
  lookaheads_.set(federate, may_be_lowered ? mine.lookahead : time_unbounded);
  needs_.set(federate, need(mine));
}

double ConservativeTime::galt(std::uint32_t federate) const {
  const double bound = bounds_.least();
  if (bound == time_unbounded || bounds_.where() != federate) return bound;
  return least_of_others(federate, bound);
}

/// The least time stamp that any other federate can use, where `bound` is the least of all and
/// `federate`'s own: others may answer that federate.
double ConservativeTime::least_of_others(std::uint32_t federate, double bound) const {
  double least = time_unbounded;
  std::size_t open[2 * 64] = {1};  // the nodes still to look at: at most two on each level
  for (std::size_t count = 1; count != 0;) {
    const std::size_t node = open[--count];
    if (std::min(bounds_.node(node),
                 std::max(floors_.node(node), bound + lookaheads_.node(node))) >= least)
      continue;
    if (node < bounds_.width()) {
      assert(count + 2 <= std::size(open));
      open[count++] = 2 * node + 1;
      open[count++] = 2 * node;
    } else if (node - bounds_.width() != federate) {
      const Clock& other = clocks_[node - bounds_.width()];
      const double answer =
          awaits_message(other)
              ? std::max(other.floor, earliest_stamp(bound, other.lookahead, other.kind))
              : time_unbounded;
      least = std::min({least, bounds_.node(node), answer});
    }
  }
  return least;
}

double ConservativeTime::lits(std::uint32_t federate) const {
  return std::min(galt(federate), clock(federate).queue.next_time());
}

bool ConservativeTime::can_serve(std::uint32_t federate) const {
  const double least = needs_[federate];
  return least < time_unbounded && least <= galt(federate);
}

/// All but the federate with the least bound have that bound as their GALT, so only that one and
/// the one with the least need have to be looked at.
void ConservativeTime::settle(TimeListener& listener) {
  for (;;) {
    const auto first = static_cast<std::uint32_t>(needs_.where()),
               slowest = static_cast<std::uint32_t>(bounds_.where());
    if (can_serve(first)) serve(first, listener);
    else if (slowest != first && can_serve(slowest)) serve(slowest, listener);
    else break;
  }
  if constexpr (checks_whole_structures) check();
}

void ConservativeTime::check() const {
  for (const LeastTree* tree : {&bounds_, &floors_, &lookaheads_, &needs_}) {
    tree->check();
    assert(tree->width() == bounds_.width());  // their nodes correspond
  }
  assert(clocks_.size() <= bounds_.width());
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    clocks_[i].queue.check();
    assert(bounds_[i] == time_unbounded || clocks_[i].is_regulating);
    assert(bounds_[i] >= floors_[i] || floors_[i] == time_unbounded);
    assert(needs_[i] == need(clocks_[i]));
  }
}

void ConservativeTime::serve(std::uint32_t federate, TimeListener& listener) {
  assert(federate < clocks_.size());
  Clock& mine = clocks_[federate];
  const double bound = galt(federate);
  if (!mine.is_constrained) deliver(federate, time_unbounded, listener);
  if (mine.awaits_constraint && mine.time <= bound) {
    mine.awaits_constraint = false;
    mine.is_constrained = true;
    mine.horizon = mine.time;
    listener.constrained_enabled(federate, mine.time);
  }
  if (mine.awaits_regulation && (!mine.is_constrained || mine.enabling <= bound)) {
    mine.awaits_regulation = false;
    if (mine.enabling > mine.time) deliver(federate, mine.enabling, listener);
    mine.time = mine.enabling;
    mine.horizon = std::max(mine.horizon, mine.time);
    listener.regulation_enabled(federate, mine.time, mine.floor);
  }
  if (mine.is_advancing) advance(federate, bound, listener);
  weigh(federate);
}

void ConservativeTime::advance(std::uint32_t federate, double galt, TimeListener& listener) {
  Clock& mine = clocks_[federate];
  double granted = goal(mine);
  if (mine.is_constrained && mine.kind == AdvanceKind::flush_queue)
    granted = std::max(mine.time, std::min({mine.asked, mine.queue.next_time(), galt}));
  else if (mine.is_constrained && (is_complete(mine.kind) ? granted >= galt : granted > galt))
    return;
  assert(mine.time <= granted && granted <= mine.asked);  // never back, nor too far
  deliver(federate, mine.kind == AdvanceKind::flush_queue ? time_unbounded : granted, listener);
  mine.is_advancing = false;
  mine.time = granted;
  mine.horizon = std::max(mine.horizon, is_complete(mine.kind) ? just_after(granted) : granted);
  if (mine.is_regulating)
    mine.floor = std::max(mine.floor, earliest_stamp(granted, mine.lookahead, mine.kind));
  listener.grant(federate, granted);
}

/// Delivers all messages that wait for the federate up to and at `until`.
void ConservativeTime::deliver(std::uint32_t federate, double until, TimeListener& listener) {
  TimeQueue& queue = clocks_[federate].queue;
  while (!queue.is_empty() && queue.next_time() <= until) listener.deliver(federate, queue.pop());
}

}  // namespace rink::rti
