// All pairs of update and subscription regions that overlap, found at once.
#pragma once

#include <span>
#include <vector>

#include "im/filter.h"
#include "im/matching/index/box_index.h"
#include "im/matching/join.h"
#include "im/matching/rejection.h"

namespace rink::im {

/// Matches n closed rectangles with m others, exactly: touching is overlap, to the last bit. Keeps
/// its memory for the next time. The same regions give the same pairs in the same order, whatever
/// the instructions.
class BatchMatcher {
 public:
  explicit BatchMatcher(Instructions instructions = Instructions::best) : join_(instructions) {}

  /// Sets where most regions are [m]; others work too, only slower. An invalid one is rejected and
  /// the one before stays; the first is the unit square.
  std::optional<Rejection> set_world(const Region& world);

  /// Sets a worker that takes half where there is enough to match (`WorthSharing`), or null for
  /// none, as at first. It must outlive the matcher. Pairs and their order are the same.
  void share_with(Worker* worker) { worker_ = worker; }

  /// A region's id is its index. An invalid region is rejected and overlaps nothing.
  void match(std::span<const Region> updates, std::span<const Region> subscriptions);

  // What the last match found, valid until the next.
  std::size_t pair_count() const { return join_.found_count(); }
  /// Calls `take(subscription, updates)` for each subscription, in the order of its place in the
  /// world; `updates` is a span of ids.
  template <class Take>
  void for_each_subscription(const Take& take) const {
    for (std::size_t i = 0; i < join_.asker_count(); ++i) take(join_.asker(i), join_.found(i));
  }
  std::span<const Rejection> rejections() const { return rejections_; }
  /// Pairs compared one by one.
  std::uint64_t pairs_tested() const { return join_.candidate_count(); }
  /// Memory held, the pairs included.
  std::size_t bytes() const { return updates_.bytes() + subscriptions_.bytes() + join_.bytes(); }
  const char* instructions() const { return join_.instructions(); }

 private:
  void stage(std::span<const Region> regions, Subject subject, BoxIndex& index,
             std::vector<Rejection>& rejections) const;

  Region world_{0.0, 0.0, 1.0, 1.0};
  BoxIndex updates_, subscriptions_;
  Join join_;
  std::vector<Rejection> rejections_, other_rejections_;
  Worker* worker_ = nullptr;
};

}  // namespace rink::im
