// A filter made of other filters that evaluates a pair again when the decision of one of them
// changes.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "im/composition/pair_states.h"
#include "im/composition/parts.h"

namespace rink::im {

/// The base of filters whose decision about a pair follows from the parts' decisions and from its
/// own last one.
class ReviewedParts : public Parts {
 public:
  explicit ReviewedParts(std::vector<std::unique_ptr<Filter>> parts) : Parts(std::move(parts)) {
    assert(parts_.size() <= PairStates::filter_max);
  }

  void remove_entity(Entity entity) override {
    Parts::remove_entity(entity);
    pairs_.remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    Parts::remove_subscriber(subscriber);
    pairs_.remove_subscriber(subscriber);
  }

 protected:
  /// Lets every part match and calls `decide(subscriber, entity, decisions, was)` for the level of
  /// each pair about which one of them changed its decision. Returns the changes to report.
  /// Where nothing moved, a part has only released pairs whose time was up: what follows from that
  /// is read off decisions that are kept, so no pair counts as tested.
  template <class Decide>
  std::span<const Change> matched(const Decide& decide) {
    std::uint64_t moved = 0;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      pairs_.take(k, parts_[k]->match());
      moved += parts_[k]->counters().regions_moved;
    }
    changes_.clear();
    const std::size_t reviewed = pairs_.review(decide, changes_);
    if (std::exchange(moved_, moved) != moved) pairs_tested_ += reviewed;
    return reported(changes_.span());
  }

  PairStates pairs_;

 private:
  std::uint64_t moved_ = 0;  ///< regions of all parts that had moved by the last match
};

}  // namespace rink::im
