// A filter for callers that are not trusted: a faulty call is rejected with a reason and changes
// nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "im/filter.h"
#include "im/matching/rejection.h"

namespace rink::im {

/// Nothing if a scheme with cells can start with `settings`: a world with an area, and a cell size
/// that is positive and finite. For expressions and all else that settings hold: `complaint_about`.
std::optional<Rejection> check(const FilterSettings& settings);

/// Wraps a scheme. Each call returns its fault, or nothing; a call that is rejected changes
/// nothing. `Filter` itself asserts its preconditions.
class CheckedFilter {
 public:
  /// Ids are less than `id_limit`: memory grows with the largest one, so an untrusted caller may
  /// not choose freely.
  CheckedFilter(std::unique_ptr<Filter> filter, std::uint32_t id_limit);

  /// Rejected if the entity exists already, its id is not below the limit, or its region is
  /// invalid.
  std::optional<Rejection> add_entity(Entity entity, const Region& region) {
    return add(Subject::update_region, entities_, entity, region);
  }
  std::optional<Rejection> add_subscriber(Subscriber subscriber, const Region& region) {
    return add(Subject::subscription_region, subscribers_, subscriber, region);
  }
  /// Rejected if the entity does not exist, or its region is invalid.
  std::optional<Rejection> move_entity(Entity entity, const Region& region) {
    return move(Subject::update_region, entities_, entity, region);
  }
  std::optional<Rejection> move_subscriber(Subscriber subscriber, const Region& region) {
    return move(Subject::subscription_region, subscribers_, subscriber, region);
  }
  /// Rejected if it is not there.
  std::optional<Rejection> remove_entity(Entity entity);
  std::optional<Rejection> remove_subscriber(Subscriber subscriber);

  /// Rejected if the subscriber does not exist, or the heading is not finite.
  std::optional<Rejection> turn(Subscriber subscriber, const Heading& heading);
  /// Rejected if it is not there.
  std::optional<Rejection> set_entity_role(Entity entity, const Role& role);
  std::optional<Rejection> set_subscriber_role(Subscriber subscriber, const Role& role);
  /// Rejected if the entity does not exist, or a number of the flight is not finite or beyond
  /// 1e150.
  std::optional<Rejection> fly_entity(Entity entity, const Flight& flight);
  std::optional<Rejection> fly_subscriber(Subscriber subscriber, const Flight& flight);
  /// Rejected if the entity does not exist.
  std::optional<Rejection> note_update(Entity entity);
  /// Rejected if the time is not finite, beyond 1e150 or before the last one.
  std::optional<Rejection> set_time(double now);

  std::span<const Change> match() { return filter_->match(); }
  const Filter& filter() const { return *filter_; }
  Filter& filter() { return *filter_; }

 private:
  using Presence = std::vector<bool>;
  std::optional<Rejection> add(Subject subject, Presence& present, std::uint32_t id,
                               const Region& region);
  std::optional<Rejection> move(Subject subject, Presence& present, std::uint32_t id,
                                const Region& region);
  static std::optional<Rejection> take_away(Subject subject, Presence& present, std::uint32_t id);
  void hand_in(Subject subject, std::uint32_t id, const Region& region);

  std::unique_ptr<Filter> filter_;
  std::uint32_t id_limit_;
  Presence entities_, subscribers_;
  double now_ = 0.0;
};

}  // namespace rink::im
