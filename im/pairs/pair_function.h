// A predicate or score over arrays of pairs: what expressions and plugins are to the filters that
// ask them.
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <utility>

#include "im/pairs/rink_plugin.h"
#include "im/schemes/judgement.h"

namespace rink::im {

/// What a function looks at beside regions.
struct PairUses {
  bool roles = false, motion = false, age = false;
  friend bool operator==(const PairUses&, const PairUses&) = default;
};

class PairFunction {
 public:
  virtual ~PairFunction() = default;
  virtual PairUses uses() const = 0;
  /// Sets `results[i]` for each pair: of a predicate 0 if it is not relevant, else 1; of a score
  /// the score, where one that is no number ranks last. `slacks[i]`, 0 at first, may be set as in
  /// rink_plugin.h.
  virtual void evaluate(const rink_pairs& pairs, double* results, double* slacks) = 0;
};

/// A function of two `rink_party`s, subscriber and entity, that answers a bool, a `Judgement` or a
/// score.
template <class Function>
class PairFunctionOf final : public PairFunction {
 public:
  PairFunctionOf(Function function, const PairUses& uses)
      : function_(std::move(function)), uses_(uses) {}
  PairUses uses() const override { return uses_; }
  void evaluate(const rink_pairs& pairs, double* results, double* slacks) override {
    for (std::size_t i = 0; i < pairs.count; ++i) {
      const auto answer = function_(pairs.subscribers[pairs.pairs[i].subscriber],
                                    pairs.entities[pairs.pairs[i].entity]);
      if constexpr (std::same_as<decltype(answer), const Judgement>)
        results[i] = answer.is_relevant ? 1.0 : 0.0, slacks[i] = answer.slack;
      else results[i] = static_cast<double>(answer);
    }
  }

 private:
  Function function_;
  PairUses uses_;
};

template <class Function>
std::unique_ptr<PairFunction> make_pair_function(Function function, const PairUses& uses = {}) {
  return std::make_unique<PairFunctionOf<Function>>(std::move(function), uses);
}

/// That of a plugin, which must outlive it.
std::unique_ptr<PairFunction> make_plugin_function(const rink_plugin& plugin);

/// The square of the distance between the middles [m^2], negated: the nearest is first.
std::unique_ptr<PairFunction> make_nearness();

}  // namespace rink::im
