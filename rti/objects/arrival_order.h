// Which of two values of an object was sent later, when they came by different channels.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "im/basics/checked.h"

#include "rti/fom/fom.h"
#include "rti/objects/object_map.h"
#include "rti/wire/datagram.h"

namespace rink::rti {

/// The order (rti/wire/datagram.h) of the newest value of each best-effort attribute of objects in
/// scope. Other objects cost nothing.
class ArrivalOrder {
 public:
  explicit ArrivalOrder(const Fom& fom) {
    for (const ObjectClass& each : fom.object_classes()) {
      best_effort_.push_back(best_effort_attributes(each));
      stride_ = std::max(stride_, best_effort_.back().count());
    }
  }

  AttributeSet best_effort(std::uint16_t object_class) const {
    assert(object_class < best_effort_.size());
    return best_effort_[object_class];
  }
  /// True if some class has such attributes.
  bool has_best_effort() const { return stride_ > 0; }
  bool contains(ObjectHandle object) const { return places_.find(object) != nullptr; }

  /// Adds an object: values older than `order` are out of date from now on.
  void enter(ObjectHandle object, std::uint16_t object_class, std::uint64_t order) {
    if (best_effort_[object_class].is_empty()) return;
    std::uint32_t* place = places_.find(object);
    if (place == nullptr) place = &(places_[object] = take_place());
    for (std::size_t i = 0; i < stride_; ++i) newest_[*place * stride_ + i] = order;
  }
  void leave(ObjectHandle object) {
    const std::uint32_t* place = places_.find(object);
    if (place == nullptr) return;
    free_.push_back(*place);
    places_.erase(object);
    if constexpr (checks_whole_structures) check();
  }
  /// Asserts that each place is free or one object's.
  void check() const {
    std::vector<bool> is_taken(stride_ == 0 ? 0 : newest_.size() / stride_);
    const auto take = [&is_taken](std::uint32_t place) {
      assert(place < is_taken.size() && !is_taken[place]);
      is_taken[place] = true;
    };
    places_.for_each([&](ObjectHandle, std::uint32_t place) { take(place); });
    for (const std::uint32_t place : free_) take(place);
    assert(places_.size() + free_.size() == is_taken.size());
  }
  /// Notes values of `set` that were sent at `order`, and returns the attributes whose values are
  /// not older than the known ones; none for an object that is not in scope.
  AttributeSet accept(ObjectHandle object, std::uint16_t object_class, AttributeSet set,
                      std::uint64_t order) {
    const std::uint32_t* place = places_.find(object);
    if (place == nullptr) return {};
    AttributeSet accepted;
    const AttributeSet best_effort = best_effort_[object_class];
    for (const AttributeHandle attribute : set& best_effort) {
      std::uint64_t& newest = newest_[*place * stride_ + best_effort.rank(attribute)];
      if (order < newest) continue;
      newest = order;
      accepted.insert(attribute);
    }
    return accepted;
  }
  std::size_t memory_bytes() const {
    return places_.memory_bytes() + newest_.capacity() * sizeof newest_[0] +
           free_.capacity() * sizeof free_[0];
  }

 private:
  std::uint32_t take_place() {
    if (free_.empty()) {
      newest_.resize(newest_.size() + stride_);
      return static_cast<std::uint32_t>(newest_.size() / stride_ - 1);
    }
    const std::uint32_t place = free_.back();
    free_.pop_back();
    return place;
  }

  std::vector<AttributeSet> best_effort_;  ///< by class
  std::size_t stride_ = 0;                 ///< the most that a class has
  ObjectMap<std::uint32_t> places_;        ///< of objects in scope
  std::vector<std::uint64_t> newest_;      ///< `stride_` for each place
  std::vector<std::uint32_t> free_;
};

}  // namespace rink::rti
