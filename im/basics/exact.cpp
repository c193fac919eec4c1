// Adds and multiplies expansions, part by part.
#include "im/basics/exact.h"

#include "im/basics/checked.h"

namespace rink::im {
namespace {

/// a + b = sum + rest (Knuth).
struct TwoSum {
  double sum, rest;
  TwoSum(double a, double b) : sum(a + b) {
    const double b_part = sum - a, a_part = sum - b_part;
    rest = (a - a_part) + (b - b_part);
  }
};

}  // namespace

/// Grows the expansion by one number; parts that become zero go.
void Exact::add(double number) {
  double carried = number;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const TwoSum two(carried, parts_[i]);
    carried = two.sum;
    if (two.rest != 0.0) parts_[kept++] = two.rest;
  }
  count_ = kept;
  append(carried);
}

void Exact::check() const {
  assert(count_ <= part_max);
  for (std::size_t i = 0; i < count_; ++i) assert(std::isfinite(parts_[i]) && parts_[i] != 0.0);
  // Not overlapping, they add up to the greater of two.
  for (std::size_t i = 1; i < count_; ++i) assert(parts_[i] + parts_[i - 1] != parts_[i - 1]);
  for (std::size_t i = 1; i < count_; ++i) assert(std::abs(parts_[i - 1]) < std::abs(parts_[i]));
}

Exact Exact::negated() const {
  Exact result;
  for (std::size_t i = 0; i < count_; ++i) result.append(-parts_[i]);
  return result;
}

Exact operator+(const Exact& a, const Exact& b) {
  Exact result = a;
  for (std::size_t i = 0; i < b.count_; ++i) result.add(b.parts_[i]);
  if constexpr (checks_whole_structures) result.check();
  return result;
}

/// The rounding error of a product comes from a fused multiply-add, which needs no splitting and is
/// right on every machine.
Exact operator*(const Exact& a, const Exact& b) {
  Exact result;
  for (std::size_t i = 0; i < a.count_; ++i)
    for (std::size_t j = 0; j < b.count_; ++j) {
      const double product = a.parts_[i] * b.parts_[j];
      result.add(std::fma(a.parts_[i], b.parts_[j], -product));
      result.add(product);
    }
  if constexpr (checks_whole_structures) result.check();
  return result;
}

}  // namespace rink::im
