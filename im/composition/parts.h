// A filter made of other filters, to each of which it forwards every call.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "im/filter.h"
#include "im/matching/buffer.h"

namespace rink::im {

/// The base of combinations and stages, which override what concerns them.
class Parts : public Filter {
 public:
  /// At least one, and none is null.
  explicit Parts(std::vector<std::unique_ptr<Filter>> parts);
  explicit Parts(std::unique_ptr<Filter> only);

  void set_update_region(Entity entity, const Region& region) override;
  void remove_entity(Entity entity) override;
  void set_subscription_region(Subscriber subscriber, const Region& region) override;
  void remove_subscriber(Subscriber subscriber) override;
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override;
  void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                     const Region& to) override;
  void set_heading(Subscriber subscriber, const Heading& heading) override;
  void set_entity_role(Entity entity, const Role& role) override;
  void set_subscriber_role(Subscriber subscriber, const Role& role) override;
  void set_flight(Entity entity, const Flight& flight) override;
  void set_subscriber_flight(Subscriber subscriber, const Flight& flight) override;
  void set_time(double now) override;
  void set_entity_facts(Entity entity, const Facts& facts) override;
  void set_subscriber_facts(Subscriber subscriber, const Facts& facts) override;
  void note_update(Entity entity) override;
  /// They match one after the other, so one worker serves them all.
  void share_with(Worker* worker) override;

  /// Of all parts together.
  Traits traits() const override;
  /// Of the first part.
  std::span<const RelevanceInterval> relevance_intervals() const override {
    return parts_.front()->relevance_intervals();
  }
  PriorityOrder* priority() override { return parts_.front()->priority(); }
  double cell_size() const override;
  /// Moves and tests of all parts, and its own tests; the changes are its own.
  const FilterCounters& counters() const override { return counters_; }
  void list_counts(std::vector<StageCount>& counts) const override;

 protected:
  /// Call it at the end of a match with the changes to report.
  std::span<const Change> reported(std::span<const Change> changes);

  std::vector<std::unique_ptr<Filter>> parts_;
  Buffer<Change> changes_;
  std::uint64_t pairs_tested_ = 0;  ///< by the derived class itself

 private:
  FilterCounters counters_;
};

}  // namespace rink::im
