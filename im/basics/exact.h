// Sums and products of doubles without rounding, and with a bound of it, for predicates that must
// tell a tie from a near miss.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rink::im {

/// A value and how far it may be from what exact arithmetic gives: the first, cheap answer.
struct Approximate {
  double value = 0.0, error = 0.0;
  Approximate(double number) : value(number) {}
  Approximate(double number, double bound) : value(number), error(bound) {}

  friend Approximate operator+(const Approximate& a, const Approximate& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend Approximate operator-(const Approximate& a, const Approximate& b) {
    return rounded(a.value - b.value, a.error + b.error);
  }
  friend Approximate operator*(const Approximate& a, const Approximate& b) {
    return rounded(a.value * b.value,
                   std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
  }

 private:
  /// Half a unit in the last place is 2^-53; doubled, it covers the rounding of the bound itself. A
  /// product may underflow by less than the least double.
  static Approximate rounded(double value, double error) {
    return {value, (error + 0x1p-52 * std::abs(value)) * (1.0 + 0x1p-49) + 5e-324};
  }
};

/// A sum of doubles that do not overlap, least first, which is the number itself: an expansion
/// (Shewchuk, Discrete & Computational Geometry 18, 1997). Exact as long as no product of parts
/// over- or underflows: with `plain` numbers and products of up to four differences of them.
class Exact {
 public:
  Exact(double number) { append(number); }
  Exact(const Exact& other) : count_(other.count_) {
    std::copy_n(other.parts_.data(), count_, parts_.data());
  }
  Exact& operator=(const Exact&) = delete;

  friend Exact operator+(const Exact& a, const Exact& b);
  friend Exact operator-(const Exact& a, const Exact& b) { return a + b.negated(); }
  friend Exact operator*(const Exact& a, const Exact& b);

  /// -1, 0 or 1: that of the greatest part.
  /// Asserts that no part is zero and each is beyond the rounding of the next.
  void check() const;
  int sign() const { return count_ == 0 ? 0 : parts_[count_ - 1] > 0.0 ? 1 : -1; }

 private:
  /// The square of a product of two differences has 512 parts at most; what is added to it, 64.
  static constexpr std::size_t part_max = 640;

  Exact() = default;
  void append(double part) {
    if (part == 0.0) return;
    assert(count_ < part_max);
    parts_[count_++] = part;
  }
  Exact negated() const;
  void add(double number);

  std::array<double, part_max> parts_;  // only the first `count_` have values
  std::size_t count_ = 0;
};

/// `number`, no larger than 2^200 (1.6e60), and 0 if it is less than 2^-200: four of its like can
/// be multiplied without loss. Never decreases where `number` increases.
inline double plain(double number) {
  if (std::abs(number) < 0x1p-200) return 0.0;
  return std::clamp(number, -0x1p200, 0x1p200);
}

/// The sign of `polynomial(numbers)`, which takes an array of `Approximate` or of `Exact` and is a
/// sum of products of at most four differences of them; all are plain.
template <std::size_t count, class Polynomial>
int sign_of(const std::array<double, count>& numbers, const Polynomial& polynomial) {
  const auto as = [&numbers]<class Real, std::size_t... i>(const Real&, std::index_sequence<i...>) {
    return std::array<Real, count>{Real(numbers[i])...};
  };
  const auto each = std::make_index_sequence<count>();
  const Approximate first = polynomial(as(Approximate(0.0), each));
  if (std::abs(first.value) > first.error) return first.value > 0.0 ? 1 : -1;
  for ([[maybe_unused]] const double number : numbers) assert(number == plain(number));
  return polynomial(as(Exact(0.0), each)).sign();
}

}  // namespace rink::im
