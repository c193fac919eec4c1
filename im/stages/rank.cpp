// The stages `nearest` and `top`: of the relevant entities, those of the highest scores, so many
// for each subscriber.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "im/composition/parts.h"
#include "im/pairs/parties.h"
#include "im/schemes/candidate_pairs.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

/// Ranks a subscriber's list anew when it, or one of its entities, moved, changed in what the score
/// uses, came or went. A list that is no longer than the count is not scored.
class Rank final : public Parts {
 public:
  Rank(std::vector<std::unique_ptr<Filter>> inner, std::unique_ptr<PairFunction> score,
       std::uint32_t count, const char* name)
      : Parts(std::move(inner)),
        score_(std::move(score)),
        uses_(score_->uses()),
        count_(count),
        name_(name),
        entities_(uses_),
        subscribers_(uses_) {
    assert(parts_.size() == 1 && count_ >= 1);
  }

  void set_update_region(Entity entity, const Region& region) override {
    if (entities_.place(entity, region)) pairs_.touch_near(entity);
    Parts::set_update_region(entity, region);
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    if (subscribers_.place(subscriber, region)) pairs_.touch(subscriber);
    Parts::set_subscription_region(subscriber, region);
  }
  void remove_entity(Entity entity) override {
    Parts::remove_entity(entity);
    pairs_.touch_near(entity);
    entities_.remove(entity);
    pairs_.remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    Parts::remove_subscriber(subscriber);
    subscribers_.remove(subscriber);
    pairs_.remove_subscriber(subscriber);
  }
  void set_entity_role(Entity entity, const Role& role) override {
    if (entities_.set_role(entity, role)) pairs_.touch_near(entity);
    Parts::set_entity_role(entity, role);
  }
  void set_subscriber_role(Subscriber subscriber, const Role& role) override {
    if (subscribers_.set_role(subscriber, role)) pairs_.touch(subscriber);
    Parts::set_subscriber_role(subscriber, role);
  }
  void set_entity_facts(Entity entity, const Facts& facts) override {
    if (entities_.set_facts(entity, facts)) pairs_.touch_near(entity);
    Parts::set_entity_facts(entity, facts);
  }
  void set_subscriber_facts(Subscriber subscriber, const Facts& facts) override {
    if (subscribers_.set_facts(subscriber, facts)) pairs_.touch(subscriber);
    Parts::set_subscriber_facts(subscriber, facts);
  }
  void set_heading(Subscriber subscriber, const Heading& heading) override {
    if (subscribers_.set_heading(subscriber, heading)) pairs_.touch(subscriber);
    Parts::set_heading(subscriber, heading);
  }
  void set_time(double now) override {
    if (uses_.age && std::exchange(now_, now) != now) is_older_ = true;
    Parts::set_time(now);
  }
  Traits traits() const override {
    Traits own = Parts::traits();
    own.uses_roles |= uses_.roles, own.uses_headings |= uses_.motion;
    own.uses_facts |= uses_.motion || uses_.age, own.uses_time |= uses_.age;
    return own;
  }
  std::span<const Change> match() override {
    const bool is_stale = entities_.take_stale() | subscribers_.take_stale();
    if (std::exchange(is_older_, false) || is_stale) {
      entities_.age(now_), subscribers_.age(now_);
      for (Subscriber subscriber = 0; subscriber < subscribers_.size(); ++subscriber)
        pairs_.touch(subscriber);
    }
    pairs_.visit_touched(parts_.front()->match(),
                         [this](Subscriber subscriber, const CandidatePairs::List& list) {
                           rank(subscriber, list);
                         });
    changes_.clear();
    pairs_.report(changes_);
    return reported(changes_.span());
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({name_, "lists that were ranked", ranked_});
    counts.push_back({name_, "entities left out", left_out_});
  }

 private:
  void rank(Subscriber subscriber, const CandidatePairs::List& list) {
    is_chosen_.assign(list.size(), list.size() <= count_);
    if (list.size() > count_) choose(subscriber, list);
    for (std::size_t i = 0; i < list.size(); ++i) pairs_.decide(subscriber, i, is_chosen_[i], 0.0f);
  }
  void choose(Subscriber subscriber, const CandidatePairs::List& list) {
    const std::size_t size = list.size();
    asked_.clear(), order_.clear();
    for (std::size_t i = 0; i < size; ++i) {
      asked_.push_back({subscriber, list.entity(i)});
      order_.push_back(static_cast<std::uint32_t>(i));
    }
    scores_.resize(size);
    slacks_.assign(size, 0.0);
    score_->evaluate({subscribers_.data(), entities_.data(), asked_.data(), size}, scores_.data(),
                     slacks_.data());
    for (double& score : scores_)
      if (std::isnan(score)) score = -std::numeric_limits<double>::infinity();
    // The list ascends by id, so of equal scores the earlier place is the smaller id.
    std::nth_element(order_.begin(), order_.begin() + count_ - 1, order_.end(),
                     [this](std::uint32_t a, std::uint32_t b) {
                       return scores_[a] != scores_[b] ? scores_[a] > scores_[b] : a < b;
                     });
    for (std::uint32_t i = 0; i < count_; ++i) is_chosen_[order_[i]] = true;
    pairs_tested_ += size, left_out_ += size - count_, ++ranked_;
  }

  std::unique_ptr<PairFunction> score_;
  PairUses uses_;
  std::uint32_t count_;
  const char* name_;
  Parties entities_, subscribers_;
  CandidatePairs pairs_;
  std::vector<rink_pair> asked_;
  std::vector<std::uint32_t> order_;
  std::vector<double> scores_, slacks_;
  std::vector<bool> is_chosen_;
  bool is_older_ = false;
  double now_ = 0.0;
  std::uint64_t ranked_ = 0, left_out_ = 0;
};

}  // namespace

std::unique_ptr<Filter> make_rank(std::unique_ptr<Filter> inner,
                                  std::unique_ptr<PairFunction> score, std::uint32_t count,
                                  const char* name) {
  std::vector<std::unique_ptr<Filter>> parts;
  parts.push_back(std::move(inner));
  return std::make_unique<Rank>(std::move(parts), std::move(score), count, name);
}

}  // namespace rink::im
