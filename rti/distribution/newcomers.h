// How many new subscriptions one match takes in, counted in the pairs that they make it look at.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>

namespace rink::rti {

/// When thousands subscribe at once, one match that took them all would keep everybody waiting for
/// it, who plays already as well. So a match has room for so many pairs of a new subscription and
/// an object, and subscriptions beyond that wait for later matches, first come first served. It is
/// counted, not timed: the same calls have the same consequences on any machine. While there is
/// room nothing waits.
class Newcomers {
 public:
  explicit Newcomers(std::size_t pairs_max) : pairs_max_(pairs_max), room_(pairs_max) {}

  /// True if nobody waits and the coming match has room for `pairs`, which it then has no more. A
  /// match takes at least one.
  bool admit(std::size_t pairs) {
    if (!waiting_.empty() || !has_room(pairs)) return false;
    take(pairs);
    return true;
  }
  /// The federate's new subscriptions wait. It does not wait yet.
  void wait(std::uint32_t federate) { waiting_.push_back(federate); }
  /// The federate waits no longer, or is gone.
  void forget(std::uint32_t federate) {
    if (!waiting_.empty()) std::erase(waiting_, federate);
  }
  std::size_t waiting_count() const { return waiting_.size(); }

  /// At the beginning of a match: calls `take_in(federate)` for those whose turn has come.
  /// `pairs_of(federate)` is what each makes the match look at.
  template <class PairsOf, class TakeIn>
  void admit_waiting(PairsOf pairs_of, TakeIn take_in) {
    while (!waiting_.empty()) {
      const std::uint32_t federate = waiting_.front();
      const std::size_t pairs = pairs_of(federate);
      if (!has_room(pairs)) return;
      take(pairs);
      waiting_.pop_front();
      take_in(federate);
    }
  }
  /// At its end: for the regions that were new to the filter, which cover `area` [m^2] in all, it
  /// found `found` pairs.
  void end_match(double area, std::size_t found) {
    // Halved at most: a match of regions that found little, as one of the whole plane or before
    // there are objects, must not let in all that wait.
    if (const double seen = static_cast<double>(found) / area; area > 0.0 && seen > 0.0)
      density_ = std::isinf(density_) ? seen : std::max(seen, 0.5 * density_);
    room_ = pairs_max_;
    is_fresh_ = true;
  }
  /// The pairs that a new region of `area` [m^2] is expected to have among `all` objects, by what
  /// those before it had: all of them before any is known.
  std::size_t expected(double area, std::size_t all) const {
    const double pairs = density_ * area;
    return pairs < static_cast<double>(all) ? static_cast<std::size_t>(pairs) + 1 : all;
  }

 private:
  bool has_room(std::size_t pairs) const { return is_fresh_ || pairs <= room_; }
  void take(std::size_t pairs) {
    room_ -= std::min(room_, pairs);
    is_fresh_ = false;
  }

  std::size_t pairs_max_, room_;
  double density_ = std::numeric_limits<double>::infinity();  ///< of pairs [1/m^2]
  bool is_fresh_ = true;               ///< the coming match has taken none yet
  std::deque<std::uint32_t> waiting_;  ///< federates, by arrival
};

}  // namespace rink::rti
