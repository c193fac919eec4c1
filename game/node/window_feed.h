// What all nodes have played, window by window, on its way from the thread that shares the
// simulation to the one that serves clients.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "game/peer/session/part_change.h"
#include "game/peer/session/scoring.h"

namespace rink::game {

/// In stretches: a window is cut where a puck comes back. One is whole when the changes of all
/// nodes' own parts in it are there.
class WindowFeed {
 public:
  /// The first stretch ends at `end` [s].
  WindowFeed(peer::PeerNumber node_count, double end)
      : changes_(node_count), told_(node_count), added_(node_count), ends_{end} {
    assert(node_count > 0);
  }

  /// Another session begins, whose first stretch ends at `end` [s]; all have told of the one before
  /// it, whose stretches are no longer counted but by taken() (asserted).
  void begin_session(double end) {
    assert(std::ranges::all_of(added_, [this](std::uint64_t count) { return count == added_[0]; }));
    ends_ = {end};
    std::ranges::fill(added_, 0);
    const std::lock_guard lock(mutex_);
    std::ranges::fill(told_, 0.0);
  }
  /// How many stretches of `node` are there; and the end [s] of the next one that this node plays
  /// or of an earlier one, of which `stretch` counts from 1.
  std::uint64_t count(peer::PeerNumber node) const { return added_[node]; }
  double end_of(std::uint64_t stretch) const {
    assert(stretch > 0 && stretch <= ends_.size());
    return ends_[stretch - 1];
  }
  /// The change of `node` in the stretch after its last one.
  void add(peer::PeerNumber node, peer::PartChange change) {
    assert(node < added_.size() && change.time == end_of(added_[node] + 1));
    ++added_[node];
    const std::lock_guard lock(mutex_);
    told_[node] = change.time;
    changes_[node].push_back(std::move(change));
  }
  /// Of the stretch that this node adds next: the goals of all after it, and the end of the one
  /// after it [s].
  void expect(peer::Scoring score, double next_end) {
    ends_.push_back(next_end);
    const std::lock_guard lock(mutex_);
    scores_.push_back(std::move(score));
  }

  /// True if all have told of what they played until then [s].
  bool has_come(double until) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::all_of(told_, [until](double time) { return time >= until; });
  }

  struct Stretch {
    std::vector<peer::PartChange> changes;  ///< by node
    peer::Scoring score;                    ///< after it
  };
  /// The earliest stretch, if it is whole and ends by `until` [s].
  std::optional<Stretch> take(double until) {
    const std::lock_guard lock(mutex_);
    for (const std::deque<peer::PartChange>& of_node : changes_)
      if (of_node.empty() || of_node.front().time > until) return std::nullopt;
    assert(!scores_.empty());
    Stretch stretch{.changes = {}, .score = std::move(scores_.front())};
    scores_.pop_front();
    for (std::deque<peer::PartChange>& of_node : changes_) {
      stretch.changes.push_back(std::move(of_node.front()));
      of_node.pop_front();
    }
    ++taken_;
    return stretch;
  }
  /// How many stretches of all sessions were taken, by the thread that takes them.
  std::uint64_t taken() const { return taken_; }

 private:
  mutable std::mutex mutex_;
  std::vector<std::deque<peer::PartChange>> changes_;  ///< by node, the earliest first
  std::deque<peer::Scoring> scores_;  ///< the earliest first; `mutex_` guards it and `changes_`
  std::vector<double> told_;          ///< by node: until when [s]; guarded by `mutex_`
  std::vector<std::uint64_t> added_;  ///< by node
  std::vector<double> ends_;          ///< by stretch
  std::uint64_t taken_ = 0;
};

}  // namespace rink::game
