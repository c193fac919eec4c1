// The stages `nearest` and `top`: of the relevant entities, those of the highest scores, so many
// for each subscriber.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "im/stages/chooser.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

/// A list that is no longer than the count is not scored.
class Rank final : public Chooser {
 public:
  Rank(std::unique_ptr<Filter> inner, std::unique_ptr<PairFunction> score, std::uint32_t count,
       const char* name)
      : Chooser(std::move(inner), score->uses()),
        score_(std::move(score)),
        count_(count),
        name_(name) {
    assert(count_ >= 1);
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({name_, "lists that were ranked", ranked_});
    counts.push_back({name_, "entities left out", left_out_});
  }

 private:
  void choose(Subscriber subscriber, const CandidatePairs::List& list) override {
    if (list.size() <= count_) return is_chosen_.assign(list.size(), true);
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
    pairs_tested_ += size, ++ranked_;
  }

  std::unique_ptr<PairFunction> score_;
  std::uint32_t count_;
  const char* name_;
  std::vector<rink_pair> asked_;
  std::vector<std::uint32_t> order_;
  std::vector<double> scores_, slacks_;
  std::uint64_t ranked_ = 0;
};

}  // namespace

std::unique_ptr<Filter> make_rank(std::unique_ptr<Filter> inner,
                                  std::unique_ptr<PairFunction> score, std::uint32_t count,
                                  const char* name) {
  return std::make_unique<Rank>(std::move(inner), std::move(score), count, name);
}

}  // namespace rink::im
