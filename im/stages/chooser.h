// The base of stages that choose among all relevant entities of a subscriber at once.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "im/composition/parts.h"
#include "im/pairs/parties.h"
#include "im/schemes/candidate_pairs.h"

namespace rink::im {

/// Calls `choose` for a subscriber's list only if the subscriber or an entity of the list moved,
/// changed in what `uses` says, came or went.
class Chooser : public Parts {
 public:
  Chooser(std::unique_ptr<Filter> inner, const PairUses& uses);

  void set_update_region(Entity entity, const Region& region) override;
  void set_subscription_region(Subscriber subscriber, const Region& region) override;
  void remove_entity(Entity entity) override;
  void remove_subscriber(Subscriber subscriber) override;
  void set_entity_role(Entity entity, const Role& role) override;
  void set_subscriber_role(Subscriber subscriber, const Role& role) override;
  void set_entity_facts(Entity entity, const Facts& facts) override;
  void set_subscriber_facts(Subscriber subscriber, const Facts& facts) override;
  void set_heading(Subscriber subscriber, const Heading& heading) override;
  void set_time(double now) override;
  Traits traits() const override;
  std::span<const Change> match() override;

 protected:
  /// Sets `is_chosen_[i]`, false at first, for each i-th entity of `list` that stays relevant. The
  /// list is not empty and ascends by id.
  virtual void choose(Subscriber subscriber, const CandidatePairs::List& list) = 0;

  Parties entities_, subscribers_;
  std::vector<bool> is_chosen_;
  std::uint64_t left_out_ = 0;  ///< entities that were not chosen

 private:
  PairUses uses_;
  CandidatePairs pairs_;
  bool is_older_ = false;
  double now_ = 0.0;
};

}  // namespace rink::im
