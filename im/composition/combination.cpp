// Keeps each operand's decision about a pair and evaluates the pair again when one of them changes.
#include "im/composition/combination.h"

#include <algorithm>
#include <cassert>

#include "im/composition/reviewed_parts.h"
#include "im/marks.h"

namespace rink::im {
namespace {

/// True if no step takes more than there is, one answer is left, and every operand exists.
[[maybe_unused]] bool are_sound(const std::vector<Step>& steps, std::size_t operand_count) {
  std::size_t depth = 0;
  for (const Step step : steps) {
    const bool takes_two = step == Step::conjunction || step == Step::alternative;
    if (depth < (takes_two ? 2u : step == Step::negation ? 1u : 0u)) return false;
    if (step < Step::conjunction && static_cast<std::size_t>(step) >= operand_count) return false;
    if (takes_two) --depth;
    else if (step != Step::negation) ++depth;
  }
  return depth == 1;
}

class Combination final : public ReviewedParts {
 public:
  Combination(std::vector<std::unique_ptr<Filter>> operands, std::vector<Step> steps)
      : ReviewedParts(std::move(operands)), steps_(std::move(steps)) {
    assert(are_sound(steps_, parts_.size()));
    assert(parts_.size() <= PairStates::filter_max && !follow(steps_, 0, true) &&
           !follow(steps_, 0, false));
    minds_sweeps_ = std::find(steps_.begin(), steps_.end(), Step::is_still) != steps_.end();
  }

  void set_update_region(Entity entity, const Region& region) override {
    mark_entity(entity, false);
    Parts::set_update_region(entity, region);
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    mark_subscriber(subscriber, false);
    Parts::set_subscription_region(subscriber, region);
  }
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override {
    mark_entity(entity, from != to);
    Parts::set_swept_update_region(entity, from, to);
  }
  void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                     const Region& to) override {
    mark_subscriber(subscriber, from != to);
    Parts::set_swept_subscription_region(subscriber, from, to);
  }
  void remove_entity(Entity entity) override {
    swept_entities_.unset(entity);
    ReviewedParts::remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    swept_subscribers_.unset(subscriber);
    ReviewedParts::remove_subscriber(subscriber);
  }
  std::span<const Change> match() override {
    return matched([this](Subscriber subscriber, Entity entity, PairStates::Decisions decisions,
                          PairStates::Level) {
      return PairStates::Level{follow(
          steps_, decisions, !swept_subscribers_.has(subscriber) && !swept_entities_.has(entity))};
    });
  }

 private:
  void mark_entity(Entity entity, bool is_swept) {
    if (minds_sweeps_ && swept_entities_.set(entity, is_swept)) pairs_.touch_entity(entity);
  }
  void mark_subscriber(Subscriber subscriber, bool is_swept) {
    if (minds_sweeps_ && swept_subscribers_.set(subscriber, is_swept))
      pairs_.touch_subscriber(subscriber);
  }

  std::vector<Step> steps_;
  bool minds_sweeps_;
  Marks swept_entities_, swept_subscribers_;
};

}  // namespace

/// The stack is the bits of a number; an expression of 16 operands needs no more than 17 of them.
bool follow(const std::vector<Step>& steps, std::uint16_t decisions, bool is_still) {
  std::uint32_t stack = 0;
  for (const Step step : steps) {
    const std::uint32_t last = stack & 1u;
    if (step == Step::negation) stack ^= 1u;
    else if (step == Step::conjunction) stack = (stack >> 1) & (~1u | last);
    else if (step == Step::alternative) stack = (stack >> 1) | last;
    else if (step == Step::is_still) stack = stack << 1 | (is_still ? 1u : 0u);
    else stack = stack << 1 | (decisions >> static_cast<unsigned>(step) & 1u);
  }
  assert(stack <= 1);  // one answer is left
  return stack != 0;
}

std::unique_ptr<Filter> make_combination(std::vector<std::unique_ptr<Filter>> operands,
                                         std::vector<Step> steps) {
  return std::make_unique<Combination>(std::move(operands), std::move(steps));
}

}  // namespace rink::im
