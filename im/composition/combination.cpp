// Keeps what each operand says of a pair and looks at the pair again when one of them changes its mind.
#include "im/composition/combination.h"

#include <cassert>

#include "im/composition/reviewed_parts.h"

namespace rink::im {
namespace {

class Combination final : public ReviewedParts {
 public:
  Combination(std::vector<std::unique_ptr<Filter>> operands, std::vector<Step> steps) : ReviewedParts(std::move(operands)), steps_(std::move(steps)) {
    assert(parts_.size() <= PairStates::filter_max && !follow(steps_, 0));
  }

  std::span<const Change> match() override {
    return matched([this](PairStates::Says says, PairStates::Level) { return PairStates::Level{follow(steps_, says)}; });
  }

 private:
  std::vector<Step> steps_;
};

}  // namespace

/// The stack is the bits of a number; an expression of 16 operands needs no more than 16 of them.
bool follow(const std::vector<Step>& steps, std::uint16_t says) {
  std::uint32_t stack = 0;
  for (const Step step : steps) {
    const std::uint32_t last = stack & 1u;
    if (step == Step::negation) stack ^= 1u;
    else if (step == Step::conjunction) stack = (stack >> 1) & (~1u | last);
    else if (step == Step::alternative) stack = (stack >> 1) | last;
    else stack = stack << 1 | (says >> static_cast<unsigned>(step) & 1u);
  }
  return (stack & 1u) != 0;
}

std::unique_ptr<Filter> make_combination(std::vector<std::unique_ptr<Filter>> operands, std::vector<Step> steps) {
  return std::make_unique<Combination>(std::move(operands), std::move(steps));
}

}  // namespace rink::im
