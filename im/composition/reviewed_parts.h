// A filter made of other filters that evaluates a pair again when the decision of one of them
// changes.
#pragma once

#include <cassert>
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
  template <class Decide>
  std::span<const Change> matched(const Decide& decide) {
    for (std::size_t k = 0; k < parts_.size(); ++k) pairs_.take(k, parts_[k]->match());
    changes_.clear();
    pairs_tested_ += pairs_.review(decide, changes_);
    return reported(changes_.span());
  }

  PairStates pairs_;
};

}  // namespace rink::im
