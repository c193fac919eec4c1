// What all nodes have played, window by window, on its way from the thread that shares the
// simulation to the one that serves clients.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <deque>
#include <limits>
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
      : changes_(node_count),
        told_(node_count),
        added_(node_count),
        is_closed_(node_count),
        ends_{end} {
    assert(node_count > 0);
  }

  /// Another session begins, whose first stretch ends at `end` [s]; all have told of the one before
  /// it, whose stretches are no longer counted but by taken() (asserted).
  void begin_session(double end) {
    assert(std::ranges::all_of(added_, [this](std::uint64_t count) { return count == added_[0]; }));
    ends_ = {end};
    felt_.clear(), taken_felt_ = 0;
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
    const std::uint64_t stretch = ++added_[node];
    if (felt_.size() < stretch - taken_felt_) felt_.resize(stretch - taken_felt_);
    std::vector<peer::Key>& felt = felt_[stretch - taken_felt_ - 1];
    felt.insert(felt.end(), change.log.begin(), change.log.end());
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

  /// The keys that were felt in stretches of which all have told, each once, in order.
  std::vector<peer::Key> take_felt() {
    std::vector<peer::Key> keys;
    for (; !felt_.empty() && is_whole(taken_felt_ + 1); ++taken_felt_, felt_.pop_front())
      keys.insert(keys.end(), felt_.front().begin(), felt_.front().end());
    return keys;
  }
  /// True if all have told of that stretch, so that nobody can go back behind its end.
  bool is_whole(std::uint64_t stretch) const {
    for (std::size_t node = 0; node < added_.size(); ++node)
      if (!is_closed_[node] && added_[node] < stretch) return false;
    return true;
  }

  /// Of the stretch that ends then [s], which this node has played; 0 at the start.
  std::uint64_t stretch_until(double time) const {
    const auto end = std::ranges::find(ends_, time);
    return end == ends_.end() ? 0 : static_cast<std::uint64_t>(end - ends_.begin()) + 1;
  }
  /// All go back to the end of that stretch. What came of later ones is forgotten, of which none
  /// was whole, and so none was taken: else somebody lies about its step, the answer is false, and
  /// nothing is done. In the first session alone.
  [[nodiscard]] bool rewind(std::uint64_t stretch) {
    assert(stretch < ends_.size());
    const std::lock_guard lock(mutex_);
    if (taken_felt_ > stretch || taken_ > stretch) return false;
    const double time = stretch == 0 ? 0.0 : ends_[stretch - 1];
    for (std::size_t node = 0; node < added_.size(); ++node)
      for (; added_[node] > stretch; --added_[node]) {
        assert(!changes_[node].empty());
        changes_[node].pop_back();
      }
    for (std::size_t node = 0; node < told_.size(); ++node)
      if (!is_closed_[node]) told_[node] = std::min(told_[node], time);
    while (ends_.size() > stretch + 1) ends_.pop_back(), scores_.pop_back();
    if (felt_.size() > stretch - taken_felt_) felt_.resize(stretch - taken_felt_);
    return true;
  }
  /// Nothing more comes of this node, whose last stretch is the last that this one has played.
  void close(peer::PeerNumber node) {
    is_closed_[node] = true;
    const std::lock_guard lock(mutex_);
    told_[node] = std::numeric_limits<double>::infinity();
  }

  bool is_closed(peer::PeerNumber node) const { return is_closed_[node]; }

  /// True if all have told of what they played until then [s].
  bool has_come(double until) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::all_of(told_, [until](double time) { return time >= until; });
  }

  struct Stretch {
    std::vector<peer::PartChange> changes;  ///< by node, without those that were closed before
    peer::Scoring score;                    ///< after it
  };
  /// The earliest stretch, if it is whole and ends by `until` [s].
  std::optional<Stretch> take(double until) {
    const std::lock_guard lock(mutex_);
    for (std::size_t node = 0; node < changes_.size(); ++node) {
      const std::deque<peer::PartChange>& of_node = changes_[node];
      const bool is_over =
          of_node.empty() && told_[node] == std::numeric_limits<double>::infinity();
      if (!is_over && (of_node.empty() || of_node.front().time > until)) return std::nullopt;
    }
    assert(!scores_.empty());
    Stretch stretch{.changes = {}, .score = std::move(scores_.front())};
    scores_.pop_front();
    for (std::deque<peer::PartChange>& of_node : changes_) {
      if (of_node.empty()) continue;
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
  std::vector<double> told_;  ///< by node: until when [s], infinite once it is closed; guarded by
                              ///< `mutex_`
  std::vector<std::uint64_t> added_;         ///< by node
  std::vector<bool> is_closed_;              ///< by node
  std::deque<std::vector<peer::Key>> felt_;  ///< by stretch, after those that were taken
  std::uint64_t taken_felt_ = 0;             ///< stretches
  std::vector<double> ends_;                 ///< by stretch
  std::uint64_t taken_ = 0;
};

}  // namespace rink::game
